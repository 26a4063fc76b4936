//! [`Primitive`]: the smallest edits (paper, "Scene Graph Updater"; Observe and SetDecay are ours).

use super::{World, WorldError};
use crate::geometry::{Pose, Size};
use crate::graph::{
    GraphError, Layer, MAX_NODES, Node, NodeId, Object, Placement, PoseSource, Region,
};
use crate::time::Stamp;

/// Where a removed object went.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Departure {
    /// Out of the graph.
    Gone,
    /// Into the gripper: temporarily removed.
    Held,
}

/// One object seen where it was expected, with better geometry where that was measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sighting {
    /// The object.
    pub id: NodeId,
    /// Its pose, if better known now.
    pub pose: Option<Pose>,
    /// Its size, if better known now.
    pub size: Option<Size>,
}

/// Smallest edit of a graph. Every graph is the fold of a list of these.
#[derive(Clone, Debug, PartialEq)]
pub enum Primitive {
    /// Which node a label meant; changes nothing, says why the edits after it are about that one.
    Find {
        /// The label or id asked for.
        query: String,
        /// The room it was looked for in.
        room: Option<NodeId>,
        /// The support it was looked for on.
        support: Option<NodeId>,
        /// Who answers to it, in order of id.
        candidates: Vec<NodeId>,
        /// Who is meant.
        chosen: Option<NodeId>,
        /// Why.
        reason: String,
    },
    /// A node is there: a new one, or one that left or was held and comes back with its id.
    Add {
        /// Its id.
        id: NodeId,
        /// The node.
        node: Node,
    },
    /// A node is not there any more.
    Remove {
        /// Its id.
        id: NodeId,
        /// Where it went.
        to: Departure,
        /// Since when.
        at: Stamp,
    },
    /// An object is elsewhere: Remove then Add, keeping the id.
    Move {
        /// Its id.
        id: NodeId,
        /// Where it is now.
        to: Placement,
    },
    /// One frame confirmed these objects.
    Observe {
        /// When.
        at: Stamp,
        /// Which.
        seen: Vec<Sighting>,
    },
    /// How fast an object is expected to move.
    SetDecay {
        /// Its id.
        id: NodeId,
        /// λ in 1/s.
        decay_rate: f64,
        /// Where λ comes from.
        origin: String,
    },
}

/// What takes one applied primitive back.
#[derive(Debug)]
pub enum Undo {
    /// Nothing was changed.
    Nothing,
    /// An object was put in: take it out (and remember it as departed, if it was).
    Added(NodeId, Option<Box<Object>>),
    /// An object was moved or taken into the gripper: put it back.
    Placed(NodeId, Placement),
    /// An object was replaced: make it this again.
    Replaced(NodeId, Box<Object>),
    /// An object left: put it in again, at this place.
    Departed(NodeId, Placement),
    /// λ of an object was set.
    Decay(NodeId, f64),
    /// Objects were observed: this is what was known of them.
    Observed(Vec<Known>),
    /// A region was put in.
    RegionAdded(NodeId),
    /// A region was taken out, and the access it gave.
    RegionRemoved(NodeId, Region, Vec<NodeId>),
}

/// What an observation changes of an object.
#[derive(Clone, Copy, Debug)]
pub struct Known {
    id: NodeId,
    placement: Placement,
    size: Size,
}

impl Primitive {
    /// The word for it in JSON.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Find { .. } => "find",
            Self::Add { .. } => "add",
            Self::Remove { .. } => "remove",
            Self::Move { .. } => "move",
            Self::Observe { .. } => "observe",
            Self::SetDecay { .. } => "set_decay",
        }
    }

    /// The nodes it changes; for `Find`, the one it chose.
    pub fn nodes(&self) -> Vec<NodeId> {
        match self {
            Self::Find { chosen, .. } => chosen.iter().copied().collect(),
            Self::Add { id, .. }
            | Self::Remove { id, .. }
            | Self::Move { id, .. }
            | Self::SetDecay { id, .. } => vec![*id],
            Self::Observe { seen, .. } => seen.iter().map(|sighting| sighting.id).collect(),
        }
    }

    /// Applies the edit, and says how to take it back. On error nothing is changed.
    pub fn apply(&self, world: &mut World) -> Result<Undo, WorldError> {
        match self {
            Self::Find { candidates, chosen, .. } => match chosen {
                Some(chosen) if !candidates.contains(chosen) => {
                    Err(WorldError::NotACandidate { chosen: *chosen })
                }
                _ => Ok(Undo::Nothing),
            },
            Self::Add { id, node: Node::Object(object) } => add_object(world, *id, object),
            Self::Add { id, node: Node::Region(region, access) } => {
                add_region(world, *id, region, access)
            }
            Self::Remove { id, to, at } => remove(world, *id, *to, *at),
            Self::Move { id, to } => move_object(world, *id, to),
            Self::Observe { at, seen } => observe(world, *at, seen),
            Self::SetDecay { id, decay_rate, .. } => {
                let before = object(world, *id)?.decay_rate;
                world.graph.set_decay_rate(*id, *decay_rate)?;
                Ok(Undo::Decay(*id, before))
            }
        }
    }
}

impl Undo {
    /// Takes the primitive back. Undone in reverse order, nothing can refuse.
    pub(super) fn apply(self, world: &mut World) {
        let undone = match self {
            Self::Nothing => Ok(()),
            Self::Added(id, departed) => {
                if let Some(object) = departed {
                    world.departed.insert(id, *object);
                }
                world.graph.remove_object(id).map(drop)
            }
            Self::Placed(id, placement) => {
                world.graph.put_back(id, &placement);
                Ok(())
            }
            Self::Replaced(id, object) => {
                world.graph.put_back_over(id, *object);
                Ok(())
            }
            Self::Departed(id, placement) => {
                let object = world.departed.remove(&id).expect("it was just put there");
                world.graph.put_back_in(id, placement.over(object));
                Ok(())
            }
            Self::Decay(id, decay_rate) => world.graph.set_decay_rate(id, decay_rate),
            Self::Observed(before) => {
                before.into_iter().rev().for_each(|known| known.restore(world));
                Ok(())
            }
            Self::RegionAdded(id) => {
                let access: Vec<NodeId> = world.graph.access_from(id).collect();
                access.into_iter().for_each(|other| world.graph.disconnect(id, other));
                world.graph.remove_region(id).map(drop)
            }
            Self::RegionRemoved(id, region, access) => world
                .graph
                .insert_region(id, region)
                .and_then(|()| access.iter().try_for_each(|to| world.graph.connect(id, *to))),
        };
        undone.expect("what was just done can be undone");
    }
}

impl Known {
    fn of(id: NodeId, object: &Object) -> Self {
        Self { id, placement: Placement::of(object), size: object.size }
    }

    fn restore(self, world: &mut World) {
        let Self { id, placement, size } = self;
        let sized = world.graph.observe_object(id, placement.at, None, Some(size));
        sized.expect("what was just observed is there");
        world.graph.put_back(id, &placement);
    }
}

fn object(world: &World, id: NodeId) -> Result<&Object, GraphError> {
    world.graph.object(id).ok_or(GraphError::UnknownNode { id })
}

fn add_object(world: &mut World, id: NodeId, object: &Object) -> Result<Undo, WorldError> {
    if object.is_held() {
        // Only `Remove` puts things into the gripper; an Add makes them present.
        return Err(GraphError::Held { id }.into());
    }
    let undo = match world.graph.object(id) {
        Some(held) if held.is_held() => {
            Undo::Replaced(id, Box::new(world.graph.swap_object(id, object.clone())?))
        }
        _ => {
            check_known(world, id)?;
            world.graph.insert_object(id, object.clone())?;
            Undo::Added(id, world.departed.remove(&id).map(Box::new))
        }
    };
    use_id(world, id);
    Ok(undo)
}

/// What left is remembered, so that it counts towards what a graph may hold.
fn check_known(world: &World, id: NodeId) -> Result<(), GraphError> {
    let known = world.graph.object_count() + world.departed.len();
    if known < MAX_NODES || world.departed.contains_key(&id) {
        return Ok(());
    }
    Err(GraphError::Full { layer: Layer::Object, limit: MAX_NODES })
}

fn add_region(
    world: &mut World,
    id: NodeId,
    region: &Region,
    access: &[NodeId],
) -> Result<Undo, WorldError> {
    for other in access {
        let known = other.layer() == Layer::Room && world.graph.region(*other).is_some();
        if !known || id.layer() != Layer::Room {
            return Err(GraphError::UnknownNode { id: *other }.into());
        }
    }
    world.graph.insert_region(id, region.clone())?;
    for other in access {
        world.graph.connect(id, *other)?;
    }
    use_id(world, id);
    Ok(Undo::RegionAdded(id))
}

/// Ids are never used twice, even if the edit that used one is taken back.
fn use_id(world: &mut World, id: NodeId) {
    let next = &mut world.next[id.layer() as usize];
    *next = (*next).max(id.index() + 1);
}

fn remove(world: &mut World, id: NodeId, to: Departure, at: Stamp) -> Result<Undo, WorldError> {
    if id.layer() != Layer::Object {
        return remove_region(world, id);
    }
    let before = Placement::of(object(world, id)?);
    match to {
        Departure::Held => {
            world.graph.hold_object(id, at)?;
            Ok(Undo::Placed(id, before))
        }
        Departure::Gone => {
            let gone = world.graph.remove_object(id)?;
            let source = match gone.pose_source {
                PoseSource::Held => PoseSource::Topological,
                known => known,
            };
            world.departed.insert(id, Object { pose_source: source, last_observed: at, ..gone });
            Ok(Undo::Departed(id, before))
        }
    }
}

/// Takes a region out, with the access it gave; nothing may belong to it.
fn remove_region(world: &mut World, id: NodeId) -> Result<Undo, WorldError> {
    let access: Vec<NodeId> = world.graph.access_from(id).collect();
    for other in &access {
        world.graph.disconnect(id, *other);
    }
    match world.graph.remove_region(id) {
        Ok(region) => Ok(Undo::RegionRemoved(id, region, access)),
        Err(refused) => {
            let reconnected = access.iter().try_for_each(|other| world.graph.connect(id, *other));
            reconnected.expect("what was just disconnected can be connected");
            Err(refused.into())
        }
    }
}

fn move_object(world: &mut World, id: NodeId, to: &Placement) -> Result<Undo, WorldError> {
    let before = Placement::of(object(world, id)?);
    if before.pose_source == PoseSource::Held || to.pose_source == PoseSource::Held {
        return Err(GraphError::Held { id }.into());
    }
    world.graph.place_object(id, to)?;
    Ok(Undo::Placed(id, before))
}

fn observe(world: &mut World, at: Stamp, seen: &[Sighting]) -> Result<Undo, WorldError> {
    let mut before = Vec::with_capacity(seen.len());
    for sighting in seen {
        let object = object(world, sighting.id)?;
        if object.is_held() {
            return Err(GraphError::Held { id: sighting.id }.into());
        }
        before.push(Known::of(sighting.id, object));
    }
    for sighting in seen {
        world.graph.observe_object(sighting.id, at, sighting.pose, sighting.size)?;
    }
    Ok(Undo::Observed(before))
}
