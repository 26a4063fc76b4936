//! Event-sourced, record-and-replay processor for dynamic 3D scene graphs.
mod bytes;
pub mod change;
pub mod cli;
pub mod container;
pub mod document;
pub mod event;
pub mod geometry;
pub mod graph;
pub mod history;
pub mod interchange;
pub mod modality;
pub mod recording;
pub mod snapshot;
pub mod time;
pub mod updater;
pub mod wire;

#[cfg(test)]
mod testing;
