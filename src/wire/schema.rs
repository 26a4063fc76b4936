//! The contracts as they are embedded in recordings, so that any reader decodes them unaided.

use crate::event::Topic;

/// A schema record of a recording, and the encoding of its messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Schema {
    /// Full name of the message type.
    pub name: &'static str,
    /// Encoding of `data`: `protobuf` or `ros2msg`.
    pub encoding: &'static str,
    /// For protobuf a `FileDescriptorSet`, dependencies first; for ROS 2 the text of the types.
    pub data: &'static [u8],
    /// Encoding of the messages: `protobuf` or `cdr`.
    pub message_encoding: &'static str,
}

macro_rules! contract {
    ($name:literal, $stem:literal) => {
        Schema {
            name: concat!("scenefold.v1.", $name),
            encoding: "protobuf",
            data: include_bytes!(concat!(env!("OUT_DIR"), "/", $stem, ".fds")),
            message_encoding: "protobuf",
        }
    };
}

/// The contract of a topic; `None` for topics that are not ours.
pub fn schema_of(topic: &Topic) -> Option<Schema> {
    Some(match topic {
        Topic::InitialGraph => contract!("GraphState", "graph_state"),
        Topic::Utterance => contract!("Utterance", "utterance"),
        Topic::Task => contract!("Task", "task"),
        Topic::TaskStatus => contract!("TaskStatus", "task_status"),
        Topic::Clock => contract!("Tick", "tick"),
        Topic::Language => contract!("LanguageReply", "language_reply"),
        Topic::Interpretation => contract!("Interpretation", "interpretation"),
        Topic::Change | Topic::TrueChange => contract!("ChangeRecord", "change_record"),
        Topic::Staleness => contract!("Staleness", "staleness"),
        Topic::Primitive => contract!("Transaction", "transaction"),
        Topic::Checkpoint => contract!("Checkpoint", "checkpoint"),
        Topic::Sensor(_) => return None,
    })
}
