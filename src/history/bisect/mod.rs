//! The first event after which a condition holds.
//!
//! # Conditions
//!
//! ```text
//! expr  = all { ("or" | "||") all }
//! all   = not { ("and" | "&&") not }
//! not   = { "not" | "!" } atom
//! atom  = "(" expr ")" | test
//! test  = "present" "(" thing ")"
//!       | "absent" "(" thing ")"
//!       | "held" "(" thing ")"
//!       | "in" "(" thing "," place ")"
//!       | "on" "(" thing "," thing ")"
//!       | "count" "(" thing ")" op number
//!       | "probability" "(" thing ")" op number
//!       | ("objects" | "rooms" | "changes") op number
//! op    = "<" | "<=" | ">" | ">=" | "=" | "==" | "!="
//! thing = an object's id (O17) or label; place = an id (R2, F1, B1) or label of a region
//! ```
//!
//! A label is written as it is, spaces and all (`in(tv remote, living room)`), or in double
//! quotes if it has a comma or a parenthesis in it; case, `_`, `-` and spaces do not matter. A
//! label stands for every object of that label, an id for one:
//!
//! | test | holds when |
//! |---|---|
//! | `present(mug)` | some mug is in the graph and not in the gripper |
//! | `absent(mug)` | some mug that was ever known is not there now; one in the gripper is not there |
//! | `held(mug)` | some mug is in the gripper |
//! | `in(mug, kitchen)` | some mug is present in that room, or in a room of that floor or building |
//! | `on(mug, table)` | some mug is present and rests on, or lies in, some table, directly |
//! | `count(mug) > 2` | so many mugs are present |
//! | `probability(mug) < 0.5` | for some mug that is present, p(static) at the time of the event is that |
//! | `objects > 10` | so many objects are in the graph, those in the gripper included |
//! | `rooms > 3` | so many rooms are in the graph |
//! | `changes >= 7` | so many changes were applied |
//!
//! So `absent(mug)` and `present(mug)` hold together where one of two mugs is gone; no mug at
//! all is `count(mug) = 0`, or `not present(mug)`.
//!
//! A condition is looked at after every event that may change it: after transactions that touch
//! what it speaks of, after applied changes where it speaks of `changes`, after every event where
//! it speaks of a probability. The cost per event is that of the objects it names.

mod expr;
mod parse;
mod scan;
mod watch;

pub use expr::{Comparison, Expr, Tally, Test, Who};
pub use parse::ParseError;

use std::ops::ControlFlow;

use serde::Serialize;

use super::log::walk;
use super::{EventLog, FoldError, advance};
use crate::change::{Cause, Step, Transaction, World};
use crate::event::{Event, Logged};
use crate::time::Stamp;
use watch::Watch;

/// The first event after which a condition holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Hit {
    /// Its number.
    pub order: u64,
    /// Its log time.
    pub at: Stamp,
    /// The change that brought it about, if one did.
    pub change: Option<u64>,
    /// The world after it.
    pub world: World,
}

/// The answer of a bisection in JSON; all null if the condition never holds.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct BisectDocument {
    /// Number of the first event after which the condition holds.
    pub order: Option<u64>,
    /// Its log time.
    pub at: Option<String>,
    /// Number of the change that brought it about, if one did.
    pub change: Option<u64>,
}

impl BisectDocument {
    /// The document of an answer.
    pub fn of(hit: Option<&Hit>) -> Self {
        Self {
            order: hit.map(|hit| hit.order),
            at: hit.map(|hit| hit.at.to_string()),
            change: hit.and_then(|hit| hit.change),
        }
    }
}

/// Why there is no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum BisectError<E> {
    /// The log cannot be read.
    #[error("{0}")]
    Log(E),
    /// The log cannot be folded.
    #[error(transparent)]
    Fold(#[from] FoldError),
}

/// The first event of `log` after which `expr` holds; the initial graph is such an event too.
///
/// # Errors
/// [`BisectError`] if the log cannot be read or folded up to there.
pub fn first_holding<L: EventLog>(
    log: &L,
    expr: &Expr,
) -> Result<Option<Hit>, BisectError<L::Error>> {
    let mut search = Search { watch: Watch::new(expr), change: None };
    let mut first = None;
    let world = walk(log, u64::MAX, BisectError::Log, |world, logged| {
        let holds = match search.step(world, logged) {
            Err(error) if log.refused(&error) => false,
            step => step?,
        };
        if !holds {
            return Ok::<_, BisectError<L::Error>>(ControlFlow::Continue(()));
        }
        first = Some((logged.order, logged.at));
        Ok(ControlFlow::Break(()))
    })?;
    let change = search.change;
    Ok(first.map(|(order, at)| Hit { order, at, change, world }))
}

impl Expr {
    /// Whether it holds in `world` at `now`, after so many applied changes.
    pub fn holds(&self, world: &World, now: Stamp, changes: u64) -> bool {
        let mut watch = Watch::new(self);
        watch.begin(world);
        watch.set_changes(changes);
        watch.holds(world, now)
    }
}

/// A walk towards the first event.
struct Search<'a> {
    watch: Watch<'a>,
    /// What made the condition hold at the last event, if a change did.
    change: Option<u64>,
}

impl Search<'_> {
    /// Advances by one event; says whether the condition holds after it.
    fn step(&mut self, world: &mut World, logged: &Logged) -> Result<bool, FoldError> {
        self.change = None;
        match &logged.event {
            Event::InitialGraph(_) => {
                advance(world, logged)?;
                self.watch.begin(world);
            }
            Event::Transaction(transaction) => self.apply(world, logged, transaction)?,
            Event::Change(record) if record.is_applied() => {
                self.watch.count_change();
                self.change = self.watch.counts_changes().then_some(record.seq);
            }
            _ => {}
        }
        Ok(self.watch.holds(world, logged.at))
    }

    /// Applies a transaction cause by cause, to know which one makes the condition hold.
    fn apply(
        &mut self,
        world: &mut World,
        logged: &Logged,
        transaction: &Transaction,
    ) -> Result<(), FoldError> {
        let mut held = false;
        let mut done = 0;
        while let Some(first) = transaction.steps.get(done) {
            let rest = &transaction.steps[done..];
            let end = rest.iter().position(|step| step.cause != first.cause);
            let group = &rest[..end.unwrap_or(rest.len())];
            apply_group(world, logged, transaction, done, group)?;
            self.watch.touch(world, group);
            let holds = self.watch.holds(world, logged.at);
            if holds && !held {
                self.change = match first.cause {
                    Cause::Change(seq) => Some(seq),
                    Cause::Evidence(_) => None,
                };
            }
            held = holds;
            done += group.len();
        }
        Ok(())
    }
}

/// Applies the steps of one cause, which begin at step `done` of the transaction.
fn apply_group(
    world: &mut World,
    logged: &Logged,
    transaction: &Transaction,
    done: usize,
    group: &[Step],
) -> Result<(), FoldError> {
    let applied = if group.len() == transaction.steps.len() {
        transaction.apply(world)
    } else {
        Transaction { at: transaction.at, steps: group.to_vec() }.apply(world)
    };
    applied.map_err(|mut error| {
        error.step += done;
        FoldError { order: logged.order, error }
    })
}
