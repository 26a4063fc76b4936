//! [`EventDocument`]: any event of a log. Payloads of sensors are counted, not printed.

use serde::Serialize;

use super::{ChangeDocument, EvidenceDocument, PoseDocument, PrimitiveDocument, RefDocument};
use crate::change::{Cause, Step};
use crate::event::{
    Event, Interpretation, LanguageReply, Logged, SensorMessage, Span, StaleTarget, Staleness, Task,
    TaskStatus,
};

/// An event in its place in the log.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EventDocument {
    /// Event number, from 1.
    pub order: u64,
    /// Log time.
    pub at: String,
    /// Its topic.
    pub topic: String,
    /// What it is: a field `event` tells the kind, the others are of that kind.
    #[serde(flatten)]
    pub content: ContentDocument,
}

/// What an event is, told apart by its field `event`.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "event", rename_all = "snake_case")]
pub enum ContentDocument {
    /// The graph at the start.
    InitialGraph {
        /// How many rooms it has.
        rooms: usize,
        /// How many objects it has.
        objects: usize,
        /// Its hash.
        hash: String,
    },
    /// Somebody said something.
    Utterance {
        /// Who.
        speaker: String,
        /// The words.
        text: String,
    },
    /// What the robot is to do.
    Task {
        /// The task's name.
        task_id: String,
        /// The words it was given in.
        instruction: String,
        /// What is to be picked.
        object: Option<RefDocument>,
        /// Where it is.
        source_room: Option<RefDocument>,
        /// Where it is to go.
        target_room: Option<RefDocument>,
        /// What it is to be put on or in.
        support: Option<RefDocument>,
    },
    /// How far a task is.
    TaskStatus {
        /// The task's name.
        task_id: String,
        /// `started`, `picked`, `placed`, `failed` or `done`.
        status: &'static str,
        /// What was picked or placed.
        object: Option<RefDocument>,
        /// The room it was picked or placed in.
        room: Option<RefDocument>,
        /// What it was picked from, or placed on or in.
        support: Option<RefDocument>,
        /// Its pose at that moment, if known.
        pose: Option<PoseDocument>,
    },
    /// Time passes.
    Tick,
    /// What really changed, in a simulation.
    TrueChange {
        /// The record.
        change: Box<ChangeDocument>,
    },
    /// A message that is passed through.
    Sensor {
        /// Name of its schema; empty if it has none.
        schema: String,
        /// Encoding of the message.
        encoding: String,
        /// Length of the payload.
        bytes: usize,
    },
    /// What a model answered to a question about a sentence.
    LanguageReply {
        /// The message that was asked about.
        of: EvidenceDocument,
        /// Kind and version of the back end.
        back_end: String,
        /// Name of the model.
        model: String,
        /// Name and version of the prompt.
        prompt: String,
        /// The question as it was sent.
        request: String,
        /// The answer as it came; none if there was an error.
        answer: Option<String>,
        /// Why there is no answer.
        error: Option<String>,
        /// How many times the question was sent.
        attempts: u32,
        /// From the question to the answer.
        latency_s: f64,
    },
    /// What was understood of a task or a sentence.
    Interpretation {
        /// The message that was interpreted.
        of: EvidenceDocument,
        /// The object meant.
        object: Option<RefDocument>,
        /// Where it is.
        source_room: Option<RefDocument>,
        /// Where it is to go.
        target_room: Option<RefDocument>,
        /// What it is to be put on or in.
        support: Option<RefDocument>,
        /// How it was understood, or why not.
        note: String,
        /// The words it rests on.
        #[serde(skip_serializing_if = "Vec::is_empty")]
        spans: Vec<SpanDocument>,
    },
    /// Objects that are probably no longer where they were last observed.
    Staleness {
        /// The probability they fell below.
        threshold: f64,
        /// Which.
        targets: Vec<StaleTargetDocument>,
    },
    /// A change record.
    Change {
        /// The record.
        change: Box<ChangeDocument>,
    },
    /// What the fold eats.
    Transaction {
        /// What it does, in order.
        steps: Vec<StepDocument>,
    },
}

/// Words of a text, and what they were taken to mean.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct SpanDocument {
    /// What they tell: `object`, `support`, `source`, `target` and the like.
    pub role: String,
    /// First byte of the text.
    pub start: u32,
    /// The byte after the last.
    pub end: u32,
    /// What they were taken to mean.
    pub chosen: Vec<RefDocument>,
    /// All that they may mean equally well.
    pub candidates: Vec<RefDocument>,
    /// Why.
    pub why: String,
}

impl SpanDocument {
    /// The document of a span.
    pub fn of(span: &Span) -> Self {
        Self {
            role: span.role.to_string(),
            start: span.start,
            end: span.end,
            chosen: span.chosen.iter().map(RefDocument::of).collect(),
            candidates: span.candidates.iter().map(RefDocument::of).collect(),
            why: span.why.clone(),
        }
    }
}

/// One object that is probably no longer where it was last observed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StaleTargetDocument {
    /// The object.
    pub object: RefDocument,
    /// The room it was last observed in.
    pub room: Option<RefDocument>,
    /// How probable it is that it is still there.
    pub probability: f64,
    /// λ in 1/s.
    pub decay_rate: f64,
    /// When it was last observed.
    pub last_observed: String,
}

/// A primitive and its cause.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StepDocument {
    /// Why.
    pub cause: CauseDocument,
    /// What.
    #[serde(flatten)]
    pub primitive: PrimitiveDocument,
}

/// What caused a primitive: `{"change":7}` or `{"evidence":{…}}`.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CauseDocument {
    /// The change with this number.
    Change(u64),
    /// A message that is no change.
    Evidence(EvidenceDocument),
}

impl EventDocument {
    /// The document of an event.
    pub fn of(logged: &Logged) -> Self {
        Self {
            order: logged.order,
            at: logged.at.to_string(),
            topic: logged.event.topic().name().into_owned(),
            content: ContentDocument::of(&logged.event),
        }
    }
}

impl StaleTargetDocument {
    /// The document of a target.
    pub fn of(target: &StaleTarget) -> Self {
        Self {
            object: RefDocument::of(&target.object),
            room: RefDocument::maybe(target.room.as_ref()),
            probability: target.probability,
            decay_rate: target.decay_rate,
            last_observed: target.last_observed.to_string(),
        }
    }
}

impl CauseDocument {
    /// The document of a cause.
    pub fn of(cause: &Cause) -> Self {
        match cause {
            Cause::Change(seq) => Self::Change(*seq),
            Cause::Evidence(reference) => Self::Evidence(EvidenceDocument::of(reference)),
        }
    }
}

impl ContentDocument {
    /// The document of an event's content.
    pub fn of(event: &Event) -> Self {
        match event {
            Event::InitialGraph(graph) => Self::InitialGraph {
                rooms: graph.rooms().count(),
                objects: graph.object_count(),
                hash: graph.hash().to_string(),
            },
            Event::Utterance(said) => {
                Self::Utterance { speaker: said.speaker.clone(), text: said.text.clone() }
            }
            Event::Task(task) => Self::task(task),
            Event::TaskStatus(status) => Self::task_status(status),
            Event::Tick => Self::Tick,
            Event::TrueChange(record) => {
                Self::TrueChange { change: Box::new(ChangeDocument::of(record)) }
            }
            Event::Sensor(message) => Self::sensor(message),
            Event::LanguageReply(reply) => Self::language_reply(reply),
            Event::Interpretation(understood) => Self::interpretation(understood),
            Event::Staleness(stale) => Self::staleness(stale),
            Event::Change(record) => Self::Change { change: Box::new(ChangeDocument::of(record)) },
            Event::Transaction(transaction) => {
                Self::Transaction { steps: transaction.steps.iter().map(step).collect() }
            }
        }
    }

    fn task(task: &Task) -> Self {
        Self::Task {
            task_id: task.task_id.clone(),
            instruction: task.instruction.clone(),
            object: RefDocument::maybe(task.object.as_ref()),
            source_room: RefDocument::maybe(task.source_room.as_ref()),
            target_room: RefDocument::maybe(task.target_room.as_ref()),
            support: RefDocument::maybe(task.support.as_ref()),
        }
    }

    fn task_status(status: &TaskStatus) -> Self {
        Self::TaskStatus {
            task_id: status.task_id.clone(),
            status: status.status.as_str(),
            object: RefDocument::maybe(status.object.as_ref()),
            room: RefDocument::maybe(status.room.as_ref()),
            support: RefDocument::maybe(status.support.as_ref()),
            pose: status.pose.as_ref().map(PoseDocument::of),
        }
    }

    fn sensor(message: &SensorMessage) -> Self {
        Self::Sensor {
            schema: message.schema_name.to_string(),
            encoding: message.message_encoding.to_string(),
            bytes: message.data.len(),
        }
    }

    fn language_reply(reply: &LanguageReply) -> Self {
        Self::LanguageReply {
            of: EvidenceDocument::of(&reply.of),
            back_end: reply.back_end.to_string(),
            model: reply.model.clone(),
            prompt: reply.prompt.to_string(),
            request: reply.request.clone(),
            answer: reply.answer.clone().ok(),
            error: reply.answer.clone().err(),
            attempts: reply.attempts,
            latency_s: reply.latency_nanos as f64 / 1e9,
        }
    }

    fn staleness(stale: &Staleness) -> Self {
        let targets = stale.targets.iter().map(StaleTargetDocument::of).collect();
        Self::Staleness { threshold: stale.threshold, targets }
    }

    fn interpretation(understood: &Interpretation) -> Self {
        Self::Interpretation {
            of: EvidenceDocument::of(&understood.of),
            object: RefDocument::maybe(understood.object.as_ref()),
            source_room: RefDocument::maybe(understood.source_room.as_ref()),
            target_room: RefDocument::maybe(understood.target_room.as_ref()),
            support: RefDocument::maybe(understood.support.as_ref()),
            note: understood.note.clone(),
            spans: understood.spans.iter().map(SpanDocument::of).collect(),
        }
    }
}

fn step(step: &Step) -> StepDocument {
    let cause = CauseDocument::of(&step.cause);
    StepDocument { cause, primitive: PrimitiveDocument::of(&step.primitive) }
}
