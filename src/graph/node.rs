//! What a node is: [`Object`], [`Region`].

use super::{Label, NodeId};
use crate::geometry::{Pose, Size};
use crate::time::Stamp;

/// How the pose of an object is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum PoseSource {
    /// Measured: by a sensor, the gripper, or whoever built the initial graph.
    Measured,
    /// Only the room or the support is known, for example from a sentence; the pose is then
    /// that of the support's upper face or of the room.
    Topological,
    /// In the gripper: temporarily removed. The pose is where it was picked.
    Held,
}

impl PoseSource {
    /// The word for it in JSON.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Measured => "measured",
            Self::Topological => "topological",
            Self::Held => "held",
        }
    }
}

/// An object node (paper, "Minimal Required 3D Scene Graph").
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Semantic class.
    pub label: Label,
    /// `world_from_object`, of the centre of the bounding box.
    pub pose: Pose,
    /// Bounding box (w, h, d) in the object's frame, metres.
    pub size: Size,
    /// λ ≥ 0 in 1/s; 0 means immovable.
    pub decay_rate: f64,
    /// When it was last added, moved or observed: t₀.
    pub last_observed: Stamp,
    /// How the pose is known.
    pub pose_source: PoseSource,
    /// The room it belongs to; while held, the room it was picked in.
    pub room: NodeId,
    /// The object it rests on or lies in, if known.
    pub support: Option<NodeId>,
}

impl Object {
    /// Whether it is in the gripper.
    pub fn is_held(&self) -> bool {
        self.pose_source == PoseSource::Held
    }

    /// Probability that it is still where it was last observed:
    /// p(static | Δt, l) = 2 / (1 + e^{λΔt}), Δt = now − t₀ in seconds, 1 if `now` is earlier
    /// (paper, "Time").
    pub fn probability_static(&self, now: Stamp) -> f64 {
        let age_s = now.seconds_since(self.last_observed);
        2.0 / (1.0 + libm::exp(self.decay_rate * age_s))
    }
}

/// A room, floor or building.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Semantic class or name.
    pub label: Label,
    /// Pose of the centre of its box, world frame, and the box; `None` if it is known only by
    /// name.
    pub extent: Option<(Pose, Size)>,
    /// The region of a higher layer it belongs to, if known.
    pub parent: Option<NodeId>,
}

/// A node of any layer.
#[derive(Clone, Debug, PartialEq)]
pub enum Node {
    /// A node of the Object layer.
    Object(Object),
    /// A node of the Room, Floor or Building layer, with the rooms it gives access to.
    Region(Region, Vec<NodeId>),
}
