//! From doors to access between rooms.

use std::collections::BTreeMap;

use super::nodes::{Category, VhNode};
use super::{Relations, node_id};
use crate::geometry::{Pose, Size};
use crate::graph::{GraphError, Layer, NodeId, SceneGraph};
use crate::interchange::ImportReport;

/// How far a room may be from a door that leads to it, in metres: the thickness of a wall.
const WALL_M: f64 = 0.3;

pub(super) fn connect(
    graph: &mut SceneGraph,
    nodes: &BTreeMap<u64, VhNode>,
    relations: &Relations,
    report: &mut ImportReport,
) -> Result<(), GraphError> {
    let mut nowhere = Vec::new();
    for (number, door) in nodes.iter().filter(|(_, node)| node.category == Category::Door) {
        let named = relations.between.get(number).map(Vec::as_slice).unwrap_or_default();
        let mut rooms: Vec<NodeId> =
            named.iter().filter_map(|n| node_id(Layer::Room, *n)).collect();
        rooms.retain(|room| graph.contains(*room));
        if rooms.len() < 2 {
            rooms = touching(graph, door);
        }
        rooms.sort_unstable();
        rooms.dedup();
        match rooms.as_slice() {
            [a, b] => graph.connect(*a, *b)?,
            _ => nowhere.push(number.to_string()),
        }
    }
    if !nowhere.is_empty() {
        let doors = nowhere.join(", ");
        report.note(format!("doors that are not between two rooms give no access: {doors}"));
    }
    Ok(())
}

/// The rooms whose boxes touch that of the door.
fn touching(graph: &SceneGraph, door: &VhNode) -> Vec<NodeId> {
    let Some(door) = door.extent else { return Vec::new() };
    let near =
        |extent: Option<(Pose, Size)>| extent.is_some_and(|room| gap_m(&door, &room) < WALL_M);
    graph.rooms().filter(|(_, room)| near(room.extent)).map(|(id, _)| id).collect()
}

/// The largest gap between two upright boxes along an axis, in metres; negative if they overlap.
fn gap_m((a, a_size): &(Pose, Size), (b, b_size): &(Pose, Size)) -> f64 {
    let centres = a.position().into_iter().zip(b.position()).map(|(a, b)| (a - b).abs());
    let halves = a_size.metres().into_iter().zip(b_size.metres()).map(|(a, b)| f64::midpoint(a, b));
    centres.zip(halves).map(|(apart, half)| apart - half).fold(f64::NEG_INFINITY, f64::max)
}
