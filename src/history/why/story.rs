//! The words for what happened, for what was said, and for who said it.
//!
//! Whatever comes from a log may hold any character: what is printed has no control characters.

use super::{Entry, Why};
use crate::change::{Action, Cause, ChangeRecord, Departure, Outcome, Primitive, Sighting};
use crate::event::{Event, Logged};
use crate::graph::NodeId;
use crate::history::Place;
use crate::time::Stamp;

/// `2026-01-05 08:18:13`, UTC.
pub(super) fn time(stamp: Stamp) -> String {
    stamp.to_string().chars().take(19).map(|c| if c == 'T' { ' ' } else { c }).collect()
}

/// `text` without control characters.
pub(super) fn clean(text: &str) -> String {
    let shown = |c: char| if c.is_control() { c.escape_default().collect() } else { c.to_string() };
    text.chars().map(shown).collect()
}

/// What happened: `picked up from kitchen, on table O1`.
pub(super) fn happened(why: &Why, entry: &Entry) -> String {
    if let Some(record) = entry.change.as_ref().filter(|change| !change.is_applied()) {
        return refused(record);
    }
    let what = entry.primitive().map_or_else(String::new, |primitive| done(entry, primitive));
    let along = why.node.id.and_then(|id: NodeId| entry.along_with(id));
    let Some(other) = along else { return what };
    let stayed = entry
        .change
        .as_ref()
        .is_some_and(|change| change.claim.action == Action::Removed && !change.claim.held);
    match (stayed, entry.primitive()) {
        (true, Some(Primitive::Move { .. })) => {
            format!("left behind when {other} was removed: {}", somewhere(entry.after.as_ref()))
        }
        _ => format!("went along with {other}: {what}"),
    }
}

fn refused(record: &ChangeRecord) -> String {
    let claimed = match record.claim.action {
        Action::Added => "an addition",
        Action::Moved => "a move",
        Action::Removed if record.claim.held => "a pick",
        Action::Removed => "a removal",
    };
    let reason = match &record.outcome {
        Outcome::Rejected { reason, .. } => clean(reason),
        Outcome::Applied => String::new(),
    };
    format!("{claimed} was claimed and rejected: {reason}")
}

fn done(entry: &Entry, primitive: &Primitive) -> String {
    let (before, after) = (entry.before.as_ref(), entry.after.as_ref());
    let was_held = before.is_some_and(Place::is_held);
    match primitive {
        Primitive::Find { .. } => "looked for".to_owned(),
        Primitive::Add { .. } if was_held => format!("put down: {}", somewhere(after)),
        Primitive::Add { .. } if entry.known_before => format!("came back: {}", somewhere(after)),
        Primitive::Add { .. } => match after {
            Some(place) => format!("added: {place}"),
            None => "added".to_owned(),
        },
        Primitive::Remove { to: Departure::Held, .. } => {
            format!("picked up from {}", somewhere(before))
        }
        Primitive::Remove { .. } if was_held => "gone from the gripper".to_owned(),
        Primitive::Remove { .. } => match before {
            Some(place) => format!("removed from {place}"),
            None => "removed".to_owned(),
        },
        Primitive::Move { .. } => moved(before, after),
        Primitive::Observe { seen, .. } => seen_words(entry, seen),
        Primitive::SetDecay { decay_rate, origin, .. } => {
            format!("decay rate set to {decay_rate}/s ({})", clean(origin))
        }
    }
}

fn somewhere(place: Option<&Place>) -> String {
    place.map_or_else(|| "nowhere".to_owned(), |place| place.spot().to_string())
}

fn moved(before: Option<&Place>, after: Option<&Place>) -> String {
    let words = format!("moved to {}", somewhere(after));
    let Some((before, after)) = before.zip(after) else { return words };
    if before.spot().to_string() != after.spot().to_string() {
        return words;
    }
    let (metres, _) = before.pose.distance(&after.pose);
    format!("moved by {metres:.2} m: {}", after.spot())
}

fn seen_words(entry: &Entry, seen: &[Sighting]) -> String {
    if let Some(sightings) = entry.sightings.filter(|it| it.count > 1) {
        return format!("seen {} times until {}", sightings.count, time(sightings.last.at));
    }
    let refined = seen.iter().any(|it| it.pose.is_some() || it.size.is_some());
    if refined { "seen, and measured anew" } else { "seen" }.to_owned()
}

/// On whose word: `action: the robot's task t reported "picked" (#106)`.
pub(super) fn because(entry: &Entry) -> Option<String> {
    let who = entry.change.as_ref().map(|change| {
        let claim = &change.claim;
        let who = claim.modality.as_str();
        if claim.confidence < 1.0 {
            format!("{who}, {:.0} % sure", claim.confidence * 100.0)
        } else {
            who.to_owned()
        }
    });
    let told: Vec<String> = entry.inputs.iter().map(told).collect();
    let told = if told.is_empty() { cause_only(entry) } else { Some(told.join("; ")) };
    match (who, told) {
        (Some(who), Some(told)) => Some(format!("{who}: {told}")),
        (who, told) => who.or(told),
    }
}

/// Evidence that is no input, such as what a model answered.
fn cause_only(entry: &Entry) -> Option<String> {
    let cited: Vec<String> = match (&entry.change, &entry.cause) {
        (Some(change), _) => change.claim.evidence.iter().map(cited).collect(),
        (None, Some(Cause::Evidence(reference))) => vec![cited(reference)],
        (None, Some(Cause::Change(seq))) => vec![format!("change c{seq}, which the log lacks")],
        (None, None) => vec![],
    };
    (!cited.is_empty()).then(|| cited.join("; "))
}

fn cited(reference: &crate::change::EvidenceRef) -> String {
    format!("{} (#{})", clean(&reference.topic), reference.order)
}

/// What an input told.
fn told(logged: &Logged) -> String {
    let order = logged.order;
    match &logged.event {
        Event::Utterance(said) => {
            let speaker = if said.speaker.is_empty() { "somebody" } else { &said.speaker };
            format!("{} said {:?} (#{order})", clean(speaker), said.text)
        }
        Event::Task(task) => {
            format!("the robot was told {:?} (#{order})", task.instruction)
        }
        Event::TaskStatus(status) => {
            let (task, status) = (clean(&status.task_id), status.status.as_str());
            format!("the robot's task {task} reported {status:?} (#{order})")
        }
        Event::Tick => format!("the clock (#{order})"),
        Event::TrueChange(_) => format!("it really happened (#{order})"),
        other => format!("{} (#{order})", clean(&other.topic().name())),
    }
}

/// How the object was found: `found as the only mug in the kitchen`.
pub(super) fn found(why: &Why, entry: &Entry) -> Option<String> {
    let Some(Primitive::Find { reason, chosen, candidates, .. }) = &entry.find else { return None };
    if chosen.is_none() || *chosen != why.node.id {
        return None;
    }
    let reason = clean(reason);
    let others = candidates.len().saturating_sub(1);
    let of = if others > 0 { format!(" (of {})", others + 1) } else { String::new() };
    Some(match reason.strip_prefix("named by id") {
        Some(rest) => format!("named by its id{rest}"),
        None => format!("found as {reason}{of}"),
    })
}
