//! What the writer remembers of a log in order to write its summary. Does no IO.

use mcap::records::{Channel, ChunkIndex, Footer, MetadataIndex, Statistics, SummaryOffset, op};

use super::options::{ChannelSpec, records_of};
use super::wire::{self, Schema};

/// Definitions, counts and indexes of the log so far.
#[derive(Default)]
pub(super) struct Summary {
    schemas: Vec<Schema>,
    channels: Vec<Channel>,
    channel_counts: Vec<u64>,
    chunks: Vec<ChunkIndex>,
    metadata: Vec<MetadataIndex>,
    statistics: Statistics,
}

impl Summary {
    /// Counts a message and returns its number, from zero.
    pub(super) fn accept(&mut self, channel_id: u16, log_time: u64) -> u64 {
        let number = self.statistics.message_count;
        if number == 0 {
            self.statistics.message_start_time = log_time;
        }
        self.statistics.message_end_time = log_time;
        self.statistics.message_count += 1;
        self.channel_counts[usize::from(channel_id) - 1] += 1;
        number
    }

    pub(super) fn messages(&self) -> u64 {
        self.statistics.message_count
    }

    /// Adds a channel under `id`, the next one, and returns the id of its schema.
    pub(super) fn add_channel(&mut self, spec: &ChannelSpec, id: u16) -> u16 {
        let next_schema = self.schemas.len() as u16 + 1;
        let (schema, mut channel) = records_of(spec, id, next_schema);
        channel.schema_id = schema.map_or(0, |schema| self.schema_id(schema));
        let schema_id = channel.schema_id;
        self.channels.push(channel);
        self.channel_counts.push(0);
        schema_id
    }

    fn schema_id(&mut self, schema: Schema) -> u16 {
        let known = self.schemas.iter().find(|known| {
            known.name == schema.name
                && known.encoding == schema.encoding
                && known.data == schema.data
        });
        if let Some(known) = known {
            return known.id;
        }
        let id = schema.id;
        self.schemas.push(schema);
        id
    }

    pub(super) fn schema(&self, id: usize) -> &Schema {
        &self.schemas[id - 1]
    }

    pub(super) fn channel(&self, id: u16) -> &Channel {
        &self.channels[usize::from(id) - 1]
    }

    pub(super) fn add_chunk(&mut self, index: ChunkIndex) {
        self.chunks.push(index);
    }

    pub(super) fn add_metadata(&mut self, name: &str, offset: u64, length: u64) {
        self.metadata.push(MetadataIndex { offset, length, name: name.to_owned() });
    }

    /// Returns summary, summary offsets and footer for a summary that starts at `start`.
    pub(super) fn encode(&self, start: u64) -> Vec<u8> {
        let mut out = Vec::new();
        let mut groups = Vec::new();
        self.put_groups(&mut out, &mut groups);
        let summary_offset_start = start + out.len() as u64;
        for (opcode, from, to) in groups {
            let group = SummaryOffset {
                group_opcode: opcode,
                group_start: start + from,
                group_length: to - from,
            };
            wire::put(&mut out, op::SUMMARY_OFFSET, &group);
        }
        let footer = Footer { summary_start: start, summary_offset_start, summary_crc: 0 };
        wire::put(&mut out, op::FOOTER, &footer);
        // The checksum covers all of the above up to the checksum itself.
        let covered = out.len() - 4;
        let crc = crc32fast::hash(&out[..covered]);
        out[covered..].copy_from_slice(&crc.to_le_bytes());
        out
    }

    fn put_groups(&self, out: &mut Vec<u8>, groups: &mut Vec<(u8, u64, u64)>) {
        let mut group = |opcode: u8, out: &mut Vec<u8>, put: &mut dyn FnMut(&mut Vec<u8>)| {
            let from = out.len() as u64;
            put(out);
            let to = out.len() as u64;
            if to > from {
                groups.push((opcode, from, to));
            }
        };
        group(op::SCHEMA, out, &mut |out| {
            self.schemas.iter().for_each(|schema| wire::put_schema(out, schema));
        });
        group(op::CHANNEL, out, &mut |out| {
            self.channels.iter().for_each(|channel| wire::put(out, op::CHANNEL, channel));
        });
        group(op::STATISTICS, out, &mut |out| {
            wire::put(out, op::STATISTICS, &self.final_statistics());
        });
        group(op::CHUNK_INDEX, out, &mut |out| {
            self.chunks.iter().for_each(|index| wire::put(out, op::CHUNK_INDEX, index));
        });
        group(op::METADATA_INDEX, out, &mut |out| {
            self.metadata.iter().for_each(|index| wire::put(out, op::METADATA_INDEX, index));
        });
    }

    fn final_statistics(&self) -> Statistics {
        let counts = self.channels.iter().zip(&self.channel_counts);
        Statistics {
            schema_count: self.schemas.len() as u16,
            channel_count: self.channels.len() as u32,
            metadata_count: self.metadata.len() as u32,
            chunk_count: self.chunks.len() as u32,
            channel_message_counts: counts.map(|(channel, count)| (channel.id, *count)).collect(),
            ..self.statistics.clone()
        }
    }
}
