//! Dense, ordered, paged storage of one layer.
//!
//! Dense slots are the fastest store measured and are ordered; pages bound what a sparse or
//! hostile index costs to one page and a pointer table.

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

/// The nodes of a layer by index.
#[derive(Clone, Debug)]
pub(super) struct Slots<T> {
    pages: Vec<Option<Box<[Option<T>; PAGE]>>>,
    len: usize,
}

impl<T> Default for Slots<T> {
    fn default() -> Self {
        Self { pages: Vec::new(), len: 0 }
    }
}

impl<T> Slots<T> {
    pub fn len(&self) -> usize {
        self.len
    }

    pub fn get(&self, index: u32) -> Option<&T> {
        let (page, slot) = split(index);
        self.pages.get(page)?.as_ref()?[slot].as_ref()
    }

    pub fn get_mut(&mut self, index: u32) -> Option<&mut T> {
        let (page, slot) = split(index);
        self.pages.get_mut(page)?.as_mut()?[slot].as_mut()
    }

    /// Puts `value` into an empty slot; gives it back if the slot is taken.
    pub fn insert(&mut self, index: u32, value: T) -> Result<(), T> {
        let (page, slot) = split(index);
        if page >= self.pages.len() {
            self.pages.resize_with(page + 1, || None);
        }
        let page = self.pages[page].get_or_insert_with(|| Box::new([const { None }; PAGE]));
        if page[slot].is_some() {
            return Err(value);
        }
        page[slot] = Some(value);
        self.len += 1;
        Ok(())
    }

    pub fn remove(&mut self, index: u32) -> Option<T> {
        let (page, slot) = split(index);
        let removed = self.pages.get_mut(page)?.as_mut()?[slot].take();
        self.len -= usize::from(removed.is_some());
        removed
    }

    /// In order of index.
    pub fn iter(&self) -> impl Iterator<Item = (u32, &T)> {
        self.pages.iter().enumerate().filter_map(|(n, page)| Some((n, page.as_ref()?))).flat_map(
            |(n, page)| {
                page.iter().enumerate().filter_map(move |(slot, value)| {
                    Some(((n * PAGE + slot) as u32, value.as_ref()?))
                })
            },
        )
    }
}

/// Equal if they hold the same values at the same indices, whatever pages were ever touched.
impl<T: PartialEq> PartialEq for Slots<T> {
    fn eq(&self, other: &Self) -> bool {
        self.len == other.len && self.iter().eq(other.iter())
    }
}

const fn split(index: u32) -> (usize, usize) {
    (index as usize / PAGE, index as usize % PAGE)
}
