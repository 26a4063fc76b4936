//! What can be told without understanding the messages: records, checksums, indexes.

use super::{Check, Status};
use crate::container::{ChunkBuffer, DamageKind, DamageList};
use crate::recording::open::Segment;

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

    /// Other programs seek by message indexes, so they are looked at though nothing here is.
    fn indexes(&mut self, segment: &Segment) {
        let mut buffer = ChunkBuffer::new();
        for entry in segment.log.chunks() {
            // What is wrong with the chunk itself shows when its messages are read.
            if segment.log.read_chunk_into(entry, &mut buffer).is_err() {
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
