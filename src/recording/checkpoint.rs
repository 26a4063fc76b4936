//! [`Checkpoint`]: the state of the updater after some event, as a message.

use super::chain::{GENESIS, Link};
use crate::change::World;
use crate::graph::StateHash;
use crate::time::Stamp;
use crate::updater::{Config, RestoreError, Updater};
use crate::wire::{
    CheckpointHead, CheckpointMessage, WireError, decode_checkpoint, encode_packed_checkpoint,
    pack_state,
};

/// Version of the message; one of another version is ignored.
const VERSION: u32 = 1;

/// A full state, verified by its hashes before it is used.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    /// Number of the event it stands after.
    pub order: u64,
    /// Number of the last change by then.
    pub changes: u64,
    /// Log time of that event.
    pub at: Stamp,
    /// Link of the chain after that event.
    pub chain: Link,
    /// Hash of the graph.
    pub state_hash: StateHash,
    /// Hash of all the bytes below.
    pub memory_hash: StateHash,
    /// The bytes of the updater.
    pub state: Vec<u8>,
}

/// Why a checkpoint is not used. It is only a cache: the fold starts from the one before.
#[derive(Debug, thiserror::Error)]
pub enum CheckpointError {
    /// Written by another version of the program.
    #[error("it has version {0}")]
    Version(u32),
    /// The message is none.
    #[error(transparent)]
    Wire(#[from] WireError),
    /// Its state is not the one it was written with.
    #[error("its state does not have the hash it states")]
    Hash,
    /// It says that it stands elsewhere than its state does.
    #[error("it says that it stands after another event than its state does")]
    Head,
    /// Its state is none.
    #[error(transparent)]
    Restore(#[from] RestoreError),
}

impl Checkpoint {
    /// The state of `updater` now. The chain is filled in when it is written.
    pub fn of(updater: &Updater) -> Self {
        let (state, state_hash) = updater.to_bytes_and_hash();
        Self {
            order: updater.order(),
            changes: updater.changes(),
            at: updater.at(),
            chain: GENESIS,
            state_hash,
            memory_hash: StateHash::of(&state),
            state,
        }
    }

    /// The state as it is stored.
    pub(super) fn packed(&self) -> Vec<u8> {
        pack_state(&self.state)
    }

    /// The payload; `packed` is what [`Self::packed`] gave.
    pub(super) fn encode(&self, packed: Vec<u8>) -> Vec<u8> {
        let head = CheckpointHead {
            version: VERSION,
            order: self.order,
            changes: self.changes,
            at: self.at,
            chain: self.chain.0,
            state_hash: self.state_hash.0,
            memory_hash: self.memory_hash.0,
            state_size: self.state.len() as u64,
        };
        encode_packed_checkpoint(&head, packed)
    }

    /// Reads a payload and verifies that the state is the one that was written.
    pub(super) fn decode(payload: &[u8]) -> Result<Self, CheckpointError> {
        let CheckpointMessage { head, state } = decode_checkpoint(payload)?;
        if head.version != VERSION {
            return Err(CheckpointError::Version(head.version));
        }
        if StateHash::of(&state).0 != head.memory_hash {
            return Err(CheckpointError::Hash);
        }
        if Updater::counters_from_bytes(&state)? != (head.order, head.changes, head.at) {
            return Err(CheckpointError::Head);
        }
        Ok(Self {
            order: head.order,
            changes: head.changes,
            at: head.at,
            chain: StateHash(head.chain),
            state_hash: StateHash(head.state_hash),
            memory_hash: StateHash(head.memory_hash),
            state,
        })
    }

    /// The world it holds.
    pub fn world(&self) -> Result<World, CheckpointError> {
        Ok(Updater::world_from_bytes(&self.state)?)
    }

    /// The updater it holds, going on under `config`.
    pub fn updater(&self, config: Config) -> Result<Updater, CheckpointError> {
        Ok(Updater::from_bytes(config, &self.state)?)
    }
}
