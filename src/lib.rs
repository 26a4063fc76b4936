//! Event-sourced, record-and-replay processor for dynamic 3D scene graphs.
pub mod time;
pub mod geometry;
mod bytes;
pub mod graph;
pub mod change;
pub mod event;
pub mod interchange;
