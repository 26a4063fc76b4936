//! `GraphState`: a whole graph. Read entry by entry into a graph, never into a list of messages.

use super::common::{
    first, index, node, object, read_index, read_node, read_object, read_region, region,
};
use super::fields::{Field, Fields, required};
use super::labels::Labels;
use super::{WireError, proto};
use crate::graph::{Layer, NodeId, Object, SceneGraph};
use crate::time::Stamp;

pub(super) fn graph_state(graph: &SceneGraph) -> proto::GraphState {
    let layers = [Layer::Building, Layer::Floor, Layer::Room];
    let regions = layers.into_iter().flat_map(|layer| graph.regions(layer));
    proto::GraphState {
        regions: regions
            .map(|(id, it)| proto::RegionNode { node: node(id), region: Some(region(it)) })
            .collect(),
        access: graph
            .access()
            .map(|(a, b)| [a, b].map(|room| index(room, Layer::Room)))
            .map(|[room_a, room_b]| proto::Access { room_a, room_b })
            .collect(),
        objects: graph
            .all_objects()
            .map(|(id, it)| proto::ObjectNode {
                index: index(id, Layer::Object),
                object: Some(object(it, None)),
            })
            .collect(),
    }
}

/// Reads the payload of `/graph/initial`; `at` is its log time.
pub(super) fn read_graph_state(at: Stamp, payload: &[u8]) -> Result<SceneGraph, WireError> {
    let fields = Fields::new("GraphState", payload);
    let mut graph = SceneGraph::new();
    // Each pass needs the ones before: belonging goes to higher layers, access needs rooms.
    for layer in [Layer::Building, Layer::Floor, Layer::Room] {
        read_regions(fields.clone(), layer, &mut graph)?;
    }
    read_access(fields.clone(), &mut graph)?;
    let resting = read_objects(fields, at, &mut graph)?;
    graph.set_supports(&resting)?;
    Ok(graph)
}

fn read_regions(
    mut fields: Fields<'_>,
    layer: Layer,
    graph: &mut SceneGraph,
) -> Result<(), WireError> {
    const NAME: &str = "RegionNode";
    while let Some(field) = fields.next()? {
        if field.number != 1 {
            continue;
        }
        let (mut entry, mut id, mut region) = (field.message(NAME)?, first(Layer::Object), None);
        while let Some(field) = entry.next()? {
            match field.number {
                1 => id = read_node(&field, "node")?,
                2 => field.once(&mut region, read_region(field.message("Region")?)?)?,
                _ => {}
            }
        }
        // An object among the regions belongs to no pass: the first one lets the graph refuse.
        if id.layer() == layer || (id.layer() == Layer::Object && layer == Layer::Building) {
            graph.insert_region(id, required(region, NAME, "region")?)?;
        }
    }
    Ok(())
}

fn read_access(mut fields: Fields<'_>, graph: &mut SceneGraph) -> Result<(), WireError> {
    while let Some(field) = fields.next()? {
        if field.number != 2 {
            continue;
        }
        let (mut pair, mut a, mut b) =
            (field.message("Access")?, first(Layer::Room), first(Layer::Room));
        while let Some(field) = pair.next()? {
            match field.number {
                1 => a = read_index(&field, "room_a", Layer::Room)?,
                2 => b = read_index(&field, "room_b", Layer::Room)?,
                _ => {}
            }
        }
        graph.connect(a, b)?;
    }
    Ok(())
}

/// Objects are inserted bare first: a support may come later. Returns what rests on something.
fn read_objects(
    mut fields: Fields<'_>,
    at: Stamp,
    graph: &mut SceneGraph,
) -> Result<Vec<(NodeId, NodeId)>, WireError> {
    const NAME: &str = "ObjectNode";
    let mut labels = Labels::default();
    let mut label = |field: &Field<'_>| labels.read(field, "Object");
    let mut resting = Vec::new();
    while let Some(field) = fields.next()? {
        if field.number != 3 {
            continue;
        }
        let (mut entry, mut id, mut object) = (field.message(NAME)?, first(Layer::Object), None);
        while let Some(field) = entry.next()? {
            match field.number {
                1 => id = read_index(&field, "index", Layer::Object)?,
                2 => field.once(&mut object, read_object(field.message("Object")?, at, &mut label)?)?,
                _ => {}
            }
        }
        let object = required(object, NAME, "object")?;
        resting.extend(object.support.map(|support| (id, support)));
        graph.insert_object(id, Object { support: None, ..object })?;
    }
    Ok(resting)
}
