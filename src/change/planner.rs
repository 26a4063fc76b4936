//! The planner: from a claim to primitives, or to the reason why not.
//!
//! Every plan begins with a `Find`. What rests on a thing goes with it into the gripper and to
//! where it is put; when a thing is gone for good, what rested on it stays in the room without
//! a support, for nobody said that it went too.

use super::resolve::{Hints, find_object, find_room, named, room_around};
use super::{Action, Claim, Departure, NodeRef, Primitive, Rejection, World, WorldError};
use crate::geometry::{Pose, Size};
use crate::graph::{Layer, Node, NodeId, Object, Placement, PoseSource, SceneGraph};
use crate::time::Stamp;

/// What the planner assumes of objects it knows nothing of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanConfig {
    /// λ of an added object, in 1/s.
    pub decay_rate: f64,
    /// Box of an added object whose box was not measured.
    pub size: Size,
}

/// What a claim comes to.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The claim with the nodes that were found.
    pub claim: Claim,
    /// What to do, in order.
    pub primitives: Vec<Primitive>,
}

/// Compiles `claim`, learned at `at`, against `world`.
///
/// # Errors
/// [`Rejection`] if the claim is ambiguous, impossible or contradicts what is known.
pub fn plan(
    world: &World,
    claim: &Claim,
    at: Stamp,
    config: &PlanConfig,
) -> Result<Plan, Rejection> {
    match claim.action {
        Action::Added => plan_added(world, claim, at, config),
        Action::Moved => plan_moved(world, claim, at),
        Action::Removed => plan_removed(world, claim, at),
    }
}

fn plan_added(
    world: &World,
    claim: &Claim,
    at: Stamp,
    config: &PlanConfig,
) -> Result<Plan, Rejection> {
    let known = claim.object.id.and_then(|id| Some((id, world.known(id)?)));
    if let Some((id, object)) = known {
        let object_ref = named(Some(&object.label), id);
        if world.graph().object(id).is_some_and(|object| !object.is_held()) {
            let room = named(world.graph().label(object.room), object.room);
            return Err(Rejection::AlreadyPresent { object: object_ref, room });
        }
        return plan_moved(world, claim, at);
    }
    let label = claim.object.label.clone().ok_or(Rejection::NothingNamed)?;
    // An id that nobody knows says nothing about which thing it is: ids are given here.
    let id = world.fresh_id(Layer::Object)?;
    let size = claim.size.unwrap_or(config.size);
    let target = find_target(world, claim, None, size, at)?;
    let object = Object {
        label: label.clone(),
        pose: target.placement.pose,
        size,
        decay_rate: config.decay_rate,
        last_observed: at,
        pose_source: target.placement.pose_source,
        room: target.placement.room,
        support: target.placement.support,
    };
    let find = Primitive::Find {
        query: label.to_string(),
        room: Some(target.placement.room),
        support: target.placement.support,
        candidates: vec![],
        chosen: None,
        reason: format!("new to the graph{}", target.note),
    };
    let add = Primitive::Add { id, node: Node::Object(object) };
    let mut claim = resolved(world.graph(), claim, id, &target.placement);
    claim.object = NodeRef { id: Some(id), label: Some(label) };
    Ok(Plan { claim, primitives: vec![find, add] })
}

fn plan_removed(world: &World, claim: &Claim, at: Stamp) -> Result<Plan, Rejection> {
    let found = find_subject(world, claim)?;
    let id = found.0;
    let object_ref = named(world.known(id).map(|object| &object.label), id);
    let Some(object) = world.graph().object(id) else {
        return Err(Rejection::AlreadyAbsent { object: object_ref });
    };
    if claim.held && object.is_held() {
        return Err(Rejection::AlreadyHeld { object: object_ref });
    }
    let mut primitives = vec![found.1];
    // Upper things first: nothing may rest on what leaves.
    for above in world.graph().resting_on(id).into_iter().rev() {
        primitives.extend(left_behind(world.graph(), above, id, claim.held, at));
    }
    let to = if claim.held { Departure::Held } else { Departure::Gone };
    primitives.push(Primitive::Remove { id, to, at });
    let claim = Claim {
        object: object_ref,
        source_room: Some(named(world.graph().label(object.room), object.room)),
        target_room: None,
        support: object.support.map(|on| named(world.graph().label(on), on)),
        ..claim.clone()
    };
    Ok(Plan { claim, primitives })
}

/// What becomes of `above`, which rests on or over `id`, when `id` leaves.
fn left_behind(
    graph: &SceneGraph,
    above: NodeId,
    id: NodeId,
    held: bool,
    at: Stamp,
) -> Option<Primitive> {
    let object = graph.object(above)?;
    if held {
        let remove = Primitive::Remove { id: above, to: Departure::Held, at };
        return (!object.is_held()).then_some(remove);
    }
    if object.support != Some(id) {
        return None;
    }
    if object.is_held() {
        // Held together and then gone together.
        return Some(Primitive::Remove { id: above, to: Departure::Gone, at });
    }
    let to =
        Placement { support: None, pose_source: PoseSource::Topological, ..Placement::of(object) };
    Some(Primitive::Move { id: above, to })
}

fn plan_moved(world: &World, claim: &Claim, at: Stamp) -> Result<Plan, Rejection> {
    let (id, find) = find_subject(world, claim)?;
    let before = world.known(id).ok_or(WorldError::NoIdLeft { layer: Layer::Object })?;
    let size = claim.size.unwrap_or(before.size);
    let target = find_target(world, claim, Some(id), size, at)?;
    let to = target.placement;
    let mut primitives = vec![with_note(find, &target.note)];
    let object = Object { size, ..placed(before, &to) };
    let there = world.graph().object(id).is_some_and(|object| !object.is_held());
    primitives.push(match there {
        true => Primitive::Move { id, to },
        false => Primitive::Add { id, node: Node::Object(object.clone()) },
    });
    for above in world.graph().resting_on(id) {
        primitives.push(carried(world.graph(), above, &before.pose, &to)?);
    }
    if there && size != before.size {
        let seen = vec![super::Sighting { id, pose: None, size: Some(size) }];
        primitives.push(Primitive::Observe { at, seen });
    }
    let claim = Claim {
        object: named(Some(&before.label), id),
        source_room: Some(named(world.graph().label(before.room), before.room)),
        ..resolved(world.graph(), claim, id, &to)
    };
    Ok(Plan { claim, primitives })
}

/// `above` goes along, rigidly, with what it rests on.
fn carried(
    graph: &SceneGraph,
    above: NodeId,
    before: &Pose,
    to: &Placement,
) -> Result<Primitive, Rejection> {
    let object = graph.object(above).ok_or(crate::graph::GraphError::UnknownNode { id: above });
    let object = object.map_err(WorldError::from)?;
    let pose = object.pose.carried(before, &to.pose).unwrap_or(to.pose);
    let measured = object.pose_source == PoseSource::Measured;
    let pose_source = match to.pose_source {
        PoseSource::Measured if measured => PoseSource::Measured,
        _ => PoseSource::Topological,
    };
    let along = Placement { room: to.room, support: object.support, pose, pose_source, at: to.at };
    Ok(if object.is_held() {
        Primitive::Add { id: above, node: Node::Object(placed(object, &along)) }
    } else {
        Primitive::Move { id: above, to: along }
    })
}

fn placed(object: &Object, to: &Placement) -> Object {
    Object {
        room: to.room,
        support: to.support,
        pose: to.pose,
        pose_source: to.pose_source,
        last_observed: to.at,
        ..object.clone()
    }
}

/// The object a removal or a move is about: its room of origin and, for a removal, its support
/// tell apart what has one name.
fn find_subject(world: &World, claim: &Claim) -> Result<(NodeId, Primitive), Rejection> {
    let room = match &claim.source_room {
        Some(room) if claim.object.id.is_none() => Some(find_room(world.graph(), room)?),
        _ => None,
    };
    let removal = claim.action == Action::Removed;
    let support = match &claim.support {
        Some(support) if removal && claim.object.id.is_none() => {
            let hints = Hints { room, ..Hints::default() };
            find_object(world, support, &hints).ok().map(|found| found.id)
        }
        _ => None,
    };
    let near = claim.pose.as_ref().filter(|_| removal);
    let found = find_object(world, &claim.object, &Hints { room, support, near, not: None })?;
    let label = world.known(found.id).map(|object| &object.label);
    if let (Some(label), Some(claimed)) = (label, &claim.object.label)
        && !label.same_class(claimed.as_str())
    {
        let (id, label, claimed) = (found.id, label.clone(), claimed.clone());
        return Err(Rejection::Contradiction { id, label, claimed });
    }
    Ok((found.id, found.find))
}

struct Target {
    placement: Placement,
    /// What to add to the reason of the `Find`, such as that a support was not understood.
    note: String,
}

/// Where `claim` says the object is now.
fn find_target(
    world: &World,
    claim: &Claim,
    id: Option<NodeId>,
    size: Size,
    at: Stamp,
) -> Result<Target, Rejection> {
    let graph = world.graph();
    let named_room = claim.target_room.as_ref().map(|room| find_room(graph, room)).transpose()?;
    let (support, note) = find_support(world, claim, id, named_room)?;
    let supported_in = support.and_then(|on| graph.object(on)).map(|object| object.room);
    let around = claim.pose.as_ref().and_then(|pose| room_around(graph, pose));
    let room = supported_in
        .or(named_room)
        .or(around)
        .ok_or_else(|| Rejection::NoTarget { object: claim.object.clone() })?;
    let (pose, pose_source) = match claim.pose {
        Some(pose) => (pose, PoseSource::Measured),
        None => (topological_pose(graph, room, support, size), PoseSource::Topological),
    };
    Ok(Target { placement: Placement { room, support, pose, pose_source, at }, note })
}

/// The support that `claim` names. One that is unknown or ambiguous costs only the support as
/// long as a room is known: the object is there, whatever it rests on.
fn find_support(
    world: &World,
    claim: &Claim,
    id: Option<NodeId>,
    room: Option<NodeId>,
) -> Result<(Option<NodeId>, String), Rejection> {
    let Some(wanted) = &claim.support else { return Ok((None, String::new())) };
    let hints = Hints { room, support: None, near: claim.pose.as_ref(), not: id };
    let present = |found: super::resolve::Found| {
        let object = world.graph().object(found.id)?;
        (!object.is_held()).then_some(found.id)
    };
    match find_object(world, wanted, &hints).map(present) {
        Ok(Some(support)) => Ok((Some(support), String::new())),
        Ok(None) if room.is_none() => {
            let held = wanted.id.is_some_and(|id| world.graph().object(id).is_some());
            let support = wanted.clone();
            Err(match held {
                true => Rejection::SupportHeld { support },
                false => Rejection::UnknownSupport { wanted: support },
            })
        }
        Err(rejection) if room.is_none() => Err(match rejection {
            Rejection::UnknownObject { wanted, .. } => Rejection::UnknownSupport { wanted },
            other => other,
        }),
        Ok(None) => Ok((None, format!("; its support is not known: {wanted} is not there"))),
        Err(rejection) => Ok((None, format!("; its support is not known: {rejection}"))),
    }
}

/// The pose of something of which only the support or the room is known: upright, in the middle
/// of the support's upper face; else in the middle of the room; else at the origin.
pub(crate) fn topological_pose(
    graph: &SceneGraph,
    room: NodeId,
    support: Option<NodeId>,
    size: Size,
) -> Pose {
    let above = |id: NodeId| {
        let support = graph.object(id)?;
        let [x, y, z] = support.pose.position();
        let lift = f64::midpoint(support.size.metres()[2], size.metres()[2]);
        Pose::at([x, y, z + lift]).ok()
    };
    let middle = || Some(graph.region(room)?.extent?.0);
    support.and_then(above).or_else(middle).unwrap_or(Pose::IDENTITY)
}

/// `claim` with the nodes it turned out to mean.
fn resolved(graph: &SceneGraph, claim: &Claim, id: NodeId, to: &Placement) -> Claim {
    Claim {
        object: named(graph.label(id), id),
        target_room: Some(named(graph.label(to.room), to.room)),
        support: to.support.map(|on| named(graph.label(on), on)),
        ..claim.clone()
    }
}

fn with_note(find: Primitive, note: &str) -> Primitive {
    match find {
        Primitive::Find { query, room, support, candidates, chosen, reason } => {
            let reason = reason + note;
            Primitive::Find { query, room, support, candidates, chosen, reason }
        }
        other => other,
    }
}
