//! One chunk in memory: checked as a whole, then walked message by message without copies.
//!
//! Nothing of a chunk is delivered before its checksum, its record framing and the times of its
//! messages have been checked. Must not know the chunks around it.

use mcap::records::op;

use super::damage::DamageKind;
use super::decode::Decoder;
use super::entry::{ChunkEntry, Compression};
use super::limits::Limits;
use super::source::Source;
use super::wire::{self, FRAME, Fields, MESSAGE_FIXED};

/// Bytes of a message record before its payload.
const MESSAGE_HEAD: usize = FRAME as usize + MESSAGE_FIXED;

/// Place of a message in a file. Positions in one file compare in file order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Position {
    /// Offset in the file of the chunk, or of the run of loose records, that holds it.
    pub chunk: u64,
    /// Offset of its record in the decompressed body.
    pub offset: u64,
}

/// Key of the total order of a log.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct OrderKey {
    /// Log time in nanoseconds.
    pub log_time: u64,
    /// Place in the file, which decides between equal times.
    pub position: Position,
}

/// A message as it stands in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RawMessage<'a> {
    /// Channel id in the file.
    pub channel: u16,
    /// Sequence number given by the publisher.
    pub sequence: u32,
    /// When it was recorded, in nanoseconds.
    pub log_time: u64,
    /// When it was published, in nanoseconds.
    pub publish_time: u64,
    /// Payload.
    pub data: &'a [u8],
    /// Place in the file.
    pub position: Position,
}

impl RawMessage<'_> {
    /// Returns its place in the total order of the log.
    pub fn key(&self) -> OrderKey {
        OrderKey { log_time: self.log_time, position: self.position }
    }
}

/// Memory for one chunk, reused from chunk to chunk.
#[derive(Default)]
pub struct ChunkBuffer {
    /// The record as read from the file.
    raw: Vec<u8>,
    /// The body, if it had to be decompressed.
    decompressed: Vec<u8>,
    /// Where the body lies in `raw`; `None` if it is `decompressed`.
    stored: Option<std::ops::Range<usize>>,
    chunk: u64,
    /// Offsets of message records in the body.
    messages: Vec<u32>,
    /// Offsets of schema and channel records in the body.
    definitions: Vec<u32>,
    sorted: bool,
    pub(super) decoder: Decoder,
}

impl ChunkBuffer {
    /// Returns an empty buffer.
    pub fn new() -> Self {
        Self::default()
    }

    /// Returns the decompressed body of the chunk that was read last.
    pub fn body(&self) -> &[u8] {
        match &self.stored {
            Some(range) => self.raw.get(range.clone()).unwrap_or_default(),
            None => &self.decompressed,
        }
    }

    /// Returns the number of messages.
    pub fn len(&self) -> usize {
        self.messages.len()
    }

    /// Returns whether there are no messages.
    pub fn is_empty(&self) -> bool {
        self.messages.is_empty()
    }

    /// Returns the messages, in file order unless [`Self::sort_by_time`] was called.
    pub fn messages(&self) -> impl Iterator<Item = RawMessage<'_>> {
        let body = self.body();
        self.messages.iter().filter_map(|at| message_at(body, self.chunk, *at))
    }

    /// Returns the message at `index` in the order of [`Self::messages`].
    pub fn message(&self, index: usize) -> Option<RawMessage<'_>> {
        message_at(self.body(), self.chunk, *self.messages.get(index)?)
    }

    /// Puts the messages into the order of the log; costs nothing if they are in it already.
    pub fn sort_by_time(&mut self) {
        if self.sorted {
            return;
        }
        let mut messages = std::mem::take(&mut self.messages);
        let body = self.body();
        messages.sort_by_key(|at| (message_at(body, self.chunk, *at).map(|m| m.log_time), *at));
        self.messages = messages;
        self.sorted = true;
    }

    /// Returns the schema and channel records in the body: opcode and record body.
    pub(super) fn definitions(&self) -> impl Iterator<Item = (u8, &[u8])> {
        let body = self.body();
        self.definitions.iter().filter_map(|at| {
            let record = body.get(*at as usize..)?;
            let (opcode, length) = wire::frame(record)?;
            let record = record.get(FRAME as usize..)?;
            Some((opcode, record.get(..usize::try_from(length).ok()?)?))
        })
    }

    /// Returns the bytes of memory it occupies.
    pub(super) fn memory(&self) -> u64 {
        let offsets = 4 * (self.messages.capacity() + self.definitions.capacity());
        (self.raw.capacity() + self.decompressed.capacity() + offsets) as u64
    }

    /// Reads and checks a chunk; after an error the buffer is empty.
    pub(super) fn load(
        &mut self,
        source: &dyn Source,
        limits: &Limits,
        entry: &ChunkEntry,
    ) -> Result<(), DamageKind> {
        self.clear();
        let loaded = self.fetch(source, limits, entry).and_then(|()| self.index_body(entry));
        if loaded.is_err() {
            self.clear();
        }
        loaded
    }

    pub(super) fn clear(&mut self) {
        self.stored = Some(0..0);
        self.messages.clear();
        self.definitions.clear();
        self.sorted = true;
    }

    fn fetch(
        &mut self,
        source: &dyn Source,
        limits: &Limits,
        entry: &ChunkEntry,
    ) -> Result<(), DamageKind> {
        let claimed = entry.length;
        let limit = limits.record_bytes.saturating_add(FRAME);
        if claimed > limit && entry.compression != Compression::Loose {
            return Err(DamageKind::TooLong { opcode: op::CHUNK, claimed, limit });
        }
        let unreadable = |message: String| DamageKind::Unreadable { message };
        if entry.end() > source.len() {
            return Err(unreadable("it lies beyond the end of the file".to_owned()));
        }
        let length = usize::try_from(claimed).map_err(|error| unreadable(error.to_string()))?;
        self.raw.resize(length, 0);
        source.read_at(entry.offset, &mut self.raw).map_err(|e| unreadable(e.to_string()))?;
        self.chunk = entry.offset;
        if entry.compression == Compression::Loose {
            self.stored = Some(0..length);
            return Ok(());
        }
        self.unpack(limits, entry)
    }

    /// Checks the chunk's header against `entry`, decompresses and checks the checksum.
    fn unpack(&mut self, limits: &Limits, entry: &ChunkEntry) -> Result<(), DamageKind> {
        let framed = wire::frame(&self.raw).is_some_and(|(opcode, n)| {
            opcode == op::CHUNK && n.checked_add(FRAME) == Some(entry.length)
        });
        let body = self.raw.get(FRAME as usize..).filter(|_| framed);
        let (header, fixed) = body.and_then(wire::chunk_header).ok_or(DamageKind::IndexMismatch)?;
        let data = FRAME as usize + fixed..self.raw.len();
        let claimed = header.uncompressed_size;
        let matches = data.len() as u64 == header.compressed_size
            && header.message_start_time == entry.start_time
            && header.message_end_time == entry.end_time
            && claimed == entry.uncompressed_size
            && Compression::from_name(&header.compression) == entry.compression;
        if !matches {
            return Err(DamageKind::IndexMismatch);
        }
        let limit = limits.chunk_bytes.min(u64::from(u32::MAX));
        if claimed > limit {
            return Err(DamageKind::ChunkTooLarge { claimed, limit });
        }
        if entry.compression == Compression::None {
            if data.len() as u64 != claimed {
                return Err(DamageKind::IndexMismatch);
            }
            self.stored = Some(data);
        } else {
            let data = &self.raw[data];
            self.decoder.decompress(&entry.compression, data, claimed, &mut self.decompressed)?;
            self.stored = None;
        }
        // Zero means that the writer computed no checksum.
        let (stored, computed) = (header.uncompressed_crc, crc32fast::hash(self.body()));
        if stored != 0 && stored != computed {
            return Err(DamageKind::Checksum { stored, computed });
        }
        Ok(())
    }

    /// Notes where the records of the body start, and that all of them make sense.
    fn index_body(&mut self, entry: &ChunkEntry) -> Result<(), DamageKind> {
        let (mut messages, mut definitions) =
            (std::mem::take(&mut self.messages), std::mem::take(&mut self.definitions));
        let body = self.body();
        let (mut at, mut last_time, mut sorted) = (0, 0, true);
        let damaged = |at: usize| DamageKind::Body { at: at as u64 };
        while at < body.len() {
            let rest = &body[at..];
            let (opcode, length) = wire::frame(rest).ok_or(damaged(at))?;
            let length = usize::try_from(length).map_err(|_| damaged(at))?;
            if length > rest.len() - FRAME as usize {
                return Err(damaged(at));
            }
            match opcode {
                op::MESSAGE => {
                    let head = rest.first_chunk::<MESSAGE_HEAD>();
                    let head = head.filter(|_| length >= MESSAGE_FIXED).ok_or(damaged(at))?;
                    let log_time = log_time_of(head);
                    if !(entry.start_time..=entry.end_time).contains(&log_time) {
                        return Err(DamageKind::OutsideChunkTime { log_time });
                    }
                    sorted &= log_time >= last_time;
                    last_time = log_time;
                    messages.push(at as u32);
                }
                op::SCHEMA | op::CHANNEL => definitions.push(at as u32),
                // Chunks nest nothing and hold no other known record.
                0..=op::DATA_END => return Err(damaged(at)),
                _ => {}
            }
            at += FRAME as usize + length;
        }
        (self.messages, self.definitions, self.sorted) = (messages, definitions, sorted);
        Ok(())
    }
}

fn log_time_of(head: &[u8; MESSAGE_HEAD]) -> u64 {
    let mut fields = Fields::new(&head[FRAME as usize + 6..]);
    fields.u64().unwrap_or_default()
}

fn message_at(body: &[u8], chunk: u64, at: u32) -> Option<RawMessage<'_>> {
    let record = body.get(at as usize..)?;
    let (_, length) = wire::frame(record)?;
    let mut fields = Fields::new(record.get(FRAME as usize..)?);
    Some(RawMessage {
        channel: fields.u16()?,
        sequence: fields.u32()?,
        log_time: fields.u64()?,
        publish_time: fields.u64()?,
        data: fields.bytes(usize::try_from(length).ok()?.checked_sub(MESSAGE_FIXED)?)?,
        position: Position { chunk, offset: u64::from(at) },
    })
}
