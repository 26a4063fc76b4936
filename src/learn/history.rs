//! [`Histories`]: where each object of a log is known to have been, and when.

use std::collections::{BTreeMap, VecDeque};
use std::ops::ControlFlow;

use crate::change::{Cause, ChangeRecord, Modality, Primitive, Step, Transaction, World};
use crate::event::{Event, Logged};
use crate::graph::{Label, NodeId, Object};
use crate::history::{EventLog, FoldError, advance};
use crate::modality::time::Stillness;
use crate::time::Stamp;

use super::belief::place_name;
use super::birth_death::PairCounts;
use super::dwell::{Dwell, DwellData, DwellError};

/// A place for objects: on or in something, or somewhere in a room.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Spot {
    /// Which of several logs it belongs to.
    pub log: u32,
    /// The room.
    pub room: NodeId,
    /// What it is on or in, if known.
    pub support: Option<NodeId>,
}

/// A stretch of time during which an object is known to have been in one place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stay {
    /// Where; `None`: in the gripper, or gone.
    pub spot: Option<Spot>,
    /// Known to be there from then on.
    pub from: Stamp,
    /// Known to be there until then.
    pub until: Stamp,
}

/// Where one object has been.
#[derive(Clone, Debug, PartialEq)]
pub struct ObjectHistory {
    /// Its class.
    pub label: Label,
    /// Where it has been, in order of time.
    pub stays: Vec<Stay>,
    /// When it was seen where it was expected, in order of time.
    pub sightings: Vec<Stamp>,
    /// Whether the graph says that it can move (λ > 0).
    pub movable: bool,
    /// λ as the graph says at the end, in 1/s.
    pub decay_rate: f64,
    /// The first change that concerns it, if there is one.
    pub first_change: Option<Stamp>,
}

/// Where the objects of a log have been.
///
/// A log that tells of no camera is *complete*: it is taken to tell of every change, as that of a
/// household's object handling does, so that what is not reported has stayed. One that tells of
/// what a camera saw says nothing of what it did not see.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Histories {
    /// By id.
    pub objects: BTreeMap<NodeId, ObjectHistory>,
    /// Names of the places, for people.
    pub names: BTreeMap<Spot, String>,
    /// When the log begins and ends.
    pub span: Option<(Stamp, Stamp)>,
    /// Whether it is taken to tell of every change.
    pub complete: bool,
}

/// Why a log gives no histories.
#[derive(Debug, thiserror::Error)]
pub enum HistoryError<E> {
    /// It cannot be read.
    #[error("{0}")]
    Log(E),
    /// It cannot be folded.
    #[error(transparent)]
    Fold(#[from] FoldError),
    /// Its times contradict each other.
    #[error("{object}: {error}")]
    Times {
        /// Of which object.
        object: String,
        /// How.
        error: DwellError,
    },
}

/// Collects the histories of a log; `number` tells its places from those of other logs.
pub fn histories<L: EventLog>(
    log: &L,
    number: u32,
) -> Result<Histories, HistoryError<L::Error>> {
    let mut collector = Collector { number, ..Collector::default() };
    let mut failed = None;
    log.visit(1, u64::MAX, &mut |logged| match collector.take(logged) {
        Ok(()) => ControlFlow::Continue(()),
        Err(error) if log.refused(&error) => ControlFlow::Continue(()),
        Err(error) => {
            failed = Some(error);
            ControlFlow::Break(())
        }
    })
    .map_err(HistoryError::Log)?;
    match failed {
        Some(error) => Err(error.into()),
        None => Ok(collector.finish()),
    }
}

/// Calls every class by one name, the first that it is met under, where logs spell it in several
/// ways (see [`Label::same_class`]). One log does so by itself.
pub fn unify(logs: &mut [Histories]) {
    let mut names: BTreeMap<String, Label> = BTreeMap::new();
    for history in logs.iter_mut().flat_map(|log| log.objects.values_mut()) {
        let name = names.entry(history.label.class_key()).or_insert_with(|| history.label.clone());
        history.label = name.clone();
    }
}

/// How many of the last changes are kept for the transaction that follows them.
const RECENT_CHANGES: usize = 1024;

#[derive(Default)]
struct Collector {
    number: u32,
    world: World,
    out: Histories,
    recent: VecDeque<ChangeRecord>,
    seen_by_camera: bool,
}

impl Collector {
    fn take(&mut self, logged: &Logged) -> Result<(), FoldError> {
        let start = self.out.span.map_or(logged.at, |(start, _)| start);
        self.out.span = Some((start, logged.at));
        match &logged.event {
            Event::InitialGraph(_) => {
                advance(&mut self.world, logged)?;
                self.start(logged.at);
            }
            Event::Change(record) => {
                self.seen_by_camera |= record.claim.modality == Modality::Perception;
                if self.recent.len() == RECENT_CHANGES {
                    self.recent.pop_front();
                }
                self.recent.push_back(record.clone());
            }
            Event::Transaction(transaction) => {
                let before = self.poses(transaction);
                advance(&mut self.world, logged)?;
                self.follow(transaction, &before, logged.at);
                self.recent.clear();
            }
            _ => {}
        }
        Ok(())
    }

    fn start(&mut self, at: Stamp) {
        let ids: Vec<NodeId> = self.world.graph().all_objects().map(|(id, _)| id).collect();
        for id in ids {
            let since = self.world.graph().object(id).map_or(at, |object| object.last_observed);
            self.note(id, since.min(at), at);
        }
    }

    /// The objects of a transaction as they are before it.
    fn poses(&self, transaction: &Transaction) -> BTreeMap<NodeId, Object> {
        let moved = |step: &Step| match &step.primitive {
            Primitive::Move { id, .. } => Some(*id),
            _ => None,
        };
        let moved = transaction.steps.iter().filter_map(moved);
        moved.filter_map(|id| Some((id, self.world.graph().object(id)?.clone()))).collect()
    }

    fn follow(&mut self, transaction: &Transaction, before: &BTreeMap<NodeId, Object>, at: Stamp) {
        for step in &transaction.steps {
            match &step.primitive {
                Primitive::Find { .. } | Primitive::SetDecay { .. } => {}
                Primitive::Observe { at, seen } => {
                    self.seen_by_camera = true;
                    seen.iter().for_each(|it| self.seen(it.id, *at));
                }
                Primitive::Add { id, .. } | Primitive::Remove { id, .. } => {
                    self.changed(step, *id, at);
                }
                Primitive::Move { id, .. } => {
                    if self.stayed(*id, before) { self.seen(*id, at) } else { self.changed(step, *id, at) }
                }
            }
        }
    }

    /// Whether a move is none: the same room and support, and no farther than ε.
    fn stayed(&self, id: NodeId, before: &BTreeMap<NodeId, Object>) -> bool {
        let Some((now, then)) = self.world.graph().object(id).zip(before.get(&id)) else {
            return false;
        };
        (now.room, now.support) == (then.room, then.support)
            && Stillness::default().holds(&now.pose, &then.pose, now.size)
    }

    /// Seen where it was: known to be there until then.
    fn seen(&mut self, id: NodeId, at: Stamp) {
        let Some(history) = self.out.objects.get_mut(&id) else { return };
        let Some(stay) = history.stays.last_mut() else { return };
        stay.until = stay.until.max(at);
        history.sightings.push(stay.until);
    }

    /// Elsewhere now: known since `not_after`, and not before `not_before`, of the change.
    fn changed(&mut self, step: &Step, id: NodeId, at: Stamp) {
        let change = match step.cause {
            Cause::Change(seq) => self.recent.iter().find(|record| record.seq == seq),
            Cause::Evidence(_) => None,
        };
        let occurred = change.map(|record| record.claim.occurred).unwrap_or_default();
        let by = occurred.not_after.unwrap_or(at).min(at);
        let not_before = occurred.not_before.unwrap_or(Stamp::EPOCH).min(by);
        if let Some(history) = self.out.objects.get_mut(&id) {
            history.first_change.get_or_insert(by);
            if let Some(stay) = history.stays.last_mut() {
                stay.until = stay.until.max(not_before.min(by));
            }
        }
        self.note(id, by, by);
    }

    /// Begins a stay where the object is now, known from `from` to `until`.
    fn note(&mut self, id: NodeId, from: Stamp, until: Stamp) {
        let graph = self.world.graph();
        let Some(object) = self.world.known(id) else { return };
        let there = graph.object(id).filter(|object| !object.is_held());
        let spot = there.map(|object| spot_of(self.number, object));
        if let Some(spot) = spot {
            self.out.names.entry(spot).or_insert_with(|| place_name(graph, spot.support.unwrap_or(spot.room)));
        }
        let history = self.out.objects.entry(id).or_insert_with(|| ObjectHistory {
            label: object.label.clone(),
            stays: Vec::new(),
            sightings: Vec::new(),
            movable: false,
            decay_rate: 0.0,
            first_change: None,
        });
        // Never before what is known already: an interval may reach back over it.
        let known = history.stays.last().map_or(from, |stay| stay.until.max(stay.from));
        let from = from.max(known);
        history.stays.push(Stay { spot, from, until: until.max(from) });
    }

    fn finish(mut self) -> Histories {
        self.out.complete = !self.seen_by_camera;
        for (id, history) in &mut self.out.objects {
            history.decay_rate = self.world.known(*id).map_or(0.0, |object| object.decay_rate);
            history.movable = history.decay_rate > 0.0;
        }
        unify(std::slice::from_mut(&mut self.out));
        self.out
    }
}

fn spot_of(log: u32, object: &Object) -> Spot {
    Spot { log, room: object.room, support: object.support }
}

impl ObjectHistory {
    /// Where it was at `at`, as far as that is known: outer `None` where it is not, inner `None`
    /// where it was nowhere. With `complete`, a stay lasts until the next.
    pub fn spot_at(&self, at: Stamp, complete: bool) -> Option<Option<Spot>> {
        let after = self.stays.partition_point(|stay| stay.from <= at);
        let stay = self.stays[..after].last()?;
        (complete || at <= stay.until).then_some(stay.spot)
    }

    /// How long it stayed where it was put or seen, each time, up to `end`. In a complete log a
    /// stay begins where it was put, and the last one has not ended by `end`; otherwise it begins
    /// anew with every sighting, and nothing is known after the last.
    pub fn dwells(&self, complete: bool, end: Stamp) -> Result<Vec<Dwell>, DwellError> {
        let mut dwells = Vec::new();
        for (n, stay) in self.stays.iter().enumerate().filter(|(_, stay)| stay.spot.is_some()) {
            if stay.from > end {
                break;
            }
            let next = self.stays.get(n + 1).filter(|next| next.from <= end);
            let mut since = stay.from;
            let first = self.sightings.partition_point(|at| *at <= stay.from);
            for seen in self.sightings[first..].iter().take_while(|at| **at <= stay.until.min(end)) {
                dwells.push(Dwell::at_least(seen.seconds_since(since))?);
                since = *seen;
            }
            let until = if complete && next.is_none() { end } else { stay.until.min(end) };
            let until = until.max(since);
            let left_s = next.map_or(f64::INFINITY, |next| next.from.seconds_since(since));
            let there_s = until.seconds_since(since).min(left_s);
            dwells.push(Dwell::between(there_s, left_s)?);
        }
        Ok(dwells)
    }
}

impl ObjectHistory {
    /// Whether it is one to learn from: it can move, or did.
    pub fn counts(&self) -> bool {
        self.movable || self.first_change.is_some()
    }

    /// Where it has been longest up to `end`; the first of equals.
    pub fn home(&self, complete: bool, end: Stamp) -> Option<Spot> {
        let mut time: BTreeMap<Spot, f64> = BTreeMap::new();
        for (n, stay) in self.stays.iter().enumerate().filter(|(_, stay)| stay.from <= end) {
            let next = self.stays.get(n + 1).map_or(Stamp::MAX, |next| next.from);
            let until = if complete { next.min(end) } else { stay.until.min(end) };
            if let Some(spot) = stay.spot {
                *time.entry(spot).or_default() += until.seconds_since(stay.from) + 1e-9;
            }
        }
        time.into_iter().max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0))).map(|(spot, _)| spot)
    }

    /// How it left its home and came back, up to `end`.
    pub fn comings_and_goings(&self, complete: bool, end: Stamp) -> PairCounts {
        let mut counts = PairCounts::default();
        let Some(home) = self.home(complete, end) else { return counts };
        for (n, stay) in self.stays.iter().enumerate().filter(|(_, stay)| stay.from <= end) {
            let here = stay.spot == Some(home);
            let next = self.stays.get(n + 1).filter(|next| next.from <= end);
            let until = if complete && next.is_none() { end } else { stay.until.min(end) };
            let Some(next) = next else {
                counts.stretch(here, until.seconds_since(stay.from), false);
                continue;
            };
            let then = next.spot == Some(home);
            let gap_s = next.from.seconds_since(until);
            counts.stretch(here, until.seconds_since(stay.from), gap_s <= 0.0 && then != here);
            counts.pair(here, then, gap_s);
        }
        counts
    }
}

impl Histories {
    /// The dwells of each class up to `end`, of the objects that can move.
    pub fn dwells(
        &self,
        end: Stamp,
        into: &mut BTreeMap<String, DwellData>,
    ) -> Result<(), (String, DwellError)> {
        for (id, history) in self.objects.iter().filter(|(_, history)| history.counts()) {
            let named = |error| (format!("{} {id}", history.label), error);
            let data = into.entry(history.label.to_string()).or_default();
            let dwells = history.dwells(self.complete, end).map_err(named)?;
            dwells.into_iter().for_each(|dwell| data.add(dwell));
        }
        Ok(())
    }

    /// How the objects of each class left their homes and came back, up to `end`.
    pub fn comings_and_goings(&self, end: Stamp, into: &mut BTreeMap<String, PairCounts>) {
        for history in self.objects.values().filter(|history| history.counts()) {
            let counts = history.comings_and_goings(self.complete, end);
            into.entry(history.label.to_string()).or_default().extend(&counts);
        }
    }
}
