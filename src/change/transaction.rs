//! [`Transaction`]: what one update did, applied whole or not at all.

use super::{EvidenceRef, Primitive, Undo, World, WorldError};
use crate::time::Stamp;

/// What caused a primitive.
#[derive(Clone, Debug, PartialEq)]
pub enum Cause {
    /// The change record with this number.
    Change(u64),
    /// A message that is no change, such as a frame that confirmed what was known.
    Evidence(EvidenceRef),
}

/// A primitive and its cause.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// Why.
    pub cause: Cause,
    /// What.
    pub primitive: Primitive,
}

/// All that one update did to the graph, as written to `/primitive`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Transaction {
    /// The time of the input that caused it.
    pub at: Stamp,
    /// What it did, in order.
    pub steps: Vec<Step>,
}

/// Why a transaction was refused: the world is as it was before.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("step {step} ({name}) is refused: {error}")]
pub struct TransactionError {
    /// Which step, from 0.
    pub step: usize,
    /// What kind of primitive it is.
    pub name: &'static str,
    /// Why.
    pub error: WorldError,
}

impl Transaction {
    /// Applies all steps, or none.
    pub fn apply(&self, world: &mut World) -> Result<(), TransactionError> {
        let next = world.next;
        let mut done: Vec<Undo> = Vec::new();
        for (n, step) in self.steps.iter().enumerate() {
            match step.primitive.apply(world) {
                Ok(Undo::Nothing) => {}
                Ok(undo) => done.push(undo),
                Err(error) => {
                    done.into_iter().rev().for_each(|undo| undo.apply(world));
                    world.next = next;
                    let name = step.primitive.name();
                    return Err(TransactionError { step: n, name, error });
                }
            }
        }
        Ok(())
    }
}
