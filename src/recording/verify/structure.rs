//! What can be told without understanding the messages: records, checksums, indexes.

use super::{Check, Status};
use crate::container::{ChunkBuffer, ChunkEntry, DamageKind, DamageList};
use crate::recording::open::{Recording, Segment};

impl Check<'_> {
    pub(super) fn structure(&mut self) {
        for segment in &self.recording.segments {
            self.damages(segment, segment.log.damage());
            if !segment.log.is_finished() {
                let what = "the file was never ended: its writer was stopped".to_owned();
                self.find(Status::Truncated, segment, what);
            }
            self.indexes(segment);
            match segment.log.check_data_section() {
                Ok(Some(false)) => {
                    let what = "the checksum of the data section does not hold".to_owned();
                    self.find(Status::Corrupt, segment, what);
                }
                Err(error) => self.find(Status::Corrupt, segment, error.to_string()),
                Ok(_) => {}
            }
        }
    }

    /// The summary says where the chunks are and what is in them; readers believe it.
    pub(super) fn compare_indexes(&mut self, opened: &Recording) {
        for (segment, indexed) in self.recording.segments.iter().zip(&opened.segments) {
            self.damages(segment, indexed.log.damage());
            let (scanned, told) = (segment.log.chunks(), indexed.log.chunks());
            let lies = scanned.len() != told.len()
                || scanned.iter().zip(told).any(|(a, b)| !same_chunk(a, b));
            if lies {
                let what = "the summary does not describe the chunks of the file".to_owned();
                self.find(Status::Corrupt, segment, what);
            }
        }
    }

    /// Other programs seek by message indexes, so they are looked at though nothing here is.
    fn indexes(&mut self, segment: &Segment) {
        let mut buffer = ChunkBuffer::new();
        let chunks = segment.log.chunks();
        for (n, entry) in chunks.iter().enumerate() {
            if let Err(damage) = segment.log.read_chunk_into(entry, &mut buffer) {
                self.find(Status::Corrupt, segment, damage.to_string());
                continue;
            }
            // Where a file is torn, the indexes of its last chunk are as well.
            if !segment.log.is_finished() && n + 1 == chunks.len() {
                continue;
            }
            if let Err(damage) = segment.log.check_indexes(entry, &buffer) {
                self.find(Status::Corrupt, segment, damage.to_string());
            }
        }
    }

    pub(super) fn damages(&mut self, segment: &Segment, damages: &DamageList) {
        for damage in damages.items() {
            let status = match damage.kind {
                DamageKind::TornTail | DamageKind::OpenChunk | DamageKind::Empty => {
                    Status::Truncated
                }
                _ => Status::Corrupt,
            };
            self.find(status, segment, damage.to_string());
        }
    }
}

fn same_chunk(a: &ChunkEntry, b: &ChunkEntry) -> bool {
    let channels = |entry: &ChunkEntry| {
        entry.channels.as_ref().map(|channels| channels.keys().copied().collect::<Vec<u16>>())
    };
    (a.offset, a.length, a.start_time, a.end_time, a.uncompressed_size)
        == (b.offset, b.length, b.start_time, b.end_time, b.uncompressed_size)
        && a.compression == b.compression
        // Files without message indexes tell what is in a chunk in one of the two places only.
        && channels(a).zip(channels(b)).is_none_or(|(a, b)| a == b)
}
