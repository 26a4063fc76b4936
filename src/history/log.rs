//! [`EventLog`]: a log that can be walked, and how its events advance a world.

use std::convert::Infallible;
use std::ops::ControlFlow;

use crate::change::{TransactionError, World};
use crate::event::{Event, Logged};

/// A log that can be walked in order.
pub trait EventLog {
    /// Why it cannot be read.
    type Error;

    /// Visits events with `first <= order <= last` in order until the visitor breaks.
    fn visit(
        &self,
        first: u64,
        last: u64,
        visitor: &mut dyn FnMut(&Logged) -> ControlFlow<()>,
    ) -> Result<(), Self::Error>;

    /// As [`EventLog::visit`], with the pictures, which a log may keep apart and leave out there.
    fn visit_all(
        &self,
        first: u64,
        last: u64,
        visitor: &mut dyn FnMut(&Logged) -> ControlFlow<()>,
    ) -> Result<(), Self::Error> {
        self.visit(first, last, visitor)
    }

    /// Told of a transaction that the graph refuses; says whether to go on without it, as one
    /// does with a log that is known to be damaged.
    fn refused(&self, _: &FoldError) -> bool {
        false
    }
}

/// A log in memory, in order.
#[derive(Clone, Copy, Debug)]
pub struct Slice<'a>(pub &'a [Logged]);

impl EventLog for Slice<'_> {
    type Error = Infallible;

    fn visit(
        &self,
        first: u64,
        last: u64,
        visitor: &mut dyn FnMut(&Logged) -> ControlFlow<()>,
    ) -> Result<(), Infallible> {
        let start = self.0.partition_point(|logged| logged.order < first);
        let wanted = self.0[start..].iter().take_while(|logged| logged.order <= last);
        for logged in wanted {
            if visitor(logged).is_break() {
                break;
            }
        }
        Ok(())
    }
}

/// A transaction of a log that its graph refuses: the log is damaged, or was written by a program
/// with other rules.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("event #{order} cannot be applied: {error}; `verify` says what is wrong with the log")]
pub struct FoldError {
    /// Its event number.
    pub order: u64,
    /// What was refused.
    pub error: TransactionError,
}

/// Advances `world` by one event; says whether the event is of a kind that changes it.
pub fn advance(world: &mut World, logged: &Logged) -> Result<bool, FoldError> {
    match &logged.event {
        Event::InitialGraph(graph) => *world = World::from_graph(graph.clone()),
        Event::Transaction(transaction) => {
            transaction.apply(world).map_err(|error| FoldError { order: logged.order, error })?;
        }
        _ => return Ok(false),
    }
    Ok(true)
}

/// As [`advance`]; a transaction that is refused is passed over if the log says so.
pub(super) fn advance_in<L: EventLog>(
    log: &L,
    world: &mut World,
    logged: &Logged,
) -> Result<bool, FoldError> {
    match advance(world, logged) {
        Err(error) if log.refused(&error) => Ok(false),
        advanced => advanced,
    }
}

/// Walks `log` from its start to event `upto` with a world that the visitor advances; returns the
/// world as it is at the end of the walk.
pub(super) fn walk<L: EventLog, E: From<FoldError>>(
    log: &L,
    upto: u64,
    from_log: impl FnOnce(L::Error) -> E,
    mut visitor: impl FnMut(&mut World, &Logged) -> Result<ControlFlow<()>, E>,
) -> Result<World, E> {
    let mut world = World::default();
    let mut failed = None;
    let visited = log.visit(1, upto, &mut |logged| match visitor(&mut world, logged) {
        Ok(flow) => flow,
        Err(error) => {
            failed = Some(error);
            ControlFlow::Break(())
        }
    });
    match (visited, failed) {
        (_, Some(error)) => Err(error),
        (Err(error), None) => Err(from_log(error)),
        (Ok(()), None) => Ok(world),
    }
}
