//! Event-sourced, record-and-replay processor for dynamic 3D scene graphs.
pub mod time;
pub mod geometry;
mod bytes;
pub mod graph;
pub mod change;
pub mod event;
pub mod modality;
pub mod updater;
pub mod document;
pub mod history;
pub mod wire;
pub mod container;
pub mod recording;
pub mod interchange;
pub mod snapshot;
pub mod cli;
