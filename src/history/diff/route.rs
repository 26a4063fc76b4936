//! The primitives that make one object what it is to be, others set aside.

use crate::change::{Departure, Primitive, Sighting};
use crate::graph::{Node, NodeId, Object, Placement, PoseSource};
use crate::time::Stamp;

const ORIGIN: &str = "difference";

/// From `before` to `after`, except that what is to be held is only brought to where it was
/// picked: see [`hold`].
pub(super) fn route(
    id: NodeId,
    before: Option<&Object>,
    after: Option<&Object>,
    at: Stamp,
) -> Vec<Primitive> {
    let add = |object: Object| Primitive::Add { id, node: Node::Object(object) };
    let gone = Primitive::Remove { id, to: Departure::Gone, at };
    match (before, after) {
        (None, None) => vec![],
        (Some(_), None) => vec![gone],
        (None, Some(after)) => vec![add(in_place(after, None))],
        (Some(before), Some(after)) if before == after => vec![],
        (Some(before), Some(after)) if before.is_held() => {
            let same = Object { decay_rate: after.decay_rate, ..before.clone() } == *after;
            if same {
                set_decay(id, before, after).into_iter().collect()
            } else {
                vec![add(in_place(after, None))]
            }
        }
        (Some(before), Some(after)) if before.label != after.label => {
            vec![gone, add(in_place(after, Some(before)))]
        }
        (Some(before), Some(after)) => adjust(id, before, &in_place(after, Some(before))),
    }
}

/// Into the gripper, if that is where `after` is.
pub(super) fn hold(id: NodeId, after: &Object) -> Option<Primitive> {
    let remove = Primitive::Remove { id, to: Departure::Held, at: after.last_observed };
    after.is_held().then_some(remove)
}

/// `after` as it is before it is picked. What the pick overwrites stays as it was `before`.
fn in_place(after: &Object, before: Option<&Object>) -> Object {
    if !after.is_held() {
        return after.clone();
    }
    Object {
        pose_source: before.map_or(PoseSource::Topological, |before| before.pose_source),
        last_observed: before.map_or(after.last_observed, |before| before.last_observed),
        ..after.clone()
    }
}

/// Both are in place and of one label.
fn adjust(id: NodeId, before: &Object, after: &Object) -> Vec<Primitive> {
    let (from, to) = (Placement::of(before), Placement::of(after));
    let resized = (before.size != after.size).then_some(after.size);
    let reposed = (from.pose != to.pose).then_some(to.pose);
    let mut primitives = Vec::new();
    let stays = from.room == to.room && from.support == to.support;
    let seen = |pose| {
        let seen = vec![Sighting { id, pose, size: resized }];
        Primitive::Observe { at: to.at, seen }
    };
    let source_fits = match reposed {
        // A pose that is observed is a measured one.
        Some(_) => to.pose_source == PoseSource::Measured,
        None => from.pose_source == to.pose_source,
    };
    if stays && source_fits {
        if reposed.is_some() || resized.is_some() || from.at != to.at {
            primitives.push(seen(reposed));
        }
    } else {
        primitives.push(Primitive::Move { id, to });
        if resized.is_some() {
            primitives.push(seen(None));
        }
    }
    primitives.extend(set_decay(id, before, after));
    primitives
}

fn set_decay(id: NodeId, before: &Object, after: &Object) -> Option<Primitive> {
    let decay_rate = after.decay_rate;
    let differs = before.decay_rate.to_bits() != decay_rate.to_bits();
    differs.then(|| Primitive::SetDecay { id, decay_rate, origin: ORIGIN.to_owned() })
}
