//! Why bytes are not what their channel promises: [`WireError`].

use crate::geometry::GeometryError;
use crate::graph::{GraphError, LabelError};

/// Why a payload was refused. Nothing of it is used.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum WireError {
    /// The bytes are not protobuf, or end too early.
    #[error("{message} is damaged: {problem}")]
    Malformed {
        /// The message.
        message: &'static str,
        /// What is wrong with the bytes.
        problem: &'static str,
    },
    /// A field holds what it must not.
    #[error("{message}.{field} is {value}: it must be {expected}")]
    Value {
        /// The message.
        message: &'static str,
        /// The field.
        field: &'static str,
        /// What it holds, shortened.
        value: Box<str>,
        /// What would be right.
        expected: &'static str,
    },
    /// A field that must be there is not.
    #[error("{message}.{field} is missing: it must be given")]
    Missing {
        /// The message.
        message: &'static str,
        /// The field.
        field: &'static str,
    },
    /// More than is taken, so that memory stays bounded.
    #[error("{message}.{field} holds more than {limit} entries or bytes")]
    TooMuch {
        /// The message.
        message: &'static str,
        /// The field.
        field: &'static str,
        /// How much is taken.
        limit: usize,
    },
    /// A text that is no label.
    #[error("{message}.label: {error}")]
    Label {
        /// The message.
        message: &'static str,
        /// Why not.
        error: LabelError,
    },
    /// A pose or a size that cannot be.
    #[error("{message}: {error}")]
    Geometry {
        /// The message.
        message: &'static str,
        /// Why not.
        error: GeometryError,
    },
    /// Nodes that do not fit together.
    #[error("GraphState: {0}")]
    Graph(#[from] GraphError),
    /// A state that does not decompress to what the checkpoint says.
    #[error("Checkpoint.state_zstd is damaged: it does not decompress to {expected} bytes")]
    State {
        /// The length it should have.
        expected: u64,
    },
    /// The topic carries no event of ours.
    #[error("{topic} carries no event of scenefold.v1: pass its messages through as they are")]
    NoEvent {
        /// The topic.
        topic: Box<str>,
    },
}
