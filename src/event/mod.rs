//! Everything that stands in a log, as Rust types, and the log's order.
//!
//! Knows nothing of bytes or files (see `wire` and `recording` for those). The total order of a
//! log is (log time, position in the file); the *event number* is the place in that order,
//! from 1, counting inputs, model outputs and derived records, but not checkpoints and
//! projections.

mod inputs;
mod topic;

pub use inputs::{MAX_NAME, MAX_PAYLOAD, MAX_SENTENCE, TooLong, Interpretation, SensorMessage, StaleTarget, Staleness, Status, Task, TaskStatus, Utterance};
pub use topic::{Role, Topic};

use crate::change::{ChangeRecord, EvidenceRef, Transaction};
use crate::graph::SceneGraph;
use crate::time::Stamp;

/// The content of one message of a log.
#[derive(Clone, Debug, PartialEq)]
pub enum Event {
    /// `/graph/initial`: the graph at the start.
    InitialGraph(SceneGraph),
    /// `/human/utterance`: somebody said something.
    Utterance(Utterance),
    /// `/robot/task`: what the robot is to do.
    Task(Task),
    /// `/robot/task_status`: how far it is.
    TaskStatus(TaskStatus),
    /// `/clock`: time passes.
    Tick,
    /// A message of a sensor or of another program, passed through untouched.
    Sensor(SensorMessage),
    /// `/evidence/interpretation`: what was understood of a task or a sentence.
    Interpretation(Interpretation),
    /// `/evidence/staleness`: what is probably no longer where it was seen.
    Staleness(Staleness),
    /// `/change`: the unified language.
    Change(ChangeRecord),
    /// `/primitive`: what the fold eats.
    Transaction(Transaction),
}

impl Event {
    /// Where it is recorded.
    pub fn topic(&self) -> Topic {
        match self {
            Self::InitialGraph(_) => Topic::InitialGraph,
            Self::Utterance(_) => Topic::Utterance,
            Self::Task(_) => Topic::Task,
            Self::TaskStatus(_) => Topic::TaskStatus,
            Self::Tick => Topic::Clock,
            Self::Sensor(message) => Topic::Sensor(message.topic.clone()),
            Self::Interpretation(_) => Topic::Interpretation,
            Self::Staleness(_) => Topic::Staleness,
            Self::Change(_) => Topic::Change,
            Self::Transaction(_) => Topic::Primitive,
        }
    }

    /// Whether it comes from outside, as opposed to being derived from what does.
    pub fn is_input(&self) -> bool {
        self.topic().role() == Role::Input
    }
}

/// An event in its place in the log.
#[derive(Clone, Debug, PartialEq)]
pub struct Logged {
    /// Event number, from 1.
    pub order: u64,
    /// Log time; never earlier than that of the event before.
    pub at: Stamp,
    /// When the source says it happened; differs from `at` only where a source's clock ran
    /// backwards.
    pub published: Stamp,
    /// What it is.
    pub event: Event,
}

impl Logged {
    /// A reference to it.
    pub fn reference(&self) -> EvidenceRef {
        EvidenceRef { topic: self.event.topic().name(), order: self.order }
    }
}
