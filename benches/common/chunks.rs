//! The chunks of a log as they stand in the file: the measure that replay is held against.

use std::path::Path;
use std::sync::Arc;

use scenefold::container::{ChunkEntry, Compression, FileSource, Limits, LogFile};

/// Bytes of a zstd chunk record before its data: frame, times, size, checksum, `zstd`, length.
const CHUNK_HEAD: usize = 9 + 8 + 8 + 8 + 4 + 4 + 4 + 8;

/// A compressed chunk and the size of what is in it.
pub struct Compressed {
    data: Vec<u8>,
    size: usize,
}

/// The log at `path`.
pub fn open(path: &Path) -> LogFile {
    let source = FileSource::open(path).expect("the log was just written");
    LogFile::open(Arc::new(source), Limits::default()).expect("the log is intact")
}

/// All zstd chunks of a log, which are those of events in the logs measured here.
pub fn compressed(log: &LogFile) -> Vec<Compressed> {
    log.chunks().iter().filter(|entry| is_zstd(entry)).map(|entry| read(log, entry)).collect()
}

fn is_zstd(entry: &ChunkEntry) -> bool {
    entry.compression == Compression::Zstd
}

fn read(log: &LogFile, entry: &ChunkEntry) -> Compressed {
    let mut record = vec![0; entry.length as usize];
    log.source().read_at(entry.offset, &mut record).expect("the chunk is in the file");
    let data = record.split_off(CHUNK_HEAD);
    Compressed { data, size: entry.uncompressed_size as usize }
}

/// Decompresses all of them, one after the other, and does nothing with what comes out.
pub fn decompress(chunks: &[Compressed]) -> usize {
    let mut zstd = zstd::bulk::Decompressor::new().expect("a context can be made");
    let mut body = Vec::with_capacity(chunks.iter().map(|chunk| chunk.size).max().unwrap_or(0));
    let mut total = 0;
    for chunk in chunks {
        body.clear();
        zstd.decompress_to_buffer(&chunk.data, &mut body).expect("the chunk is intact");
        total += std::hint::black_box(&body).len();
    }
    total
}

/// What events and checkpoints take in a log without sensor data.
pub struct Sizes {
    /// Bytes of event messages.
    pub events: u64,
    /// Bytes of the file that are not checkpoints: event chunks and their indexes.
    pub events_in_file: u64,
    /// Bytes of checkpoints in the file.
    pub checkpoints: u64,
}

/// Measures a log: events are compressed, checkpoints are stored as they are.
pub fn sizes(log: &LogFile) -> Sizes {
    let of = |zstd: bool| log.chunks().iter().filter(move |entry| is_zstd(entry) == zstd);
    let checkpoints = of(false).map(|entry| entry.length).sum();
    let events = of(true).map(|entry| entry.uncompressed_size).sum();
    Sizes { events, events_in_file: log.source().len() - checkpoints, checkpoints }
}
