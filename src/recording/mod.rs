//! Recordings: logs of events in MCAP files, written as they happen and read back at any point.
//!
//! The only module that opens recordings. A recording is one MCAP file or a folder of segments,
//! one for each run of the recorder, read in the order of their names.
//!
//! - [`Recorder`] takes inputs, runs them through the [`crate::updater::Updater`] and writes
//!   what comes out, with checkpoints, a hash chain and acknowledgements.
//! - [`Recording`] opens one; [`Recording::state_at`] gives any past state,
//!   [`Recording::visit_events`] any past event.
//! - [`verify()`] says what is wrong with one, [`recover()`] saves what is intact, [`reprocess()`]
//!   runs the detectors again.
//!
//! Invariant: log time never decreases along a recording, and (log time, position in the file)
//! is the order in which events arrived.
//! Invariant: what was acknowledged is read back after `kill -9`.
//! Invariant: a checkpoint is a cache; leaving all of them out changes no state.

mod batch;
mod chain;
mod checkpoint;
mod events;
mod meta;
mod open;
mod orphans;
mod parallel;
mod point;
mod recorder;
mod recover;
mod reprocess;
mod resume;
mod segment;
mod sink;
mod state;
mod summary;
mod verify;
mod way;

pub use chain::{Chain, Link};
pub use checkpoint::Checkpoint;
pub use events::{Walk, WalkError};
pub use meta::{Ending, FORMAT_VERSION, Meta, Seal};
pub use open::{OpenError, Recording};
pub use point::{Point, PointError};
pub use recorder::{RecordError, Recorded, Recorder, RecorderOptions, SyncPolicy};
pub use recover::{LostEvents, Recovered, recover};
pub use reprocess::{Difference, ReprocessError, Reprocessed, UpdateSink, reprocess};
pub use state::State;
pub use summary::{ChannelSummary, Summary};
pub use verify::{Finding, Status, Verified, verify, verify_bytes};
