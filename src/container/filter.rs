//! Which messages of a log are wanted. Does no IO.

use std::collections::BTreeSet;

use super::chunk::{OrderKey, RawMessage};
use super::entry::ChunkEntry;

/// A choice of messages; the default is all of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MessageFilter {
    /// Channel ids, or all channels.
    pub channels: Option<BTreeSet<u16>>,
    /// Earliest log time, included.
    pub from_time: u64,
    /// Latest log time, included.
    pub until_time: u64,
    /// Only messages that come after this one in the order of the log.
    pub after: Option<OrderKey>,
}

impl Default for MessageFilter {
    fn default() -> Self {
        Self { channels: None, from_time: 0, until_time: u64::MAX, after: None }
    }
}

impl MessageFilter {
    /// Returns the choice of all messages on `channels`.
    pub fn on_channels(channels: impl IntoIterator<Item = u16>) -> Self {
        Self { channels: Some(channels.into_iter().collect()), ..Self::default() }
    }

    /// Returns whether a chunk may hold a wanted message.
    pub fn may_take(&self, entry: &ChunkEntry) -> bool {
        let in_time = entry.start_time <= self.until_time && entry.end_time >= self.from_time;
        let after = self.after.is_none_or(|after| {
            // At equal times only a later chunk, or the one the message stands in, can follow.
            entry.end_time > after.log_time
                || (entry.end_time == after.log_time && entry.offset >= after.position.chunk)
        });
        let channels = self.channels.as_ref();
        in_time && after && channels.is_none_or(|ids| ids.iter().any(|id| entry.may_hold(*id)))
    }

    /// Returns whether a message is wanted.
    pub fn takes(&self, message: &RawMessage<'_>) -> bool {
        (self.from_time..=self.until_time).contains(&message.log_time)
            && self.after.is_none_or(|after| message.key() > after)
            && self.channels.as_ref().is_none_or(|ids| ids.contains(&message.channel))
    }
}
