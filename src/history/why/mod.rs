//! The life of a node: every change that concerns it, with the evidence and the inputs behind it.
//!
//! The log is walked twice (three times for a label): to find who is meant, to collect what
//! concerns that node, and to fetch the events that the evidence points to. Memory grows with the
//! node's own history and the graph, not with the log; sightings that told nothing new are
//! counted, not kept.

mod collect;
mod document;
mod fetch;
mod select;
mod story;
mod text;

pub use document::{EntryDocument, InitialDocument, SightingsDocument, StateDocument, WhyDocument};
pub use select::{Candidate, Presence, Selector};

use std::fmt;
use std::str::FromStr;

use super::{EventLog, FoldError, Place};
use crate::change::{Cause, ChangeRecord, NodeRef, Primitive};
use crate::event::Logged;
use crate::graph::NodeId;
use crate::time::Stamp;

/// The life of a node up to an event.
#[derive(Clone, Debug, PartialEq)]
pub struct Why {
    /// The node, with its label at the end.
    pub node: NodeRef,
    /// How things stand at the end.
    pub state: State,
    /// The end: the last event that was looked at.
    pub upto: Moment,
    /// The initial graph, if the node was in it.
    pub initial: Option<Initial>,
    /// What concerns the node, in order.
    pub entries: Vec<Entry>,
    /// When it became improbable, in order.
    pub stale: Vec<Stale>,
    /// Others of the same name that never changed.
    pub namesakes: Vec<NodeRef>,
}

/// An event and its time.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Moment {
    /// Event number.
    pub order: u64,
    /// Log time.
    pub at: Stamp,
}

impl Moment {
    /// When `logged` was logged.
    pub fn of(logged: &Logged) -> Self {
        Self { order: logged.order, at: logged.at }
    }
}

/// How the node was at the start.
#[derive(Clone, Debug, PartialEq)]
pub struct Initial {
    /// The event of the initial graph.
    pub moment: Moment,
    /// Where it was; nothing for a region.
    pub place: Option<Place>,
}

/// How things stand with the node at the end.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// What became of it.
    pub presence: Presence,
    /// Since which event; nothing if it was never there.
    pub since: Option<Moment>,
    /// Where it is; while held or absent, where it was last. Nothing for a region.
    pub place: Option<Place>,
    /// How probable it is that it is still there; nothing for a region, or what is not there.
    pub belief: Option<Belief>,
}

/// How far it is to be believed that an object is where the graph says.
#[derive(Clone, Debug, PartialEq)]
pub struct Belief {
    /// p(static) = 2 / (1 + e^{λΔt}) at the end (paper, "Time").
    pub probability: f64,
    /// λ in 1/s.
    pub decay_rate: f64,
    /// Where λ comes from, in words.
    pub origin: String,
    /// When the object was last added, moved or seen.
    pub last_observed: Stamp,
}

/// A report that the object had become improbable: a target to look at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stale {
    /// The event.
    pub moment: Moment,
    /// How probable it was by then that it was still there.
    pub probability: f64,
    /// What it fell below.
    pub threshold: f64,
}

/// One thing that happened to the node, or was said of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The event: the transaction, or the rejected change.
    pub moment: Moment,
    /// What was done to the node. Nothing if the change was rejected.
    pub primitives: Vec<Primitive>,
    /// The `Find` that the change began with.
    pub find: Option<Primitive>,
    /// What caused it; nothing for a rejected change.
    pub cause: Option<Cause>,
    /// The change record.
    pub change: Option<ChangeRecord>,
    /// Where the node was before; nothing if it was not there, or is a region.
    pub before: Option<Place>,
    /// Where the node is after it.
    pub after: Option<Place>,
    /// Whether the node was known before, there or not.
    pub known_before: bool,
    /// For sightings that told nothing new: how many there were in a row.
    pub sightings: Option<Sightings>,
    /// The events that the cause or the change points to, as far as the log has them.
    pub evidence: Vec<Logged>,
    /// The inputs among the evidence and behind it, in order.
    pub inputs: Vec<Logged>,
}

/// Sightings in a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sightings {
    /// How many.
    pub count: u64,
    /// The last of them.
    pub last: Moment,
}

impl Entry {
    /// Whether it is a claim that was not believed.
    pub fn is_rejected(&self) -> bool {
        self.change.as_ref().is_some_and(|change| !change.is_applied())
    }

    /// The primitive that tells most: an Add, Remove or Move if there is one.
    pub fn primitive(&self) -> Option<&Primitive> {
        let decisive = |it: &&Primitive| is_decisive(it);
        self.primitives.iter().find(decisive).or(self.primitives.first())
    }

    /// The object that the change was about, if the node only went along.
    pub fn along_with(&self, id: NodeId) -> Option<&NodeRef> {
        let object = &self.change.as_ref().filter(|change| change.is_applied())?.claim.object;
        (object.id != Some(id)).then_some(object)
    }
}

/// Whether a primitive says that a node is there, gone or elsewhere.
pub(super) fn is_decisive(primitive: &Primitive) -> bool {
    matches!(primitive, Primitive::Add { .. } | Primitive::Remove { .. } | Primitive::Move { .. })
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum WhyError<E> {
    /// The log cannot be read.
    #[error("{0}")]
    Log(E),
    /// The log cannot be folded.
    #[error(transparent)]
    Fold(#[from] FoldError),
    /// Nothing in the log answers to the id or the label.
    #[error("nothing in the log is called {wanted}{}", suggestion(.similar))]
    Unknown {
        /// What was asked for.
        wanted: String,
        /// What it may have meant: labels in the log, most similar first.
        similar: Vec<String>,
    },
    /// Several nodes of the label have a history.
    #[error("{wanted} may be any of these, so give an id:{}", list(.candidates))]
    Ambiguous {
        /// What was asked for.
        wanted: String,
        /// Who it may be, in order of id.
        candidates: Vec<Candidate>,
    },
}

fn suggestion(similar: &[String]) -> String {
    match similar {
        [] => String::new(),
        labels => {
            let quoted: Vec<String> = labels.iter().map(|label| format!("{label:?}")).collect();
            format!("; did you mean {}?", quoted.join(" or "))
        }
    }
}

fn list(candidates: &[Candidate]) -> String {
    const SHOWN: usize = 20;
    let shown = candidates.iter().take(SHOWN).map(|candidate| format!("\n  {candidate}"));
    let rest = candidates.len().saturating_sub(SHOWN);
    let more = if rest > 0 { format!("\n  and {rest} more") } else { String::new() };
    shown.collect::<String>() + &more
}

/// Tells the life of `who` up to event `upto`.
///
/// # Errors
/// [`WhyError`] if the log cannot be read or folded, or if it is not clear who is meant.
pub fn why<L: EventLog>(log: &L, upto: u64, who: &Selector) -> Result<Why, WhyError<L::Error>> {
    let (id, namesakes) = select::select(log, upto, who)?;
    let mut why = collect::collect(log, upto, id)?;
    why.namesakes = namesakes;
    fetch::fetch(log, &mut why).map_err(WhyError::Log)?;
    Ok(why)
}

impl FromStr for Selector {
    type Err = std::convert::Infallible;

    /// An id if it has the form of one, else a label.
    fn from_str(text: &str) -> Result<Self, Self::Err> {
        Ok(text.parse().map_or_else(|_| Self::Label(text.to_owned()), Self::Id))
    }
}

impl fmt::Display for Selector {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Id(id) => write!(f, "{id}"),
            Self::Label(label) => write!(f, "{label:?}"),
        }
    }
}
