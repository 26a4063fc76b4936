//! What can be wrong with a log: damage, which is local and reported, and errors, which end
//! the reading. Knows no records.

use std::io;

/// A stretch of a file that cannot be believed, and why.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("bytes {offset} to {}: {kind}", offset.saturating_add(*length))]
pub struct Damage {
    /// First byte concerned.
    pub offset: u64,
    /// Number of bytes concerned.
    pub length: u64,
    /// What is wrong with them.
    pub kind: DamageKind,
}

/// The ways in which a stretch of a file can be damaged.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DamageKind {
    /// Zero bytes long.
    #[error("the file is empty")]
    Empty,
    /// The first eight bytes are wrong.
    #[error("the file does not start with the MCAP magic bytes")]
    BadMagic,
    /// The file ends inside a record, as a crash leaves it.
    #[error("the file ends inside a record; what was written before is intact")]
    TornTail,
    /// A chunk that its writer never closed.
    #[error("the writer stopped before it closed this chunk")]
    OpenChunk,
    /// A record longer than [`super::Limits::record_bytes`].
    #[error("record of type {opcode:#04x} claims {claimed} bytes, more than the limit of {limit}")]
    TooLong {
        /// Record type.
        opcode: u8,
        /// Length the record claims.
        claimed: u64,
        /// Length that is allowed.
        limit: u64,
    },
    /// A record whose fields contradict its length.
    #[error("record of type {opcode:#04x} is malformed")]
    Malformed {
        /// Record type.
        opcode: u8,
    },
    /// Bytes that are no record.
    #[error("no record starts here")]
    Garbage,
    /// Bytes after the end of the log.
    #[error("bytes after the end of the log")]
    TrailingBytes,
    /// The summary section, which is only an index: the log was read without it.
    #[error("the summary is damaged, the file was scanned instead")]
    Summary,
    /// Message indexes that do not fit the chunk before them.
    #[error("the message indexes do not fit the chunk before them; no message is lost")]
    MessageIndex,
    /// A chunk that is not the one its index promised.
    #[error("the chunk does not match its index")]
    IndexMismatch,
    /// A checksum that does not hold.
    #[error("checksum is {computed:08x} where the file says {stored:08x}")]
    Checksum {
        /// Checksum in the file.
        stored: u32,
        /// Checksum of the bytes.
        computed: u32,
    },
    /// Compressed data that cannot be decompressed to the size it claims.
    #[error("{compression} data cannot be decompressed to the {claimed} bytes it claims")]
    Decompress {
        /// Compression of the chunk.
        compression: &'static str,
        /// Size the chunk claims.
        claimed: u64,
    },
    /// A chunk larger than [`super::Limits::chunk_bytes`].
    #[error("chunk claims {claimed} bytes, more than the limit of {limit}")]
    ChunkTooLarge {
        /// Size the chunk claims.
        claimed: u64,
        /// Size that is allowed.
        limit: u64,
    },
    /// A compression that MCAP does not name.
    #[error("compression {name:?} is not known; rewrite the file with zstd, lz4 or none")]
    UnknownCompression {
        /// Name in the file.
        name: String,
    },
    /// A chunk body that is not a sequence of records.
    #[error("the chunk's records are malformed at byte {at} of its body")]
    Body {
        /// Offset in the decompressed body.
        at: u64,
    },
    /// A message outside the time range that its chunk declares.
    #[error("message at time {log_time} lies outside the time range of its chunk")]
    OutsideChunkTime {
        /// Log time of the message.
        log_time: u64,
    },
    /// A schema or channel defined twice in different ways.
    #[error("{what} {id} is defined again in another way")]
    Redefined {
        /// `schema` or `channel`.
        what: &'static str,
        /// Its id in the file.
        id: u16,
    },
    /// More schemas, channels or metadata than allowed.
    #[error("more {what} than the limit of {limit} bytes; the rest is ignored")]
    TooMuch {
        /// What there is too much of.
        what: &'static str,
        /// Bytes that are allowed.
        limit: u64,
    },
    /// The medium failed.
    #[error("cannot be read: {message}")]
    Unreadable {
        /// What the operating system said.
        message: String,
    },
}

/// Damages of one file, the first ones in full and the rest counted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DamageList {
    items: Vec<Damage>,
    beyond: u64,
    limit: usize,
}

impl DamageList {
    /// Returns an empty list that keeps at most `limit` damages.
    pub fn new(limit: usize) -> Self {
        Self { items: Vec::new(), beyond: 0, limit }
    }

    /// Adds a damage, or counts it when the list is full.
    pub fn push(&mut self, damage: Damage) {
        if self.items.len() < self.limit {
            self.items.push(damage);
        } else {
            self.beyond += 1;
        }
    }

    /// Returns the damages that were kept, in order of discovery.
    pub fn items(&self) -> &[Damage] {
        &self.items
    }

    /// Returns how many damages were found beyond those kept.
    pub fn beyond(&self) -> u64 {
        self.beyond
    }

    /// Returns whether nothing is damaged.
    pub fn is_empty(&self) -> bool {
        self.items.is_empty() && self.beyond == 0
    }
}

impl Extend<Damage> for DamageList {
    fn extend<I: IntoIterator<Item = Damage>>(&mut self, damages: I) {
        damages.into_iter().for_each(|damage| self.push(damage));
    }
}

/// Why a log cannot be read at all, or no further.
#[derive(Debug, thiserror::Error)]
pub enum LogError {
    /// The medium failed.
    #[error("cannot read the recording: {0}")]
    Io(#[from] io::Error),
    /// The file as a whole is compressed.
    #[error(
        "the whole file is compressed with {with}: decompress it first, for example with `{mend}`"
    )]
    WholeFileCompressed {
        /// Name of the compression.
        with: &'static str,
        /// Command that decompresses it.
        mend: &'static str,
    },
    /// Nothing in the file looks like MCAP.
    #[error("not an MCAP file: no magic bytes and no record of one was found")]
    NotMcap,
    /// More chunks than [`super::Limits::chunks`].
    #[error("the file has more than {limit} chunks; raise the limit to read it")]
    TooManyChunks {
        /// Chunks that are allowed.
        limit: usize,
    },
    /// Too many chunks overlap in time to be merged within [`super::Limits::held_bytes`].
    #[error(
        "chunks that overlap at time {log_time} need more than {limit} bytes at once: read fewer \
         channels or a shorter time range, or raise the limit"
    )]
    TooMuchOverlap {
        /// Log time at which the limit was reached.
        log_time: u64,
        /// Bytes that are allowed.
        limit: u64,
    },
}
