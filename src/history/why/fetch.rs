//! The second pass: the events that the evidence points to, and those that they point to.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;

use super::{Entry, Why};
use crate::change::{Cause, EvidenceRef};
use crate::event::{Event, Logged};
use crate::history::EventLog;

/// How often references are followed. Evidence of evidence is an interpretation and its input;
/// the limit is for logs that were not written by this program.
const DEPTH: usize = 4;

/// Events closer together than this are read in one go.
const GAP: u64 = 64;

type Events = BTreeMap<u64, Logged>;

/// Fills in the evidence and the inputs of every entry.
pub(super) fn fetch<L: EventLog>(log: &L, why: &mut Why) -> Result<(), L::Error> {
    let mut wanted: BTreeSet<u64> =
        why.entries.iter().flat_map(references_of).map(|to| to.order).collect();
    let mut events = Events::new();
    for _ in 0..DEPTH {
        wanted.retain(|order| !events.contains_key(order) && *order <= why.upto.order);
        if wanted.is_empty() {
            break;
        }
        let found = read(log, &wanted)?;
        wanted = found.values().flat_map(references).map(|to| to.order).collect();
        events.extend(found);
    }
    for entry in &mut why.entries {
        let direct = references_of(entry);
        entry.evidence = direct.iter().filter_map(|to| events.get(&to.order)).cloned().collect();
        entry.inputs = inputs(&direct, &events);
    }
    Ok(())
}

/// The events with these numbers.
fn read<L: EventLog>(log: &L, wanted: &BTreeSet<u64>) -> Result<Events, L::Error> {
    let mut found = Events::new();
    let mut rest = wanted.iter().copied().peekable();
    while let Some(first) = rest.next() {
        let mut last = first;
        while let Some(next) = rest.next_if(|next| *next - last <= GAP) {
            last = next;
        }
        log.visit_all(first, last, &mut |logged| {
            if wanted.contains(&logged.order) {
                found.insert(logged.order, logged.clone());
            }
            ControlFlow::Continue(())
        })?;
    }
    Ok(found)
}

/// What an entry points to.
fn references_of(entry: &Entry) -> Vec<EvidenceRef> {
    let cause = match &entry.cause {
        Some(Cause::Evidence(reference)) => Some(reference.clone()),
        _ => None,
    };
    let claimed = entry.change.iter().flat_map(|change| change.claim.evidence.iter().cloned());
    cause.into_iter().chain(claimed).collect()
}

/// What an event points to.
fn references(logged: &Logged) -> Vec<EvidenceRef> {
    match &logged.event {
        Event::Interpretation(understood) => vec![understood.of.clone()],
        Event::LanguageReply(reply) => vec![reply.of.clone()],
        Event::Change(record) => record.claim.evidence.clone(),
        _ => vec![],
    }
}

/// The inputs among the events that can be reached from `direct`, in order.
fn inputs(direct: &[EvidenceRef], events: &Events) -> Vec<Logged> {
    let mut reached = BTreeSet::new();
    let mut next: Vec<u64> = direct.iter().map(|to| to.order).collect();
    while let Some(order) = next.pop() {
        if let Some(logged) = events.get(&order)
            && reached.insert(order)
        {
            next.extend(references(logged).iter().map(|to| to.order));
        }
    }
    let reached = reached.iter().map(|order| &events[order]);
    reached.filter(|logged| logged.event.is_input()).cloned().collect()
}
