//! Bounds on what a file may make the reader do. Knows no records.

/// What a log may claim before it is disbelieved. Every bound holds whatever the bytes say.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Limits {
    /// Longest record that is read; attachments are skipped, so they may be longer.
    pub record_bytes: u64,
    /// Longest chunk body after decompression.
    pub chunk_bytes: u64,
    /// Most chunks in one file.
    pub chunks: usize,
    /// Longest summary section that is read; above it the file is scanned instead.
    pub summary_bytes: u64,
    /// Schema and channel bytes kept in all.
    pub definition_bytes: u64,
    /// Metadata bytes kept in all.
    pub metadata_bytes: u64,
    /// Bytes one [`super::MessageCursor`] may hold at once, besides the chunk it reads.
    pub held_bytes: u64,
    /// Damages listed one by one; the others are only counted.
    pub damages: usize,
}

impl Default for Limits {
    fn default() -> Self {
        const MIB: u64 = 1 << 20;
        Self {
            record_bytes: 64 * MIB,
            chunk_bytes: 128 * MIB,
            chunks: 1 << 20,
            summary_bytes: 256 * MIB,
            definition_bytes: 64 * MIB,
            metadata_bytes: 16 * MIB,
            held_bytes: 256 * MIB,
            damages: 1000,
        }
    }
}
