//! What really changed, as change records.

use super::scenario::check::Done;
use super::story::Story;
use crate::change::{Action, ChangeRecord, Claim, Modality, NodeRef, Occurred, Outcome};
use crate::graph::{Layer, NodeId};
use crate::time::Stamp;

/// Name and version of the simulator, as change records carry it.
pub const NAME: &str = "simulation/1";

/// What somebody did: one record for each thing. Their modality says that people did it.
pub fn by_people(story: &Story, done: &Done, at: Stamp) -> Vec<ChangeRecord> {
    let (action, things) = match done {
        Done::Removed(n) => (Action::Removed, vec![*n]),
        Done::Moved(all) => (Action::Moved, all.clone()),
        Done::Added(n) => (Action::Added, vec![*n]),
    };
    let change = |n| record(story, Modality::Human, action, n, at);
    things.into_iter().map(change).collect()
}

/// What the robot did with its gripper: taken (removed) or put (moved).
pub fn by_robot(story: &Story, action: Action, n: usize, at: Stamp) -> ChangeRecord {
    let mut change = record(story, Modality::Action, action, n, at);
    change.claim.held = action == Action::Removed;
    change
}

fn record(story: &Story, modality: Modality, action: Action, n: usize, at: Stamp) -> ChangeRecord {
    let thing = story.world().thing(n);
    let id = (action != Action::Added).then(|| object_id(n));
    let there = action != Action::Removed;
    let room = NodeRef::id(room_id(thing.room));
    let claim = Claim {
        modality,
        detector: NAME.into(),
        action,
        object: NodeRef { id, label: Some(thing.label.clone()) },
        source_room: None,
        target_room: there.then_some(room),
        support: thing.support.filter(|_| there).map(|n| NodeRef::id(object_id(n))),
        pose: there.then_some(thing.pose),
        size: there.then_some(thing.size),
        confidence: 1.0,
        occurred: Occurred::at(at),
        held: false,
        evidence: Vec::new(),
    };
    ChangeRecord { seq: 0, at, claim, outcome: Outcome::Applied }
}

/// Thing number `n` in the graph.
///
/// # Panics
/// Beyond the most nodes that a graph can have.
pub fn object_id(n: usize) -> NodeId {
    NodeId::new(Layer::Object, n as u32 + 1).expect("a house has fewer things")
}

/// Room number `n` in the graph.
///
/// # Panics
/// Beyond the most nodes that a graph can have.
pub fn room_id(n: usize) -> NodeId {
    NodeId::new(Layer::Room, n as u32 + 1).expect("a house has fewer rooms")
}
