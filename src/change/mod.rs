//! What changes a graph: the unified language, primitives, transactions, and the planner.
//!
//! Knows nothing of detectors, messages or files. A [`ChangeRecord`] says what changed in the
//! world, in the terms of the paper's unified language; the planner compiles it against what is
//! known ([`World`]) to [`Primitive`]s, or rejects it with a [`Rejection`] that is recorded.
//!
//! Invariant: a graph changes only through [`Primitive`]s; a refused one changes nothing.
//! Invariant: a [`Transaction`] is applied whole or not at all.

mod evidence;
mod memory;
mod planner;
mod primitive;
mod record;
mod rejection;
mod resolve;
#[cfg(test)]
mod tests;
mod transaction;
mod world;

pub use evidence::EvidenceRef;
pub(crate) use planner::topological_pose;
pub use planner::{Plan, PlanConfig, plan};
pub use primitive::{Departure, Known, Primitive, Sighting, Undo};
pub use record::{Action, ChangeRecord, Claim, Modality, NodeRef, Occurred, Outcome};
pub use rejection::Rejection;
pub(crate) use resolve::room_around;
pub use resolve::{locate, locate_room};
pub use transaction::{Cause, Edit, Step, Transaction, TransactionError, apply_edits};
pub use world::{World, WorldError};
