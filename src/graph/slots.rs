//! Dense, ordered storage of one layer.
//!
//! Ids are dense per layer, so slots by index are the fastest store measured and are ordered.
//! The slots hold places in an arena instead of nodes, so that a sparse or hostile index costs a
//! page of small numbers and not a page of nodes.

use super::{Object, Region};

/// An object and what depends on it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ObjectSlot {
    pub object: Object,
    /// How many objects that are not held name this one as their support.
    pub resting: u32,
    /// How many held objects do.
    pub resting_held: u32,
}

/// A region and how many nodes belong to it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct RegionSlot {
    pub region: Region,
    pub children: u32,
}

const PAGE: usize = 64;
/// The place of an index that is not in use.
const NOWHERE: u32 = u32::MAX;

/// The nodes of a layer by index.
#[derive(Clone, Debug)]
pub(super) struct Slots<T> {
    /// Places by index.
    pages: Vec<Option<Box<[u32; PAGE]>>>,
    arena: Vec<Option<T>>,
    /// Places that are free again.
    free: Vec<u32>,
}

impl<T> Default for Slots<T> {
    fn default() -> Self {
        Self { pages: Vec::new(), arena: Vec::new(), free: Vec::new() }
    }
}

impl<T> Slots<T> {
    pub fn len(&self) -> usize {
        self.arena.len() - self.free.len()
    }

    /// The place of an index in use: smaller than [`Self::places`] and that of no other index.
    pub fn place(&self, index: u32) -> Option<usize> {
        let (page, slot) = split(index);
        let place = self.pages.get(page)?.as_ref()?[slot];
        (place != NOWHERE).then_some(place as usize)
    }

    /// How many places there are, used or free.
    pub fn places(&self) -> usize {
        self.arena.len()
    }

    pub fn get(&self, index: u32) -> Option<&T> {
        self.arena.get(self.place(index)?)?.as_ref()
    }

    pub fn get_mut(&mut self, index: u32) -> Option<&mut T> {
        let place = self.place(index)?;
        self.arena.get_mut(place)?.as_mut()
    }

    /// Puts `value` into an empty slot; gives it back if the slot is taken.
    pub fn insert(&mut self, index: u32, value: T) -> Result<(), T> {
        let (page, slot) = split(index);
        if page >= self.pages.len() {
            self.pages.resize_with(page + 1, || None);
        }
        let page = self.pages[page].get_or_insert_with(|| Box::new([NOWHERE; PAGE]));
        if page[slot] != NOWHERE {
            return Err(value);
        }
        if let Some(place) = self.free.pop() {
            page[slot] = place;
            self.arena[place as usize] = Some(value);
        } else {
            page[slot] = self.arena.len() as u32;
            self.arena.push(Some(value));
        }
        Ok(())
    }

    pub fn remove(&mut self, index: u32) -> Option<T> {
        let place = self.place(index)?;
        let (page, slot) = split(index);
        self.pages[page].as_mut()?[slot] = NOWHERE;
        self.free.push(place as u32);
        self.arena[place].take()
    }

    /// In order of index.
    pub fn iter(&self) -> impl Iterator<Item = (u32, &T)> {
        self.pages.iter().enumerate().filter_map(|(n, page)| Some((n, page.as_ref()?))).flat_map(
            move |(n, page)| {
                page.iter().enumerate().filter_map(move |(slot, place)| {
                    // Looked up even where it is nowhere: no place is as large as that.
                    let value = self.arena.get(*place as usize)?.as_ref()?;
                    Some(((n * PAGE + slot) as u32, value))
                })
            },
        )
    }
}

/// Equal if they hold the same values at the same indices, whatever pages were ever touched.
impl<T: PartialEq> PartialEq for Slots<T> {
    fn eq(&self, other: &Self) -> bool {
        self.len() == other.len() && self.iter().eq(other.iter())
    }
}

const fn split(index: u32) -> (usize, usize) {
    (index as usize / PAGE, index as usize % PAGE)
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use proptest::collection::vec;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn slots_hold_what_an_ordered_map_holds(edits in vec((0..300_u32, any::<bool>()), 0..200)) {
            let (mut slots, mut map) = (Slots::default(), BTreeMap::new());
            for (n, (index, insert)) in edits.into_iter().enumerate() {
                if insert {
                    let free = !map.contains_key(&index);
                    prop_assert_eq!(slots.insert(index, n), if free { Ok(()) } else { Err(n) });
                    map.entry(index).or_insert(n);
                } else {
                    prop_assert_eq!(slots.remove(index), map.remove(&index));
                }
                prop_assert_eq!(slots.get(index), map.get(&index));
                prop_assert_eq!(slots.len(), map.len());
            }
            prop_assert!(slots.iter().eq(map.iter().map(|(index, value)| (*index, value))));
        }
    }
}
