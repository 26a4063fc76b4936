//! The unified language: [`ChangeRecord`] (paper, "Scene Graph Updater").

use std::borrow::Cow;

use super::{EvidenceRef, Rejection};
use crate::geometry::{Pose, Size};
use crate::graph::{Label, NodeId};
use crate::time::Stamp;

/// What noticed a change.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Modality {
    /// A person said so.
    Human,
    /// The robot did it.
    Action,
    /// The camera saw it.
    Perception,
    /// Time has passed.
    Time,
}

impl Modality {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Human, Self::Action, Self::Perception, Self::Time];

    /// The word for it in JSON.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Human => "human",
            Self::Action => "action",
            Self::Perception => "perception",
            Self::Time => "time",
        }
    }
}

/// What happened to the object.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Action {
    /// It is there now and was not before.
    Added,
    /// It is elsewhere now.
    Moved,
    /// It is gone, or in the gripper.
    Removed,
}

impl Action {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Added, Self::Moved, Self::Removed];

    /// The word for it in JSON.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Added => "added",
            Self::Moved => "moved",
            Self::Removed => "removed",
        }
    }
}

/// A node by id, by label, or both. In a recorded change at least one is known, except where the
/// claim itself named nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NodeRef {
    /// The id, once it is known which node is meant.
    pub id: Option<NodeId>,
    /// The label, as claimed or as the node has it.
    pub label: Option<Label>,
}

impl NodeRef {
    /// A node known by id.
    pub const fn id(id: NodeId) -> Self {
        Self { id: Some(id), label: None }
    }

    /// A node known by label.
    pub const fn label(label: Label) -> Self {
        Self { id: None, label: Some(label) }
    }

    /// Whether it names nothing.
    pub const fn is_empty(&self) -> bool {
        self.id.is_none() && self.label.is_none()
    }
}

/// `mug O17`, `mug`, `O17` or `something`.
impl std::fmt::Display for NodeRef {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (&self.label, self.id) {
            (Some(label), Some(id)) => write!(f, "{label} {id}"),
            (Some(label), None) => write!(f, "{label}"),
            (None, Some(id)) => write!(f, "{id}"),
            (None, None) => f.write_str("something"),
        }
    }
}

/// When something happened in the world, as opposed to when it was learned.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Occurred {
    /// Not before this, if that is known.
    pub not_before: Option<Stamp>,
    /// Not after this, if that is known.
    pub not_after: Option<Stamp>,
}

impl Occurred {
    /// Exactly at `stamp`.
    pub const fn at(stamp: Stamp) -> Self {
        Self { not_before: Some(stamp), not_after: Some(stamp) }
    }
}

/// What a detector claims: the fields of the unified language and where they come from.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// Which modality noticed it.
    pub modality: Modality,
    /// Name and version of the detector, such as `action/1`.
    pub detector: Cow<'static, str>,
    /// What happened.
    pub action: Action,
    /// To which object.
    pub object: NodeRef,
    /// The room it was in.
    pub source_room: Option<NodeRef>,
    /// The room it is in now.
    pub target_room: Option<NodeRef>,
    /// What it rests on or lies in now; for a removal, what it rested on.
    pub support: Option<NodeRef>,
    /// `world_from_object` now, if measured.
    pub pose: Option<Pose>,
    /// Its bounding box, if measured.
    pub size: Option<Size>,
    /// How sure the detector is, in [0, 1].
    pub confidence: f64,
    /// When it happened in the world.
    pub occurred: Occurred,
    /// For a removal: it is in the gripper, temporarily removed.
    pub held: bool,
    /// What the claim rests on.
    pub evidence: Vec<EvidenceRef>,
}

/// What became of a claim.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// The graph was changed accordingly.
    Applied,
    /// The graph was not changed.
    Rejected {
        /// Stable word for the kind of reason; see [`Rejection::code`].
        code: Cow<'static, str>,
        /// The reason in words.
        reason: String,
    },
}

impl From<Rejection> for Outcome {
    fn from(rejection: Rejection) -> Self {
        Self::Rejected { code: rejection.code().into(), reason: rejection.to_string() }
    }
}

/// One record of the unified language, as written to `/change`.
#[derive(Clone, Debug, PartialEq)]
pub struct ChangeRecord {
    /// Number of the change in its log, from 1; printed `c7`.
    pub seq: u64,
    /// When it was learned: the time of the input that told.
    pub at: Stamp,
    /// What is claimed; once applied, with ids and labels of the nodes found.
    pub claim: Claim,
    /// What became of it.
    pub outcome: Outcome,
}

impl ChangeRecord {
    /// Whether the graph was changed.
    pub fn is_applied(&self) -> bool {
        self.outcome == Outcome::Applied
    }
}
