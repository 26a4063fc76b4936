//! Pictures that reached the disk before the events around them, when their writer was killed.
//!
//! Sensor chunks are written ahead of event chunks, so that a picture stands before what was
//! derived from it. A crash between the two leaves pictures whose numbers lie beyond the last
//! event; they were never acknowledged, and the next segment gives their numbers anew. They are
//! no part of the log.

use super::open::{Recording, Segment};
use crate::container::ChunkBuffer;

/// Tells the messages of one segment that are part of the log from those that are not.
#[derive(Debug)]
pub(super) struct Orphans {
    /// Number of the first event of the next segment.
    next_first: u64,
    /// Number of the last event that is no picture, in a segment whose writer was killed.
    last_event: u64,
    previous: u64,
}

impl Orphans {
    /// For segment number `n` of a recording that numbers its events itself.
    pub fn of(recording: &Recording, n: usize) -> Self {
        let metas = recording.segments[n + 1..].iter().filter_map(|next| next.meta.as_ref());
        let segment = &recording.segments[n];
        let last_event = match segment.log.is_finished() {
            true => u64::MAX,
            false => *segment.last_event.get_or_init(|| last_event(segment)),
        };
        let first = segment.meta.as_ref().map_or(1, |meta| meta.first_order);
        let next_first = metas.map(|meta| meta.first_order).min().unwrap_or(u64::MAX);
        Self { next_first, last_event, previous: first.saturating_sub(1) }
    }

    /// As [`Orphans::of`], for a walk that begins after event `known`, which a checkpoint covers.
    pub fn after(known: u64, recording: &Recording, n: usize) -> Self {
        let fresh = Self::of(recording, n);
        Self { previous: known.max(fresh.previous), ..fresh }
    }

    /// Whether the message with this number, the next one of the segment, is part of the log.
    pub fn takes(&mut self, order: u64) -> bool {
        // Beyond the last event a picture counts only if nothing before it is missing.
        let beyond = order > self.last_event && order > self.previous + 1;
        if order >= self.next_first || beyond {
            return false;
        }
        self.previous = self.previous.max(order);
        true
    }
}

fn last_event(segment: &Segment) -> u64 {
    let mut buffer = ChunkBuffer::new();
    for entry in segment.log.chunks().iter().rev() {
        let events = segment.events.iter().any(|id| entry.may_hold(*id));
        if !events || segment.log.read_chunk_into(entry, &mut buffer).is_err() {
            continue;
        }
        let orders = buffer
            .messages()
            .filter(|message| segment.events.contains(&message.channel))
            .map(|message| u64::from(message.sequence));
        if let Some(last) = orders.max() {
            return last;
        }
    }
    0
}
