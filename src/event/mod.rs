//! Everything that stands in a log, as Rust types, and the log's order.
//!
//! Knows nothing of bytes or files (see `wire` and `recording` for those). The total order of a
//! log is (log time, position in the file); the *event number* is the place in that order,
//! from 1, counting inputs, model outputs and derived records, but not checkpoints and
//! projections.

mod inputs;
mod language;
mod topic;

pub use inputs::{
    Interpretation, MAX_NAME, MAX_PAYLOAD, MAX_SENTENCE, SensorMessage, Span, StaleTarget, Staleness,
    Status, Task, TaskStatus, TooLong, Utterance,
};
pub use language::{LanguageReply, MAX_ANSWER};
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
    /// `/truth/change`: what really changed, in the truth file of a simulation; see
    /// [`crate::updater::Detectors::Truth`].
    TrueChange(ChangeRecord),
    /// A message of a sensor or of another program, passed through untouched.
    Sensor(SensorMessage),
    /// `/model/language`: what a model answered to a question about a sentence.
    LanguageReply(LanguageReply),
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
            Self::TrueChange(_) => Topic::TrueChange,
            Self::Sensor(message) => Topic::Sensor(message.topic.clone()),
            Self::LanguageReply(_) => Topic::Language,
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

    /// Whether it is the answer of a model: it belongs to the input before it.
    pub fn is_model_output(&self) -> bool {
        self.topic().role() == Role::Model
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
