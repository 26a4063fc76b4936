//! The inputs of a log, and what was understood of them.

use std::sync::Arc;

use crate::change::{EvidenceRef, NodeRef};
use crate::geometry::Pose;

/// Somebody said something.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Utterance {
    /// Who, as far as known.
    pub speaker: String,
    /// The words.
    pub text: String,
}

/// What the robot is to do. What the planner does not give is understood from the instruction.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Task {
    /// Names the task in its statuses.
    pub task_id: String,
    /// The words it was given in.
    pub instruction: String,
    /// What is to be picked.
    pub object: Option<NodeRef>,
    /// Where it is.
    pub source_room: Option<NodeRef>,
    /// Where it is to go.
    pub target_room: Option<NodeRef>,
    /// What it is to be put on or in.
    pub support: Option<NodeRef>,
}

/// How far a task is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Status {
    /// The robot set out.
    Started,
    /// The object is in the gripper.
    Picked,
    /// The object was let go of.
    Placed,
    /// The task was given up.
    Failed,
    /// The task is complete.
    Done,
}

impl Status {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::Started, Self::Picked, Self::Placed, Self::Failed, Self::Done];

    /// The word for it in JSON.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Started => "started",
            Self::Picked => "picked",
            Self::Placed => "placed",
            Self::Failed => "failed",
            Self::Done => "done",
        }
    }
}

/// The robot's report on a task.
///
/// A report may itself name what was picked and where it was placed; what it names goes before
/// what the task said.
#[derive(Clone, Debug, PartialEq)]
pub struct TaskStatus {
    /// The task it is about.
    pub task_id: String,
    /// How far it is.
    pub status: Status,
    /// `world_from_object` at that moment, when known.
    pub pose: Option<Pose>,
    /// What was picked or placed.
    pub object: Option<NodeRef>,
    /// The room it was picked or placed in.
    pub room: Option<NodeRef>,
    /// What it was picked from, or placed on or in.
    pub support: Option<NodeRef>,
}

impl TaskStatus {
    /// A report that says no more than how far the task is.
    pub fn bare(task_id: impl Into<String>, status: Status) -> Self {
        let task_id = task_id.into();
        Self { task_id, status, pose: None, object: None, room: None, support: None }
    }
}

/// What was understood of a task.
#[derive(Clone, Debug, PartialEq)]
pub struct Interpretation {
    /// The message that was interpreted.
    pub of: EvidenceRef,
    /// The object meant.
    pub object: Option<NodeRef>,
    /// Where it is.
    pub source_room: Option<NodeRef>,
    /// Where it is to go.
    pub target_room: Option<NodeRef>,
    /// What it is to be put on or in.
    pub support: Option<NodeRef>,
    /// How it was understood, or why not.
    pub note: String,
}

/// A message that is passed through as it came.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SensorMessage {
    /// Its topic.
    pub topic: Arc<str>,
    /// Encoding of the message, such as `cdr`.
    pub message_encoding: Arc<str>,
    /// Name of the schema, such as `sensor_msgs/msg/Image`; empty if there is none.
    pub schema_name: Arc<str>,
    /// Encoding of the schema, such as `ros2msg`.
    pub schema_encoding: Arc<str>,
    /// The schema.
    pub schema: Arc<[u8]>,
    /// The payload.
    pub data: Arc<[u8]>,
}
