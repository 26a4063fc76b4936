//! Rooms, floors and buildings of the file.

use std::collections::BTreeMap;

use super::boxes::{self, Around};
use super::nodes::{File, Kind};
use super::{SparkDsgError, labels};
use crate::geometry::{Pose, Size};
use crate::graph::{Label, Layer, NodeId, Region, SceneGraph};
use crate::interchange::json::{At, JsonError};
use crate::interchange::{ImportReport, counted};

/// Boxes of objects by their ids in the file.
pub(super) type ObjectBoxes = BTreeMap<u64, Option<(Pose, Size)>>;

/// Adds all regions, buildings first, and the access between rooms.
pub(super) fn insert(
    graph: &mut SceneGraph,
    root: &At<'_>,
    file: &File<'_>,
    ids: &BTreeMap<u64, NodeId>,
    objects: &ObjectBoxes,
    report: &mut ImportReport,
) -> Result<(), SparkDsgError> {
    let extents = extents(file, ids, objects, report)?;
    for layer in [Layer::Building, Layer::Floor, Layer::Room] {
        if layer == Layer::Floor {
            insert_own_floors(graph, root)?;
        }
        for (bits, id) in ids.iter().filter(|(_, id)| id.layer() == layer) {
            let node = &file.nodes[bits];
            let above = |layer| file.ancestor(*bits, layer).map(|bits| ids[&bits]);
            let parent = match layer {
                Layer::Room => own_floor(graph, &node.attributes)?
                    .or_else(|| above(Layer::Floor))
                    .or_else(|| above(Layer::Building)),
                Layer::Floor => above(Layer::Building),
                Layer::Building | Layer::Object => None,
            };
            let label = labels::read(root, node, *id)?;
            graph.insert_region(*id, Region { label, extent: extents[bits], parent })?;
        }
    }
    let room = |bits: &u64| ids.get(bits).copied().filter(|id| id.layer() == Layer::Room);
    for (a, b) in &file.edges {
        match (room(a), room(b)) {
            (Some(a), Some(b)) if a != b => graph.connect(a, b)?,
            _ => {}
        }
    }
    Ok(())
}

/// The boxes of all regions: those of the file where they are valid, else derived.
fn extents(
    file: &File<'_>,
    ids: &BTreeMap<u64, NodeId>,
    objects: &ObjectBoxes,
    report: &mut ImportReport,
) -> Result<BTreeMap<u64, Option<(Pose, Size)>>, JsonError> {
    let mut extents = BTreeMap::new();
    let (mut derived, mut without) = (Vec::new(), Vec::new());
    for layer in [Layer::Room, Layer::Floor, Layer::Building] {
        let mut around = members(file, objects, &extents, layer)?;
        for (bits, id) in ids.iter().filter(|(_, id)| id.layer() == layer) {
            let mut extent = boxes::read(&file.nodes[bits].attributes)?;
            if extent.is_none() {
                extent = around.remove(bits).and_then(Around::finish);
                if extent.is_some() { derived.push(*id) } else { without.push(*id) }
            }
            extents.insert(*bits, extent);
        }
    }
    if !derived.is_empty() {
        report.note(counted(&derived, "regions got the box around what belongs to them"));
    }
    if !without.is_empty() {
        report.note(counted(&without, "regions are known only by name"));
    }
    Ok(extents)
}

/// The boxes around what belongs to each region of `layer`: places, objects, lower regions.
fn members(
    file: &File<'_>,
    objects: &ObjectBoxes,
    lower: &BTreeMap<u64, Option<(Pose, Size)>>,
    layer: Layer,
) -> Result<BTreeMap<u64, Around>, JsonError> {
    let mut around: BTreeMap<u64, Around> = BTreeMap::new();
    for (bits, node) in &file.nodes {
        let extent = objects.get(bits).or_else(|| lower.get(bits)).copied().flatten();
        let is_place = node.kind == Kind::Place;
        if extent.is_none() && !is_place {
            continue;
        }
        let Some(region) = file.ancestor(*bits, layer) else { continue };
        let around = around.entry(region).or_default();
        match extent {
            Some(extent) => around.extent(extent),
            None => around.point(node.attributes.field("position")?.triple()?.into()),
        }
    }
    Ok(around)
}

/// Floors that our export keeps in the metadata, for Spark-DSG has no layer for them.
fn insert_own_floors(graph: &mut SceneGraph, root: &At<'_>) -> Result<(), SparkDsgError> {
    let Some(metadata) = root.optional("metadata")? else { return Ok(()) };
    let Some(own) = metadata.optional("scenefold")? else { return Ok(()) };
    for at in own.list("floors")? {
        let id: NodeId = at.field("id")?.parsed()?;
        let building = at.optional("building")?.map(|at| at.parsed()).transpose()?;
        let label = Label::new(at.field("label")?.text()?).map_err(|error| at.error(error))?;
        if id.layer() != Layer::Floor {
            return Err(at.error(format!("{id} is no floor")).into());
        }
        let extent = boxes::read(&at)?;
        graph.insert_region(id, Region { label, extent, parent: building })?;
    }
    Ok(())
}

fn own_floor(graph: &SceneGraph, attributes: &At<'_>) -> Result<Option<NodeId>, JsonError> {
    let Some(metadata) = attributes.optional("metadata")? else { return Ok(None) };
    let Some(own) = metadata.optional("scenefold")? else { return Ok(None) };
    let floor: Option<NodeId> = own.optional("floor")?.map(|at| at.parsed()).transpose()?;
    Ok(floor.filter(|id| id.layer() == Layer::Floor && graph.contains(*id)))
}
