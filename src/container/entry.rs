//! What is known of a chunk before it is read. Does no IO.

use std::collections::BTreeMap;

/// How the body of a chunk is stored.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Compression {
    /// No chunk at all: a run of records directly in the data section.
    Loose,
    /// A chunk stored as it is.
    None,
    /// A chunk compressed with Zstandard.
    Zstd,
    /// A chunk compressed as an LZ4 frame.
    Lz4,
    /// A chunk compressed in a way MCAP does not name; it cannot be read.
    Unknown(String),
}

impl Compression {
    /// Returns the compression that an MCAP chunk header names.
    pub fn from_name(name: &str) -> Self {
        match name {
            "" => Self::None,
            "zstd" => Self::Zstd,
            "lz4" => Self::Lz4,
            other => Self::Unknown(other.to_owned()),
        }
    }
}

/// A chunk, or a run of messages outside any chunk, that can be read on its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChunkEntry {
    /// Offset of its first record in the file.
    pub offset: u64,
    /// Length in the file, record header included, message indexes not.
    pub length: u64,
    /// Earliest log time of its messages.
    pub start_time: u64,
    /// Latest log time of its messages.
    pub end_time: u64,
    /// Size of its body once decompressed.
    pub uncompressed_size: u64,
    /// How it is stored.
    pub compression: Compression,
    /// Channels in it, each with its number of messages where that is known. `None` if the
    /// file does not say what the chunk holds: then it may hold anything.
    pub channels: Option<BTreeMap<u16, Option<u64>>>,
}

impl ChunkEntry {
    /// Returns whether messages of `channel` may be in it.
    pub fn may_hold(&self, channel: u16) -> bool {
        self.channels.as_ref().is_none_or(|channels| channels.contains_key(&channel))
    }

    /// Returns the offset of the first byte after it.
    pub fn end(&self) -> u64 {
        self.offset.saturating_add(self.length)
    }
}
