//! Is there a record at this offset, and what does it hold? Judges one record at a time; the
//! walk in `scan` decides what to do with the answer.

use std::io;

use mcap::records::{Channel, Header, Metadata, op};

use super::damage::DamageKind;
use super::entry::{ChunkEntry, Compression};
use super::limits::Limits;
use super::window::Window;
use super::wire::{self, CHUNK_HEADER_MAX, FRAME, Fields, MESSAGE_FIXED, Schema};

/// Length field of a chunk that the `mcap` crate has opened and not closed.
const NEVER_CLOSED: u64 = u64::MAX;

/// A record that was found, by its place in the file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    pub offset: u64,
    pub opcode: u8,
    pub body_len: u64,
}

impl Frame {
    pub(super) fn body(&self) -> u64 {
        self.offset + FRAME
    }

    pub(super) fn end(&self) -> u64 {
        self.body() + self.body_len
    }
}

/// What a record holds, as far as the walk needs it.
pub(super) enum Content {
    Header(Header),
    Schema(Schema),
    Channel(Channel),
    Message {
        channel: u16,
        log_time: u64,
    },
    Chunk(ChunkEntry),
    MessageIndex {
        channel: u16,
        count: u64,
    },
    Metadata(Metadata),
    Attachment,
    DataEnd {
        crc: u32,
    },
    Footer,
    /// Another known record, or one of a kind that this reader does not know.
    Other,
}

impl Content {
    /// Whether the record repeats its length inside, so that the length is surely right.
    pub(super) fn confirms_length(&self) -> bool {
        matches!(self, Self::Chunk(_) | Self::MessageIndex { .. } | Self::Attachment)
    }
}

/// Reads records of one file up to `until`, which is the end of the file or of a gap.
pub(super) struct Examiner<'s> {
    pub window: Window<'s>,
    pub limits: Limits,
    pub until: u64,
    /// Whether `until` is the end of the file, where a record can be torn.
    pub to_the_end: bool,
    /// Definition bytes that `resync` may still parse, so that a hostile file cannot have the
    /// same bytes parsed from every offset.
    pub resync_budget: u64,
    /// Last answer of `resync` for either kind of file: asked from `.0` on, it found `.1`.
    pub resynced: [Option<(u64, u64)>; 2],
}

type Judged<T> = io::Result<Result<T, DamageKind>>;

impl<'s> Examiner<'s> {
    pub(super) fn new(window: Window<'s>, limits: Limits, until: u64) -> Self {
        let resync_budget = limits.record_bytes;
        Self { window, limits, until, to_the_end: true, resync_budget, resynced: [None; 2] }
    }
}

impl Examiner<'_> {
    /// Reads opcode and length at `offset` and checks that the record ends within bounds.
    pub(super) fn frame(&mut self, offset: u64) -> Judged<Frame> {
        let Some((opcode, body_len)) = wire::frame(self.window.peek(offset, FRAME as usize)?)
        else {
            return Ok(Err(DamageKind::TornTail));
        };
        if opcode == op::CHUNK && body_len == NEVER_CLOSED {
            return Ok(Err(DamageKind::OpenChunk));
        }
        let limit = self.limits.record_bytes;
        let too_long = body_len > limit && opcode != op::ATTACHMENT;
        if opcode == 0 || (too_long && opcode > op::DATA_END) {
            return Ok(Err(DamageKind::Garbage));
        }
        if too_long {
            return Ok(Err(DamageKind::TooLong { opcode, claimed: body_len, limit }));
        }
        match offset.checked_add(FRAME).and_then(|body| body.checked_add(body_len)) {
            Some(end) if end <= self.until => Ok(Ok(Frame { offset, opcode, body_len })),
            _ if self.to_the_end => Ok(Err(DamageKind::TornTail)),
            _ => Ok(Err(DamageKind::Malformed { opcode })),
        }
    }

    /// Parses as much of the record as is needed to know whether it makes sense.
    pub(super) fn content(&mut self, frame: Frame) -> Judged<Content> {
        let malformed = DamageKind::Malformed { opcode: frame.opcode };
        let parsed = match frame.opcode {
            op::CHUNK => self.chunk(frame)?.map(Content::Chunk),
            op::MESSAGE => self.message(frame)?,
            op::MESSAGE_INDEX => self.message_index(frame)?,
            op::ATTACHMENT => self.attachment(frame)?.then_some(Content::Attachment),
            op::HEADER | op::SCHEMA | op::CHANNEL | op::METADATA => {
                if frame.body_len > self.definition_limit() {
                    return Ok(Err(DamageKind::TooMuch {
                        what: "definitions or metadata in one record",
                        limit: self.definition_limit(),
                    }));
                }
                self.definition(frame)?
            }
            op::DATA_END => self.data_end(frame)?,
            op::FOOTER => (frame.body_len >= 20).then_some(Content::Footer),
            op::SUMMARY_OFFSET => (frame.body_len >= 17).then_some(Content::Other),
            op::CHUNK_INDEX | op::ATTACHMENT_INDEX | op::STATISTICS | op::METADATA_INDEX => {
                (frame.body_len >= 20).then_some(Content::Other)
            }
            // A chunk whose opcode is damaged must not pass for an unknown record.
            _ => self.chunk(frame)?.is_none().then_some(Content::Other),
        };
        Ok(parsed.ok_or(malformed))
    }

    /// Whether the bytes at `offset` could be the start of a record, or the end of everything.
    pub(super) fn plausible(&self, offset: u64) -> io::Result<bool> {
        if offset == self.until {
            return Ok(true);
        }
        let mut bytes = [0; FRAME as usize];
        let bytes = self.window.glance(offset, &mut bytes)?;
        if bytes.starts_with(mcap::MAGIC) {
            return Ok(true);
        }
        let Some((opcode, body_len)) = wire::frame(bytes) else {
            return Ok(bytes.first().is_some_and(|opcode| is_known(*opcode)));
        };
        let fits = match opcode {
            op::CHUNK if body_len == NEVER_CLOSED => true,
            op::ATTACHMENT => body_len <= self.until.saturating_sub(offset),
            _ => body_len <= self.limits.record_bytes,
        };
        Ok(is_known(opcode) && fits)
    }

    fn definition_limit(&self) -> u64 {
        self.limits.definition_bytes.min(self.limits.metadata_bytes)
    }

    fn definition(&mut self, frame: Frame) -> io::Result<Option<Content>> {
        let body = self.window.read(frame.body(), frame.body_len)?;
        Ok(match frame.opcode {
            op::HEADER => wire::header(&body).map(Content::Header),
            op::SCHEMA => wire::schema(&body).map(Content::Schema),
            op::CHANNEL => wire::channel(&body).map(Content::Channel),
            _ => wire::metadata(&body).map(Content::Metadata),
        })
    }

    fn chunk(&mut self, frame: Frame) -> io::Result<Option<ChunkEntry>> {
        let prefix = CHUNK_HEADER_MAX.min(usize::try_from(frame.body_len).unwrap_or(usize::MAX));
        let bytes = self.window.peek(frame.body(), prefix)?;
        let Some((header, fixed)) = wire::chunk_header(bytes) else { return Ok(None) };
        if (fixed as u64).checked_add(header.compressed_size) != Some(frame.body_len) {
            return Ok(None);
        }
        let stored = header.compression.is_empty();
        if stored && header.compressed_size != header.uncompressed_size {
            return Ok(None);
        }
        Ok((header.message_start_time <= header.message_end_time).then(|| ChunkEntry {
            offset: frame.offset,
            length: FRAME + frame.body_len,
            start_time: header.message_start_time,
            end_time: header.message_end_time,
            uncompressed_size: header.uncompressed_size,
            compression: Compression::from_name(&header.compression),
            channels: None,
        }))
    }

    fn message(&mut self, frame: Frame) -> io::Result<Option<Content>> {
        if frame.body_len < MESSAGE_FIXED as u64 {
            return Ok(None);
        }
        let mut fields = Fields::new(self.window.peek(frame.body(), MESSAGE_FIXED)?);
        let channel = fields.u16();
        let _sequence = fields.u32();
        Ok(channel
            .zip(fields.u64())
            .map(|(channel, log_time)| Content::Message { channel, log_time }))
    }

    fn message_index(&mut self, frame: Frame) -> io::Result<Option<Content>> {
        let mut fields = Fields::new(self.window.peek(frame.body(), 6)?);
        let Some((channel, bytes)) = fields.u16().zip(fields.u32()) else { return Ok(None) };
        let bytes = u64::from(bytes);
        let sound = bytes.is_multiple_of(16) && frame.body_len == bytes + 6;
        Ok(sound.then_some(Content::MessageIndex { channel, count: bytes / 16 }))
    }

    /// An attachment is never loaded: its inner lengths only have to add up.
    fn attachment(&mut self, frame: Frame) -> io::Result<bool> {
        let mut at = 16;
        for width in [4, 4, 8] {
            let offset = frame.body().saturating_add(at);
            if offset.saturating_add(width) > frame.end() {
                return Ok(false);
            }
            let mut bytes = [0; 8];
            self.window.glance(offset, &mut bytes[..width as usize])?;
            at = at.saturating_add(width).saturating_add(u64::from_le_bytes(bytes));
        }
        Ok(at.checked_add(4) == Some(frame.body_len))
    }

    fn data_end(&mut self, frame: Frame) -> io::Result<Option<Content>> {
        let crc = Fields::new(self.window.peek(frame.body(), 4)?).u32();
        Ok(crc.filter(|_| frame.body_len >= 4).map(|crc| Content::DataEnd { crc }))
    }
}

fn is_known(opcode: u8) -> bool {
    // From 0x80 on, opcodes are for private use.
    (op::HEADER..=op::DATA_END).contains(&opcode) || opcode >= 0x80
}
