//! [`Checkpoint`]: the state of the updater after some event, as a message.

use std::io;

use super::chain::{GENESIS, Link};
use crate::change::World;
use crate::graph::StateHash;
use crate::time::Stamp;
use crate::updater::{Config, RestoreError, Updater};
use crate::wire::CheckpointMessage;

/// Version of the message; one of another version is ignored.
const VERSION: u32 = 1;
/// Largest state that is unpacked, so that a hostile file cannot fill the memory.
const STATE_MAX: u64 = 256 << 20;

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
    /// Its state cannot be unpacked.
    #[error("its state cannot be unpacked: {0}")]
    Unpack(#[from] io::Error),
    /// Its state is not the one it was written with.
    #[error("its state does not have the hash it states")]
    Hash,
    /// Its state is none.
    #[error(transparent)]
    Restore(#[from] RestoreError),
}

impl Checkpoint {
    /// The state of `updater` now. The chain is filled in when it is written.
    pub fn of(updater: &Updater) -> Self {
        let state = updater.to_bytes();
        Self {
            order: updater.order(),
            changes: updater.changes(),
            at: updater.at(),
            chain: GENESIS,
            state_hash: updater.graph().hash(),
            memory_hash: StateHash::of(&state),
            state,
        }
    }

    pub(super) fn encode(&self) -> io::Result<Vec<u8>> {
        Ok(wire_message(self)?.encode())
    }

    pub(super) fn from_message(message: CheckpointMessage) -> Result<Self, CheckpointError> {
        if message.version != VERSION {
            return Err(CheckpointError::Version(message.version));
        }
        let state = unpack(&message)?;
        if StateHash::of(&state).0 != message.memory_hash {
            return Err(CheckpointError::Hash);
        }
        Ok(Self {
            order: message.order,
            changes: message.changes,
            at: message.at,
            chain: StateHash(message.chain),
            state_hash: StateHash(message.state_hash),
            memory_hash: StateHash(message.memory_hash),
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

fn wire_message(checkpoint: &Checkpoint) -> io::Result<CheckpointMessage> {
    Ok(CheckpointMessage {
        version: VERSION,
        order: checkpoint.order,
        changes: checkpoint.changes,
        at: checkpoint.at,
        chain: checkpoint.chain.0,
        state_hash: checkpoint.state_hash.0,
        memory_hash: checkpoint.memory_hash.0,
        state_size: checkpoint.state.len() as u64,
        state_zstd: zstd::bulk::compress(&checkpoint.state, 1)?,
    })
}

/// Never more than the message says it is, and never more than the limit.
fn unpack(message: &CheckpointMessage) -> Result<Vec<u8>, CheckpointError> {
    let too_large = || io::Error::other("it claims to be larger than 256 MiB");
    let size = message.state_size;
    if size > STATE_MAX {
        return Err(too_large().into());
    }
    // Zstandard expands at most some thousandfold: a small message cannot claim a large state.
    if size > (message.state_zstd.len() as u64).saturating_mul(32 << 10) {
        return Err(too_large().into());
    }
    Ok(zstd::bulk::decompress(&message.state_zstd, size as usize)?)
}
