//! [`SceneDocument`]: the fields of the JSON, and how a graph fills them.

use serde::Serialize;

use crate::geometry::{Pose, Size};
use crate::graph::{Label, Layer, NodeId, Object, PoseSource, Region, SceneGraph};
use crate::interchange::json;
use crate::time::Stamp;

/// A graph at one moment. What is `None` or empty was left out by whoever wrote it.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct SceneDocument {
    /// The moment.
    #[serde(serialize_with = "json::shown")]
    pub at: Option<Stamp>,
    /// Hash of the graph, 64 hexadecimal digits.
    pub hash: Option<String>,
    /// Rooms, in order of id.
    pub rooms: Vec<RoomEntry>,
    /// Objects that are where the graph says, in order of id.
    pub objects: Vec<ObjectEntry>,
    /// Objects in the gripper, in order of id.
    pub held: Vec<ObjectEntry>,
    /// Floors, in order of id.
    pub floors: Vec<FloorEntry>,
    /// Buildings, in order of id.
    pub buildings: Vec<BuildingEntry>,
}

/// A room.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RoomEntry {
    /// Its id.
    #[serde(serialize_with = "json::shown")]
    pub id: Option<NodeId>,
    /// Its name.
    #[serde(serialize_with = "label")]
    pub label: Label,
    /// Pose of the centre of its box.
    #[serde(serialize_with = "json::pose")]
    pub pose: Option<Pose>,
    /// Its box.
    #[serde(serialize_with = "json::size")]
    pub size: Option<Size>,
    /// The floor it is on: an id, or a label.
    pub floor: Option<String>,
    /// The building it is in, where it belongs to no floor: an id, or a label.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub building: Option<String>,
    /// The rooms it gives access to: ids, or labels.
    pub access_to: Vec<String>,
}

/// An object.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ObjectEntry {
    /// Its id.
    #[serde(serialize_with = "json::shown")]
    pub id: Option<NodeId>,
    /// Its class.
    #[serde(serialize_with = "label")]
    pub label: Label,
    /// The room it is in: an id, or a label.
    pub room: Option<String>,
    /// What it rests on or lies in: an id, or a label.
    pub support: Option<String>,
    /// Its pose.
    #[serde(serialize_with = "json::pose")]
    pub pose: Option<Pose>,
    /// Its box.
    #[serde(serialize_with = "json::size")]
    pub size: Option<Size>,
    /// λ in 1/s.
    pub decay_rate: Option<f64>,
    /// When it was last observed.
    #[serde(serialize_with = "json::shown")]
    pub last_observed: Option<Stamp>,
    /// How its pose is known.
    #[serde(serialize_with = "json::source")]
    pub pose_source: Option<PoseSource>,
    /// How probable it is that it is still there, at [`SceneDocument::at`]. Not read back.
    pub probability: Option<f64>,
}

/// A floor.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FloorEntry {
    /// Its id.
    #[serde(serialize_with = "json::shown")]
    pub id: Option<NodeId>,
    /// Its name.
    #[serde(serialize_with = "label")]
    pub label: Label,
    /// Pose of the centre of its box.
    #[serde(serialize_with = "json::pose")]
    pub pose: Option<Pose>,
    /// Its box.
    #[serde(serialize_with = "json::size")]
    pub size: Option<Size>,
    /// The building it is in: an id, or a label.
    pub building: Option<String>,
}

/// A building.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct BuildingEntry {
    /// Its id.
    #[serde(serialize_with = "json::shown")]
    pub id: Option<NodeId>,
    /// Its name.
    #[serde(serialize_with = "label")]
    pub label: Label,
    /// Pose of the centre of its box.
    #[serde(serialize_with = "json::pose")]
    pub pose: Option<Pose>,
    /// Its box.
    #[serde(serialize_with = "json::size")]
    pub size: Option<Size>,
}

fn label<S: serde::Serializer>(label: &Label, to: S) -> Result<S::Ok, S::Error> {
    to.serialize_str(label.as_str())
}

impl SceneDocument {
    /// `graph` at `at`.
    pub fn of(graph: &SceneGraph, at: Stamp) -> Self {
        let entry = |(id, object): (NodeId, &Object)| object_entry(id, object, at);
        Self {
            at: Some(at),
            hash: Some(graph.hash().to_string()),
            rooms: graph.rooms().map(|(id, room)| room_entry(graph, id, room)).collect(),
            objects: graph.objects().map(entry).collect(),
            held: graph.held().map(entry).collect(),
            floors: graph.regions(Layer::Floor).map(floor_entry).collect(),
            buildings: graph.regions(Layer::Building).map(building_entry).collect(),
        }
    }
}

fn object_entry(id: NodeId, object: &Object, at: Stamp) -> ObjectEntry {
    ObjectEntry {
        id: Some(id),
        label: object.label.clone(),
        room: Some(object.room.to_string()),
        support: object.support.map(|support| support.to_string()),
        pose: Some(object.pose),
        size: Some(object.size),
        decay_rate: Some(object.decay_rate),
        last_observed: Some(object.last_observed),
        pose_source: Some(object.pose_source),
        probability: Some(object.probability_static(at)),
    }
}

fn room_entry(graph: &SceneGraph, id: NodeId, room: &Region) -> RoomEntry {
    let parent = |layer| room.parent.filter(|p| p.layer() == layer).map(|p| p.to_string());
    RoomEntry {
        id: Some(id),
        label: room.label.clone(),
        pose: room.extent.map(|(pose, _)| pose),
        size: room.extent.map(|(_, size)| size),
        floor: parent(Layer::Floor),
        building: parent(Layer::Building),
        access_to: graph.access_from(id).map(|other| other.to_string()).collect(),
    }
}

fn floor_entry((id, floor): (NodeId, &Region)) -> FloorEntry {
    FloorEntry {
        id: Some(id),
        label: floor.label.clone(),
        pose: floor.extent.map(|(pose, _)| pose),
        size: floor.extent.map(|(_, size)| size),
        building: floor.parent.map(|parent| parent.to_string()),
    }
}

fn building_entry((id, building): (NodeId, &Region)) -> BuildingEntry {
    BuildingEntry {
        id: Some(id),
        label: building.label.clone(),
        pose: building.extent.map(|(pose, _)| pose),
        size: building.extent.map(|(_, size)| size),
    }
}
