//! The inputs of a log, and what was understood of them.

use std::borrow::Cow;
use std::sync::Arc;

use crate::change::{EvidenceRef, NodeRef};
use crate::geometry::Pose;
use crate::time::Stamp;

/// Longest name of a task or a speaker, in bytes.
pub const MAX_NAME: usize = 64 << 10;
/// Longest sentence, in bytes.
pub const MAX_SENTENCE: usize = 1 << 20;
/// Longest payload of a sensor message, in bytes.
pub const MAX_PAYLOAD: usize = 32 << 20;

/// An input that is too long to be recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{field} has {bytes} bytes, at most {limit} can be recorded")]
pub struct TooLong {
    /// Which part of it.
    pub field: &'static str,
    /// How long it is.
    pub bytes: usize,
    /// How long it may be.
    pub limit: usize,
}

pub(super) fn check(field: &'static str, bytes: usize, limit: usize) -> Result<(), TooLong> {
    if bytes > limit { Err(TooLong { field, bytes, limit }) } else { Ok(()) }
}

impl super::Event {
    /// Checks that an input is short enough to be recorded and read back.
    pub fn check_length(&self) -> Result<(), TooLong> {
        match self {
            Self::Utterance(it) => {
                check("speaker", it.speaker.len(), MAX_NAME)?;
                check("text", it.text.len(), MAX_SENTENCE)
            }
            Self::Task(it) => {
                check("task_id", it.task_id.len(), MAX_NAME)?;
                check("instruction", it.instruction.len(), MAX_SENTENCE)
            }
            Self::TaskStatus(it) => check("task_id", it.task_id.len(), MAX_NAME),
            Self::Sensor(it) => {
                check("schema", it.schema.len(), MAX_SENTENCE)?;
                check("topic", it.topic.len(), MAX_NAME)?;
                check("data", it.data.len(), MAX_PAYLOAD)
            }
            Self::LanguageReply(it) => it.check_length(),
            _ => Ok(()),
        }
    }
}

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
    /// The words it rests on, and how each was understood.
    pub spans: Vec<Span>,
}

impl Interpretation {
    /// An interpretation of `of` that says nothing yet.
    pub fn of(of: EvidenceRef) -> Self {
        let (object, source_room, target_room, support) = (None, None, None, None);
        let (note, spans) = (String::new(), Vec::new());
        Self { of, object, source_room, target_room, support, note, spans }
    }
}

/// Words of a text, and what they were taken to mean.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Span {
    /// What they tell: `object`, `support`, `source`, `target` and the like.
    pub role: Cow<'static, str>,
    /// First byte of the text.
    pub start: u32,
    /// The byte after the last; as `start` where the words are those of an earlier text.
    pub end: u32,
    /// What they were taken to mean.
    pub chosen: Vec<NodeRef>,
    /// All that they may mean equally well.
    pub candidates: Vec<NodeRef>,
    /// Why.
    pub why: String,
}

/// Objects that are probably no longer where they were last observed: targets to look at.
#[derive(Clone, Debug, PartialEq)]
pub struct Staleness {
    /// The probability they fell below, above 0 and below 1.
    pub threshold: f64,
    /// In the order in which they crossed it.
    pub targets: Vec<StaleTarget>,
}

/// One of them.
#[derive(Clone, Debug, PartialEq)]
pub struct StaleTarget {
    /// The object.
    pub object: NodeRef,
    /// The room it was last observed in.
    pub room: Option<NodeRef>,
    /// How probable it is, at the log time, that it is still there: 0 to 1.
    pub probability: f64,
    /// λ in 1/s.
    pub decay_rate: f64,
    /// When it was last added, moved or seen.
    pub last_observed: Stamp,
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
