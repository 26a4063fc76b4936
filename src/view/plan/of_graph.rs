//! Plans of graphs, and of what changed between two.

use super::{Plan, PlanChange, PlanRoom, PlanThing, of_block};
use crate::graph::{Object, PoseSource, SceneGraph};
use crate::simulation::house::{footprint, from_graph};
use crate::time::Stamp;

/// Moves shorter than this are not drawn, metres.
const STILL_M: f64 = 0.02;

impl Plan {
    /// The plan of a graph. Its rooms are their boxes, made to meet where they nearly do. A graph
    /// says which rooms give access to each other, not where: a door is drawn where the shared
    /// wall is free. What is in the gripper is left out.
    pub fn of_graph(graph: &SceneGraph, title: &str) -> Self {
        let mut plan = Self { title: title.to_owned(), ..Self::default() };
        let extents = graph.rooms().filter(|(_, room)| room.extent.is_some()).count();
        match from_graph(graph, title) {
            Ok(made) if made.house.rooms.len() >= extents => plan.build(&made.house),
            _ => plan.boxes(graph),
        }
        plan.things =
            graph.objects().filter(|(_, it)| !is_structure(it)).map(|(_, it)| thing(it)).collect();
        plan
    }

    /// Rooms that overlap, or none: boxes as they are.
    fn boxes(&mut self, graph: &SceneGraph) {
        for (_, room) in graph.rooms() {
            let Some((pose, size)) = room.extent else { continue };
            let outline = footprint(&pose, size).corners().to_vec();
            self.rooms.push(PlanRoom { label: room.label.to_string(), outline });
        }
    }

    /// Shows how probable it is at `now` that things are still where they were seen, by colour.
    pub fn with_probabilities(mut self, graph: &SceneGraph, now: Stamp) -> Self {
        let objects = graph.objects().filter(|(_, object)| !is_structure(object));
        for (thing, (_, object)) in self.things.iter_mut().zip(objects) {
            if object.decay_rate > 0.0 {
                thing.probability = Some(object.probability_static(now));
            }
        }
        self
    }

    /// Shows what changed since `before`: what was added, what was removed, what was moved.
    /// `self` must be the plan of `graph`.
    pub fn with_changes(mut self, before: &SceneGraph, graph: &SceneGraph) -> Self {
        let objects = graph.objects().filter(|(_, object)| !is_structure(object));
        for (thing, (id, object)) in self.things.iter_mut().zip(objects) {
            let known = before.object(id).filter(|known| known.label == object.label);
            match known {
                None => thing.change = Some(PlanChange::Added),
                Some(known)
                    if known.pose.distance(&object.pose).0 > STILL_M
                        || known.room != object.room =>
                {
                    let from = footprint(&known.pose, known.size).corners();
                    thing.change = Some(PlanChange::Moved { from });
                }
                Some(_) => {}
            }
        }
        for (id, object) in before.objects().filter(|(_, object)| !is_structure(object)) {
            let there = graph.object(id).filter(|it| !it.is_held() && it.label == object.label);
            if there.is_none() {
                let change = Some(PlanChange::Removed);
                self.things.push(PlanThing { change, ..thing(object) });
            }
        }
        self
    }
}

/// What the rooms are drawn from already.
fn is_structure(object: &Object) -> bool {
    ["floor", "ceiling", "wall", "door", "doorjamb"]
        .iter()
        .any(|name| object.label.same_class(name))
}

fn thing(object: &Object) -> PlanThing {
    let block = footprint(&object.pose, object.size);
    let mut label = object.label.to_string();
    if object.pose_source == PoseSource::Topological {
        // Only its room or support is known.
        label.push('?');
    }
    of_block(label, &block, object.decay_rate > 0.0)
}
