//! A log opened for reading, whole or damaged. Knows nothing of what messages mean.

use std::collections::BTreeMap;
use std::sync::Arc;

use mcap::records::{Channel, Header, Metadata, Statistics};

use super::chunk::ChunkBuffer;
use super::cursor::MessageCursor;
use super::damage::{Damage, DamageKind, DamageList, LogError};
use super::entry::ChunkEntry;
use super::filter::MessageFilter;
use super::learn::{Definitions, learn};
use super::limits::Limits;
use super::scan::{Found, walk};
use super::source::Source;
use super::summary::{self, Outcome, Summary};
use super::wire::Schema;

/// Bytes of the magic number that starts and ends a log.
const MAGIC: u64 = mcap::MAGIC.len() as u64;

/// A log: its tables, and access to its chunks and messages. Can be shared between threads.
pub struct LogFile {
    source: Arc<dyn Source>,
    limits: Limits,
    definitions: Definitions,
    found: Found,
    statistics: Option<Statistics>,
}

impl LogFile {
    /// Opens a log through its summary, or by scanning it if there is none to be trusted.
    ///
    /// # Errors
    /// If the medium fails or the file cannot be a log at all; damage is no error.
    pub fn open(source: Arc<dyn Source>, limits: Limits) -> Result<Self, LogError> {
        match summary::read(&*source, &limits)? {
            Outcome::Sound(summary) => Self::from_summary(source, limits, *summary),
            Outcome::Absent => Self::scan(source, limits),
            Outcome::Damaged(range) => {
                let mut log = Self::scan(source, limits)?;
                let (offset, length) = (range.start, range.end - range.start);
                log.found.damage.push(Damage { offset, length, kind: DamageKind::Summary });
                Ok(log)
            }
        }
    }

    /// Opens a log by walking over its records, without using its summary.
    ///
    /// # Errors
    /// As [`Self::open`].
    pub fn scan(source: Arc<dyn Source>, limits: Limits) -> Result<Self, LogError> {
        let mut found = Found::new(&limits);
        check_start(&*source, &mut found)?;
        let foreign = !found.damage.is_empty() && source.len() >= MAGIC;
        walk(&*source, &limits, MAGIC..source.len(), &mut found)?;
        if foreign && found.records == 0 {
            return Err(LogError::NotMcap);
        }
        Ok(Self::learned(source, limits, found, Definitions::default(), None))
    }

    fn from_summary(
        source: Arc<dyn Source>,
        limits: Limits,
        summary: Summary,
    ) -> Result<Self, LogError> {
        let mut found = Found::new(&limits);
        check_start(&*source, &mut found)?;
        for gap in summary.gaps() {
            walk(&*source, &limits, gap, &mut found)?;
        }
        found.finished = true;
        found.chunks.extend(summary.chunks);
        found.chunks.sort_by_key(|entry| entry.offset);
        let mut definitions = Definitions::default();
        let offset = summary.start;
        for schema in summary.schemas {
            let kind = definitions.add_schema(schema).err();
            found.damage.extend(kind.map(|kind| Damage { offset, length: 0, kind }));
        }
        for channel in summary.channels {
            let kind = definitions.add_channel(channel).err();
            found.damage.extend(kind.map(|kind| Damage { offset, length: 0, kind }));
        }
        Ok(Self::learned(source, limits, found, definitions, summary.statistics))
    }

    fn learned(
        source: Arc<dyn Source>,
        limits: Limits,
        mut found: Found,
        mut definitions: Definitions,
        statistics: Option<Statistics>,
    ) -> Self {
        learn(&*source, &limits, &mut found, &mut definitions);
        Self { source, limits, definitions, found, statistics }
    }

    /// Returns the limits it was opened with.
    pub fn limits(&self) -> &Limits {
        &self.limits
    }

    /// Returns the source it reads from.
    pub fn source(&self) -> &Arc<dyn Source> {
        &self.source
    }

    /// Returns the header record, if it is intact.
    pub fn header(&self) -> Option<&Header> {
        self.found.header.as_ref()
    }

    /// Returns the schemas by id.
    pub fn schemas(&self) -> &BTreeMap<u16, Schema> {
        &self.definitions.schemas
    }

    /// Returns the channels by id.
    pub fn channels(&self) -> &BTreeMap<u16, Channel> {
        &self.definitions.channels
    }

    /// Returns the chunks in file order; runs of messages outside chunks count as chunks.
    pub fn chunks(&self) -> &[ChunkEntry] {
        &self.found.chunks
    }

    /// Returns the metadata records in file order.
    pub fn metadata(&self) -> &[Metadata] {
        &self.found.metadata
    }

    /// Returns the statistics, if the log has a summary to be trusted.
    pub fn statistics(&self) -> Option<&Statistics> {
        self.statistics.as_ref()
    }

    /// Returns the number of attachments; they are never loaded.
    pub fn attachments(&self) -> u64 {
        self.found.attachments
    }

    /// Returns whether its writer closed it.
    pub fn is_finished(&self) -> bool {
        self.found.finished
    }

    /// Returns the damage outside chunks; that inside shows when chunks are read.
    pub fn damage(&self) -> &DamageList {
        &self.found.damage
    }

    /// Returns the chunks that may hold messages `filter` takes, by start time, then offset.
    pub fn chunks_for(&self, filter: &MessageFilter) -> Vec<&ChunkEntry> {
        let mut chunks: Vec<_> = self.chunks().iter().filter(|e| filter.may_take(e)).collect();
        chunks.sort_by_key(|entry| (entry.start_time, entry.offset));
        chunks
    }

    /// Returns a cursor over the messages `filter` takes, in the order of the log.
    pub fn messages(&self, filter: MessageFilter) -> MessageCursor<'_> {
        MessageCursor::new(self, filter)
    }

    /// Reads a chunk and checks all of it, reusing the memory of `buffer`.
    ///
    /// # Errors
    /// What is wrong with the chunk; `buffer` is then empty.
    pub fn read_chunk_into(
        &self,
        entry: &ChunkEntry,
        buffer: &mut ChunkBuffer,
    ) -> Result<(), Damage> {
        let loaded = buffer.load(&*self.source, &self.limits, entry);
        let checked = loaded.and_then(|()| self.definitions.check(buffer));
        checked.map_err(|kind| {
            buffer.clear();
            Damage { offset: entry.offset, length: entry.length, kind }
        })
    }

    /// Compares the checksum of the whole data section, by which damage outside chunks shows.
    /// Returns `None` if the file has no such checksum.
    ///
    /// # Errors
    /// If the medium fails.
    pub fn check_data_section(&self) -> Result<Option<bool>, LogError> {
        let Some((end, stored)) = self.found.data_end.filter(|(_, crc)| *crc != 0) else {
            return Ok(None);
        };
        let mut crc = crc32fast::Hasher::new();
        let mut block = vec![0; 1 << 20];
        let mut at = 0;
        while at < end {
            let n = (end - at).min(block.len() as u64) as usize;
            self.source.read_at(at, &mut block[..n])?;
            crc.update(&block[..n]);
            at += n as u64;
        }
        Ok(Some(crc.finalize() == stored))
    }
}

/// Looks at the first bytes: a log, a compressed log, or something else.
fn check_start(source: &dyn Source, found: &mut Found) -> Result<(), LogError> {
    let mut bytes = [0; mcap::MAGIC.len()];
    let length = source.len().min(MAGIC);
    let start = &mut bytes[..length as usize];
    source.read_at(0, start)?;
    let compressed = match *start {
        [0x28, 0xb5, 0x2f, 0xfd, ..] => Some(("zstd", "zstd -d FILE")),
        [0x04, 0x22, 0x4d, 0x18, ..] => Some(("lz4", "lz4 -d FILE")),
        [0x1f, 0x8b, ..] => Some(("gzip", "gunzip FILE")),
        _ => None,
    };
    if let Some((with, mend)) = compressed {
        return Err(LogError::WholeFileCompressed { with, mend });
    }
    if start == mcap::MAGIC {
        return Ok(());
    }
    let kind = match start.len() {
        0 => DamageKind::Empty,
        n if n < mcap::MAGIC.len() && mcap::MAGIC.starts_with(start) => DamageKind::TornTail,
        n if n < mcap::MAGIC.len() => return Err(LogError::NotMcap),
        _ => DamageKind::BadMagic,
    };
    found.damage.push(Damage { offset: 0, length, kind });
    Ok(())
}
