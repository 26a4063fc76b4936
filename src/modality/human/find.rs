//! From a mention to the nodes it may mean.

use std::collections::{BTreeMap, BTreeSet};

use super::lexicon::{Lexicon, lexicon};
use super::names::{Closeness, Name};
use super::reading::{Mention, Reading};
use crate::change::World;
use crate::graph::{NodeId, Object};

/// Finds the label that means most nearly the same as a noun the lexicon does not connect with
/// any, for example by embeddings.
pub trait LabelSimilarity {
    /// The index of the nearest of `labels` and how near it is, 0 to 1; none if none is near.
    fn nearest(&self, noun: &str, labels: &[&str]) -> Option<(usize, f64)>;
}

/// What is called by what it holds.
const CONTAINERS: [&str; 12] = [
    "bottle", "can", "box", "bag", "jar", "pack", "packet", "carton", "bar", "roll", "tube", "plant",
];

/// A node that may be meant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Candidate {
    pub id: NodeId,
    pub closeness: Closeness,
    /// Adjectives of the mention that its label does not have.
    pub missing: usize,
}

/// Which names are compared how.
#[derive(Clone, Copy)]
pub(super) struct Finder<'a> {
    pub similarity: Option<&'a dyn LabelSimilarity>,
    /// Whether a guess is better than none, as with a task.
    pub guess: bool,
}

/// A mention, split for comparing.
struct Wanted<'a> {
    lexicon: &'a Lexicon,
    noun: Name,
    /// "kitchen counter" without the room, and the room.
    adjectives: Vec<&'a str>,
}

impl<'a> Wanted<'a> {
    fn new(mention: &'a Mention) -> Self {
        let lexicon = lexicon();
        let novelty = &lexicon.words.novelty;
        let adjectives = mention.adjectives.iter().map(String::as_str);
        let adjectives = adjectives.filter(|it| !novelty.contains(*it)).collect();
        Self { lexicon, noun: Name::new(&mention.noun), adjectives }
    }

    /// How closely a label agrees, and how many adjectives it lacks.
    fn compare(&self, label: &str, guess: bool) -> Option<(Closeness, usize)> {
        let full = Name::new(label);
        let core = self.core(&full);
        let own: Vec<&String> = full.words[..full.words.len() - core.words.len()].iter().collect();
        if self.conflicts(&own) {
            return None;
        }
        let has = |it: &&&str| full.words.iter().any(|word| word == *it) || full.key.starts_with(&Name::new(it).key);
        let missing = self.adjectives.len() - self.adjectives.iter().filter(has).count();
        let said: Vec<String> = self.adjectives.iter().map(|it| (*it).to_owned()).chain(self.noun.words.clone()).collect();
        let said = Name::of(said);
        let names = &self.lexicon.names;
        if said.key == full.key || self.noun.key == full.key {
            return Some((Closeness::Same, missing));
        }
        // "old chair" is a chair, whatever it is called by here.
        let with_core = names.compare(&self.noun, &core);
        let with_full = if self.adjectives.is_empty() { None } else { names.compare(&said, &full).filter(|it| *it < Closeness::Compound(0)) };
        let closeness = with_full.or(with_core).or_else(|| names.compare(&self.noun, &full));
        let closeness = closeness.or_else(|| self.part(&core).then_some(Closeness::Part));
        let closeness = if guess { self.usual(&said, &full, closeness) } else { closeness }?;
        Some((closeness, missing))
    }

    /// What people often mean by the words, where nothing closer is known.
    fn usual(&self, said: &Name, label: &Name, known: Option<Closeness>) -> Option<Closeness> {
        let names = &self.lexicon.names;
        let typical = names.typical(said, label).or_else(|| names.typical(&self.noun, label));
        let typical = typical.map(Closeness::Typical);
        let often = || names.often(said, label).or_else(|| names.often(&self.noun, label)).map(Closeness::Often);
        [known, typical].into_iter().flatten().min().or_else(often)
    }

    /// The label without the adjectives it begins with.
    fn core(&self, full: &Name) -> Name {
        let adjectives = &self.lexicon.words.adjectives;
        let last = full.words.len().saturating_sub(1);
        let first = full.words[..last].iter().position(|word| !adjectives.contains(word)).unwrap_or(last);
        Name::of(full.words[first..].to_vec())
    }

    /// A red thing is not the blue one.
    fn conflicts(&self, own: &[&String]) -> bool {
        let words = &self.lexicon.words;
        [&words.colours, &words.sizes].into_iter().any(|list| {
            let said: Vec<&&str> = self.adjectives.iter().filter(|it| list.contains(**it)).collect();
            let has: Vec<&&String> = own.iter().filter(|it| list.contains(**it)).collect();
            !said.is_empty() && !has.is_empty() && !said.iter().any(|it| has.iter().any(|own| own.as_str() == **it))
        })
    }

    /// "toilet tank" of the toilet, "apple slice" of the apple, "glass of water" of the water.
    fn part(&self, label: &Name) -> bool {
        let words = &self.lexicon.words;
        let Some((last, before)) = self.noun.words.split_last() else { return false };
        let part = words.parts.contains(last) || words.partitives.contains(last);
        let held = CONTAINERS.contains(&last.as_str());
        // "the soap" of the soap bottle.
        if let Some((container, what)) = label.words.split_last()
            && !what.is_empty()
            && CONTAINERS.contains(&container.as_str())
            && Name::of(what.to_vec()).key == self.noun.key
        {
            return true;
        }
        if before.is_empty() || !(part || held) {
            return false;
        }
        let whole = Name::of(before.to_vec());
        let closeness = self.lexicon.names.compare(&whole, label);
        closeness.is_some_and(|it| it < Closeness::Kind)
    }
}

impl Finder<'_> {
    /// The objects among `objects` that `mention` may mean, whatever their place.
    pub fn objects<'w>(
        &self,
        mention: &Mention,
        objects: impl Iterator<Item = (NodeId, &'w Object)>,
    ) -> Vec<Candidate> {
        let named = objects.map(|(id, object)| (id, object.label.as_str()));
        self.nodes(mention, named)
    }

    /// The rooms that `mention` may mean.
    pub fn rooms(&self, mention: &Mention, world: &World) -> Vec<Candidate> {
        let named = world.graph().rooms().map(|(id, room)| (id, room.label.as_str()));
        self.nodes(mention, named)
    }

    fn nodes<'w>(
        &self,
        mention: &Mention,
        named: impl Iterator<Item = (NodeId, &'w str)>,
    ) -> Vec<Candidate> {
        let wanted = Wanted::new(mention);
        let mut known: BTreeMap<&str, Option<(Closeness, usize)>> = BTreeMap::new();
        let mut all: Vec<Candidate> = Vec::new();
        let mut labels: Vec<(NodeId, &str)> = Vec::new();
        for (id, label) in named {
            labels.push((id, label));
            let found = *known.entry(label).or_insert_with(|| wanted.compare(label, self.guess));
            if let Some((closeness, missing)) = found {
                all.push(Candidate { id, closeness, missing });
            }
        }
        if all.is_empty() {
            all = self.similar(mention, &labels);
        }
        all.sort_by_key(|it| (it.closeness, it.missing, it.id));
        all
    }

    fn similar(&self, mention: &Mention, labels: &[(NodeId, &str)]) -> Vec<Candidate> {
        let Some(similarity) = self.similarity else { return Vec::new() };
        let distinct: BTreeSet<&str> = labels.iter().map(|it| it.1).collect();
        let distinct: Vec<&str> = distinct.into_iter().collect();
        let Some((nearest, _)) = similarity.nearest(&mention.noun, &distinct) else { return Vec::new() };
        let Some(label) = distinct.get(nearest) else { return Vec::new() };
        let same = labels.iter().filter(|it| it.1 == *label);
        same.map(|(id, _)| Candidate { id: *id, closeness: Closeness::Kind, missing: 0 }).collect()
    }
}

/// The names in `reading` that neither the graph nor the lexicon knows.
pub(super) fn unknown_names(world: &World, reading: &Reading) -> Vec<String> {
    let finder = Finder { similarity: None, guess: false };
    let unknown = |mention: &&Mention| {
        let things = || finder.objects(mention, world.graph().all_objects());
        let departed = || finder.objects(mention, world.all_departed());
        mention.id.is_none()
            && finder.rooms(mention, world).is_empty()
            && things().is_empty()
            && departed().is_empty()
    };
    let mentions = reading.statements.iter().flat_map(|it| {
        let others = [&it.support, &it.source_room, &it.target_room];
        let named = std::iter::once(&it.object).chain(others.into_iter().flatten());
        named.flat_map(|mention| std::iter::once(mention).chain(&mention.at))
    });
    let names: BTreeSet<String> = mentions.filter(unknown).map(|it| it.noun.clone()).collect();
    names.into_iter().collect()
}

/// The closest of `candidates`, which are in order: all that are equally close.
pub(super) fn closest(candidates: &[Candidate]) -> Vec<Candidate> {
    let Some(best) = candidates.first() else { return Vec::new() };
    let as_close = |it: &&Candidate| it.closeness == best.closeness && it.missing == best.missing;
    candidates.iter().filter(as_close).copied().collect()
}
