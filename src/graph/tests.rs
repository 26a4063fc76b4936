//! Tests of what a graph refuses to hold, and of piles.

use super::*;
use crate::change::{Cause, Departure, Primitive, Step, Transaction, World};
use crate::geometry::{Pose, Size};
use crate::time::Stamp;

fn room() -> NodeId {
    NodeId::new(Layer::Room, 0).unwrap()
}

fn thing(index: u32) -> NodeId {
    NodeId::new(Layer::Object, index).unwrap()
}

fn cup(support: Option<NodeId>) -> Object {
    Object {
        label: Label::new("cup").unwrap(),
        pose: Pose::IDENTITY,
        size: Size::new(0.1, 0.1, 0.1).unwrap(),
        decay_rate: 0.0,
        last_observed: Stamp::EPOCH,
        pose_source: PoseSource::Measured,
        room: room(),
        support,
    }
}

/// A room with a pile of `count` cups from `first` up.
fn pile(graph: &mut SceneGraph, first: u32, count: u32) {
    for n in 0..count {
        let support = (n > 0).then(|| thing(first + n - 1));
        graph.insert_object(thing(first + n), cup(support)).unwrap();
    }
}

fn empty_room() -> SceneGraph {
    let mut graph = SceneGraph::new();
    let region = Region { label: Label::new("kitchen").unwrap(), extent: None, parent: None };
    graph.insert_region(room(), region).unwrap();
    graph
}

/// Two piles, the lower end of one put on the upper end of the other.
fn high_pile() -> SceneGraph {
    let mut graph = empty_room();
    pile(&mut graph, 0, 100);
    pile(&mut graph, 100, 100);
    let to = Placement { support: Some(thing(99)), ..Placement::of(&cup(None)) };
    graph.place_object(thing(100), &to).unwrap();
    graph
}

#[test]
fn a_pile_higher_than_the_limit_is_refused() {
    let mut graph = empty_room();
    pile(&mut graph, 0, 101);
    let before = graph.clone();
    let (id, support, limit) = (thing(101), thing(100), MAX_PILE);
    let refused = graph.insert_object(id, cup(Some(support)));
    assert_eq!(refused, Err(GraphError::PileTooHigh { id, support, limit }));
    assert_eq!(graph, before);
}

#[test]
fn a_pile_that_grew_from_below_reads_back() {
    let graph = high_pile();
    assert_eq!(SceneGraph::from_bytes(&graph.to_bytes()), Ok(graph));
}

#[test]
fn a_refused_transaction_leaves_a_high_pile_as_it_was() {
    let mut world = World::from_graph(high_pile());
    let before = world.clone();
    let top = thing(199);
    let on_the_floor = Placement::of(&cup(None));
    let at = Stamp::EPOCH;
    let edits = [
        Primitive::Move { id: top, to: on_the_floor },
        Primitive::Remove { id: top, to: Departure::Held, at },
        Primitive::Add { id: top, node: Node::Object(cup(None)) },
        Primitive::SetDecay { id: top, decay_rate: 1.0, origin: String::new() },
        Primitive::Remove { id: top, to: Departure::Gone, at },
        Primitive::Remove { id: thing(198), to: Departure::Gone, at },
        Primitive::Remove { id: thing(0), to: Departure::Gone, at },
    ];
    let cause = Cause::Change(1);
    let steps = edits.map(|primitive| Step { cause: cause.clone(), primitive }).into();
    let refused = Transaction { at, steps }.apply(&mut world).unwrap_err();
    assert_eq!(refused.step, 6);
    assert_eq!(world, before);
}

#[test]
fn supports_that_go_round_are_no_graph() {
    let mut graph = empty_room();
    pile(&mut graph, 0, 3);
    let to = Placement { support: Some(thing(2)), ..Placement::of(&cup(None)) };
    let (id, support) = (thing(0), thing(2));
    assert_eq!(graph.place_object(id, &to), Err(GraphError::SupportCycle { id, support }));
    let mut bare = empty_room();
    (0..3).for_each(|n| bare.insert_object(thing(n), cup(None)).unwrap());
    let round = [(thing(0), thing(1)), (thing(1), thing(2)), (thing(2), thing(0))];
    assert!(matches!(bare.set_supports(&round), Err(GraphError::SupportCycle { .. })));
}

#[test]
fn nodes_beyond_the_limit_are_refused() {
    let mut graph = SceneGraph::new();
    let floor = Region { label: Label::new("floor").unwrap(), extent: None, parent: None };
    for index in 0..MAX_NODES as u32 {
        graph.insert_region(NodeId::new(Layer::Floor, index).unwrap(), floor.clone()).unwrap();
    }
    let next = NodeId::new(Layer::Floor, MAX_NODES as u32).unwrap();
    let full = GraphError::Full { layer: Layer::Floor, limit: MAX_NODES };
    assert_eq!(graph.insert_region(next, floor), Err(full));
}
