//! The hash chain over the events of a log.
//!
//! A link is BLAKE3 over the link before it and every message since, in order, pictures
//! included: lengths of topic and payload, event number, log time, publish time, topic, payload.
//! The chain of a segment begins with what the segment says of itself (program, configuration)
//! and ends with a seal over the last link and all counts. Links are stored with every checkpoint
//! and at the end, so a log that was edited and given new checksums still shows it. The chain
//! does not depend on how messages were packed into chunks.

use std::fmt;

use crate::graph::StateHash;

/// A link of the chain, printed as 64 hexadecimal digits.
pub type Link = StateHash;

/// The link before the first event.
pub const GENESIS: Link = StateHash([0; 32]);

/// The chain as it grows.
#[derive(Clone)]
pub struct Chain {
    hasher: blake3::Hasher,
    /// What was added but not hashed yet: long inputs are hashed several times faster.
    waiting: Vec<u8>,
}

/// Bytes at which waiting ends.
const BATCH: usize = 64 << 10;

impl fmt::Debug for Chain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Chain({})", self.link())
    }
}

impl Chain {
    /// A chain that goes on from `link`.
    pub fn after(link: Link) -> Self {
        Self { hasher: blake3::Hasher::new(), waiting: link.0.to_vec() }
    }

    /// Takes the next event message.
    pub fn add(&mut self, topic: &str, order: u64, log_time: u64, publish_time: u64, data: &[u8]) {
        let fields = [topic.len() as u64, order, log_time, publish_time, data.len() as u64];
        fields.iter().for_each(|field| self.waiting.extend_from_slice(&field.to_le_bytes()));
        self.waiting.extend_from_slice(topic.as_bytes());
        self.waiting.extend_from_slice(data);
        if self.waiting.len() >= BATCH {
            self.hasher.update(&self.waiting);
            self.waiting.clear();
        }
    }

    /// The link over all that was added.
    pub fn link(&self) -> Link {
        let mut hasher = self.hasher.clone();
        hasher.update(&self.waiting);
        StateHash(*hasher.finalize().as_bytes())
    }

    /// Makes the link over all that was added the start of what follows, and returns it.
    pub fn close(&mut self) -> Link {
        let link = self.link();
        *self = Self::after(link);
        link
    }
}

/// The hash of some texts, each preceded by its length.
pub(super) fn hash_of(parts: &[&[u8]]) -> Link {
    let mut hasher = blake3::Hasher::new();
    for part in parts {
        hasher.update(&(part.len() as u64).to_le_bytes()).update(part);
    }
    StateHash(*hasher.finalize().as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn link(edit: impl Fn(&mut Chain)) -> Link {
        let mut chain = Chain::after(GENESIS);
        chain.add("/a", 1, 10, 10, b"one");
        edit(&mut chain);
        chain.link()
    }

    #[test]
    fn every_field_of_a_message_is_in_the_link() {
        let same = link(|c| c.add("/b", 2, 20, 20, b"two"));
        assert_eq!(same, link(|c| c.add("/b", 2, 20, 20, b"two")));
        let others = [
            link(|_| {}),
            link(|c| c.add("/c", 2, 20, 20, b"two")),
            link(|c| c.add("/b", 3, 20, 20, b"two")),
            link(|c| c.add("/b", 2, 21, 20, b"two")),
            link(|c| c.add("/b", 2, 20, 21, b"two")),
            link(|c| c.add("/b", 2, 20, 20, b"tw0")),
            link(|c| c.add("/bt", 2, 20, 20, b"wo")),
        ];
        assert!(others.iter().all(|other| *other != same));
    }

    #[test]
    fn a_closed_link_carries_what_came_before() {
        let mut a = Chain::after(GENESIS);
        a.add("/a", 1, 1, 1, b"x");
        let first = a.close();
        a.add("/a", 2, 2, 2, b"y");
        let mut resumed = Chain::after(first);
        resumed.add("/a", 2, 2, 2, b"y");
        assert_eq!(a.link(), resumed.link());
    }
}
