//! What a log writer is told, and what it refuses. Does no IO.

use std::collections::BTreeMap;
use std::io;
use std::sync::Arc;

use mcap::records::Channel;

use super::open_chunk::ChunkClass;
use super::wire::Schema;

/// Largest message payload that is accepted.
pub(super) const MESSAGE_MAX: usize = 32 << 20;
/// Largest schema, channel or metadata record that is accepted.
const DEFINITION_MAX: usize = 8 << 20;
/// How a log is laid out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LogOptions {
    /// Program name in the file header; pinned, so that equal input gives equal bytes.
    pub library: String,
    /// MCAP profile, for example `ros2`.
    pub profile: String,
    /// Body size at which an event chunk is closed.
    pub event_chunk_bytes: usize,
    /// Body size at which a sensor chunk is closed.
    pub sensor_chunk_bytes: usize,
    /// Zstandard level of compressed chunks.
    pub zstd_level: i32,
}

impl Default for LogOptions {
    fn default() -> Self {
        Self {
            library: "scenefold".to_owned(),
            profile: String::new(),
            event_chunk_bytes: 256 << 10,
            sensor_chunk_bytes: 1 << 20,
            zstd_level: 3,
        }
    }
}

/// A message type to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SchemaSpec {
    /// Name of the type.
    pub name: String,
    /// Language of the description.
    pub encoding: String,
    /// The description.
    pub data: Vec<u8>,
}

/// A channel to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChannelSpec {
    /// Topic of its messages.
    pub topic: String,
    /// Encoding of its payloads, for example `protobuf` or `cdr`.
    pub message_encoding: String,
    /// Free key-value pairs.
    pub metadata: BTreeMap<String, String>,
    /// Type of its messages, if described.
    pub schema: Option<SchemaSpec>,
    /// Which chunks its messages go to.
    pub class: ChunkClass,
}

/// Why a log cannot be written. After an IO error the writer refuses everything.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The inner writer or the compressor failed.
    #[error("cannot write the recording: {0}")]
    Io(#[from] io::Error),
    /// An earlier write failed, so the state of the file is not known.
    #[error("an earlier write failed: recover the file and start a new one")]
    Poisoned,
    /// A message older than the one before it.
    #[error(
        "log time {log_time} on {topic} is before {previous}: messages must come in order of time"
    )]
    TimeWentBack {
        /// Topic of the message.
        topic: String,
        /// Its log time.
        log_time: u64,
        /// The log time before it.
        previous: u64,
    },
    /// A payload above the limit.
    #[error("message of {bytes} bytes on {topic} is longer than {limit} bytes: split it")]
    MessageTooLong {
        /// Topic of the message.
        topic: String,
        /// Its length.
        bytes: usize,
        /// Longest allowed.
        limit: usize,
    },
    /// A schema, channel or metadata record above the limit.
    #[error("definition or metadata {name:?} of {bytes} bytes is longer than {limit} bytes")]
    DefinitionTooLong {
        /// Its name or topic.
        name: String,
        /// Its length.
        bytes: usize,
        /// Longest allowed.
        limit: usize,
    },
    /// More channels than MCAP can number.
    #[error("more than {} channels in one file", u16::MAX)]
    TooManyChannels,
    /// A handle that this writer never gave out.
    #[error("channel handle {0} belongs to another writer")]
    UnknownChannel(u16),
}

pub(super) fn check_definition(spec: &ChannelSpec) -> Result<(), WriteError> {
    let channel = spec.topic.len() + spec.message_encoding.len() + text_map_bytes(&spec.metadata);
    let schema = spec.schema.as_ref();
    let schema = schema.map_or(0, |s| s.name.len() + s.encoding.len() + s.data.len());
    check_length(&spec.topic, channel.max(schema))
}

pub(super) fn check_length(name: &str, bytes: usize) -> Result<(), WriteError> {
    if bytes > DEFINITION_MAX {
        let (name, limit) = (name.to_owned(), DEFINITION_MAX);
        return Err(WriteError::DefinitionTooLong { name, bytes, limit });
    }
    Ok(())
}

pub(super) fn text_map_bytes(map: &BTreeMap<String, String>) -> usize {
    map.iter().map(|(key, value)| 8 + key.len() + value.len()).sum()
}

/// Returns the schema and channel records of `spec` under the given ids.
pub(super) fn records_of(spec: &ChannelSpec, id: u16, schema_id: u16) -> (Option<Schema>, Channel) {
    let schema = spec.schema.as_ref().map(|schema| Schema {
        id: schema_id,
        name: schema.name.clone(),
        encoding: schema.encoding.clone(),
        data: Arc::from(schema.data.as_slice()),
    });
    let channel = Channel {
        id,
        schema_id,
        topic: spec.topic.clone(),
        message_encoding: spec.message_encoding.clone(),
        metadata: spec.metadata.clone(),
    };
    (schema, channel)
}
