//! [`Summary`]: what is in a recording, at a glance.

use std::collections::BTreeMap;

use super::open::{Recording, Segment};
use crate::container::{ChunkBuffer, ChunkEntry};
use crate::event::Topic;
use crate::time::Stamp;
use crate::wire;

/// A topic and what is recorded on it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ChannelSummary {
    /// The topic.
    pub topic: String,
    /// Name of its schema; empty if it has none.
    pub schema: String,
    /// Encoding of its messages.
    pub encoding: String,
    /// How many messages there are.
    pub count: u64,
}

/// What is in a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct Summary {
    /// Log time of the first message.
    pub start: Option<Stamp>,
    /// Log time of the last message.
    pub end: Option<Stamp>,
    /// Number of messages.
    pub messages: u64,
    /// By topic and schema.
    pub channels: Vec<ChannelSummary>,
    /// Number of primitives, in all transactions.
    pub primitives: u64,
    /// Number of change records, applied or rejected.
    pub changes: u64,
    /// Number of checkpoints.
    pub checkpoints: u64,
    /// Number of files.
    pub segments: u64,
    /// Whether every file was ended by its writer.
    pub finished: bool,
    /// Program that wrote it, if it says so.
    pub program: Option<String>,
    /// Program library that wrote the container, if it says so.
    pub library: Option<String>,
    /// What is wrong with it, as far as was seen.
    pub trouble: Vec<String>,
}

impl Recording {
    /// Counts what is in the recording; chunks are read only where the file does not tell.
    pub fn summary(&self) -> Summary {
        let mut channels: BTreeMap<(String, String, String), u64> = BTreeMap::new();
        for segment in &self.segments {
            let counts = self.count(segment);
            for (id, channel) in segment.log.channels() {
                let schema = segment.log.schemas().get(&channel.schema_id);
                let schema = schema.map_or(String::new(), |schema| schema.name.clone());
                let key = (channel.topic.clone(), schema, channel.message_encoding.clone());
                *channels.entry(key).or_default() += counts.get(id).copied().unwrap_or(0);
            }
        }
        let channels: Vec<ChannelSummary> = channels
            .into_iter()
            .map(|((topic, schema, encoding), count)| ChannelSummary {
                topic,
                schema,
                encoding,
                count,
            })
            .collect();
        let on = |topic: &Topic| {
            let name = topic.name();
            channels.iter().filter(|c| c.topic == name).map(|c| c.count).sum()
        };
        let chunks = || {
            let all = self.segments.iter().flat_map(|segment| segment.log.chunks());
            all.filter(|entry| entry.start_time <= entry.end_time && holds_messages(entry))
        };
        Summary {
            start: chunks().map(|entry| entry.start_time).min().map(Stamp::from_nanos),
            end: chunks().map(|entry| entry.end_time).max().map(Stamp::from_nanos),
            messages: channels.iter().map(|channel| channel.count).sum(),
            primitives: self.count_primitives(),
            changes: on(&Topic::Change),
            checkpoints: on(&Topic::Checkpoint),
            segments: self.segments.len() as u64,
            finished: self.segments.iter().all(|segment| segment.log.is_finished()),
            program: self.meta().map(|meta| meta.program.clone()),
            library: self.segments[0].log.header().map(|header| header.library.clone()),
            trouble: self.trouble(),
            channels,
        }
    }

    fn count(&self, segment: &Segment) -> BTreeMap<u16, u64> {
        let intact = segment.log.damage().is_empty();
        if let Some(statistics) = segment.log.statistics().filter(|_| intact) {
            return statistics.channel_message_counts.clone();
        }
        let mut counts = BTreeMap::new();
        let mut buffer = ChunkBuffer::new();
        for entry in segment.log.chunks() {
            // Message indexes may lie about a chunk that cannot be read.
            if let Err(damage) = segment.log.read_chunk_into(entry, &mut buffer) {
                self.report_damage(segment, &damage);
                continue;
            }
            for message in buffer.messages() {
                *counts.entry(message.channel).or_default() += 1;
            }
        }
        counts
    }

    /// Sealed segments tell; others are decoded.
    fn count_primitives(&self) -> u64 {
        self.segments
            .iter()
            .map(|segment| match segment.seal {
                Some(seal) => seal.primitives,
                None => count_primitives(segment),
            })
            .sum()
    }
}

fn holds_messages(entry: &ChunkEntry) -> bool {
    entry.channels.as_ref().is_none_or(|channels| !channels.is_empty())
}

fn count_primitives(segment: &Segment) -> u64 {
    let channels: Vec<u16> = segment.channels_of(&Topic::Primitive).collect();
    let holds = |entry: &&ChunkEntry| channels.iter().any(|channel| entry.may_hold(*channel));
    let (mut buffer, mut count) = (ChunkBuffer::new(), 0);
    for entry in segment.log.chunks().iter().filter(holds) {
        // What is damaged is told elsewhere.
        if segment.log.read_chunk_into(entry, &mut buffer).is_err() {
            continue;
        }
        for message in buffer.messages().filter(|message| channels.contains(&message.channel)) {
            let at = Stamp::from_nanos(message.log_time);
            let transaction = wire::decode_transaction(at, message.data);
            count += transaction.map_or(0, |transaction| transaction.steps.len() as u64);
        }
    }
    count
}
