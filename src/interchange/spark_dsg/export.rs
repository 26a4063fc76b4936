//! From a graph to Spark-DSG JSON, version 1.1.3.

use std::collections::BTreeMap;

use serde_json::{Value, json};

use super::labels::{NO_LABEL, is_meaningful};
use crate::document::PoseDocument;
use crate::geometry::{Pose, Size};
use crate::graph::{Label, Layer, NodeId, Object, Region, SceneGraph};

const OBJECTS: u64 = 2;
const ROOMS: u64 = 4;
const BUILDINGS: u64 = 5;

/// The graph as `spark_dsg.DynamicSceneGraph.load` reads it; objects in the gripper are left out.
pub fn export(graph: &SceneGraph) -> Value {
    let classes = classes(graph);
    let objects = graph.objects().map(|(id, object)| object_node(id, object, &classes));
    let rooms = graph.rooms().map(|(id, room)| room_node(graph, id, room));
    let buildings = graph.regions(Layer::Building).map(|(id, building)| {
        let attributes = region(graph, id, building, "SemanticNodeAttributes", json!({}));
        node(id, BUILDINGS, &attributes)
    });
    let nodes: Vec<Value> = objects.chain(rooms).chain(buildings).collect();
    let space: Vec<Value> = classes.iter().map(|(label, n)| json!([n, label.as_str()])).collect();
    let floors: Vec<Value> = graph.regions(Layer::Floor).map(floor).collect();
    let key = |layer: u64| json!({"layer": layer, "partition": 0});
    json!({
        "SPARK_DSG_header": {
            "project_name": "main",
            "version": {"major": 1, "minor": 1, "patch": 3},
        },
        "directed": false,
        "multigraph": false,
        "layer_keys": [key(2), key(3), key(4), key(5)],
        "layer_names": {
            "OBJECTS": key(2), "PLACES": key(3), "ROOMS": key(4), "BUILDINGS": key(5),
        },
        "metadata": {"labelspaces": {"_l2p0": space}, "scenefold": {"floors": floors}},
        "nodes": nodes,
        "edges": edges(graph),
    })
}

/// Every label of an object with its number in the label space.
fn classes(graph: &SceneGraph) -> BTreeMap<&Label, u64> {
    let mut classes: BTreeMap<&Label, u64> =
        graph.objects().map(|(_, object)| (&object.label, 0)).collect();
    classes.values_mut().zip(0..).for_each(|(class, n)| *class = n);
    classes
}

fn node(id: NodeId, layer: u64, attributes: &Value) -> Value {
    json!({"id": id.bits(), "layer": layer, "partition": 0, "attributes": attributes})
}

fn object_node(id: NodeId, object: &Object, classes: &BTreeMap<&Label, u64>) -> Value {
    let own = json!({
        "decay_rate": object.decay_rate,
        "pose_source": object.pose_source.as_str(),
        "support": object.support.map(|support| support.to_string()),
    });
    let extent = Some((object.pose, object.size));
    let name = object.label.as_str();
    let mut attributes = semantic(name, classes[&object.label], extent, object.pose, own);
    attributes["type"] = json!("ObjectNodeAttributes");
    attributes["last_update_time_ns"] = json!(object.last_observed.nanos());
    attributes["mesh_connections"] = json!([]);
    attributes["registered"] = json!(false);
    attributes["world_R_object"] = json!(PoseDocument::of(&object.pose).orientation);
    node(id, OBJECTS, &attributes)
}

fn room_node(graph: &SceneGraph, id: NodeId, room: &Region) -> Value {
    let floor = room.parent.filter(|parent| parent.layer() == Layer::Floor);
    let own = json!({"floor": floor.map(|floor| floor.to_string())});
    let mut attributes = region(graph, id, room, "RoomNodeAttributes", own);
    attributes["semantic_class_probabilities"] = json!({});
    node(id, ROOMS, &attributes)
}

fn region(graph: &SceneGraph, id: NodeId, region: &Region, kind: &str, own: Value) -> Value {
    // One known only by name stands where the first thing in it is.
    let is_in = |room| room == id || graph.ancestor(room, id.layer()) == Some(id);
    let inside = || graph.objects().find(|(_, object)| is_in(object.room));
    let middle = region.extent.map(|(pose, _)| pose);
    let position = middle.or_else(|| Some(inside()?.1.pose)).unwrap_or(Pose::IDENTITY);
    let name = region.label.as_str();
    let mut attributes = semantic(name, NO_LABEL, region.extent, position, own);
    attributes["type"] = json!(kind);
    attributes
}

fn semantic(
    name: &str,
    class: u64,
    extent: Option<(Pose, Size)>,
    position: Pose,
    mut own: Value,
) -> Value {
    if !is_meaningful(name) {
        own["label"] = json!(name);
    }
    json!({
        "bounding_box": bounding_box(extent),
        "color": {"a": 255, "b": 0, "g": 0, "r": 0},
        "is_active": false,
        "is_predicted": false,
        "last_update_time_ns": 0,
        "metadata": {"scenefold": own},
        "name": name,
        "position": position.position(),
        "semantic_feature": {"cols": 0, "data": null, "rows": 0},
        "semantic_label": class,
    })
}

fn bounding_box(extent: Option<(Pose, Size)>) -> Value {
    let (kind, pose, sides) = match extent {
        None => ("INVALID", Pose::IDENTITY, [0.0; 3]),
        Some((pose, size)) => {
            let upright = pose.orientation_e7() == Pose::IDENTITY.orientation_e7();
            (if upright { "AABB" } else { "OBB" }, pose, size.metres())
        }
    };
    json!({
        "type": kind,
        "dimensions": sides,
        "world_P_center": pose.position(),
        "world_R_center": PoseDocument::of(&pose).orientation,
    })
}

fn floor((id, floor): (NodeId, &Region)) -> Value {
    json!({
        "id": id.to_string(),
        "label": floor.label.as_str(),
        "building": floor.parent.map(|building| building.to_string()),
        "bounding_box": bounding_box(floor.extent),
    })
}

/// Belonging (building to room, room to object) and access.
fn edges(graph: &SceneGraph) -> Vec<Value> {
    let edge = |source: NodeId, target: NodeId| {
        let info =
            json!({"metadata": {}, "type": "EdgeAttributes", "weight": 1.0, "weighted": false});
        json!({"source": source.bits(), "target": target.bits(), "info": info})
    };
    let building = |(id, _)| Some(edge(graph.ancestor(id, Layer::Building)?, id));
    let above_rooms = graph.rooms().filter_map(building);
    let above_objects = graph.objects().map(|(id, object)| edge(object.room, id));
    let access = graph.access().map(|(a, b)| edge(a, b));
    above_rooms.chain(above_objects).chain(access).collect()
}
