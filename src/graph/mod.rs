//! The 3D scene graph as a value: nodes in layers, belonging, access, canonical bytes, hash.
//!
//! Knows nothing of messages, detectors or files. Every edit either succeeds or is refused and
//! leaves the graph as it was ([`GraphError`]).
//!
//! Invariant: an object belongs to a room of the graph; a region to a region of a higher layer.
//! Invariant: what supports an object is an object of the graph, never itself, even indirectly.
//! Invariant: nothing rests on an object that is held in the gripper, unless it is held too.

mod canonical;
mod edit;
mod edit_region;
mod error;
mod id;
mod label;
mod node;
mod query;
mod restore;
mod slots;
#[cfg(test)]
mod tests;

use std::collections::BTreeSet;

pub use canonical::{CANONICAL_VERSION, CanonicalError, StateHash};
pub(crate) use canonical::{read_object_bytes, write_object_bytes};
pub use edit::{MAX_NODES, MAX_PILE, Placement};
pub use error::GraphError;
pub use id::{Layer, NodeId, NodeIdError};
pub use label::{Label, LabelError, class_key};
pub use node::{Node, Object, PoseSource, Region};
use slots::{ObjectSlot, RegionSlot, Slots};

/// The graph: what the robot believes the world to be at one moment.
///
/// Objects that are held in the gripper are part of it (see [`PoseSource::Held`]) but not among
/// [`SceneGraph::objects`]; objects that left are not.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneGraph {
    objects: Slots<ObjectSlot>,
    rooms: Slots<RegionSlot>,
    floors: Slots<RegionSlot>,
    buildings: Slots<RegionSlot>,
    /// Undirected: each pair both ways, so that the rooms next to one are found at once.
    access: BTreeSet<(NodeId, NodeId)>,
}
