//! Detectors: what notices change. Pure, deterministic, with explicit memory.
//!
//! A detector is shown one input event at a time and makes its claims to a [`Desk`], which
//! plans them against the world as it is by then and tells the detector at once what became of
//! them. Detectors know nothing of bytes and files.

pub mod action;
mod desk;
pub mod human;
pub mod time;

pub use desk::Desk;
