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

/// A step that may change the graph, without its cause: what replay needs of a transaction.
#[derive(Clone, Debug, PartialEq)]
pub struct Edit {
    /// Which step it is, from 0.
    pub step: usize,
    /// What it does.
    pub primitive: Primitive,
}

impl Transaction {
    /// Applies all steps, or none.
    pub fn apply(&self, world: &mut World) -> Result<(), TransactionError> {
        apply(self.steps.iter().map(|step| &step.primitive).enumerate(), world)
    }
}

/// Applies all edits of one transaction, or none.
pub fn apply_edits(edits: &[Edit], world: &mut World) -> Result<(), TransactionError> {
    apply(edits.iter().map(|edit| (edit.step, &edit.primitive)), world)
}

fn apply<'p>(
    steps: impl Iterator<Item = (usize, &'p Primitive)>,
    world: &mut World,
) -> Result<(), TransactionError> {
    let next = world.next;
    // One edit, the commonest case, needs no list of what to undo.
    let mut last = Undo::Nothing;
    let mut done: Vec<Undo> = Vec::new();
    for (step, primitive) in steps {
        match primitive.apply(world) {
            Ok(Undo::Nothing) => {}
            Ok(undo) => match std::mem::replace(&mut last, undo) {
                Undo::Nothing => {}
                earlier => done.push(earlier),
            },
            Err(error) => {
                last.apply(world);
                done.into_iter().rev().for_each(|undo| undo.apply(world));
                world.next = next;
                return Err(TransactionError { step, name: primitive.name(), error });
            }
        }
    }
    Ok(())
}
