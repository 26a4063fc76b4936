//! [`Place`]: where an object is, with the labels a person knows it by.

use std::fmt;

use serde::Serialize;

use crate::change::NodeRef;
use crate::document::{PoseDocument, RefDocument};
use crate::geometry::Pose;
use crate::graph::{NodeId, Object, PoseSource, SceneGraph};

/// Where an object is, or was.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Its room; while held, the room it was picked in.
    pub room: NodeRef,
    /// What it rests on or lies in.
    pub support: Option<NodeRef>,
    /// Whether it lies in its support rather than on it, as far as the boxes tell. For words
    /// only.
    pub inside: bool,
    /// Its pose; while held, where it was picked.
    pub pose: Pose,
    /// How the pose is known.
    pub pose_source: PoseSource,
}

impl Place {
    /// Where `object` is, with labels of `graph`.
    pub fn of(graph: &SceneGraph, object: &Object) -> Self {
        let support = object.support.and_then(|id| graph.object(id));
        Self {
            room: named(graph, object.room),
            support: object.support.map(|id| named(graph, id)),
            inside: support.is_some_and(|support| lies_in(object, support)),
            pose: object.pose,
            pose_source: object.pose_source,
        }
    }

    /// Whether it is in the gripper.
    pub fn is_held(&self) -> bool {
        self.pose_source == PoseSource::Held
    }

    /// `kitchen, on table O114`, held or not.
    pub fn spot(&self) -> Spot<'_> {
        Spot(self)
    }
}

/// The words for a place as if nothing were held. See [`Place::spot`].
#[derive(Clone, Copy, Debug)]
pub struct Spot<'a>(&'a Place);

impl fmt::Display for Spot<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0.room.label {
            Some(label) => write!(f, "{label}")?,
            None => write!(f, "{}", self.0.room)?,
        }
        let Some(support) = &self.0.support else { return Ok(()) };
        write!(f, ", {} {support}", if self.0.inside { "in" } else { "on" })
    }
}

/// `kitchen, on table O114`, or `in the gripper`.
impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.is_held() { f.write_str("in the gripper") } else { write!(f, "{}", self.spot()) }
    }
}

/// A node by its id, with its label in `graph`.
pub(super) fn named(graph: &SceneGraph, id: NodeId) -> NodeRef {
    NodeRef { id: Some(id), label: graph.label(id).cloned() }
}

/// Whether the centre of `object` lies in the box of `support`.
fn lies_in(object: &Object, support: &Object) -> bool {
    let local = support.pose.isometry().inverse_transform_point(&object.pose.point());
    local.coords.iter().zip(support.size.metres()).all(|(c, side)| c.abs() < side / 2.0)
}

/// The document of a place.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlaceDocument {
    /// Its room.
    pub room: RefDocument,
    /// What it rests on or lies in.
    pub support: Option<RefDocument>,
    /// Its pose.
    pub pose: PoseDocument,
    /// `measured`, `topological` or `held`.
    pub pose_source: &'static str,
}

impl PlaceDocument {
    /// The document of a place.
    pub fn of(place: &Place) -> Self {
        Self {
            room: RefDocument::of(&place.room),
            support: RefDocument::maybe(place.support.as_ref()),
            pose: PoseDocument::of(&place.pose),
            pose_source: place.pose_source.as_str(),
        }
    }
}
