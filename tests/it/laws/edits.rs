//! Laws of the edits: refused ones change nothing, and transactions are whole.

use proptest::prelude::*;
use scenefold::change::{Cause, Primitive, Step, Transaction, World};
use scenefold::graph::{Layer, NodeId};

use super::cases;
use crate::testing;

/// Arbitrary ids are rarely those of a graph: these are, mostly.
fn aimed(primitive: Primitive, world: &World, pick: usize) -> Primitive {
    let objects: Vec<NodeId> = world
        .graph()
        .all_objects()
        .map(|(id, _)| id)
        .chain(world.all_departed().map(|(id, _)| id))
        .collect();
    let regions = [Layer::Room, Layer::Floor, Layer::Building]
        .into_iter()
        .flat_map(|layer| world.graph().regions(layer).map(|(id, _)| id));
    let regions: Vec<NodeId> = regions.collect();
    let known = |id: NodeId| {
        let from = if id.layer() == Layer::Object { &objects } else { &regions };
        from.get((pick + id.index() as usize) % (from.len() + 1)).copied().unwrap_or(id)
    };
    match primitive {
        Primitive::Remove { id, to, at } => Primitive::Remove { id: known(id), to, at },
        Primitive::Move { id, mut to } => {
            to.room = known(to.room);
            to.support = to.support.map(known);
            Primitive::Move { id: known(id), to }
        }
        Primitive::Observe { at, mut seen } => {
            seen.iter_mut().for_each(|sighting| sighting.id = known(sighting.id));
            Primitive::Observe { at, seen }
        }
        Primitive::SetDecay { id, decay_rate, origin } => {
            Primitive::SetDecay { id: known(id), decay_rate, origin }
        }
        Primitive::Add { id, node: scenefold::graph::Node::Object(mut object) } => {
            object.room = known(object.room);
            object.support = object.support.map(known);
            Primitive::Add { id: known(id), node: scenefold::graph::Node::Object(object) }
        }
        other => other,
    }
}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn a_refused_primitive_changes_nothing(
        world in testing::world(),
        primitives in prop::collection::vec((testing::primitive(), 0..12_usize), 1..12),
    ) {
        let mut world = world;
        for (primitive, pick) in primitives {
            let primitive = aimed(primitive, &world, pick);
            let before = world.clone();
            if primitive.apply(&mut world).is_err() {
                prop_assert_eq!(&world, &before, "{:?}", primitive);
                prop_assert_eq!(world.graph().hash(), before.graph().hash());
            }
        }
    }

    #[test]
    fn a_refused_transaction_changes_nothing(
        world in testing::world(),
        primitives in prop::collection::vec((testing::primitive(), 0..12_usize), 1..12),
    ) {
        let mut world = world;
        let step = |(primitive, pick)| {
            Step { cause: Cause::Change(1), primitive: aimed(primitive, &world, pick) }
        };
        let steps: Vec<Step> = primitives.into_iter().map(step).collect();
        // All that pass one after the other, and then one that is refused.
        let mut scratch = world.clone();
        let mut passing: Vec<Step> = Vec::new();
        for step in steps {
            let refused = step.primitive.apply(&mut scratch).is_err();
            passing.push(step);
            if refused {
                break;
            }
        }
        let before = world.clone();
        let transaction = Transaction { steps: passing, ..Transaction::default() };
        match transaction.apply(&mut world) {
            Ok(()) => prop_assert_eq!(world, scratch),
            Err(error) => {
                prop_assert_eq!(error.step + 1, transaction.steps.len());
                prop_assert_eq!(&world, &before);
                prop_assert_eq!(world.graph().hash(), before.graph().hash());
            }
        }
    }
}
