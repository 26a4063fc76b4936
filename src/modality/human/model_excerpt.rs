//! [`Excerpt`]: the part of a graph that a sentence may be about, small for graphs of any size.
//!
//! A chat server is told what the robot knows, or it could not choose among ids and labels. All
//! of a large graph would cost seconds and money a sentence, and drown what matters. Kept are:
//! objects whose label shares a word with the sentence (those in a room it names first, then
//! those seen last), what left the house and shares a word with it, what was seen or moved last
//! (pronouns mean that), what all these rest on, the rooms of all these and the rooms named, and
//! the commonest labels, so that a synonym can be told.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use crate::change::World;
use crate::graph::{NodeId, Object, Region};
use crate::time::Stamp;

/// Objects that share a word with the sentence, at most.
const NAMED: usize = 24;
/// Objects that were seen last, at most.
const RECENT: usize = 8;
/// Objects that left and share a word with the sentence, at most.
const GONE: usize = 8;
/// Rooms, at most.
const ROOMS: usize = 32;
/// Bytes of labels, at most.
const LABEL_BYTES: usize = 1500;

/// What a model is told of the graph.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Excerpt<'w> {
    /// Rooms.
    pub rooms: Vec<RoomEntry<'w>>,
    /// Objects.
    pub objects: Vec<ObjectEntry<'w>>,
    /// Labels of objects, those above included.
    pub labels: Vec<&'w str>,
}

/// A room.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RoomEntry<'w> {
    /// Its id.
    pub id: String,
    /// Its label.
    pub label: &'w str,
}

/// An object.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ObjectEntry<'w> {
    /// Its id.
    pub id: String,
    /// Its label.
    pub label: &'w str,
    /// Its room, or the last one it was in.
    pub room: String,
    /// What it rests on.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub on: Option<String>,
    /// It left the house.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub gone: bool,
}

impl<'w> Excerpt<'w> {
    /// The part of `world` that `sentence` may be about.
    pub fn of(world: &'w World, sentence: &str) -> Self {
        let words = Words::of(sentence);
        let rooms_named = rooms_named(world, &words);
        let mut chosen = named(world, &words, &rooms_named);
        recent(world, &mut chosen);
        supports(world, &mut chosen);
        let gone = gone(world, &words);
        let known = chosen.iter().chain(&gone);
        let objects: Vec<ObjectEntry<'w>> =
            known.filter_map(|id| Some(entry(*id, world.known(*id)?, world))).collect();
        let labels = labels(world, &objects);
        Self { rooms: rooms(world, &rooms_named, &chosen), objects, labels }
    }
}

/// The words of a text in lower case, each without the endings of the plural.
pub(super) fn words(text: &str) -> Vec<String> {
    let words = text.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    words.map(|word| singular(&word.to_lowercase())).collect()
}

/// The words of a sentence.
struct Words {
    each: BTreeSet<String>,
    /// One after the other, each between spaces.
    text: String,
}

impl Words {
    fn of(sentence: &str) -> Self {
        let words = words(sentence);
        Self { text: format!(" {} ", words.join(" ")), each: words.into_iter().collect() }
    }
}

/// `mugs` and `mug`, `knives` and `knife`, `berries` and `berry` meet; this need not be English.
fn singular(word: &str) -> String {
    let cut = |ending: &str, put: &str| {
        let stem = word.strip_suffix(ending).filter(|stem| stem.chars().count() > 1);
        stem.map(|stem| format!("{stem}{put}"))
    };
    if word.ends_with("ss") {
        return word.to_owned();
    }
    let ends = [("ies", "y"), ("ives", "ife"), ("elves", "elf"), ("xes", "x"), ("ches", "ch")];
    let cuts = ends.iter().chain(&[("shes", "sh"), ("sses", "ss"), ("s", "")]);
    cuts.copied().find_map(|(ending, put)| cut(ending, put)).unwrap_or_else(|| word.to_owned())
}

/// How many words of `label` the sentence has; one more if it has them in a row.
fn overlap(label: &str, sentence: &Words) -> usize {
    let words = words(label);
    let count = words.iter().filter(|word| sentence.each.contains(*word)).count();
    let in_a_row = count > 0 && sentence.text.contains(&format!(" {} ", words.join(" ")));
    // "tvremote" is asked for in two words, "tea pot" in one.
    let joined = sentence.each.contains(&words.concat());
    count.max(usize::from(joined)) + usize::from(in_a_row)
}

/// The rooms that share a word with the sentence, and how many words.
fn rooms_named(world: &World, words: &Words) -> BTreeMap<NodeId, usize> {
    let counted = |(id, room): (NodeId, &Region)| (id, overlap(room.label.as_str(), words));
    world.graph().rooms().map(counted).filter(|(_, count)| *count > 0).collect()
}

/// How many words of each label are in the sentence; labels are few, objects are many.
fn overlaps<'w>(
    objects: impl Iterator<Item = (NodeId, &'w Object)>,
    words: &Words,
) -> Vec<(usize, NodeId, &'w Object)> {
    let mut known: BTreeMap<&str, usize> = BTreeMap::new();
    let found = objects.filter_map(|(id, object)| {
        let label = object.label.as_str();
        let count = *known.entry(label).or_insert_with(|| overlap(label, words));
        (count > 0).then_some((count, id, object))
    });
    found.collect()
}

fn named(world: &World, words: &Words, rooms: &BTreeMap<NodeId, usize>) -> Vec<NodeId> {
    let mut found = overlaps(world.graph().all_objects(), words);
    found.sort_by_key(|(count, id, object)| {
        let here = rooms.get(&object.room).copied();
        (Reverse(*count), Reverse(here), Reverse(object.last_observed), *id)
    });
    found.into_iter().take(NAMED).map(|(_, id, _)| id).collect()
}

fn gone(world: &World, words: &Words) -> Vec<NodeId> {
    let mut found = overlaps(world.all_departed(), words);
    found.sort_by_key(|(count, id, object)| (Reverse(*count), Reverse(object.last_observed), *id));
    found.into_iter().take(GONE).map(|(_, id, _)| id).collect()
}

fn recent(world: &World, chosen: &mut Vec<NodeId>) {
    let mut latest: BTreeSet<(Reverse<Stamp>, NodeId)> = BTreeSet::new();
    for (id, object) in world.graph().all_objects() {
        if !chosen.contains(&id) {
            latest.insert((Reverse(object.last_observed), id));
        }
        if latest.len() > RECENT {
            latest.pop_last();
        }
    }
    chosen.extend(latest.into_iter().map(|(_, id)| id));
}

fn supports(world: &World, chosen: &mut Vec<NodeId>) {
    let below = |id: &NodeId| world.graph().object(*id)?.support;
    let found: BTreeSet<NodeId> = chosen.iter().filter_map(below).collect();
    let new: Vec<NodeId> = found.into_iter().filter(|id| !chosen.contains(id)).collect();
    chosen.extend(new);
}

fn entry<'w>(id: NodeId, object: &'w Object, world: &World) -> ObjectEntry<'w> {
    let gone = world.departed(id).is_some();
    let on = object.support.filter(|_| !gone).map(|id| id.to_string());
    let label = object.label.as_str();
    ObjectEntry { id: id.to_string(), label, room: object.room.to_string(), on, gone }
}

fn rooms<'w>(
    world: &'w World,
    named: &BTreeMap<NodeId, usize>,
    objects: &[NodeId],
) -> Vec<RoomEntry<'w>> {
    let mut first: Vec<(Reverse<usize>, NodeId)> =
        named.iter().map(|(id, count)| (Reverse(*count), *id)).collect();
    first.sort_unstable();
    let of_objects = objects.iter().filter_map(|id| world.known(*id)).map(|object| object.room);
    let all = world.graph().rooms().map(|(id, _)| id);
    let mut seen = BTreeSet::new();
    let ids = first.into_iter().map(|(_, id)| id).chain(of_objects).chain(all);
    ids.filter(|id| seen.insert(*id))
        .filter_map(|id| world.graph().region(id).map(|room| (id, room)))
        .map(|(id, room)| RoomEntry { id: id.to_string(), label: room.label.as_str() })
        .take(ROOMS)
        .collect()
}

/// The labels of the objects chosen, then the commonest others.
fn labels<'w>(world: &'w World, objects: &[ObjectEntry<'w>]) -> Vec<&'w str> {
    let mut counts: BTreeMap<&'w str, usize> = BTreeMap::new();
    for (_, object) in world.graph().all_objects() {
        *counts.entry(object.label.as_str()).or_default() += 1;
    }
    let mut common: Vec<(Reverse<usize>, &'w str)> =
        counts.into_iter().map(|(label, count)| (Reverse(count), label)).collect();
    common.sort_unstable();
    let mut seen = BTreeSet::new();
    let chosen = objects.iter().map(|object| object.label);
    let mut bytes = 0;
    chosen
        .chain(common.into_iter().map(|(_, label)| label))
        .filter(|label| seen.insert(*label))
        .take_while(|label| {
            bytes += label.len() + 3;
            bytes <= LABEL_BYTES
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plural_meets_its_singular() {
        for (plural, one) in [
            ("mugs", "mug"),
            ("knives", "knife"),
            ("shelves", "shelf"),
            ("boxes", "box"),
            ("glasses", "glass"),
            ("glass", "glass"),
            ("watches", "watch"),
            ("dishes", "dish"),
            ("berries", "berry"),
            ("s", "s"),
        ] {
            assert_eq!(singular(plural), one);
        }
    }

    #[test]
    fn a_label_is_found_by_any_of_its_words() {
        let check = |label: &str, sentence: &str, count: usize| {
            assert_eq!(overlap(label, &Words::of(sentence)), count, "{label} in {sentence}");
        };
        check("tv remote", "I put the remotes on the table", 1);
        check("tv_remote", "The TV remote is gone", 3);
        check("tv remote", "The remote of the TV is gone", 2);
        check("tvremote", "The tvremote is gone", 2);
        check("tea pot", "The teapot is gone", 1);
        check("mug", "The smug cat", 0);
        check("чашка", "Где Чашка?", 2);
    }
}
