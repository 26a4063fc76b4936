//! Contracts: events to payload bytes and back, and the schemas that recordings embed.
//!
//! Knows bytes and no files. Our own messages are protobuf (`schemas/scenefold/v1`); sensor
//! messages are ROS 2 CDR and pass through untouched ([`ros2`] reads and writes the few types
//! that perception needs).
//!
//! Writing goes through generated structs, so that the contracts in `schemas/` are what is
//! written; change records and the commonest primitives, which are most of a log, are written
//! without them, and a test holds the bytes to what the structs would give. Reading walks the bytes and makes domain values at once: whatever comes out has been
//! checked, memory stays proportional to what is valid, and a refusal names its field. Any
//! bytes whatever are read without panic.

mod change_record;
mod checkpoint;
mod common;
mod error;
mod fields;
mod graph_state;
mod inputs;
mod labels;
mod language;
pub mod ros2;
mod put;
mod schema;
mod staleness;
mod transaction;

#[cfg(test)]
mod tests;

/// Generated from `schemas/scenefold/v1`.
#[allow(clippy::pedantic, dead_code, missing_docs, unused_qualifications)]
mod proto {
    include!(concat!(env!("OUT_DIR"), "/scenefold.v1.rs"));
}

pub use change_record::MAX_EVIDENCE;
pub use checkpoint::{
    CHECKPOINT_PEEK, CheckpointHead, CheckpointMessage, MAX_STATE, decode_checkpoint,
    encode_checkpoint, encode_packed_checkpoint, pack_state, peek_checkpoint,
};
pub use error::WireError;
pub use inputs::MAX_UTTERANCE;
pub use labels::Labels;
pub use schema::{Schema, schema_of};
pub use transaction::{MAX_TRANSACTION_ITEMS, decode_edits, decode_transaction};

use prost::Message;

use crate::event::{Event, Topic};
use crate::time::Stamp;

/// The payload of an event.
pub fn encode(event: &Event) -> Vec<u8> {
    let mut payload = Vec::new();
    encode_into(event, &mut payload);
    payload
}

/// Appends the payload of an event to `out`.
pub fn encode_into(event: &Event, out: &mut Vec<u8>) {
    match event {
        Event::InitialGraph(graph) => append(&graph_state::graph_state(graph), out),
        Event::Utterance(utterance) => append(&inputs::utterance(utterance), out),
        Event::Task(task) => append(&inputs::task(task), out),
        Event::TaskStatus(status) => append(&inputs::task_status(status), out),
        Event::Tick => append(&proto::Tick {}, out),
        Event::TrueChange(record) | Event::Change(record) => {
            change_record::put_change_record(record, out);
        }
        Event::Sensor(message) => out.extend_from_slice(&message.data),
        Event::LanguageReply(it) => append(&language::language_reply(it), out),
        Event::Interpretation(it) => append(&inputs::interpretation(it), out),
        Event::Staleness(it) => append(&staleness::staleness(it), out),
        Event::Transaction(it) => transaction::put_transaction(it, out),
    }
}

fn append(message: &impl Message, out: &mut Vec<u8>) {
    message.encode(out).expect("a vector has room for any message");
}

/// The event in a payload; `at` is the log time of the message.
///
/// Messages of other topics than ours are no concern of this function: they pass through as
/// they are. Checkpoints are no events either: see [`decode_checkpoint`].
pub fn decode(topic: &Topic, at: Stamp, payload: &[u8]) -> Result<Event, WireError> {
    Ok(match topic {
        Topic::InitialGraph => Event::InitialGraph(graph_state::read_graph_state(at, payload)?),
        Topic::Utterance => Event::Utterance(inputs::read_utterance(payload)?),
        Topic::Task => Event::Task(inputs::read_task(payload)?),
        Topic::TaskStatus => Event::TaskStatus(inputs::read_task_status(payload)?),
        Topic::Clock => inputs::read_tick(payload).map(|()| Event::Tick)?,
        Topic::TrueChange => Event::TrueChange(change_record::read_change_record(payload)?),
        Topic::Language => Event::LanguageReply(language::read_language_reply(payload)?),
        Topic::Interpretation => Event::Interpretation(inputs::read_interpretation(payload)?),
        Topic::Staleness => Event::Staleness(staleness::read_staleness(payload)?),
        Topic::Change => Event::Change(change_record::read_change_record(payload)?),
        Topic::Primitive => Event::Transaction(decode_transaction(at, payload)?),
        Topic::Checkpoint | Topic::Sensor(_) => {
            return Err(WireError::NoEvent { topic: topic.name().into() });
        }
    })
}
