//! The beginning of a message in a chunk that is stored as it is, without reading the chunk.

use mcap::records::op;

use super::entry::{ChunkEntry, Compression};
use super::file::LogFile;
use super::wire::{self, FRAME, MESSAGE_FIXED};

impl LogFile {
    /// Returns the first payload on `channel`, as far as it lies within the first `bytes` bytes
    /// of an uncompressed chunk. Nothing of it has been checked.
    pub fn peek(&self, entry: &ChunkEntry, channel: u16, bytes: usize) -> Option<Vec<u8>> {
        if entry.compression != Compression::None {
            return None;
        }
        let length = usize::try_from(entry.length).map_or(bytes, |length| length.min(bytes));
        let mut prefix = vec![0; length];
        self.source().read_at(entry.offset, &mut prefix).ok()?;
        let body = prefix.get(FRAME as usize..)?;
        let (_, fixed) = wire::chunk_header(body)?;
        first_payload(body.get(fixed..)?, channel).map(<[u8]>::to_vec)
    }
}

fn first_payload(mut records: &[u8], channel: u16) -> Option<&[u8]> {
    loop {
        let (opcode, length) = wire::frame(records)?;
        let content = &records[FRAME as usize..];
        let content = &content[..content.len().min(usize::try_from(length).ok()?)];
        if opcode == op::MESSAGE && content.get(..2)? == channel.to_le_bytes() {
            return content.get(MESSAGE_FIXED..);
        }
        records = records.get((FRAME as usize).checked_add(usize::try_from(length).ok()?)?..)?;
    }
}
