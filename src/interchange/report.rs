//! [`Import`]: what an import gives; [`ImportReport`]: what it did with what it was given.

use std::collections::BTreeMap;
use std::fmt;

use serde::Serialize;

use crate::event::Event;
use crate::graph::SceneGraph;
use crate::time::Stamp;

/// A graph, and what happened to it, as read from elsewhere.
#[derive(Clone, Debug, PartialEq)]
pub struct Import {
    /// The graph at the start.
    pub graph: SceneGraph,
    /// When that was.
    pub start: Stamp,
    /// Input events after the start, in order; times never run backwards.
    pub inputs: Vec<(Stamp, Event)>,
    /// What was taken, left out and made up.
    pub report: ImportReport,
}

/// What an import took, left out and made up.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct ImportReport {
    /// How many of what: `objects`, `places skipped`, …
    pub counts: BTreeMap<String, u64>,
    /// What is worth saying in words.
    pub notes: Vec<String>,
}

impl ImportReport {
    /// Counts `n` more of `what`.
    pub(super) fn count(&mut self, what: &str, n: u64) {
        if n > 0 {
            *self.counts.entry(what.to_owned()).or_default() += n;
        }
    }

    /// Adds a note.
    pub(super) fn note(&mut self, words: impl Into<String>) {
        self.notes.push(words.into());
    }

    /// Counts the nodes of the graph.
    pub(super) fn count_graph(&mut self, graph: &SceneGraph) {
        use crate::graph::Layer;
        self.count("objects", graph.object_count() as u64);
        self.count("rooms", graph.rooms().count() as u64);
        self.count("floors", graph.regions(Layer::Floor).count() as u64);
        self.count("buildings", graph.regions(Layer::Building).count() as u64);
        self.count(
            "supports",
            graph.all_objects().filter(|(_, o)| o.support.is_some()).count() as u64,
        );
        self.count("accesses", graph.access().count() as u64);
    }
}

/// One line of counts, then one line per note.
impl fmt::Display for ImportReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let counts: Vec<String> =
            self.counts.iter().map(|(what, n)| format!("{n} {what}")).collect();
        f.write_str(&counts.join(", "))?;
        self.notes.iter().try_for_each(|note| write!(f, "\n{note}"))
    }
}
