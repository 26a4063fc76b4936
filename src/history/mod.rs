//! Questions about the past: what differs, why, and since when.
//!
//! Knows nothing of files: a log is whatever can be walked in order ([`EventLog`]), and the
//! answers are values with a text form for people and a document for programs.
//!
//! - [`Diff`]: what differs between two graphs, and the primitives that lead from one to the
//!   other ([`primitives_between`]).
//! - [`why()`]: the life of a node, back to the evidence.
//! - [`first_holding`]: the first event after which an [`Expr`] holds.
//!
//! Invariant: a world is advanced by initial graphs and transactions only ([`advance`]).

pub mod bisect;
pub mod diff;
mod log;
mod place;
pub mod why;

pub use bisect::{BisectDocument, BisectError, Expr, Hit, first_holding};
pub use diff::{Diff, DiffDocument, primitives_between};
pub use log::{EventLog, FoldError, Slice, advance};
pub use place::{Place, PlaceDocument};
pub use why::{Selector, Why, WhyDocument, WhyError, why};

#[cfg(test)]
mod tests;
