//! Why a claim is not applied: a value, recorded with the change.

use super::{NodeRef, WorldError};
use crate::graph::{Label, NodeId};

/// Why a change record was rejected. The graph is unchanged in every case.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Rejection {
    /// The claim names no object.
    #[error("the claim names no object")]
    NothingNamed,
    /// No object answers to the name.
    #[error("no such object known: {wanted}{where_}")]
    UnknownObject {
        /// What was asked for.
        wanted: NodeRef,
        /// ` in the kitchen`, ` on the table`, or empty.
        where_: String,
    },
    /// The id and the label name different things.
    #[error("{id} is a {label}, not a {claimed}")]
    Contradiction {
        /// The id.
        id: NodeId,
        /// What it is.
        label: Label,
        /// What it is said to be.
        claimed: Label,
    },
    /// Several do.
    #[error("{wanted} is ambiguous: {}", join(.candidates))]
    Ambiguous {
        /// What was asked for.
        wanted: NodeRef,
        /// Who answers to it.
        candidates: Vec<NodeId>,
    },
    /// Several do, and what was said tells them apart no further.
    #[error("{wanted} is ambiguous: {}. {question}", join(.candidates))]
    WhichOne {
        /// What was asked for.
        wanted: NodeRef,
        /// Who answers to it.
        candidates: Vec<NodeId>,
        /// What to ask whoever said it.
        question: String,
    },
    /// What answers to the name is elsewhere.
    #[error("no such object known: {wanted} {where_}. {question}")]
    NotThere {
        /// What was asked for.
        wanted: NodeRef,
        /// Where it is said to have been, `in the kitchen`.
        where_: String,
        /// Who answers to the name elsewhere.
        known: Vec<NodeId>,
        /// What to ask whoever said it.
        question: String,
    },
    /// More are spoken of than are known.
    #[error("{said} × {wanted} are spoken of, but only {} known: {}", .known.len(), join(.known))]
    TooFew {
        /// What was asked for.
        wanted: NodeRef,
        /// How many are spoken of.
        said: u32,
        /// Who answers to it.
        known: Vec<NodeId>,
    },
    /// No room answers to the name.
    #[error("no such room known: {wanted}")]
    UnknownRoom {
        /// What was asked for.
        wanted: NodeRef,
    },
    /// The thing to put it on is not there, and no room is named either.
    #[error("no such support known: {wanted}")]
    UnknownSupport {
        /// What was asked for.
        wanted: NodeRef,
    },
    /// A move or an addition to nowhere.
    #[error("neither a room, a support nor a pose says where {object} is now")]
    NoTarget {
        /// The object.
        object: NodeRef,
    },
    /// The object is there already.
    #[error("{object} is already in the graph, in {room}")]
    AlreadyPresent {
        /// The object.
        object: NodeRef,
        /// Its room.
        room: NodeRef,
    },
    /// The object left before.
    #[error("{object} is not in the graph: it was removed before")]
    AlreadyAbsent {
        /// The object.
        object: NodeRef,
    },
    /// The object is in the gripper.
    #[error("{object} is already in the gripper")]
    AlreadyHeld {
        /// The object.
        object: NodeRef,
    },
    /// A status speaks of a task nobody announced, and names no object.
    #[error("no task {task:?} was announced, and the status names no object")]
    UnknownTask {
        /// The id of the task.
        task: String,
    },
    /// A task ended badly while something was in the gripper.
    #[error("task {task:?} failed after the pick: {object} stays in the gripper")]
    FailedHolding {
        /// The id of the task.
        task: String,
        /// What is held.
        object: NodeRef,
    },
    /// A task says it is done but never placed what it holds.
    #[error("task {task:?} is done but never placed {object}: it stays in the gripper")]
    DoneHolding {
        /// The id of the task.
        task: String,
        /// What is held.
        object: NodeRef,
    },
    /// Placing what a rejected pick left unknown.
    #[error("task {task:?} placed what it picked, but which object that was is ambiguous: {}",
            join(.candidates))]
    PlacedAmbiguous {
        /// The id of the task.
        task: String,
        /// What it may have been.
        candidates: Vec<NodeId>,
    },
    /// Nothing can be put on what is in the gripper.
    #[error("{support} is in the gripper: nothing can be put on it")]
    SupportHeld {
        /// The would-be support.
        support: NodeRef,
    },
    /// The graph itself refused.
    #[error("the graph refuses: {0}")]
    Refused(#[from] WorldError),
}

impl Rejection {
    /// Stable word for the kind of reason, for machines.
    pub const fn code(&self) -> &'static str {
        match self {
            Self::NothingNamed => "nothing_named",
            Self::UnknownObject { .. } => "unknown_object",
            Self::Contradiction { .. } => "contradiction",
            Self::Ambiguous { .. } | Self::WhichOne { .. } => "ambiguous",
            Self::NotThere { .. } => "not_there",
            Self::TooFew { .. } => "too_few",
            Self::UnknownRoom { .. } => "unknown_room",
            Self::UnknownSupport { .. } => "unknown_support",
            Self::NoTarget { .. } => "no_target",
            Self::AlreadyPresent { .. } => "already_present",
            Self::AlreadyAbsent { .. } => "already_absent",
            Self::AlreadyHeld { .. } => "already_held",
            Self::UnknownTask { .. } => "unknown_task",
            Self::FailedHolding { .. } => "failed_holding",
            Self::DoneHolding { .. } => "done_holding",
            Self::PlacedAmbiguous { .. } => "placed_ambiguous",
            Self::SupportHeld { .. } => "support_held",
            Self::Refused(_) => "refused",
        }
    }
}

fn join(ids: &[NodeId]) -> String {
    let shown: Vec<String> = ids.iter().take(12).map(NodeId::to_string).collect();
    let rest = ids.len().saturating_sub(shown.len());
    let more = if rest > 0 { format!(" and {rest} more") } else { String::new() };
    shown.join(", ") + &more
}
