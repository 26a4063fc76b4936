//! [`PrimitiveDocument`]: one edit of a graph.

use serde::Serialize;

use super::PoseDocument;
use crate::change::{Departure, Primitive, Sighting};
use crate::geometry::Size;
use crate::graph::{Node, NodeId, Placement};

/// A primitive, told apart by its field `primitive`.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "primitive", rename_all = "snake_case")]
pub enum PrimitiveDocument {
    /// Which node was meant.
    Find {
        /// The label or id asked for.
        query: String,
        /// The room it was looked for in.
        room: Option<String>,
        /// The support it was looked for on.
        support: Option<String>,
        /// Who answers to it.
        candidates: Vec<String>,
        /// Who is meant.
        chosen: Option<String>,
        /// Why.
        reason: String,
    },
    /// A node is there.
    Add {
        /// Its id.
        id: String,
        /// What it is.
        node: NodeDocument,
    },
    /// A node is not there any more.
    Remove {
        /// Its id.
        id: String,
        /// `gone` or `held`.
        to: &'static str,
        /// Since when.
        at: String,
    },
    /// An object is elsewhere.
    Move {
        /// Its id.
        id: String,
        /// Where it is now.
        to: PlacementDocument,
    },
    /// One frame confirmed objects.
    Observe {
        /// When.
        at: String,
        /// Which.
        seen: Vec<SightingDocument>,
    },
    /// How fast an object is expected to move.
    SetDecay {
        /// Its id.
        id: String,
        /// λ in 1/s.
        decay_rate: f64,
        /// Where λ comes from.
        origin: String,
    },
}

/// A node of any layer, told apart by its fields.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum NodeDocument {
    /// An object.
    Object {
        /// Its label.
        label: String,
        /// Its box (w, h, d) in metres.
        size: [f64; 3],
        /// λ in 1/s.
        decay_rate: f64,
        /// Where it is.
        #[serde(flatten)]
        placement: PlacementDocument,
    },
    /// A room, floor or building.
    Region {
        /// Its label.
        label: String,
        /// The centre of its box, if known.
        pose: Option<PoseDocument>,
        /// Its box (w, h, d) in metres, if known.
        size: Option<[f64; 3]>,
        /// The region it belongs to, if known.
        parent: Option<String>,
        /// The rooms it gives access to.
        access_to: Vec<String>,
    },
}

/// Where an object is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlacementDocument {
    /// Id of its room.
    pub room: String,
    /// Id of what it rests on, if known.
    pub support: Option<String>,
    /// Its pose.
    pub pose: PoseDocument,
    /// `measured`, `topological` or `held`.
    pub pose_source: &'static str,
    /// Since when, or when last seen there.
    pub last_observed: String,
}

/// One object that was seen where it was expected.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SightingDocument {
    /// Its id.
    pub id: String,
    /// Its pose, if better known now.
    pub pose: Option<PoseDocument>,
    /// Its size, if better known now.
    pub size: Option<[f64; 3]>,
}

impl PrimitiveDocument {
    /// The document of a primitive.
    pub fn of(primitive: &Primitive) -> Self {
        match primitive {
            Primitive::Find { query, room, support, candidates, chosen, reason } => Self::Find {
                query: query.clone(),
                room: text(*room),
                support: text(*support),
                candidates: candidates.iter().map(NodeId::to_string).collect(),
                chosen: text(*chosen),
                reason: reason.clone(),
            },
            Primitive::Add { id, node } => {
                Self::Add { id: id.to_string(), node: NodeDocument::of(node) }
            }
            Primitive::Remove { id, to, at } => {
                let to = match to {
                    Departure::Gone => "gone",
                    Departure::Held => "held",
                };
                Self::Remove { id: id.to_string(), to, at: at.to_string() }
            }
            Primitive::Move { id, to } => {
                Self::Move { id: id.to_string(), to: PlacementDocument::of(to) }
            }
            Primitive::Observe { at, seen } => Self::Observe {
                at: at.to_string(),
                seen: seen.iter().map(SightingDocument::of).collect(),
            },
            Primitive::SetDecay { id, decay_rate, origin } => Self::SetDecay {
                id: id.to_string(),
                decay_rate: *decay_rate,
                origin: origin.clone(),
            },
        }
    }
}

impl NodeDocument {
    /// The document of a node.
    pub fn of(node: &Node) -> Self {
        match node {
            Node::Object(object) => Self::Object {
                label: object.label.to_string(),
                size: object.size.metres(),
                decay_rate: object.decay_rate,
                placement: PlacementDocument::of(&Placement::of(object)),
            },
            Node::Region(region, access) => Self::Region {
                label: region.label.to_string(),
                pose: region.extent.as_ref().map(|(pose, _)| PoseDocument::of(pose)),
                size: region.extent.map(|(_, size)| size.metres()),
                parent: text(region.parent),
                access_to: access.iter().map(NodeId::to_string).collect(),
            },
        }
    }
}

impl PlacementDocument {
    /// The document of a placement.
    pub fn of(placement: &Placement) -> Self {
        Self {
            room: placement.room.to_string(),
            support: text(placement.support),
            pose: PoseDocument::of(&placement.pose),
            pose_source: placement.pose_source.as_str(),
            last_observed: placement.at.to_string(),
        }
    }
}

impl SightingDocument {
    /// The document of a sighting.
    pub fn of(sighting: &Sighting) -> Self {
        Self {
            id: sighting.id.to_string(),
            pose: sighting.pose.as_ref().map(PoseDocument::of),
            size: sighting.size.map(Size::metres),
        }
    }
}

fn text(id: Option<NodeId>) -> Option<String> {
    id.map(|id| id.to_string())
}
