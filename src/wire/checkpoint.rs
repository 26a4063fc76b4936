//! `Checkpoint`: a fold state as opaque bytes, with what is known of it without reading it.

use std::io::Read;

use prost::Message;

use super::common::read_stamp;
use super::fields::{Field, Fields, required};
use super::{WireError, proto};
use crate::time::Stamp;

const NAME: &str = "Checkpoint";
const STATE: u32 = 15;
/// Larger states are not read, so that a hostile one costs bounded memory.
pub const MAX_STATE: u64 = 256 << 20;
/// The first bytes of a payload that [`peek_checkpoint`] needs.
pub const CHECKPOINT_PEEK: usize = 256;
/// Most that is allocated on the word of a payload alone.
const TRUSTED: u64 = 8 << 20;
/// Level of zstd at which more costs time but hardly helps.
const ZSTD_LEVEL: i32 = 3;

/// What a checkpoint says of itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CheckpointHead {
    /// Version of the layout of the state.
    pub version: u32,
    /// Number of the event after which it stands.
    pub order: u64,
    /// Number of the last change record before it; 0 if there is none.
    pub changes: u64,
    /// Log time of that event.
    pub at: Stamp,
    /// Running BLAKE3 chain over the events up to there.
    pub chain: [u8; 32],
    /// BLAKE3 of the canonical bytes of the graph.
    pub state_hash: [u8; 32],
    /// BLAKE3 of the detectors' memory.
    pub memory_hash: [u8; 32],
    /// Length of the state, bytes.
    pub state_size: u64,
}

/// The message on `/checkpoint`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CheckpointMessage {
    /// What it says of itself; `state_size` is the length of `state`.
    pub head: CheckpointHead,
    /// The bytes of the fold state.
    pub state: Vec<u8>,
}

/// The payload for a state of which `head` is true; the size is taken from `state` itself.
pub fn encode_checkpoint(head: &CheckpointHead, state: &[u8]) -> Vec<u8> {
    let head = CheckpointHead { state_size: state.len() as u64, ..*head };
    encode_packed_checkpoint(&head, pack_state(state))
}

/// A state as a payload holds it.
pub fn pack_state(state: &[u8]) -> Vec<u8> {
    zstd::bulk::compress(state, ZSTD_LEVEL)
        .expect("compression into a buffer of its own size cannot fail")
}

/// The payload for a state that is packed already; all of `head` is true.
pub fn encode_packed_checkpoint(head: &CheckpointHead, state_zstd: Vec<u8>) -> Vec<u8> {
    let message = proto::Checkpoint {
        version: head.version,
        order: head.order,
        changes: head.changes,
        at_nanos: head.at.nanos(),
        chain: head.chain.to_vec(),
        state_hash: head.state_hash.to_vec(),
        memory_hash: head.memory_hash.to_vec(),
        state_size: head.state_size,
        state_zstd,
    };
    message.encode_to_vec()
}

/// Reads a whole payload of `/checkpoint`.
pub fn decode_checkpoint(payload: &[u8]) -> Result<CheckpointMessage, WireError> {
    let mut fields = Fields::new(NAME, payload);
    let (mut parts, mut compressed) = (Parts::default(), None);
    while let Some(field) = fields.next()? {
        match field.number {
            STATE => field.once(&mut compressed, field.bytes()?)?,
            _ => parts.read(&field)?,
        }
    }
    let head = parts.head()?;
    let state = decompress(required(compressed, NAME, "state_zstd")?, head.state_size)?;
    Ok(CheckpointMessage { head, state })
}

/// Reads all but the state from the first [`CHECKPOINT_PEEK`] bytes of a payload, or all of it.
pub fn peek_checkpoint(prefix: &[u8]) -> Result<CheckpointHead, WireError> {
    let mut fields = Fields::new(NAME, prefix);
    let mut parts = Parts::default();
    while fields.peek() != Some(STATE) {
        let Some(field) = fields.next()? else { break };
        parts.read(&field)?;
    }
    parts.head()
}

#[derive(Default)]
struct Parts {
    version: u32,
    order: u64,
    changes: u64,
    at: Stamp,
    chain: Option<[u8; 32]>,
    state_hash: Option<[u8; 32]>,
    memory_hash: Option<[u8; 32]>,
    state_size: u64,
}

impl Parts {
    fn read(&mut self, field: &Field<'_>) -> Result<(), WireError> {
        match field.number {
            1 => self.version = field.u32("version")?,
            2 => self.order = field.u64()?,
            3 => self.changes = field.u64()?,
            4 => self.at = read_stamp(field, "at_nanos")?,
            5 => self.chain = Some(read_hash(field, "chain")?),
            6 => self.state_hash = Some(read_hash(field, "state_hash")?),
            7 => self.memory_hash = Some(read_hash(field, "memory_hash")?),
            8 => self.state_size = field.u64()?,
            _ => {}
        }
        Ok(())
    }

    fn head(self) -> Result<CheckpointHead, WireError> {
        Ok(CheckpointHead {
            version: self.version,
            order: self.order,
            changes: self.changes,
            at: self.at,
            chain: required(self.chain, NAME, "chain")?,
            state_hash: required(self.state_hash, NAME, "state_hash")?,
            memory_hash: required(self.memory_hash, NAME, "memory_hash")?,
            state_size: self.state_size,
        })
    }
}

fn read_hash(field: &Field<'_>, name: &'static str) -> Result<[u8; 32], WireError> {
    let bytes = field.bytes()?;
    let len = || field.refuse(name, format!("{} bytes long", bytes.len()), "32 bytes long");
    bytes.try_into().map_err(|_| len())
}

/// Memory grows with what comes out, never with what the payload claims.
fn decompress(compressed: &[u8], size: u64) -> Result<Vec<u8>, WireError> {
    if size > MAX_STATE {
        let limit = MAX_STATE as usize;
        return Err(WireError::TooMuch { message: NAME, field: "state_size", limit });
    }
    if size <= TRUSTED {
        let state = zstd::bulk::decompress(compressed, size as usize).ok();
        let state = state.filter(|state| state.len() as u64 == size);
        return state.ok_or(WireError::State { expected: size });
    }
    let mut state = Vec::new();
    let read = zstd::Decoder::with_buffer(compressed)
        .and_then(|decoder| decoder.take(size + 1).read_to_end(&mut state));
    match read {
        Ok(_) if state.len() as u64 == size => Ok(state),
        _ => Err(WireError::State { expected: size }),
    }
}
