//! Spark-DSG JSON, as Hydra, Khronos and Clio write it: import and export.
//!
//! Read are the format versions 1.0.0 (no header, `layer_ids`, boxes with `min` and `max`) to
//! 1.1.3 (`SPARK_DSG_header`, `layer_keys`, boxes with `dimensions`); written is 1.1.3, for
//! `spark_dsg.DynamicSceneGraph.load`. Knows nothing of files.
//!
//! # Import
//! - Layers are told by `layer_names`, where there are any, else by their usual numbers: 2
//!   objects, 3 places, 4 rooms, 5 buildings. Agents share layer 2 with the objects and are
//!   told by their type, partition and letter. Places, agents and all else are counted.
//! - A label is the `name`, unless that is empty or only says the id (`O(12)`); else the entry
//!   of the label space; else `class_12`; for regions `room 3`.
//! - An object belongs to the room above it (through its place); else to the smallest room
//!   whose box holds it; else to a room called `unknown`.
//! - A region without a valid box gets the box around what belongs to it. An object without
//!   one gets a cube of 0.2 m at its position.
//! - Times after the year 2100 are taken for uninitialised memory, and as unknown (1970).
//!
//! # Export
//! What Spark-DSG has no place for is kept in `metadata.scenefold` of nodes (λ, support, source
//! of the pose) and of the graph (floors), and read back from there. Objects in the gripper are
//! left out: they are nowhere in the scene.

mod boxes;
mod export;
mod import;
mod labels;
mod nodes;
mod regions;
#[cfg(test)]
mod tests;

pub use export::export;
pub use import::import;

use super::JsonError;
use crate::graph::GraphError;

/// Why a Spark-DSG graph was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SparkDsgError {
    /// A value that cannot be.
    #[error(transparent)]
    Json(#[from] JsonError),
    /// Nodes that do not fit together.
    #[error(transparent)]
    Graph(#[from] GraphError),
    /// More nodes than ids.
    #[error("node {bits} finds no free id; use indices of at most 16777215")]
    NoIdLeft {
        /// Its id in the file.
        bits: u64,
    },
}
