//! Our own JSON of a graph: what `replay --json` prints, and what it reads back.
//!
//! Reading what was printed gives the same graph, hash for hash. A scene written by hand may
//! leave most of it out: ids are then numbered in order, a missing pose is that of the room or
//! of the support's upper face, a missing size is a cube of 0.2 m, and rooms and supports may be
//! named by a label that only one has. Knows nothing of files.
//!
//! ```
//! use scenefold::interchange::scene;
//! let text = r#"{"rooms": [{"label": "kitchen"}],
//!                "objects": [{"label": "table"}, {"label": "mug", "support": "table"}]}"#;
//! let import = scene::import(text).unwrap();
//! assert_eq!(import.graph.object_count(), 2);
//! ```

mod document;
mod ids;
mod parse;
mod resolve;

pub use document::{BuildingEntry, FloorEntry, ObjectEntry, RoomEntry, SceneDocument};

use super::{Import, ImportReport, JsonError};

/// Why a scene was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SceneError {
    /// A value that cannot be.
    #[error(transparent)]
    Json(#[from] JsonError),
    /// More nodes than ids.
    #[error("{path}: no id is left to number it; give ids of at most 16777215")]
    NoIdLeft {
        /// The node without an id.
        path: String,
    },
}

/// Reads a scene.
pub fn import(text: &str) -> Result<Import, SceneError> {
    let document = SceneDocument::parse(text)?;
    let expected = document.hash.clone();
    let (graph, start) = document.to_graph()?;
    let mut report = ImportReport::default();
    report.count_graph(&graph);
    report.count("held", graph.held().count() as u64);
    let found = graph.hash().to_string();
    if let Some(expected) = expected.filter(|expected| *expected != found) {
        report.note(format!("hash: the scene has {found}, not {expected}: it was edited since"));
    }
    Ok(Import { graph, start, inputs: Vec::new(), report })
}

#[cfg(test)]
mod tests;
