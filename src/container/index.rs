//! Whether the message indexes after a chunk tell the truth. They have no checksum, and nothing
//! is lost with them, but other programs seek by them.

use std::collections::BTreeMap;

use mcap::records::op;

use super::chunk::ChunkBuffer;
use super::damage::{Damage, DamageKind};
use super::entry::{ChunkEntry, Compression};
use super::file::LogFile;
use super::wire::{self, FRAME, Fields};

/// Log time and offset in the body of each message, by channel.
type Index = BTreeMap<u16, Vec<(u64, u64)>>;

impl LogFile {
    /// Compares the message indexes that follow `entry` with the messages in `buffer`, which
    /// holds that chunk. A chunk without message indexes has none to be wrong.
    ///
    /// # Errors
    /// The bytes of the indexes, if they tell something else.
    pub fn check_indexes(&self, entry: &ChunkEntry, buffer: &ChunkBuffer) -> Result<(), Damage> {
        if entry.compression == Compression::Loose {
            return Ok(());
        }
        let (stored, end) = self.stored_indexes(entry);
        let told = stored.as_ref().is_some_and(|stored| {
            stored.is_empty() || sorted(stored.clone()) == sorted(actual(buffer))
        });
        if told {
            return Ok(());
        }
        let (offset, length) = (entry.end(), end - entry.end());
        Err(Damage { offset, length, kind: DamageKind::MessageIndex })
    }

    /// The indexes after a chunk, `None` if they make no sense, and where they end.
    fn stored_indexes(&self, entry: &ChunkEntry) -> (Option<Index>, u64) {
        let mut index = Index::new();
        let mut at = entry.end();
        // No chunk within the limits can have longer indexes than this.
        let most = 64 + entry.uncompressed_size;
        loop {
            let mut head = [0; FRAME as usize];
            if self.source().read_at(at, &mut head).is_err() {
                return (Some(index), at);
            }
            let Some((op::MESSAGE_INDEX, length)) = wire::frame(&head) else {
                return (Some(index), at);
            };
            let end = at.saturating_add(FRAME).saturating_add(length);
            if length > most || end > self.source().len() {
                return (None, at.saturating_add(FRAME));
            }
            let mut body = vec![0; length as usize];
            let read = self.source().read_at(at + FRAME, &mut body).is_ok();
            if !read || read_index(&body, &mut index).is_none() {
                return (None, end);
            }
            at = end;
        }
    }
}

fn read_index(body: &[u8], index: &mut Index) -> Option<()> {
    let mut fields = Fields::new(body);
    let entries = index.entry(fields.u16()?).or_default();
    let length = fields.u32()? as usize;
    if length != fields.len() {
        return None;
    }
    while !fields.is_empty() {
        entries.push((fields.u64()?, fields.u64()?));
    }
    Some(())
}

fn actual(buffer: &ChunkBuffer) -> Index {
    let mut index = Index::new();
    for message in buffer.messages() {
        let entry = (message.log_time, message.position.offset);
        index.entry(message.channel).or_default().push(entry);
    }
    index
}

/// Channels without messages need no index, but may have one.
fn sorted(mut index: Index) -> Index {
    index.retain(|_, entries| !entries.is_empty());
    index.values_mut().for_each(|entries| entries.sort_unstable());
    index
}
