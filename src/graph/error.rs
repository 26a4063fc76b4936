//! Why an edit of a graph is refused.

use super::{Layer, NodeId};

/// Why an edit of a [`super::SceneGraph`] was refused. The graph is unchanged in every case.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GraphError {
    /// The id is taken.
    #[error("node {id} already exists")]
    DuplicateNode {
        /// The id.
        id: NodeId,
    },
    /// No such node.
    #[error("node {id} does not exist")]
    UnknownNode {
        /// The id.
        id: NodeId,
    },
    /// The node is of another layer than the edit needs.
    #[error("{id} is a {found}, not a {expected}")]
    WrongLayer {
        /// The id.
        id: NodeId,
        /// Its layer.
        found: Layer,
        /// The layer needed.
        expected: Layer,
    },
    /// Belonging goes upwards only.
    #[error("{parent} cannot be a parent of {child}: it is not of a higher layer")]
    LayerOrder {
        /// Would-be parent.
        parent: NodeId,
        /// Would-be child.
        child: NodeId,
    },
    /// The object is in the gripper.
    #[error("{id} is held in the gripper")]
    Held {
        /// The object.
        id: NodeId,
    },
    /// Something would rest on nothing.
    #[error("{id} still has {count} object(s) on or in it")]
    StillSupports {
        /// The object.
        id: NodeId,
        /// How many.
        count: u32,
    },
    /// Something would belong nowhere.
    #[error("{id} still has {count} node(s) belonging to it or rooms it gives access to")]
    StillContains {
        /// The region.
        id: NodeId,
        /// How many.
        count: usize,
    },
    /// An object would rest on itself.
    #[error("{id} cannot rest on {support}: that rests on {id}")]
    SupportCycle {
        /// The object.
        id: NodeId,
        /// The would-be support.
        support: NodeId,
    },
    /// Too many objects stand on each other.
    #[error("{id} cannot be put on {support}: at most {limit} objects stand on each other")]
    PileTooHigh {
        /// The object.
        id: NodeId,
        /// The would-be support.
        support: NodeId,
        /// Most objects below one.
        limit: usize,
    },
    /// Too many nodes.
    #[error("a graph holds at most {limit} nodes of one layer, and that many {layer}s are known")]
    Full {
        /// The layer.
        layer: Layer,
        /// Most nodes in it.
        limit: usize,
    },
    /// λ must be a number ≥ 0.
    #[error("decay rate {value} of {id} is not a number ≥ 0")]
    DecayRate {
        /// The object.
        id: NodeId,
        /// The value.
        value: f64,
    },
    /// A room cannot give access to itself.
    #[error("{id} cannot give access to itself")]
    SelfAccess {
        /// The room.
        id: NodeId,
    },
}
