//! Laws of primitives and transactions over arbitrary worlds.

use proptest::prelude::*;

use super::{Transaction, World};
use crate::bytes::{Reader, Writer};
use crate::testing::{primitive, transaction, world};

proptest! {
    #[test]
    fn a_refused_primitive_changes_nothing_and_an_applied_one_can_be_taken_back(
        before in world(),
        primitive in primitive(),
    ) {
        let mut world = before.clone();
        if let Ok(undo) = primitive.apply(&mut world) {
            undo.apply(&mut world);
            prop_assert_eq!(world.graph().to_bytes(), before.graph().to_bytes());
            prop_assert_eq!(&world.departed, &before.departed);
        } else {
            prop_assert_eq!(world, before);
        }
    }

    #[test]
    fn a_transaction_is_applied_whole_or_not_at_all(
        before in world(),
        transaction in transaction(),
    ) {
        let mut at_once = before.clone();
        let applied = transaction.apply(&mut at_once);
        let mut one_by_one = before.clone();
        let refused = transaction.steps.iter().position(|step| {
            let step = Transaction { at: transaction.at, steps: vec![step.clone()] };
            step.apply(&mut one_by_one).is_err()
        });
        match applied {
            Ok(()) => {
                prop_assert_eq!(refused, None);
                prop_assert_eq!(at_once, one_by_one);
            }
            Err(error) => {
                prop_assert_eq!(Some(error.step), refused);
                prop_assert_eq!(at_once, before);
            }
        }
    }

    #[test]
    fn a_world_reads_back_from_its_bytes(world in world()) {
        let mut bytes = Writer::default();
        world.write_bytes(&mut bytes);
        prop_assert_eq!(World::read_bytes(&mut Reader(&bytes.0)), Ok(world));
    }
}
