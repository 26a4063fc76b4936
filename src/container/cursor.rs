//! Messages of many chunks in the order of the log.
//!
//! Chunks are opened only when their time comes, so for chunks that do not overlap the cursor
//! streams one chunk at a time; where they overlap it merges, within a bound on memory.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::collections::binary_heap::PeekMut;

use super::chunk::{ChunkBuffer, OrderKey, RawMessage};
use super::damage::{DamageList, LogError};
use super::decode::Decoder;
use super::entry::ChunkEntry;
use super::file::LogFile;
use super::filter::MessageFilter;

/// Emptied buffers that are kept for reuse.
const SPARE: usize = 2;
/// What an open chunk costs besides its bytes.
const OVERHEAD: u64 = 512;

/// Walks the messages of a log that a [`MessageFilter`] takes, in the order of the log.
/// Damaged chunks are left out and listed in [`Self::damage`].
pub struct MessageCursor<'l> {
    log: &'l LogFile,
    filter: MessageFilter,
    /// Chunks not yet opened, the next one last.
    pending: Vec<&'l ChunkEntry>,
    slots: Vec<Slot>,
    /// Next message of each open slot.
    heads: BinaryHeap<Reverse<(OrderKey, usize)>>,
    free: Vec<usize>,
    spare: Vec<ChunkBuffer>,
    /// Bytes of memory in all slots and spare buffers.
    held: u64,
    /// Whether the first head has been delivered and not yet passed.
    delivered: bool,
    decoder: Decoder,
    damage: DamageList,
}

#[derive(Default)]
struct Slot {
    buffer: ChunkBuffer,
    next: usize,
}

impl<'l> MessageCursor<'l> {
    pub(super) fn new(log: &'l LogFile, filter: MessageFilter) -> Self {
        let mut pending = log.chunks_for(&filter);
        pending.reverse();
        Self {
            log,
            filter,
            pending,
            slots: Vec::new(),
            heads: BinaryHeap::new(),
            free: Vec::new(),
            spare: Vec::new(),
            held: 0,
            delivered: false,
            decoder: Decoder::default(),
            damage: DamageList::new(log.limits().damages),
        }
    }

    /// Returns the next message, or `None` at the end.
    ///
    /// # Errors
    /// [`LogError::TooMuchOverlap`]; the cursor stays where it is.
    pub fn next_message(&mut self) -> Result<Option<RawMessage<'_>>, LogError> {
        self.pass_delivered();
        self.open_due()?;
        let Some(Reverse((_, slot))) = self.heads.peek() else { return Ok(None) };
        self.delivered = true;
        let slot = &self.slots[*slot];
        Ok(slot.buffer.message(slot.next))
    }

    /// Returns the damage met so far; complete once the cursor has reached the end.
    pub fn damage(&self) -> &DamageList {
        &self.damage
    }

    fn pass_delivered(&mut self) {
        if !std::mem::take(&mut self.delivered) {
            return;
        }
        let Some(mut head) = self.heads.peek_mut() else { return };
        let index = head.0.1;
        let slot = &mut self.slots[index];
        slot.next += 1;
        if let Some(key) = slot.seek(&self.filter) {
            *head = Reverse((key, index));
        } else {
            PeekMut::pop(head);
            self.release(index);
        }
    }

    /// Opens every chunk that may hold a message at or before the next one.
    fn open_due(&mut self) -> Result<(), LogError> {
        while let Some(entry) = self.pending.last().copied() {
            let head = self.heads.peek().map(|Reverse((key, _))| key.log_time);
            if head.is_some_and(|time| entry.start_time > time) {
                break;
            }
            self.pending.pop();
            if let Err(error) = self.open(entry) {
                self.pending.push(entry);
                return Err(error);
            }
        }
        Ok(())
    }

    /// Makes sure that what is held is within the limit. Asked after a chunk has been read,
    /// since only then its claims are proven: a chunk alone is bounded by the limits on chunks.
    fn check_room(&mut self, log_time: u64) -> Result<(), LogError> {
        let limit = self.log.limits().held_bytes;
        if self.held > limit {
            for buffer in self.spare.drain(..) {
                self.held -= buffer.memory();
            }
        }
        if self.held > limit && !self.heads.is_empty() {
            return Err(LogError::TooMuchOverlap { log_time, limit });
        }
        Ok(())
    }

    fn open(&mut self, entry: &ChunkEntry) -> Result<(), LogError> {
        let mut buffer = self.spare.pop().unwrap_or_default();
        self.held -= buffer.memory();
        // One decompression context serves all slots.
        std::mem::swap(&mut buffer.decoder, &mut self.decoder);
        let read = self.log.read_chunk_into(entry, &mut buffer);
        std::mem::swap(&mut buffer.decoder, &mut self.decoder);
        buffer.sort_by_time();
        self.held += buffer.memory() + OVERHEAD;
        if let Err(error) = self.check_room(entry.start_time) {
            self.held -= buffer.memory() + OVERHEAD;
            return Err(error);
        }
        if let Err(damage) = read {
            self.damage.push(damage);
        }
        let mut slot = Slot { buffer, next: 0 };
        let first = slot.seek(&self.filter);
        let index = self.free.pop().unwrap_or(self.slots.len());
        match self.slots.get_mut(index) {
            Some(vacant) => *vacant = slot,
            None => self.slots.push(slot),
        }
        match first {
            Some(key) => self.heads.push(Reverse((key, index))),
            None => self.release(index),
        }
        Ok(())
    }

    fn release(&mut self, index: usize) {
        let buffer = std::mem::take(&mut self.slots[index]).buffer;
        self.held -= OVERHEAD;
        if self.spare.len() < SPARE {
            self.spare.push(buffer);
        } else {
            self.held -= buffer.memory();
        }
        self.free.push(index);
    }
}

impl Slot {
    /// Moves to the next message that `filter` takes and returns its key.
    fn seek(&mut self, filter: &MessageFilter) -> Option<OrderKey> {
        while let Some(message) = self.buffer.message(self.next) {
            if filter.takes(&message) {
                return Some(message.key());
            }
            self.next += 1;
        }
        None
    }
}
