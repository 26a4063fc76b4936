//! What several documents are made of: references, poses, evidence, intervals.

use serde::Serialize;

use crate::change::{EvidenceRef, NodeRef, Occurred};
use crate::geometry::Pose;

/// A node by id, by label, or both.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct RefDocument {
    /// Its id, if it is known which node is meant.
    pub id: Option<String>,
    /// Its label, if known.
    pub label: Option<String>,
}

impl RefDocument {
    /// The document of a reference.
    pub fn of(node: &NodeRef) -> Self {
        Self {
            id: node.id.map(|id| id.to_string()),
            label: node.label.as_ref().map(ToString::to_string),
        }
    }

    /// The document of a reference that may be missing.
    pub fn maybe(node: Option<&NodeRef>) -> Option<Self> {
        node.map(Self::of)
    }
}

/// A pose in the world frame.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PoseDocument {
    /// (x, y, z) in metres.
    pub position: [f64; 3],
    /// Rotation from the node's frame to the world.
    pub orientation: OrientationDocument,
}

/// A unit quaternion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct OrientationDocument {
    /// Scalar part.
    pub w: f64,
    /// Vector part.
    pub x: f64,
    /// Vector part.
    pub y: f64,
    /// Vector part.
    pub z: f64,
}

impl PoseDocument {
    /// The document of a pose.
    pub fn of(pose: &Pose) -> Self {
        let [w, x, y, z] = pose.orientation();
        let orientation = OrientationDocument { w, x, y, z };
        Self { position: pose.position(), orientation }
    }
}

/// A message of the same log.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct EvidenceDocument {
    /// Its topic.
    pub topic: String,
    /// Its event number.
    pub order: u64,
}

impl EvidenceDocument {
    /// The document of a reference to a message.
    pub fn of(reference: &EvidenceRef) -> Self {
        Self { topic: reference.topic.to_string(), order: reference.order }
    }
}

/// When something happened in the world.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct OccurredDocument {
    /// Not before this, if known.
    pub not_before: Option<String>,
    /// Not after this, if known.
    pub not_after: Option<String>,
}

impl OccurredDocument {
    /// The document of an interval.
    pub fn of(occurred: &Occurred) -> Self {
        Self {
            not_before: occurred.not_before.map(|at| at.to_string()),
            not_after: occurred.not_after.map(|at| at.to_string()),
        }
    }
}
