//! From INSIDE and ON to one support an object.

use std::collections::BTreeMap;

use super::Relations;
use crate::graph::{NodeId, Placement, SceneGraph};
use crate::interchange::{ImportReport, counted};

/// Sets the supports of all objects in `taken` (`VirtualHome` number to id).
pub(super) fn connect(
    graph: &mut SceneGraph,
    taken: &BTreeMap<u64, NodeId>,
    relations: &Relations,
    report: &mut ImportReport,
) {
    let (mut several, mut cyclic) = (Vec::new(), Vec::new());
    for (number, id) in taken {
        let candidates = candidates(graph, *number, taken, relations);
        if candidates.len() > 1 {
            several.push(*id);
        }
        if !candidates.is_empty() && !place(graph, *id, &candidates) {
            cyclic.push(*id);
        }
    }
    if !several.is_empty() {
        report.note(counted(&several, "objects have several supports, the smallest is taken"));
    }
    if !cyclic.is_empty() {
        report.note(counted(&cyclic, "objects would rest on themselves and got no support"));
    }
}

/// The possible supports of an object, the most specific first.
fn candidates(
    graph: &SceneGraph,
    number: u64,
    taken: &BTreeMap<u64, NodeId>,
    relations: &Relations,
) -> Vec<NodeId> {
    let height = |n: &u64| Some(graph.object(*taken.get(n)?)?.pose.position_um()[2]);
    // Of two that each claim to be on the other, the higher one is.
    let is_below = |to: &&u64| {
        let mutual = targets(relations, **to).any(|back| *back == number);
        !mutual || (height(to), **to) < (height(&number), number)
    };
    let below = targets(relations, number).filter(is_below);
    let mut found: Vec<NodeId> = below.filter_map(|to| taken.get(to).copied()).collect();
    found.sort_unstable();
    found.dedup();
    found.sort_by_key(|id| {
        let object = graph.object(*id).expect("what was taken is in the graph");
        // Whole litres: boxes of one model differ in the last digits.
        let litres = object.size.metres().iter().product::<f64>() * 1000.0;
        (libm::round(litres) as i64, std::cmp::Reverse(object.pose.position_um()[2]), *id)
    });
    found
}

/// What an object is said to be on or in.
fn targets(relations: &Relations, number: u64) -> impl Iterator<Item = &u64> {
    let related = [&relations.inside, &relations.on];
    related.into_iter().filter_map(move |relation| relation.get(&number)).flatten()
}

/// Rests `id` on the first of `candidates` that does not rest on `id` itself.
fn place(graph: &mut SceneGraph, id: NodeId, candidates: &[NodeId]) -> bool {
    let object = graph.object(id).expect("what was taken is in the graph");
    let here = Placement::of(object);
    candidates.iter().any(|support| {
        graph.place_object(id, &Placement { support: Some(*support), ..here }).is_ok()
    })
}
