//! The topics of a log and their roles.

use std::borrow::Cow;
use std::sync::Arc;

/// What messages of a topic are to the fold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Role {
    /// From outside: people, the robot, sensors, the clock.
    Input,
    /// The answer of a model that is not deterministic, recorded so that it can be replayed.
    Model,
    /// Computed from the others.
    Derived,
    /// A cache; can be deleted and rebuilt.
    Cache,
    /// For viewers; never read back.
    Projection,
}

/// Where an event is recorded.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Topic {
    /// `/graph/initial`
    InitialGraph,
    /// `/human/utterance`
    Utterance,
    /// `/robot/task`
    Task,
    /// `/robot/task_status`
    TaskStatus,
    /// `/clock`
    Clock,
    /// `/truth/change`
    TrueChange,
    /// `/model/language`
    Language,
    /// `/evidence/interpretation`
    Interpretation,
    /// `/evidence/staleness`
    Staleness,
    /// `/change`
    Change,
    /// `/primitive`
    Primitive,
    /// `/checkpoint`
    Checkpoint,
    /// Any other.
    Sensor(Arc<str>),
}

impl Topic {
    /// The topics with schemas of our own.
    pub const OWN: [Self; 12] = [
        Self::InitialGraph,
        Self::Utterance,
        Self::Task,
        Self::TaskStatus,
        Self::Clock,
        Self::TrueChange,
        Self::Language,
        Self::Interpretation,
        Self::Staleness,
        Self::Change,
        Self::Primitive,
        Self::Checkpoint,
    ];

    /// The topic with this name.
    pub fn named(name: &str) -> Self {
        let own = Self::OWN.into_iter().find(|topic| topic.name() == name);
        own.unwrap_or_else(|| Self::Sensor(name.into()))
    }

    /// Its name in the recording.
    pub fn name(&self) -> Cow<'static, str> {
        Cow::Borrowed(match self {
            Self::InitialGraph => "/graph/initial",
            Self::Utterance => "/human/utterance",
            Self::Task => "/robot/task",
            Self::TaskStatus => "/robot/task_status",
            Self::Clock => "/clock",
            Self::TrueChange => "/truth/change",
            Self::Language => "/model/language",
            Self::Interpretation => "/evidence/interpretation",
            Self::Staleness => "/evidence/staleness",
            Self::Change => "/change",
            Self::Primitive => "/primitive",
            Self::Checkpoint => "/checkpoint",
            Self::Sensor(name) => return Cow::Owned(name.to_string()),
        })
    }

    /// Its role.
    pub fn role(&self) -> Role {
        match self {
            Self::Language => Role::Model,
            Self::Interpretation | Self::Staleness | Self::Change | Self::Primitive => {
                Role::Derived
            }
            Self::Checkpoint => Role::Cache,
            Self::Sensor(name) if name.starts_with("/model/") => Role::Model,
            Self::Sensor(name) if name.starts_with("/evidence/") => Role::Derived,
            Self::Sensor(name) if name.starts_with("/viz/") => Role::Projection,
            Self::InitialGraph
            | Self::Utterance
            | Self::Task
            | Self::TaskStatus
            | Self::Clock
            | Self::TrueChange
            | Self::Sensor(_) => Role::Input,
        }
    }
}
