//! The walk over records that finds what is in a file without its summary.
//!
//! It reads record headers, not chunk bodies. Damage is skipped and reported; the walk goes on
//! at the next believable record. With a sound summary only the gaps between the indexed chunks
//! are walked.

use std::collections::BTreeMap;
use std::ops::Range;

use mcap::records::{Channel, Header, Metadata, op};

use super::damage::{Damage, DamageKind, DamageList, LogError};
use super::entry::{ChunkEntry, Compression};
use super::examine::{Content, Examiner, Frame};
use super::limits::Limits;
use super::source::Source;
use super::window::Window;
use super::wire::Schema;

/// Bytes of loose records that are read as one.
const LOOSE_RUN: u64 = 1 << 20;
/// Channels named by message indexes that are remembered in all.
const CHANNEL_REFS_MAX: usize = 16 << 20;

/// What a walk has found, in file order.
pub(super) struct Found {
    pub header: Option<Header>,
    pub chunks: Vec<ChunkEntry>,
    pub schemas: Vec<(Range<u64>, Schema)>,
    pub channels: Vec<(Range<u64>, Channel)>,
    pub metadata: Vec<Metadata>,
    pub attachments: u64,
    /// Offset of the record that ends the data section, and the checksum in it.
    pub data_end: Option<(u64, u32)>,
    pub finished: bool,
    pub records: u64,
    pub damage: DamageList,
    definition_bytes: u64,
    metadata_bytes: u64,
}

impl Found {
    pub(super) fn new(limits: &Limits) -> Self {
        Self {
            header: None,
            chunks: Vec::new(),
            schemas: Vec::new(),
            channels: Vec::new(),
            metadata: Vec::new(),
            attachments: 0,
            data_end: None,
            finished: false,
            records: 0,
            damage: DamageList::new(limits.damages),
            definition_bytes: 0,
            metadata_bytes: 0,
        }
    }
}

/// Walks the records from `from` to `until` and adds what they hold to `found`.
pub(super) fn walk(
    source: &dyn Source,
    limits: &Limits,
    range: Range<u64>,
    found: &mut Found,
) -> Result<(), LogError> {
    let mut examiner = Examiner::new(Window::new(source, range.end), *limits, range.end);
    examiner.to_the_end = range.end == source.len();
    Walk { examiner, found, run: None, collecting: None, channel_refs: 0, loose: false }
        .run(range.start)
}

/// A chunk whose message indexes are being read.
struct Collecting {
    entry: ChunkEntry,
    channels: BTreeMap<u16, Option<u64>>,
}

struct Walk<'s, 'f> {
    examiner: Examiner<'s>,
    found: &'f mut Found,
    run: Option<ChunkEntry>,
    collecting: Option<Collecting>,
    channel_refs: usize,
    /// Whether messages outside chunks have been seen.
    loose: bool,
}

impl Walk<'_, '_> {
    fn run(mut self, from: u64) -> Result<(), LogError> {
        let mut at = from;
        while at < self.examiner.until {
            at = self.step(at)?;
        }
        self.close_run()?;
        // The file ends here, so further message indexes may have been lost with its end.
        self.settle(false)
    }

    /// Takes one record, or one stretch of damage, and returns where the next one starts.
    fn step(&mut self, at: u64) -> Result<u64, LogError> {
        let frame = match self.examiner.frame(at)? {
            Ok(frame) => frame,
            Err(kind) => return self.skip(at, kind),
        };
        let content = match self.examiner.content(frame)? {
            Ok(content) => content,
            Err(kind) => return self.skip(at, kind),
        };
        if !content.confirms_length() && !self.ends_well(frame)? {
            return self.skip(at, DamageKind::Malformed { opcode: frame.opcode });
        }
        self.found.records += 1;
        self.accept(frame, content)
    }

    /// Whether the end of `frame` is believable: a record follows, or none starts inside.
    fn ends_well(&mut self, frame: Frame) -> Result<bool, LogError> {
        if self.examiner.plausible(frame.end())? {
            return Ok(true);
        }
        // Nothing at all speaks for an unknown record that no record follows.
        if frame.opcode > op::DATA_END {
            return Ok(false);
        }
        let loose = self.may_be_loose(frame.opcode);
        Ok(self.examiner.resync(frame.offset + 1, loose)? >= frame.end())
    }

    fn may_be_loose(&self, opcode: u8) -> bool {
        let no_chunks = self.found.chunks.is_empty() && self.collecting.is_none();
        self.loose || (no_chunks && opcode != op::CHUNK)
    }

    fn skip(&mut self, at: u64, kind: DamageKind) -> Result<u64, LogError> {
        self.close_run()?;
        self.settle(false)?;
        let opcode = self.examiner.window.peek(at, 1)?.first().copied().unwrap_or(0);
        let loose = self.may_be_loose(opcode);
        let next = self.examiner.resync(at + 1, loose)?;
        let kind = match kind {
            _ if self.found.finished => DamageKind::TrailingBytes,
            // A record that overruns the file is a torn tail only if nothing follows in it.
            DamageKind::TornTail if !self.examiner.to_the_end || next != self.examiner.until => {
                DamageKind::Malformed { opcode }
            }
            kind => kind,
        };
        self.found.damage.push(Damage { offset: at, length: next - at, kind });
        Ok(next)
    }

    fn accept(&mut self, frame: Frame, content: Content) -> Result<u64, LogError> {
        if let Content::MessageIndex { channel, count } = content {
            self.index(channel, count);
            return Ok(frame.end());
        }
        // Whatever else comes ends the message indexes of the chunk before it.
        self.settle(true)?;
        match content {
            Content::Message { channel, log_time } => {
                self.loose_message(frame, channel, log_time)?;
            }
            Content::Schema(schema) => self.schema(frame, schema)?,
            Content::Channel(channel) => self.channel(frame, channel)?,
            other => {
                self.close_run()?;
                return self.structural(frame, other);
            }
        }
        Ok(frame.end())
    }

    fn structural(&mut self, frame: Frame, content: Content) -> Result<u64, LogError> {
        match content {
            Content::Header(header) => {
                self.found.header.get_or_insert(header);
            }
            Content::Chunk(entry) => {
                self.collecting = Some(Collecting { entry, channels: BTreeMap::new() });
            }
            Content::Metadata(metadata) => self.metadata(frame, metadata),
            Content::Attachment => self.found.attachments += 1,
            Content::DataEnd { crc } => {
                self.found.data_end.get_or_insert((frame.offset, crc));
            }
            Content::Footer => return self.footer(frame),
            _ => {}
        }
        Ok(frame.end())
    }

    /// A log is finished if the footer is followed by the magic bytes.
    fn footer(&mut self, frame: Frame) -> Result<u64, LogError> {
        let magic = self.examiner.window.peek(frame.end(), mcap::MAGIC.len())? == mcap::MAGIC;
        if magic {
            self.found.finished = self.found.data_end.is_some();
        }
        Ok(frame.end() + if magic { mcap::MAGIC.len() as u64 } else { 0 })
    }

    fn index(&mut self, channel: u16, count: u64) {
        if let Some(collecting) = &mut self.collecting {
            self.channel_refs += 1;
            // Writers may index a channel of which the chunk holds nothing.
            if count > 0 {
                collecting.channels.insert(channel, Some(count));
            }
        }
    }

    /// Ends the collection of message indexes; `whole` says that none can be missing.
    fn settle(&mut self, whole: bool) -> Result<(), LogError> {
        let Some(collecting) = self.collecting.take() else { return Ok(()) };
        let known =
            whole && !collecting.channels.is_empty() && self.channel_refs <= CHANNEL_REFS_MAX;
        let channels = known.then_some(collecting.channels);
        self.push(ChunkEntry { channels, ..collecting.entry })
    }

    fn loose_message(&mut self, frame: Frame, channel: u16, log_time: u64) -> Result<(), LogError> {
        self.loose = true;
        if !self.extends_run(frame) {
            self.close_run()?;
        }
        let run = self.run.get_or_insert_with(|| new_run(frame.offset, log_time));
        run.length = frame.end() - run.offset;
        run.start_time = run.start_time.min(log_time);
        run.end_time = run.end_time.max(log_time);
        let count = run.channels.get_or_insert_default().entry(channel).or_insert(Some(0));
        *count = count.map(|count| count + 1);
        Ok(())
    }

    fn extends_run(&self, frame: Frame) -> bool {
        self.run.as_ref().is_some_and(|run| run.end() == frame.offset && run.length < LOOSE_RUN)
    }

    fn close_run(&mut self) -> Result<(), LogError> {
        let Some(run) = self.run.take() else { return Ok(()) };
        self.push(ChunkEntry { uncompressed_size: run.length, ..run })
    }

    fn push(&mut self, entry: ChunkEntry) -> Result<(), LogError> {
        if self.found.chunks.len() >= self.examiner.limits.chunks {
            return Err(LogError::TooManyChunks { limit: self.examiner.limits.chunks });
        }
        self.found.chunks.push(entry);
        Ok(())
    }

    fn schema(&mut self, frame: Frame, schema: Schema) -> Result<(), LogError> {
        self.definition(frame)?;
        if self.within_definitions(frame) {
            self.found.schemas.push((frame.offset..frame.end(), schema));
        }
        Ok(())
    }

    fn channel(&mut self, frame: Frame, channel: Channel) -> Result<(), LogError> {
        self.definition(frame)?;
        if self.within_definitions(frame) {
            self.found.channels.push((frame.offset..frame.end(), channel));
        }
        Ok(())
    }

    /// Definitions between loose messages belong to their run.
    fn definition(&mut self, frame: Frame) -> Result<(), LogError> {
        if self.extends_run(frame) {
            if let Some(run) = &mut self.run {
                run.length = frame.end() - run.offset;
            }
            return Ok(());
        }
        self.close_run()
    }

    fn within_definitions(&mut self, frame: Frame) -> bool {
        let limit = self.examiner.limits.definition_bytes;
        // Small records cost more in memory than in the file.
        self.found.definition_bytes += frame.body_len + 64;
        let within = self.found.definition_bytes <= limit;
        if !within {
            self.too_much(frame, "schema and channel definitions", limit);
        }
        within
    }

    fn metadata(&mut self, frame: Frame, metadata: Metadata) {
        let limit = self.examiner.limits.metadata_bytes;
        self.found.metadata_bytes += frame.body_len + 64;
        if self.found.metadata_bytes <= limit {
            self.found.metadata.push(metadata);
        } else {
            self.too_much(frame, "metadata", limit);
        }
    }

    fn too_much(&mut self, frame: Frame, what: &'static str, limit: u64) {
        let (offset, length) = (frame.offset, frame.end() - frame.offset);
        self.found.damage.push(Damage {
            offset,
            length,
            kind: DamageKind::TooMuch { what, limit },
        });
    }
}

fn new_run(offset: u64, log_time: u64) -> ChunkEntry {
    ChunkEntry {
        offset,
        length: 0,
        start_time: log_time,
        end_time: log_time,
        uncompressed_size: 0,
        compression: Compression::Loose,
        channels: None,
    }
}
