//! From the JSON text to a graph.

use std::collections::BTreeMap;

use super::nodes::{File, FileNode, Kind};
use super::regions::{self, ObjectBoxes};
use super::{SparkDsgError, boxes, labels};
use crate::change::room_around;
use crate::geometry::{Pose, Size};
use crate::graph::{Label, Layer, NodeId, Object, PoseSource, Region, SceneGraph};
use crate::interchange::json::{self, At, JsonError};
use crate::interchange::{Import, ImportReport, MOVABLE_DECAY_RATE, counted, insert_all};
use crate::time::Stamp;

/// Side of the cube that stands for an object without a valid box.
const DEFAULT_SIDE_UM: i64 = 200_000;
/// The year 2100: later times are garbage.
const LAST_TIME_NS: u64 = 4_102_444_800_000_000_000;

/// Reads a Spark-DSG graph. It starts when the last object was seen.
pub fn import(text: &str) -> Result<Import, SparkDsgError> {
    let value = json::parse(text)?;
    let root = At::root(&value);
    let file = File::read(&root)?;
    let ids = file.ids()?;
    let mut report = ImportReport::default();
    count_skipped(&root, &file, &ids, &mut report)?;
    note_version(&root, &mut report);
    let object_boxes = file
        .nodes
        .iter()
        .filter(|(_, node)| node.kind == Kind::Known(Layer::Object))
        .map(|(bits, node)| Ok((*bits, boxes::read(&node.attributes)?)))
        .collect::<Result<ObjectBoxes, JsonError>>()?;
    let mut graph = SceneGraph::new();
    regions::insert(&mut graph, &root, &file, &ids, &object_boxes, &mut report)?;
    let objects = objects(&mut graph, &root, &file, &ids, &object_boxes, &mut report)?;
    let start = objects.iter().map(|(_, object)| object.last_observed).max();
    let unsupported = insert_all(&mut graph, objects)?;
    if !unsupported.is_empty() {
        report.note(counted(&unsupported, "objects have a support that cannot be, and got none"));
    }
    report.count_graph(&graph);
    Ok(Import { graph, start: start.unwrap_or_default(), inputs: Vec::new(), report })
}

/// The newest version that was ever seen; later ones may mean other things.
fn note_version(root: &At<'_>, report: &mut ImportReport) {
    let version = root.value.get("SPARK_DSG_header").and_then(|header| header.get("version"));
    let part = |name| version.and_then(|version| version.get(name)?.as_u64()).unwrap_or(0);
    let found = [part("major"), part("minor"), part("patch")];
    if found > [1, 1, 3] {
        let [major, minor, patch] = found;
        report.note(format!("format {major}.{minor}.{patch} is newer than 1.1.3, read as that"));
    }
}

fn count_skipped(
    root: &At<'_>,
    file: &File<'_>,
    ids: &BTreeMap<u64, NodeId>,
    report: &mut ImportReport,
) -> Result<(), JsonError> {
    for node in file.nodes.values() {
        match node.kind {
            Kind::Known(_) => {}
            Kind::Place => report.count("places skipped", 1),
            Kind::Agent => report.count("agent poses skipped", 1),
            Kind::Other => report.count("nodes of other layers skipped", 1),
        }
    }
    report.count("edges of unknown nodes skipped", file.loose_edges);
    if root.optional("mesh")?.is_some() {
        report.count("meshes skipped", 1);
    }
    let renumbered: Vec<NodeId> =
        ids.iter().filter(|(bits, id)| id.bits() != **bits).map(|(_, id)| *id).collect();
    if !renumbered.is_empty() {
        report.note(counted(&renumbered, "ids of the file do not fit and were numbered anew"));
    }
    Ok(())
}

/// What has to be said of objects.
#[derive(Debug, Default)]
struct Oddities {
    no_box: Vec<NodeId>,
    no_room: Vec<NodeId>,
    by_box: Vec<NodeId>,
    bad_time: Vec<NodeId>,
}

fn objects(
    graph: &mut SceneGraph,
    root: &At<'_>,
    file: &File<'_>,
    ids: &BTreeMap<u64, NodeId>,
    boxes: &ObjectBoxes,
    report: &mut ImportReport,
) -> Result<Vec<(NodeId, Object)>, SparkDsgError> {
    let mut odd = Oddities::default();
    let mut objects = Vec::new();
    for (bits, extent) in boxes {
        let (id, node) = (ids[bits], &file.nodes[bits]);
        let (pose, size) = if let Some(extent) = extent {
            *extent
        } else {
            odd.no_box.push(id);
            default_box(node)?
        };
        let room = match file.ancestor(*bits, Layer::Room) {
            Some(room) => ids[&room],
            None => room_without_edge(graph, id, &pose, &mut odd)?,
        };
        let label = labels::read(root, node, id)?;
        objects.push((id, object(node, label, id, (pose, size), room, &mut odd)?));
    }
    for (ids, words) in [
        (odd.no_box, "objects have no valid box and got a cube of 0.2 m"),
        (odd.by_box, "objects hang below no room and were put in the one whose box holds them"),
        (odd.no_room, "objects are in no room and were put in one called unknown"),
        (odd.bad_time, "objects have an impossible time of last update, now unknown"),
    ] {
        if !ids.is_empty() {
            report.note(counted(&ids, words));
        }
    }
    Ok(objects)
}

fn default_box(node: &FileNode<'_>) -> Result<(Pose, Size), JsonError> {
    let at = node.attributes.field("position")?;
    let pose = Pose::at(at.triple()?).map_err(|error| at.error(error))?;
    Ok((pose, Size::from_micrometres([DEFAULT_SIDE_UM; 3]).expect("the side is positive")))
}

fn room_without_edge(
    graph: &mut SceneGraph,
    id: NodeId,
    pose: &Pose,
    odd: &mut Oddities,
) -> Result<NodeId, SparkDsgError> {
    if let Some(room) = room_around(graph, pose) {
        odd.by_box.push(id);
        return Ok(room);
    }
    odd.no_room.push(id);
    let unknown = graph.rooms().find(|(_, room)| room.label.as_str() == "unknown");
    if let Some((room, _)) = unknown {
        return Ok(room);
    }
    let next = graph.last_index(Layer::Room).map_or(0, |last| last + 1);
    let room = NodeId::new(Layer::Room, next).ok_or(SparkDsgError::NoIdLeft { bits: id.bits() })?;
    let label = Label::new("unknown").expect("it is a label");
    graph.insert_region(room, Region { label, extent: None, parent: None })?;
    Ok(room)
}

fn object(
    node: &FileNode<'_>,
    label: Label,
    id: NodeId,
    (pose, size): (Pose, Size),
    room: NodeId,
    odd: &mut Oddities,
) -> Result<Object, JsonError> {
    let metadata = node.attributes.optional("metadata")?;
    let own = metadata.map_or(Ok(None), |metadata| metadata.optional("scenefold"))?;
    let field = |name| own.as_ref().map_or(Ok(None), |own| own.optional(name));
    let updated = node.attributes.optional("last_update_time_ns")?;
    let nanos = updated.map_or(Some(0), |at| at.value.as_u64());
    let trusted = nanos.filter(|nanos| own.is_some() || *nanos <= LAST_TIME_NS);
    if trusted.is_none() {
        odd.bad_time.push(id);
    }
    let pose_source = match field("pose_source")?.map(|at| at.text()).transpose()? {
        Some("topological") => PoseSource::Topological,
        _ => PoseSource::Measured,
    };
    Ok(Object {
        label,
        pose,
        size,
        decay_rate: field("decay_rate")?.map_or(Ok(MOVABLE_DECAY_RATE), |at| at.f64())?,
        last_observed: trusted.map(Stamp::from_nanos).unwrap_or_default(),
        pose_source,
        room,
        support: field("support")?.map(|at| at.parsed()).transpose()?,
    })
}
