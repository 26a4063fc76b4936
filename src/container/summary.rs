//! The summary section at the end of a finished log, if it can be believed.
//!
//! It is believed only with a checksum that holds: without one a flipped bit could hide or move
//! chunks, and a scan of the record headers is cheap.

use std::io;
use std::ops::Range;

use mcap::records::{Channel, ChunkIndex, Footer, Statistics, op};

use super::entry::{ChunkEntry, Compression};
use super::limits::Limits;
use super::source::Source;
use super::wire::{self, FRAME, Fields, Schema};

/// Bytes of footer and closing magic.
const TAIL: u64 = FRAME + 20 + 8;

/// A summary whose checksum holds and whose offsets make sense.
#[derive(Default)]
pub(super) struct Summary {
    pub start: u64,
    pub schemas: Vec<Schema>,
    pub channels: Vec<Channel>,
    pub chunks: Vec<ChunkEntry>,
    /// File ranges of chunks with their message indexes, in order.
    pub covered: Vec<Range<u64>>,
    pub statistics: Option<Statistics>,
}

/// What the end of a file offers.
pub(super) enum Outcome {
    /// A summary that can be used.
    Sound(Box<Summary>),
    /// No footer, no summary, or one without checksum.
    Absent,
    /// A summary in this range that must not be used.
    Damaged(Range<u64>),
}

/// Reads and checks the summary.
pub(super) fn read(source: &dyn Source, limits: &Limits) -> io::Result<Outcome> {
    let Some((footer, footer_at)) = read_footer(source)? else { return Ok(Outcome::Absent) };
    if footer.summary_start == 0 || footer.summary_crc == 0 {
        return Ok(Outcome::Absent);
    }
    let damaged = |start: u64| Ok(Outcome::Damaged(start..footer_at + FRAME + 20));
    if !(8..=footer_at).contains(&footer.summary_start) {
        return damaged(footer_at);
    }
    let length = footer_at - footer.summary_start;
    if length > limits.summary_bytes {
        return Ok(Outcome::Absent);
    }
    let covered = length + FRAME + 16;
    let mut bytes = vec![0; usize::try_from(covered).map_err(|_| io::ErrorKind::InvalidInput)?];
    source.read_at(footer.summary_start, &mut bytes)?;
    if crc32fast::hash(&bytes) != footer.summary_crc {
        return damaged(footer.summary_start);
    }
    bytes.truncate(length as usize);
    match parse(&bytes, footer.summary_start, limits) {
        Some(summary) => Ok(Outcome::Sound(Box::new(summary))),
        None => damaged(footer.summary_start),
    }
}

fn read_footer(source: &dyn Source) -> io::Result<Option<(Footer, u64)>> {
    let Some(footer_at) = source.len().checked_sub(TAIL) else { return Ok(None) };
    let mut bytes = [0; TAIL as usize];
    source.read_at(footer_at, &mut bytes)?;
    let Some(bytes) = bytes.strip_suffix(mcap::MAGIC) else { return Ok(None) };
    if wire::frame(bytes) != Some((op::FOOTER, 20)) {
        return Ok(None);
    }
    Ok(wire::footer(&bytes[FRAME as usize..]).map(|footer| (footer, footer_at)))
}

fn parse(bytes: &[u8], start: u64, limits: &Limits) -> Option<Summary> {
    let mut summary = Summary { start, ..Summary::default() };
    let mut indexes = Vec::new();
    let mut definition_bytes = 0;
    let mut fields = Fields::new(bytes);
    while !fields.is_empty() {
        let (opcode, length) = wire::frame(fields.bytes(FRAME as usize)?)?;
        let body = fields.bytes(usize::try_from(length).ok()?)?;
        match opcode {
            op::SCHEMA => summary.schemas.push(wire::schema(body)?),
            op::CHANNEL => summary.channels.push(wire::channel(body)?),
            op::CHUNK_INDEX => indexes.push(wire::chunk_index(body)?),
            op::STATISTICS => summary.statistics = Some(wire::statistics(body)?),
            _ => continue,
        }
        if matches!(opcode, op::SCHEMA | op::CHANNEL) {
            definition_bytes += length + 64;
        }
        if indexes.len() > limits.chunks || definition_bytes > limits.definition_bytes {
            return None;
        }
    }
    indexes.sort_by_key(|index| index.chunk_start_offset);
    for index in indexes {
        summary.add(index)?;
    }
    Some(summary)
}

impl Summary {
    /// Adds a chunk; `None` if it overlaps the one before or lies outside the data section.
    fn add(&mut self, index: ChunkIndex) -> Option<()> {
        let free_from = self.covered.last().map_or(8, |range| range.end);
        let chunk_end = index.chunk_start_offset.checked_add(index.chunk_length)?;
        let end = chunk_end.checked_add(index.message_index_length)?;
        let within = index.chunk_start_offset >= free_from && end <= self.start;
        if !within || index.message_start_time > index.message_end_time {
            return None;
        }
        self.covered.push(index.chunk_start_offset..end);
        // Without message indexes an empty map says nothing about the content.
        let indexed = !index.message_index_offsets.is_empty();
        let channels = index.message_index_offsets.into_keys().map(|id| (id, None));
        self.chunks.push(ChunkEntry {
            offset: index.chunk_start_offset,
            length: index.chunk_length,
            start_time: index.message_start_time,
            end_time: index.message_end_time,
            uncompressed_size: index.uncompressed_size,
            compression: Compression::from_name(&index.compression),
            channels: indexed.then(|| channels.collect()),
        });
        Some(())
    }

    /// Returns the ranges of the data section that no chunk covers.
    pub(super) fn gaps(&self) -> Vec<Range<u64>> {
        let mut gaps = Vec::new();
        let mut from = 8;
        for range in &self.covered {
            gaps.push(from..range.start);
            from = range.end;
        }
        gaps.push(from..self.start);
        gaps.retain(|gap| !gap.is_empty());
        gaps
    }
}
