//! A chunk that is still being filled, in memory. Knows no file and no other chunk.

use std::collections::BTreeMap;

use mcap::records::{ChunkHeader, ChunkIndex, MessageHeader, op};

use super::wire;

/// Which messages share chunks, and how their chunks are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ChunkClass {
    /// Sensor data that compresses: zstd.
    Sensor,
    /// Sensor data whose payloads are compressed already: stored as it is.
    PackedSensor,
    /// Events: zstd. Closed after the sensor chunks, so that an event never precedes in the
    /// file the data it rests on.
    Event,
    /// One chunk per message, stored as it is, for payloads that compress themselves.
    Checkpoint,
}

impl ChunkClass {
    pub(super) const ALL: [Self; 4] =
        [Self::Sensor, Self::PackedSensor, Self::Event, Self::Checkpoint];

    pub(super) fn is_compressed(self) -> bool {
        matches!(self, Self::Sensor | Self::Event)
    }
}

/// Bytes of a message record before its payload.
const HEAD: usize = wire::FRAME as usize + wire::MESSAGE_FIXED;

/// Where the first message of the open chunk stands in the log.
#[derive(Clone, Copy)]
pub(super) struct Held {
    pub first_message: u64,
    pub start_time: u64,
    pub end_time: u64,
}

/// Body and message indexes of a chunk that is being filled.
#[derive(Default)]
pub(super) struct OpenChunk {
    pub body: Vec<u8>,
    /// Encoded index entries per channel id.
    indexes: Vec<Vec<u8>>,
    pub held: Option<Held>,
}

impl OpenChunk {
    /// Appends a message record; `number` is its place in the order of arrival.
    pub(super) fn push(&mut self, header: MessageHeader, data: &[u8], number: u64) {
        let offset = self.body.len() as u64;
        let length = (wire::MESSAGE_FIXED + data.len()) as u64;
        // Put together first: many small appends cost more than the message.
        let mut head = [0; HEAD];
        head[0] = op::MESSAGE;
        head[1..9].copy_from_slice(&length.to_le_bytes());
        head[9..11].copy_from_slice(&header.channel_id.to_le_bytes());
        head[11..15].copy_from_slice(&header.sequence.to_le_bytes());
        head[15..23].copy_from_slice(&header.log_time.to_le_bytes());
        head[23..].copy_from_slice(&header.publish_time.to_le_bytes());
        self.body.reserve(HEAD + data.len());
        self.body.extend_from_slice(&head);
        self.body.extend_from_slice(data);
        self.index(header.channel_id, header.log_time, offset);
        let held = self.held.get_or_insert(Held {
            first_message: number,
            start_time: header.log_time,
            end_time: header.log_time,
        });
        held.end_time = header.log_time;
    }

    fn index(&mut self, channel: u16, log_time: u64, offset: u64) {
        let slot = usize::from(channel);
        if self.indexes.len() <= slot {
            self.indexes.resize_with(slot + 1, Vec::new);
        }
        let entries = &mut self.indexes[slot];
        let mut entry = [0; 16];
        entry[..8].copy_from_slice(&log_time.to_le_bytes());
        entry[8..].copy_from_slice(&offset.to_le_bytes());
        entries.extend_from_slice(&entry);
    }

    /// Channels with messages in the chunk and their encoded index entries, by channel id.
    pub(super) fn indexes(&self) -> impl Iterator<Item = (u16, &[u8])> {
        let all = self.indexes.iter().enumerate();
        all.filter(|(_, entries)| !entries.is_empty())
            .map(|(channel, entries)| (channel as u16, entries.as_slice()))
    }

    /// Forgets the content and keeps the memory.
    pub(super) fn clear(&mut self) {
        self.body.clear();
        self.indexes.iter_mut().for_each(Vec::clear);
        self.held = None;
    }
}

/// Appends a chunk record and its message indexes; `position` is where `out` starts in the file.
pub(super) fn put_chunk(
    out: &mut Vec<u8>,
    header: ChunkHeader,
    data: &[u8],
    chunk: &OpenChunk,
    position: u64,
) -> ChunkIndex {
    let mut fixed = Vec::with_capacity(wire::CHUNK_HEADER_MAX);
    wire::put(&mut fixed, op::CHUNK, &header);
    let body_len = fixed.len() as u64 - wire::FRAME + data.len() as u64;
    fixed[1..9].copy_from_slice(&body_len.to_le_bytes());
    out.extend_from_slice(&fixed);
    out.extend_from_slice(data);
    let chunk_length = out.len() as u64;
    let mut offsets = BTreeMap::new();
    for (channel, entries) in chunk.indexes() {
        offsets.insert(channel, position + out.len() as u64);
        out.push(op::MESSAGE_INDEX);
        out.extend_from_slice(&(6 + entries.len() as u64).to_le_bytes());
        out.extend_from_slice(&channel.to_le_bytes());
        out.extend_from_slice(&(entries.len() as u32).to_le_bytes());
        out.extend_from_slice(entries);
    }
    ChunkIndex {
        message_start_time: header.message_start_time,
        message_end_time: header.message_end_time,
        chunk_start_offset: position,
        chunk_length,
        message_index_offsets: offsets,
        message_index_length: out.len() as u64 - chunk_length,
        compression: header.compression,
        compressed_size: header.compressed_size,
        uncompressed_size: header.uncompressed_size,
    }
}
