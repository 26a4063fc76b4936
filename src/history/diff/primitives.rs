//! From a world to a graph, by primitives.

use super::path::Path;
use crate::change::{Departure, Primitive, World};
use crate::graph::{Layer, Node, NodeId, SceneGraph};
use crate::time::Stamp;

/// Layers of regions, highest first: the order in which they can be added.
const REGIONS: [Layer; 3] = [Layer::Building, Layer::Floor, Layer::Room];

/// The primitives that lead from `from` to a world whose graph is `to`; removals are dated `at`.
///
/// Applied in order, none is refused, and the graphs are equal, hash and all. As few as need be
/// where only objects differ. Regions cannot be edited, only added: where one is missing or
/// differs, everything is taken out and put in again.
pub fn primitives_between(from: &World, to: &SceneGraph, at: Stamp) -> Vec<Primitive> {
    let mut path = Path::new(from, at);
    if !has_grown(from.graph(), to) {
        path.bring_objects(&SceneGraph::new());
        remove_regions(&mut path, at);
    }
    add_regions(&mut path, to);
    path.bring_objects(to);
    path.finish()
}

/// Whether `to` has all regions and accesses of `from`, and no new access between old rooms.
fn has_grown(from: &SceneGraph, to: &SceneGraph) -> bool {
    let kept = |layer| from.regions(layer).all(|(id, region)| to.region(id) == Some(region));
    let old = |id: NodeId| from.region(id).is_some();
    let among_old: Vec<_> = to.access().filter(|(a, b)| old(*a) && old(*b)).collect();
    REGIONS.into_iter().all(kept) && from.access().eq(among_old)
}

fn remove_regions(path: &mut Path, at: Stamp) {
    for layer in REGIONS.into_iter().rev() {
        let ids: Vec<NodeId> = path.graph().regions(layer).map(|(id, _)| id).collect();
        for id in ids {
            let taken = path.attempt(&Primitive::Remove { id, to: Departure::Gone, at });
            debug_assert!(taken, "nothing belongs to {id} any more");
        }
    }
}

fn add_regions(path: &mut Path, to: &SceneGraph) {
    for layer in REGIONS {
        for (id, region) in to.regions(layer) {
            if path.graph().region(id).is_some() {
                continue;
            }
            let known = |other: &NodeId| path.graph().region(*other).is_some();
            let access = to.access_from(id).filter(known).collect();
            let node = Node::Region(region.clone(), access);
            let taken = path.attempt(&Primitive::Add { id, node });
            debug_assert!(taken, "{id} is free and what it belongs to is there");
        }
    }
}
