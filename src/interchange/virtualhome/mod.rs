//! Import of a `VirtualHome` graph: the apartment as the Unity simulator describes it.
//!
//! Rooms are the nodes of category `Rooms`; objects all others with a box, except characters
//! and, unless [`Options::structure`] is set, floors, ceilings and walls. Ids are kept: node 41
//! becomes `R41`, node 114 `O114`. Knows nothing of files.
//!
//! # Frame
//! Unity is left-handed: x to the right, y up, z ahead. We are right-handed with z up. Seen from
//! above, with x to the right of the page, z of Unity points up the page, exactly as y of ours
//! does. So (x, y, z) of Unity is the point (x, z, y) of ours: exchanging two axes turns a
//! left-handed frame into a right-handed one, and the scene itself stays as it is. Keeping the
//! order of the axes, or negating one as well, would mirror the apartment. Boxes are aligned
//! with the axes in both frames, so their sides are exchanged alike.
//!
//! # Relations
//! `INSIDE` a room is belonging. `INSIDE` or `ON` an object is support; of several supports the
//! smallest is taken (a mouse is on the mouse mat, not on the desk), of equally large ones the
//! highest. A door gives access between the rooms it is `BETWEEN`, or else between the two rooms
//! whose boxes touch it.
//!
//! λ is [`MOVABLE_DECAY_RATE`] for what is `GRABBABLE` or `MOVABLE`,
//! and 0 for the rest.

mod doors;
mod frame;
mod nodes;
mod supports;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use self::nodes::{Category, VhNode};
use super::json::{self, At};
use super::{IMMOVABLE_DECAY_RATE, Import, ImportReport, JsonError, MOVABLE_DECAY_RATE, counted};
use crate::change::room_around;
use crate::graph::{GraphError, Label, Layer, NodeId, Object, PoseSource, Region, SceneGraph};
use crate::time::Stamp;

/// How to import.
#[derive(Clone, Copy, Debug, Default)]
pub struct Options {
    /// Take floors, ceilings and walls as objects too.
    pub structure: bool,
    /// When all was seen.
    pub start: Stamp,
}

/// Why a `VirtualHome` graph was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum VirtualHomeError {
    /// A value that cannot be.
    #[error(transparent)]
    Json(#[from] JsonError),
    /// Nodes that do not fit together.
    #[error(transparent)]
    Graph(#[from] GraphError),
    /// Something is nowhere.
    #[error("{id} ({class}) is in no room and no room's box holds it; add an INSIDE edge")]
    NoRoom {
        /// The object.
        id: NodeId,
        /// Its class.
        class: Label,
    },
}

/// The relations that matter, by node.
#[derive(Debug, Default)]
struct Relations {
    inside: BTreeMap<u64, Vec<u64>>,
    on: BTreeMap<u64, Vec<u64>>,
    between: BTreeMap<u64, Vec<u64>>,
}

/// Reads a `VirtualHome` graph: `{"nodes": […], "edges": […]}`.
pub fn import(text: &str, options: &Options) -> Result<Import, VirtualHomeError> {
    let value = json::parse(text)?;
    let root = At::root(&value);
    let mut report = ImportReport::default();
    let nodes = nodes::read(&root)?;
    let relations = read_relations(&root, &nodes, &mut report)?;
    let mut graph = SceneGraph::new();
    for (number, node) in nodes.iter().filter(|(_, node)| node.category == Category::Room) {
        insert_room(&mut graph, *number, node)?;
    }
    let mut taken = BTreeMap::new();
    for (number, node) in &nodes {
        if let Some(id) = object_id(*number, node, options, &mut report) {
            let room = room_of(&graph, id, node, &relations, *number, &nodes, &mut report)?;
            graph.insert_object(id, object(node, room, options))?;
            taken.insert(*number, id);
        }
    }
    let thick: Vec<NodeId> =
        taken.iter().filter(|(number, _)| nodes[number].thickened).map(|(_, id)| *id).collect();
    if !thick.is_empty() {
        report.note(counted(&thick, "boxes were made a millimetre thick"));
    }
    supports::connect(&mut graph, &taken, &relations, &mut report);
    doors::connect(&mut graph, &nodes, &relations, &mut report)?;
    report.count_graph(&graph);
    Ok(Import { graph, start: options.start, inputs: Vec::new(), report })
}

fn read_relations(
    root: &At<'_>,
    nodes: &BTreeMap<u64, VhNode>,
    report: &mut ImportReport,
) -> Result<Relations, VirtualHomeError> {
    let mut relations = Relations::default();
    for edge in root.list("edges")? {
        let (from, to) = (edge.field("from_id")?.u64()?, edge.field("to_id")?.u64()?);
        if !nodes.contains_key(&from) || !nodes.contains_key(&to) {
            report.count("relations of unknown nodes skipped", 1);
            continue;
        }
        let list = match edge.field("relation_type")?.text()? {
            "INSIDE" => &mut relations.inside,
            "ON" => &mut relations.on,
            "BETWEEN" => &mut relations.between,
            other => {
                let name: String = other.chars().filter(|c| !c.is_control()).take(40).collect();
                report.count(&format!("{name} relations skipped"), 1);
                continue;
            }
        };
        list.entry(from).or_default().push(to);
    }
    Ok(relations)
}

fn insert_room(graph: &mut SceneGraph, number: u64, node: &VhNode) -> Result<(), GraphError> {
    let Some(id) = node_id(Layer::Room, number) else { return Ok(()) };
    let extent = node.extent;
    graph.insert_region(id, Region { label: room_label(&node.class), extent, parent: None })
}

/// People say living room.
fn room_label(class: &Label) -> Label {
    match class.as_str() {
        "livingroom" => Label::new("living room").expect("it is a label"),
        _ => class.clone(),
    }
}

fn node_id(layer: Layer, number: u64) -> Option<NodeId> {
    NodeId::new(layer, u32::try_from(number).ok()?)
}

fn object_id(
    number: u64,
    node: &VhNode,
    options: &Options,
    report: &mut ImportReport,
) -> Option<NodeId> {
    let skipped = match node.category {
        Category::Room => return None,
        Category::Character => Some("characters skipped"),
        Category::Structure(plural) if !options.structure => Some(plural),
        _ if node.extent.is_none() => Some("objects without a box skipped"),
        _ => None,
    };
    if let Some(what) = skipped {
        report.count(what, 1);
        return None;
    }
    node_id(Layer::Object, number)
}

fn room_of(
    graph: &SceneGraph,
    id: NodeId,
    node: &VhNode,
    relations: &Relations,
    number: u64,
    nodes: &BTreeMap<u64, VhNode>,
    report: &mut ImportReport,
) -> Result<NodeId, VirtualHomeError> {
    let is_room = |n: &&u64| nodes.get(n).is_some_and(|node| node.category == Category::Room);
    let inside = relations.inside.get(&number).map(Vec::as_slice).unwrap_or_default();
    let rooms: Vec<u64> = inside.iter().filter(is_room).copied().collect();
    let around = node.extent.and_then(|(pose, _)| room_around(graph, &pose));
    match rooms.as_slice() {
        [only] => Ok(node_id(Layer::Room, *only)),
        [] => {
            report.count("rooms of objects found by their boxes", 1);
            Ok(around)
        }
        several => {
            report
                .note(format!("{id} is inside {} rooms: the smallest id is taken", several.len()));
            Ok(several.iter().min().and_then(|n| node_id(Layer::Room, *n)))
        }
    }
    .and_then(|room| room.ok_or_else(|| VirtualHomeError::NoRoom { id, class: node.class.clone() }))
}

fn object(node: &VhNode, room: NodeId, options: &Options) -> Object {
    let (pose, size) = node.extent.expect("objects without a box are skipped");
    Object {
        label: node.class.clone(),
        pose,
        size,
        decay_rate: if node.movable { MOVABLE_DECAY_RATE } else { IMMOVABLE_DECAY_RATE },
        last_observed: options.start,
        pose_source: PoseSource::Measured,
        room,
        support: None,
    }
}
