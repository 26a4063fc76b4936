//! Running the detectors again over the recorded inputs, and comparing what they derive.

use std::collections::BTreeMap;
use std::ops::ControlFlow;

use super::events::{Walk, WalkError};
use super::open::Recording;
use crate::change::{Cause, ChangeRecord, EvidenceRef};
use crate::event::{Event, Interpretation, LanguageReply, Logged};
use crate::time::Stamp;
use crate::updater::{Config, UpdateError, Updater};

/// An input from which something else follows now than was recorded.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Number of the input.
    pub order: u64,
    /// Its log time.
    pub at: Stamp,
    /// What was recorded.
    pub recorded: Vec<Event>,
    /// What follows now, with event and change numbers as they were recorded where the two agree.
    pub now: Vec<Event>,
}

/// What came of running the detectors again.
#[derive(Clone, Debug, PartialEq)]
pub struct Reprocessed {
    /// How many inputs there were.
    pub inputs: u64,
    /// How many of them give something else now.
    pub different: u64,
    /// The first of those.
    pub differences: Vec<Difference>,
    /// The state after the last input.
    pub updater: Updater,
}

/// Differences that are kept; the others are only counted.
const KEPT: usize = 1000;

/// Why reprocessing ended early.
#[derive(Debug, thiserror::Error)]
pub enum ReprocessError<E> {
    /// The recording cannot be walked.
    #[error(transparent)]
    Walk(#[from] WalkError),
    /// A recorded input is refused.
    #[error("event #{order}: {error}")]
    Update {
        /// Number of the input.
        order: u64,
        /// Why.
        error: UpdateError,
    },
    /// The caller's sink failed.
    #[error(transparent)]
    Sink(E),
}

/// Takes each recorded input and what follows from it now, itself first.
pub type UpdateSink<'s, E> = dyn FnMut(&Logged, &[Logged]) -> Result<(), E> + 's;

/// Feeds the recorded inputs to a new updater under `config`, compares what it derives with what
/// was recorded, and hands each update to `sink`, for example to record it anew.
pub fn reprocess<E>(
    recording: &Recording,
    config: &Config,
    sink: &mut UpdateSink<'_, E>,
) -> Result<Reprocessed, ReprocessError<E>> {
    let mut again = Again::new(Updater::new(config.clone()));
    let (mut failure, mut expected) = (None, 1);
    recording.visit_events(Walk::Everything, (1, u64::MAX), &mut |logged| {
        if logged.order > expected && recording.is_numbered() {
            let Some((next, updater)) = after_gap(recording, logged.order, config) else {
                return ControlFlow::Break(());
            };
            if let Err(error) = again.settle(sink) {
                failure = Some(error);
                return ControlFlow::Break(());
            }
            again.go_on_from(updater);
            expected = next;
        }
        if logged.order < expected {
            // Between a gap and the checkpoint that mends it nothing can be compared.
            return ControlFlow::Continue(());
        }
        expected = logged.order + 1;
        match again.take(logged, sink) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                failure = Some(error);
                ControlFlow::Break(())
            }
        }
    })?;
    if let Some(error) = failure {
        return Err(error);
    }
    again.settle(sink)?;
    Ok(again.finish())
}

/// With what a gap before event `order` ends: the number of the event after the first usable
/// checkpoint from there on, and its state.
fn after_gap(recording: &Recording, order: u64, config: &Config) -> Option<(u64, Updater)> {
    recording.checkpoints().filter(|at| at.order + 1 >= order).find_map(|at| {
        let updater = recording.checkpoint(at).ok()?.updater(config.clone()).ok()?;
        Some((at.order + 1, updater))
    })
}

/// The comparison on its way through a log.
pub(super) struct Again {
    updater: Updater,
    /// An input that is not updated with yet: the outputs of models about it may still follow.
    waiting: Option<(Logged, Vec<Event>)>,
    /// The last input with what it derives now, and what was recorded of it so far.
    current: Option<(Logged, Vec<Logged>)>,
    recorded: Vec<Event>,
    /// Event numbers now → as recorded, where they differ; and the same of changes.
    orders: Renumber,
    inputs: u64,
    different: u64,
    differences: Vec<Difference>,
}

/// Numbers now and as recorded, where inputs stand elsewhere now.
#[derive(Default)]
struct Renumber {
    orders: BTreeMap<u64, u64>,
}

impl Again {
    pub fn new(updater: Updater) -> Self {
        Self {
            updater,
            waiting: None,
            current: None,
            recorded: Vec::new(),
            orders: Renumber::default(),
            inputs: 0,
            different: 0,
            differences: Vec::new(),
        }
    }

    /// Takes the next recorded event.
    pub fn take<E>(
        &mut self,
        logged: &Logged,
        sink: &mut UpdateSink<'_, E>,
    ) -> Result<(), ReprocessError<E>> {
        if let Some((_, outputs)) = &mut self.waiting
            && logged.event.is_model_output()
        {
            outputs.push(logged.event.clone());
            self.recorded.push(logged.event.clone());
            return Ok(());
        }
        self.settle(sink)?;
        if logged.event.is_input() {
            self.compare();
            self.waiting = Some((logged.clone(), Vec::new()));
        } else {
            self.recorded.push(logged.event.clone());
        }
        Ok(())
    }

    /// Updates with the last input, if that was not done yet: nothing more is recorded of what
    /// models said about it.
    pub fn settle<E>(&mut self, sink: &mut UpdateSink<'_, E>) -> Result<(), ReprocessError<E>> {
        let Some((input, outputs)) = self.waiting.take() else { return Ok(()) };
        let order = input.order;
        let updated = self.updater.update_with(input.published, input.event.clone(), outputs);
        let events = updated.map_err(|error| ReprocessError::Update { order, error })?;
        self.inputs += 1;
        if events[0].order != order {
            self.orders.orders.insert(events[0].order, order);
        }
        sink(&input, &events).map_err(ReprocessError::Sink)?;
        self.current = Some((input, events));
        Ok(())
    }

    /// Forgets the last input if what it derives may have been lost: at a gap. It must be settled.
    pub fn forget_unfinished(&mut self) {
        let Some((_, events)) = &self.current else { return };
        let (recorded, now) = (self.recorded.len(), events.len() - 1);
        if recorded < now {
            self.current = None;
        }
    }

    /// What the last input derives but the log does not hold, if it holds nothing of it but what
    /// models said. The last input must be settled.
    pub fn missing_tail(&self) -> Vec<Logged> {
        let Some((_, events)) = &self.current else { return Vec::new() };
        let known = 1 + self.recorded.len();
        match self.recorded.iter().all(Event::is_model_output) {
            true => events.get(known..).unwrap_or_default().to_vec(),
            false => Vec::new(),
        }
    }

    /// Goes on from a known state, without what was not compared by then.
    fn go_on_from(&mut self, updater: Updater) {
        self.forget_last();
        self.recorded.clear();
        self.waiting = None;
        self.updater = updater;
    }

    /// Leaves the last input out of the comparison.
    pub fn forget_last(&mut self) {
        self.current = None;
    }

    pub fn finish(mut self) -> Reprocessed {
        self.compare();
        let Self { updater, inputs, different, differences, .. } = self;
        Reprocessed { inputs, different, differences, updater }
    }

    /// The updater by now, once the last input is settled.
    pub fn updater(&self) -> &Updater {
        &self.updater
    }

    pub fn different(&self) -> u64 {
        self.different
    }

    fn compare(&mut self) {
        let recorded = std::mem::take(&mut self.recorded);
        let Some((input, events)) = self.current.take() else { return };
        let now: Vec<Event> =
            events[1..].iter().map(|logged| self.orders.as_recorded(&logged.event)).collect();
        if same(&recorded, &now) {
            return;
        }
        self.different += 1;
        if self.differences.len() < KEPT {
            let (order, at) = (input.order, input.at);
            self.differences.push(Difference { order, at, recorded, now });
        }
    }
}

impl Renumber {
    /// `event` with its references as the recording numbers them.
    fn as_recorded(&self, event: &Event) -> Event {
        let mut event = event.clone();
        match &mut event {
            Event::Change(record) => record.claim.evidence.iter_mut().for_each(|e| self.fix(e)),
            Event::Interpretation(Interpretation { of, .. })
            | Event::LanguageReply(LanguageReply { of, .. }) => self.fix(of),
            Event::Transaction(transaction) => {
                for step in &mut transaction.steps {
                    if let Cause::Evidence(evidence) = &mut step.cause {
                        self.fix(evidence);
                    }
                }
            }
            _ => {}
        }
        event
    }

    fn fix(&self, evidence: &mut EvidenceRef) {
        if let Some(order) = self.orders.get(&evidence.order) {
            evidence.order = *order;
        }
    }
}

/// Equal but for the numbers of changes, which shift where one more or less was made before.
fn same(recorded: &[Event], now: &[Event]) -> bool {
    recorded.len() == now.len()
        && recorded.iter().zip(now).all(|(recorded, now)| match (recorded, now) {
            (Event::Change(a), Event::Change(b)) => *a == ChangeRecord { seq: a.seq, ..b.clone() },
            (Event::Transaction(a), Event::Transaction(b)) => {
                a.at == b.at
                    && a.steps.len() == b.steps.len()
                    && a.steps.iter().zip(&b.steps).all(|(a, b)| {
                        let by_change =
                            matches!((&a.cause, &b.cause), (Cause::Change(_), Cause::Change(_)));
                        a.primitive == b.primitive && (by_change || a.cause == b.cause)
                    })
            }
            (a, b) => a == b,
        })
}
