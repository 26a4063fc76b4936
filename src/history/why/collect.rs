//! The first pass: what concerns one node.

use std::collections::VecDeque;
use std::ops::ControlFlow;

use super::select::{Presence, node_ref, place};
use super::{
    Belief, Entry, Initial, Moment, Sightings, Stale, State, Why, WhyError, is_decisive,
};
use crate::change::{Cause, ChangeRecord, NodeRef, Primitive, Step, Transaction, World};
use crate::event::{Event, Logged, Staleness};
use crate::graph::{Label, NodeId};
use crate::history::log::walk;
use crate::history::log::advance_in;
use crate::history::{EventLog, Place};

/// How many of the last changes are kept for the transaction that follows them.
const RECENT_CHANGES: usize = 1024;

/// Collects the life of `id`, without the events that its evidence points to.
pub(super) fn collect<L: EventLog>(
    log: &L,
    upto: u64,
    id: NodeId,
) -> Result<Why, WhyError<L::Error>> {
    let mut life = Life::new(id);
    let world = walk(log, upto, WhyError::Log, |world, logged| {
        life.last = Moment::of(logged);
        match &logged.event {
            Event::Change(record) => life.change(world, logged, record),
            Event::Staleness(stale) => life.stale(logged, stale),
            Event::Transaction(transaction) => {
                let concerned = transaction.steps.iter().any(|it| touches(&it.primitive, id));
                let before = concerned.then(|| Snapshot::of(world, id));
                let applied = advance_in(log, world, logged)?;
                if let Some(before) = before.filter(|_| applied) {
                    life.transaction(&before, world, logged, transaction);
                }
                life.recent.clear();
            }
            Event::InitialGraph(_) => {
                advance_in(log, world, logged)?;
                life.start(world, logged);
            }
            _ => {}
        }
        Ok::<_, WhyError<L::Error>>(ControlFlow::Continue(()))
    })?;
    life.finish(&world)
}

struct Life {
    id: NodeId,
    /// What it is called, once it was met.
    label: Option<Label>,
    initial: Option<Initial>,
    entries: Vec<Entry>,
    stale: Vec<Stale>,
    recent: VecDeque<ChangeRecord>,
    /// When it last came, went or moved.
    since: Option<Moment>,
    last: Moment,
}

/// The node before a transaction.
struct Snapshot {
    place: Option<Place>,
    known: bool,
}

impl Snapshot {
    fn of(world: &World, id: NodeId) -> Self {
        let there = world.graph().object(id);
        Self {
            place: there.map(|object| Place::of(world.graph(), object)),
            known: world.known(id).is_some() || world.graph().contains(id),
        }
    }
}

impl Life {
    fn new(id: NodeId) -> Self {
        let (since, last) = (None, Moment::default());
        let (entries, stale, recent) = (Vec::new(), Vec::new(), VecDeque::new());
        Self { id, label: None, initial: None, entries, stale, recent, since, last }
    }

    fn start(&mut self, world: &World, logged: &Logged) {
        if !world.graph().contains(self.id) {
            return;
        }
        self.label = world.graph().label(self.id).cloned();
        let moment = Moment::of(logged);
        self.since = Some(moment);
        self.initial = Some(Initial { moment, place: place(world, self.id) });
    }

    fn stale(&mut self, logged: &Logged, stale: &Staleness) {
        let named = stale.targets.iter().find(|target| target.object.id == Some(self.id));
        self.stale.extend(named.map(|target| Stale {
            moment: Moment::of(logged),
            probability: target.probability,
            threshold: stale.threshold,
        }));
    }

    /// How far its place is to be believed at the end.
    fn belief(&self, world: &World) -> Option<Belief> {
        let object = world.graph().object(self.id).filter(|object| !object.is_held())?;
        let set = self.entries.iter().rev().flat_map(|entry| entry.primitives.iter().rev());
        let origin = set.filter_map(|primitive| match primitive {
            Primitive::SetDecay { origin, .. } => Some(origin.clone()),
            _ => None,
        });
        let unsaid = if self.initial.is_some() { "the initial graph" } else { "as it was added" };
        Some(Belief {
            probability: object.probability_static(self.last.at),
            decay_rate: object.decay_rate,
            origin: origin.into_iter().next().unwrap_or_else(|| unsaid.to_owned()),
            last_observed: object.last_observed,
        })
    }

    /// A change is kept for its transaction; a rejected one that names the node is an entry.
    fn change(&mut self, world: &World, logged: &Logged, record: &ChangeRecord) {
        if record.is_applied() {
            if self.recent.len() == RECENT_CHANGES {
                self.recent.pop_front();
            }
            self.recent.push_back(record.clone());
            return;
        }
        if !self.is_named_by(&record.claim.object) {
            return;
        }
        let now = Snapshot::of(world, self.id);
        self.entries.push(Entry {
            moment: Moment::of(logged),
            primitives: vec![],
            find: None,
            cause: None,
            change: Some(record.clone()),
            before: now.place.clone(),
            after: now.place,
            known_before: now.known,
            sightings: None,
            evidence: vec![],
            inputs: vec![],
        });
    }

    fn is_named_by(&self, object: &NodeRef) -> bool {
        match (object.id, &object.label, &self.label) {
            (Some(id), _, _) => id == self.id,
            (None, Some(named), Some(label)) => label.same_class(named.as_str()),
            _ => false,
        }
    }

    fn transaction(
        &mut self,
        before: &Snapshot,
        world: &World,
        logged: &Logged,
        transaction: &Transaction,
    ) {
        let mut rest = transaction.steps.as_slice();
        // Steps of one cause stand together.
        while let Some(first) = rest.first() {
            let end = rest.iter().position(|step| step.cause != first.cause);
            let (group, after) = rest.split_at(end.unwrap_or(rest.len()));
            rest = after;
            if let Some(entry) = self.entry(before, world, logged, group) {
                self.push(entry);
            }
        }
    }

    fn entry(
        &mut self,
        before: &Snapshot,
        world: &World,
        logged: &Logged,
        group: &[Step],
    ) -> Option<Entry> {
        let primitives: Vec<Primitive> =
            group.iter().filter_map(|step| part_of(&step.primitive, self.id)).collect();
        let cause = group.first().filter(|_| !primitives.is_empty())?.cause.clone();
        if let Some(label) = node_ref(world, self.id).label {
            self.label = Some(label);
        }
        let is_find = |it: &&Primitive| matches!(it, Primitive::Find { .. });
        let change = match cause {
            Cause::Change(seq) => self.recent.iter().find(|record| record.seq == seq).cloned(),
            Cause::Evidence(_) => None,
        };
        Some(Entry {
            moment: Moment::of(logged),
            primitives,
            find: group.iter().map(|step| &step.primitive).find(is_find).cloned(),
            cause: Some(cause),
            change,
            before: before.place.clone(),
            after: Snapshot::of(world, self.id).place,
            known_before: before.known,
            sightings: None,
            evidence: vec![],
            inputs: vec![],
        })
    }

    /// Adds an entry; a sighting that tells nothing new is counted with the one before it.
    fn push(&mut self, mut entry: Entry) {
        if entry.primitives.iter().any(is_decisive) {
            self.since = Some(entry.moment);
        }
        if is_plain_sighting(&entry) {
            if let Some(Entry { sightings: Some(sightings), .. }) = self.entries.last_mut() {
                sightings.count += 1;
                sightings.last = entry.moment;
                return;
            }
            entry.sightings = Some(Sightings { count: 1, last: entry.moment });
        }
        self.entries.push(entry);
    }

    fn finish<E>(self, world: &World) -> Result<Why, WhyError<E>> {
        if self.label.is_none() && self.entries.is_empty() {
            let wanted = self.id.to_string();
            return Err(WhyError::Unknown { wanted, similar: vec![] });
        }
        let presence = Presence::of(world, self.id);
        let belief = self.belief(world);
        let node = NodeRef { id: Some(self.id), label: self.label };
        Ok(Why {
            node,
            state: State { presence, since: self.since, place: place(world, self.id), belief },
            upto: self.last,
            initial: self.initial,
            entries: self.entries,
            stale: self.stale,
            namesakes: vec![],
        })
    }
}

/// Whether a primitive does anything to `id`.
fn touches(primitive: &Primitive, id: NodeId) -> bool {
    match primitive {
        Primitive::Find { .. } => false,
        Primitive::Add { id: of, .. }
        | Primitive::Remove { id: of, .. }
        | Primitive::Move { id: of, .. }
        | Primitive::SetDecay { id: of, .. } => *of == id,
        Primitive::Observe { seen, .. } => seen.iter().any(|sighting| sighting.id == id),
    }
}

/// What a primitive does to `id`; of an Observe only the sighting of it.
fn part_of(primitive: &Primitive, id: NodeId) -> Option<Primitive> {
    if !touches(primitive, id) {
        return None;
    }
    Some(match primitive {
        Primitive::Observe { at, seen } => {
            let seen = seen.iter().filter(|sighting| sighting.id == id).copied().collect();
            Primitive::Observe { at: *at, seen }
        }
        other => other.clone(),
    })
}

fn is_plain_sighting(entry: &Entry) -> bool {
    let plain = |primitive: &Primitive| match primitive {
        Primitive::Observe { seen, .. } => {
            seen.iter().all(|sighting| sighting.pose.is_none() && sighting.size.is_none())
        }
        _ => false,
    };
    entry.change.is_none() && entry.primitives.iter().all(plain)
}
