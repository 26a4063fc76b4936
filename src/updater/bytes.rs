//! The bytes of an updater: what a checkpoint holds.

use super::{Config, Updater};
use crate::bytes::{Reader, Writer};
use crate::change::World;
use crate::graph::{CanonicalError, StateHash};
use crate::modality::action::ActionDetector;
use crate::modality::human::HumanDetector;
use crate::modality::time::TimeDetector;
use crate::time::Stamp;

/// Versions of the bytes. A checkpoint of another one is ignored, for it is only a cache. The
/// memory of time stands only where the configuration asks for it, so that recordings without
/// it are the same bytes for ever.
const STATE_VERSION: u64 = 1;
/// With the memory of time after that of actions.
const STATE_VERSION_TIME: u64 = 2;

/// Says that the memory of what was said follows. It is left out where there is none, so that
/// checkpoints of recordings without language are what they always were.
const LANGUAGE_FOLLOWS: u64 = 1;

/// Why bytes are not those of an updater.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RestoreError {
    /// Written by another version of the program.
    #[error("checkpoint bytes have version {found}, this program reads up to 2")]
    Version {
        /// The version found.
        found: u64,
    },
    /// The bytes do not hold what they should.
    #[error(transparent)]
    Malformed(#[from] CanonicalError),
}

impl Updater {
    /// Everything but the configuration, as bytes. Equal states have equal bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        self.to_bytes_and_hash().0
    }

    /// [`Updater::to_bytes`], and the hash of the graph, which costs little beside them.
    pub fn to_bytes_and_hash(&self) -> (Vec<u8>, StateHash) {
        let mut out = Writer::default();
        let watches = self.config.stale_below.is_some();
        out.u64(if watches { STATE_VERSION_TIME } else { STATE_VERSION });
        out.u64(self.order);
        out.u64(self.changes);
        out.u64(self.at.nanos());
        let hash = self.world.write_bytes(&mut out);
        self.action.write_bytes(&mut out);
        if watches {
            self.time.write_bytes(&mut out);
        }
        if !(self.human.is_empty() && self.action.is_simple()) {
            out.u64(LANGUAGE_FOLLOWS);
            self.human.write_bytes(&mut out);
            self.action.write_parts(&mut out);
        }
        (out.0, hash)
    }

    /// The updater with these bytes, going on under `config`.
    pub fn from_bytes(config: Config, bytes: &[u8]) -> Result<Self, RestoreError> {
        let mut input = Reader(bytes);
        let (order, changes, at) = read_counters(&mut input)?;
        let world = World::read_bytes(&mut input)?;
        let mut action = ActionDetector::read_bytes(&mut input)?;
        let has_time = Reader(bytes).u64() == Some(STATE_VERSION_TIME);
        let remembered =
            if has_time { Some(TimeDetector::read_bytes(&mut input)?) } else { None };
        let human = read_language(&mut input, &mut action)?;
        if !input.0.is_empty() {
            let what = "bytes follow the last memory";
            return Err(CanonicalError::Malformed { what }.into());
        }
        let time = match (config.stale_below, remembered) {
            (Some(_), Some(remembered)) => remembered,
            // The state of a recording that had no threshold, gone on with under one.
            (Some(threshold), None) => TimeDetector::resumed(world.graph(), threshold, at),
            (None, _) => TimeDetector::default(),
        };
        Ok(Self { config, world, action, human, time, order, changes, at })
    }

    /// Number of the last event, number of the last change and log time of the last event.
    pub fn counters_from_bytes(bytes: &[u8]) -> Result<(u64, u64, Stamp), RestoreError> {
        read_counters(&mut Reader(bytes))
    }

    /// Only the world of these bytes; the memory of detectors is not needed to replay.
    pub fn world_from_bytes(bytes: &[u8]) -> Result<World, RestoreError> {
        let mut input = Reader(bytes);
        read_counters(&mut input)?;
        Ok(World::read_bytes(&mut input)?)
    }
}

fn read_language(
    input: &mut Reader<'_>,
    action: &mut ActionDetector,
) -> Result<HumanDetector, CanonicalError> {
    if input.0.is_empty() {
        return Ok(HumanDetector::default());
    }
    if input.u64() != Some(LANGUAGE_FOLLOWS) {
        return Err(CanonicalError::Malformed { what: "bytes follow the last memory" });
    }
    let human = HumanDetector::read_bytes(input)?;
    action.read_parts(input)?;
    Ok(human)
}

fn read_counters(input: &mut Reader<'_>) -> Result<(u64, u64, Stamp), RestoreError> {
    let malformed = CanonicalError::Malformed { what: "counters" };
    match input.u64() {
        Some(STATE_VERSION | STATE_VERSION_TIME) => {}
        Some(found) => return Err(RestoreError::Version { found }),
        None => return Err(malformed.into()),
    }
    let counters = (|| Some((input.u64()?, input.u64()?, Stamp::from_nanos(input.u64()?))))();
    counters.ok_or(malformed.into())
}
