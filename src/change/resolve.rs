//! Find: from a name to a node, with the candidates, the choice and the reason.

use super::{NodeRef, Primitive, Rejection, World};
use crate::geometry::Pose;
use crate::graph::{Label, Layer, NodeId, Object, Region, SceneGraph};

/// What narrows a search for an object down.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Hints<'a> {
    pub room: Option<NodeId>,
    pub support: Option<NodeId>,
    /// Where it was reported, which breaks ties.
    pub near: Option<&'a Pose>,
    /// Never this one.
    pub not: Option<NodeId>,
}

/// The object that `wanted` names, looked for in `room` if that is given.
///
/// # Errors
/// [`Rejection`] if nothing or several things answer to the name.
pub fn locate(world: &World, wanted: &NodeRef, room: Option<NodeId>) -> Result<NodeId, Rejection> {
    find_object(world, wanted, &Hints { room, ..Hints::default() }).map(|found| found.id)
}

/// The room that `wanted` names.
///
/// # Errors
/// [`Rejection`] if no room or several rooms answer to the name.
pub fn locate_room(world: &World, wanted: &NodeRef) -> Result<NodeId, Rejection> {
    find_room(world.graph(), wanted)
}

/// Who was found, and the record of the search.
#[derive(Debug)]
pub(super) struct Found {
    pub id: NodeId,
    pub find: Primitive,
}

/// The object that `wanted` names: in the graph or held; one that left only if named by id, or
/// if none that is there answers to the label.
pub(super) fn find_object(
    world: &World,
    wanted: &NodeRef,
    hints: &Hints<'_>,
) -> Result<Found, Rejection> {
    if let Some(id) = wanted.id {
        return find_by_id(world, id, wanted);
    }
    let Some(label) = &wanted.label else { return Err(Rejection::NothingNamed) };
    let by_label = |(id, object): (NodeId, &Object)| {
        (object.label.same_class(label.as_str()) && hints.not != Some(id)).then_some(id)
    };
    let mut named: Vec<NodeId> = world.graph().all_objects().filter_map(by_label).collect();
    let mut reason = format!("the only {label} known");
    if named.is_empty() {
        named = world.all_departed().filter_map(by_label).collect();
        reason = format!("the only {label} that was ever known; it had been removed");
    }
    let (candidates, narrowed) = narrow(world, &named, hints);
    if let Some(how) = narrowed {
        reason = format!("the only {label} {how}");
    }
    let id = match candidates.as_slice() {
        [] => {
            let where_ = place_words(world.graph(), hints);
            return Err(Rejection::UnknownObject { wanted: wanted.clone(), where_ });
        }
        [only] => *only,
        several => match nearest(world, several, hints.near) {
            Some((id, metres)) => {
                reason = format!("the nearest {label} to the reported pose ({metres:.2} m)");
                id
            }
            None => {
                return Err(Rejection::Ambiguous { wanted: wanted.clone(), candidates });
            }
        },
    };
    let query = label.to_string();
    Ok(Found { id, find: find(query, hints, candidates, id, reason) })
}

fn find_by_id(world: &World, id: NodeId, wanted: &NodeRef) -> Result<Found, Rejection> {
    if world.known(id).is_none() {
        return Err(Rejection::UnknownObject { wanted: wanted.clone(), where_: String::new() });
    }
    let reason = "named by id".to_owned();
    let find = find(id.to_string(), &Hints::default(), vec![id], id, reason);
    Ok(Found { id, find })
}

fn find(
    query: String,
    hints: &Hints<'_>,
    candidates: Vec<NodeId>,
    chosen: NodeId,
    reason: String,
) -> Primitive {
    let (room, support) = (hints.room, hints.support);
    Primitive::Find { query, room, support, candidates, chosen: Some(chosen), reason }
}

/// Those of `named` on the support and in the room that are hinted at; the words for it if that
/// helped. A hint that fits none leaves none: the claim is about something else.
fn narrow(world: &World, named: &[NodeId], hints: &Hints<'_>) -> (Vec<NodeId>, Option<String>) {
    let fits = |id: &&NodeId| {
        let Some(object) = world.known(**id) else { return false };
        hints.room.is_none_or(|room| object.room == room)
            && hints.support.is_none_or(|support| object.support == Some(support))
    };
    let fitting: Vec<NodeId> = named.iter().filter(fits).copied().collect();
    let helped = fitting.len() < named.len() && !fitting.is_empty();
    let words = helped.then(|| place_words(world.graph(), hints).trim_start().to_owned());
    (fitting, words)
}

fn place_words(graph: &SceneGraph, hints: &Hints<'_>) -> String {
    let word = |preposition: &str, id: Option<NodeId>| {
        let label = id.and_then(|id| graph.label(id));
        label.map_or(String::new(), |label| format!(" {preposition} the {label}"))
    };
    word("on", hints.support) + &word("in", hints.room)
}

fn nearest(world: &World, ids: &[NodeId], near: Option<&Pose>) -> Option<(NodeId, f64)> {
    let near = near?;
    let distance = |id: &NodeId| Some((*id, world.known(*id)?.pose.distance(near).0));
    // Ties go to the smaller id: `min_by` keeps the first.
    ids.iter().filter_map(distance).min_by(|a, b| a.1.total_cmp(&b.1))
}

/// The room that `wanted` names.
pub(super) fn find_room(graph: &SceneGraph, wanted: &NodeRef) -> Result<NodeId, Rejection> {
    let unknown = || Rejection::UnknownRoom { wanted: wanted.clone() };
    if let Some(id) = wanted.id {
        let known = id.layer() == Layer::Room && graph.region(id).is_some();
        return if known { Ok(id) } else { Err(unknown()) };
    }
    let Some(label) = &wanted.label else { return Err(unknown()) };
    let named = |(id, room): (NodeId, &Region)| room.label.same_class(label.as_str()).then_some(id);
    let candidates: Vec<NodeId> = graph.rooms().filter_map(named).collect();
    match candidates.as_slice() {
        [] => Err(unknown()),
        [only] => Ok(*only),
        _ => Err(Rejection::Ambiguous { wanted: wanted.clone(), candidates }),
    }
}

/// The smallest room whose box holds the position of `pose`, if any does.
pub(crate) fn room_around(graph: &SceneGraph, pose: &Pose) -> Option<NodeId> {
    let holds = |(id, room): (NodeId, &Region)| {
        let (centre, size) = room.extent?;
        let local = centre.isometry().inverse_transform_point(&pose.point());
        let inside = local.coords.iter().zip(size.metres()).all(|(c, side)| c.abs() <= side / 2.0);
        inside.then(|| (id, size.metres().iter().product::<f64>()))
    };
    graph.rooms().filter_map(holds).min_by(|a, b| a.1.total_cmp(&b.1)).map(|(id, _)| id)
}

/// `wanted` with the id and the label of the node it turned out to mean.
pub(super) fn named(label: Option<&Label>, id: NodeId) -> NodeRef {
    NodeRef { id: Some(id), label: label.cloned() }
}
