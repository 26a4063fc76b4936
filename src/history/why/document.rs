//! [`WhyDocument`]: the life of a node in JSON.

use serde::Serialize;

use super::{Entry, Initial, Stale, State, Why};
use crate::document::{ChangeDocument, EventDocument, PrimitiveDocument, RefDocument};
use crate::graph::NodeId;
use crate::history::PlaceDocument;

/// The life of a node.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WhyDocument {
    /// The node.
    pub object: RefDocument,
    /// What concerns it, in order.
    pub events: Vec<EntryDocument>,
    /// How things stand at the end.
    pub state: StateDocument,
    /// How it was in the initial graph, if it was.
    pub initial: Option<InitialDocument>,
    /// The last event that was looked at.
    pub upto: u64,
    /// Others of the same name that never changed.
    pub namesakes: Vec<RefDocument>,
    /// When it became improbable that it was still there.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub stale: Vec<StaleDocument>,
}

/// A report that an object had become improbable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StaleDocument {
    /// Number of the event.
    pub order: u64,
    /// Its time.
    pub at: String,
    /// How probable it was by then that it was still there.
    pub probability: f64,
    /// What it fell below.
    pub threshold: f64,
}

/// How things stand with a node.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StateDocument {
    /// `present`, `held` or `absent`.
    pub presence: &'static str,
    /// Number of the event since which it is so; null if it was never there.
    pub since: Option<u64>,
    /// When that was.
    pub at: Option<String>,
    /// Where it is, or was last.
    pub place: Option<PlaceDocument>,
    /// For an object that is there: how probable it is that it still is.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub probability: Option<f64>,
    /// λ in 1/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub decay_rate: Option<f64>,
    /// Where λ comes from.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub decay_origin: Option<String>,
    /// When it was last added, moved or seen.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub last_observed: Option<String>,
}

/// How a node was at the start.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct InitialDocument {
    /// Number of the event of the initial graph.
    pub order: u64,
    /// Its time.
    pub at: String,
    /// Where the node was.
    pub place: Option<PlaceDocument>,
}

/// One thing that happened to the node, or was said of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EntryDocument {
    /// Number of the event: the transaction, or the rejected change.
    pub order: u64,
    /// What was done; null for a rejected change.
    pub primitive: Option<PrimitiveDocument>,
    /// The change record; null if no change caused it.
    pub change: Option<ChangeDocument>,
    /// What it rests on.
    pub evidence: Vec<EventDocument>,
    /// The inputs among the evidence and behind it.
    pub inputs: Vec<EventDocument>,
    /// Log time.
    pub at: String,
    /// What else the same cause did to the node.
    pub also: Vec<PrimitiveDocument>,
    /// The search that the change began with.
    pub find: Option<PrimitiveDocument>,
    /// The object that the change was about, if the node only went along.
    pub along_with: Option<RefDocument>,
    /// For sightings in a row that told nothing new.
    pub sightings: Option<SightingsDocument>,
}

/// Sightings in a row.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SightingsDocument {
    /// How many.
    pub count: u64,
    /// Number of the last event of them.
    pub last: u64,
    /// Its time.
    pub at: String,
}

impl WhyDocument {
    /// The document of a life.
    pub fn of(why: &Why) -> Self {
        Self {
            object: RefDocument::of(&why.node),
            events: why.entries.iter().map(|it| EntryDocument::of(it, why.node.id)).collect(),
            state: StateDocument::of(&why.state),
            initial: why.initial.as_ref().map(InitialDocument::of),
            upto: why.upto.order,
            namesakes: why.namesakes.iter().map(RefDocument::of).collect(),
            stale: why.stale.iter().map(StaleDocument::of).collect(),
        }
    }
}

impl StateDocument {
    fn of(state: &State) -> Self {
        let belief = state.belief.as_ref();
        Self {
            presence: state.presence.as_str(),
            since: state.since.map(|since| since.order),
            at: state.since.map(|since| since.at.to_string()),
            place: state.place.as_ref().map(PlaceDocument::of),
            probability: belief.map(|it| it.probability),
            decay_rate: belief.map(|it| it.decay_rate),
            decay_origin: belief.map(|it| it.origin.clone()),
            last_observed: belief.map(|it| it.last_observed.to_string()),
        }
    }
}

impl StaleDocument {
    fn of(stale: &Stale) -> Self {
        Self {
            order: stale.moment.order,
            at: stale.moment.at.to_string(),
            probability: stale.probability,
            threshold: stale.threshold,
        }
    }
}

impl InitialDocument {
    fn of(initial: &Initial) -> Self {
        Self {
            order: initial.moment.order,
            at: initial.moment.at.to_string(),
            place: initial.place.as_ref().map(PlaceDocument::of),
        }
    }
}

impl EntryDocument {
    fn of(entry: &Entry, id: Option<NodeId>) -> Self {
        let main = entry.primitive();
        let also = entry.primitives.iter().filter(|it| !main.is_some_and(|main| main == *it));
        Self {
            order: entry.moment.order,
            primitive: main.map(PrimitiveDocument::of),
            change: entry.change.as_ref().map(ChangeDocument::of),
            evidence: entry.evidence.iter().map(EventDocument::of).collect(),
            inputs: entry.inputs.iter().map(EventDocument::of).collect(),
            at: entry.moment.at.to_string(),
            also: also.map(PrimitiveDocument::of).collect(),
            find: entry.find.as_ref().map(PrimitiveDocument::of),
            along_with: RefDocument::maybe(id.and_then(|id| entry.along_with(id))),
            sightings: entry.sightings.map(|it| SightingsDocument {
                count: it.count,
                last: it.last.order,
                at: it.last.at.to_string(),
            }),
        }
    }
}
