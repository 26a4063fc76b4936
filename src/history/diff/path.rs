//! [`Path`]: the primitives done so far and the world they led to.
//!
//! Objects depend on each other through what supports them, in both graphs. What can be done is
//! done, again and again; what is stuck is taken off its support first, with all that is tied to
//! it. That takes few primitives in the usual case and ends in every case.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use super::route::{hold, route};
use crate::change::{Primitive, World};
use crate::graph::{Node, NodeId, Object, Placement, PoseSource, SceneGraph};
use crate::time::Stamp;

/// A list of primitives in the making.
#[derive(Debug)]
pub(super) struct Path {
    world: World,
    done: Vec<Primitive>,
    at: Stamp,
}

/// What is still to be done, by object.
type Pending = BTreeMap<NodeId, VecDeque<Primitive>>;

impl Path {
    pub fn new(from: &World, at: Stamp) -> Self {
        Self { world: from.clone(), done: Vec::new(), at }
    }

    pub fn graph(&self) -> &SceneGraph {
        self.world.graph()
    }

    /// Does `primitive`, if the world takes it.
    pub fn attempt(&mut self, primitive: &Primitive) -> bool {
        let taken = primitive.apply(&mut self.world).is_ok();
        if taken {
            self.done.push(primitive.clone());
        }
        taken
    }

    /// Makes the objects those of `to`; their rooms are there already.
    pub fn bring_objects(&mut self, to: &SceneGraph) {
        let ids: BTreeSet<NodeId> =
            self.graph().all_objects().chain(to.all_objects()).map(|(id, _)| id).collect();
        let stuck = self.settle(self.routes(&ids, to));
        if !stuck.is_empty() {
            let tied = self.tied_to(stuck.into_keys().collect(), to);
            self.loosen(&tied, to);
            let stuck = self.settle(self.routes(&tied, to));
            debug_assert!(stuck.is_empty(), "nothing rests on anything: {stuck:?}");
        }
        let to_hold = |(id, object): (NodeId, &Object)| {
            let free = self.graph().object(id).is_some_and(|now| !now.is_held());
            hold(id, object).filter(|_| free).map(|hold| (id, VecDeque::from([hold])))
        };
        let holds = to.held().filter_map(to_hold).collect();
        let stuck = self.settle(holds);
        debug_assert!(stuck.is_empty(), "what is held rests on nothing that is not: {stuck:?}");
    }

    /// The list, with what was observed at one time in one primitive.
    pub fn finish(self) -> Vec<Primitive> {
        let mut merged: Vec<Primitive> = Vec::new();
        for primitive in self.done {
            match (merged.last_mut(), primitive) {
                (
                    Some(Primitive::Observe { at, seen }),
                    Primitive::Observe { at: also_at, seen: more },
                ) if *at == also_at => seen.extend(more),
                (_, primitive) => merged.push(primitive),
            }
        }
        merged
    }

    fn routes(&self, ids: &BTreeSet<NodeId>, to: &SceneGraph) -> Pending {
        let of = |id: &NodeId| {
            let route = route(*id, self.graph().object(*id), to.object(*id), self.at);
            (!route.is_empty()).then_some((*id, VecDeque::from(route)))
        };
        ids.iter().filter_map(of).collect()
    }

    /// Does what can be done until nothing more can; returns what cannot.
    fn settle(&mut self, mut pending: Pending) -> Pending {
        // What leaves, leaves first, before anything is put on it.
        for route in pending.values_mut() {
            let leaves = |next: &&Primitive| matches!(next, Primitive::Remove { .. });
            if route.front().filter(leaves).is_some_and(|next| self.attempt(next)) {
                route.pop_front();
            }
        }
        loop {
            let before = self.done.len();
            for route in pending.values_mut() {
                while route.front().is_some_and(|next| self.attempt(next)) {
                    route.pop_front();
                }
            }
            pending.retain(|_, route| !route.is_empty());
            if pending.is_empty() || self.done.len() == before {
                return pending;
            }
        }
    }

    /// All objects that rest on one of `ids` or support one, now or in `to`, directly or not.
    fn tied_to(&self, ids: Vec<NodeId>, to: &SceneGraph) -> BTreeSet<NodeId> {
        let mut ties: BTreeMap<NodeId, Vec<NodeId>> = BTreeMap::new();
        for (id, object) in self.graph().all_objects().chain(to.all_objects()) {
            if let Some(support) = object.support {
                ties.entry(id).or_default().push(support);
                ties.entry(support).or_default().push(id);
            }
        }
        let mut found = BTreeSet::new();
        let mut next = ids;
        while let Some(id) = next.pop() {
            if found.insert(id) {
                next.extend(ties.get(&id).into_iter().flatten());
            }
        }
        found
    }

    /// Puts all of `ids` down, each on nothing.
    fn loosen(&mut self, ids: &BTreeSet<NodeId>, to: &SceneGraph) {
        for id in ids {
            let Some(object) = self.graph().object(*id) else { continue };
            let primitive = if object.is_held() {
                let free = Object {
                    support: None,
                    pose_source: PoseSource::Topological,
                    // An Add sets everything at once, so the rest may be right already.
                    ..to.object(*id).unwrap_or(object).clone()
                };
                Primitive::Add { id: *id, node: Node::Object(free) }
            } else if object.support.is_some() {
                Primitive::Move {
                    id: *id,
                    to: Placement { support: None, ..Placement::of(object) },
                }
            } else {
                continue;
            };
            let taken = self.attempt(&primitive);
            debug_assert!(taken, "an object can be put on nothing: {primitive:?}");
        }
    }
}
