//! [`TimeDetector`]: which objects have become improbable, found without looking at the others.

use std::collections::{BTreeMap, BTreeSet};

use super::{age_at, memory};
use crate::bytes::{Reader, Writer};
use crate::event::{StaleTarget, Staleness};
use crate::graph::{CanonicalError, NodeId, Object, SceneGraph};
use crate::modality::Desk;
use crate::modality::desk::node_ref;
use crate::time::Stamp;

/// What is remembered of an object that can become stale: present, not held, λ > 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Watch {
    /// t₀.
    pub since: Stamp,
    /// When it crosses; `None` once that was reported.
    pub due: Option<Stamp>,
}

/// Notices what is probably no longer where it was seen. See the module docs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TimeDetector {
    watched: BTreeMap<NodeId, Watch>,
    /// Those not reported yet, by the time at which they cross.
    queue: BTreeSet<(Stamp, NodeId)>,
}

impl TimeDetector {
    /// A detector for a graph as it is at `now`; what is below `threshold` by then counts as
    /// reported.
    pub fn resumed(graph: &SceneGraph, threshold: f64, now: Stamp) -> Self {
        let mut detector = Self::default();
        detector.watch_all(graph, threshold);
        let _ = detector.crossed(graph, threshold, now);
        detector
    }

    /// Watches every object of a graph.
    pub fn watch_all(&mut self, graph: &SceneGraph, threshold: f64) {
        for (id, object) in graph.objects() {
            self.watch(id, Some(object), threshold);
        }
    }

    /// Follows what the update did to the world, and reports what has crossed by its time.
    pub fn update(&mut self, desk: &mut Desk<'_>, threshold: f64) {
        let touched: BTreeSet<NodeId> =
            desk.steps().iter().flat_map(|step| step.primitive.nodes()).collect();
        let graph = desk.world().graph();
        for id in touched {
            self.watch(id, graph.object(id), threshold);
        }
        let crossed = self.crossed(graph, threshold, desk.at());
        if crossed.is_empty() {
            return;
        }
        let targets = crossed.into_iter().filter_map(|id| target(desk, id)).collect();
        desk.report_stale(Staleness { threshold, targets });
    }

    /// When the next object crosses the threshold, as far as is known now.
    pub fn next_crossing(&self) -> Option<Stamp> {
        self.queue.first().map(|(due, _)| *due)
    }

    /// Schedules an object anew, if it can become stale and anything about that has changed.
    fn watch(&mut self, id: NodeId, object: Option<&Object>, threshold: f64) {
        let before = self.watched.remove(&id);
        if let Some(due) = before.and_then(|watch| watch.due) {
            self.queue.remove(&(due, id));
        }
        let Some(object) = object.filter(|object| !object.is_held()) else { return };
        let Some(due) = crossing(object, threshold) else { return };
        let since = object.last_observed;
        // Reported, and nobody has looked since: once is enough, whatever λ is by now.
        if before == Some(Watch { since, due: None }) {
            self.watched.insert(id, Watch { since, due: None });
            return;
        }
        self.watched.insert(id, Watch { since, due: Some(due) });
        self.queue.insert((due, id));
    }

    /// Takes what has crossed by `now` off the queue, in the order in which it crossed.
    fn crossed(&mut self, graph: &SceneGraph, threshold: f64, now: Stamp) -> Vec<NodeId> {
        let mut crossed = Vec::new();
        let mut too_early = Vec::new();
        while let Some((due, id)) = self.queue.first().copied().filter(|(due, _)| *due <= now) {
            self.queue.remove(&(due, id));
            let Some(watch) = self.watched.get_mut(&id) else { continue };
            let below = graph.object(id).is_some_and(|it| it.probability_static(now) < threshold);
            // The crossing was rounded: what is not below it yet is so a nanosecond later.
            watch.due = (!below).then(|| now.plus_nanos(1));
            match watch.due {
                Some(due) => too_early.push((due, id)),
                None => crossed.push(id),
            }
        }
        self.queue.extend(too_early);
        crossed
    }

    pub(crate) fn write_bytes(&self, out: &mut Writer) {
        memory::write(&self.watched, out);
    }

    pub(crate) fn read_bytes(input: &mut Reader<'_>) -> Result<Self, CanonicalError> {
        let watched = memory::read(input)?;
        let queue = watched.iter().filter_map(|(id, watch)| Some((watch.due?, *id))).collect();
        Ok(Self { watched, queue })
    }
}

/// The first nanosecond at which the probability is below the threshold.
fn crossing(object: &Object, threshold: f64) -> Option<Stamp> {
    let age_s = age_at(object.decay_rate, threshold)?;
    let nanos = libm::ceil(age_s * 1e9) + 1.0;
    // What crosses after the end of time never does.
    let left = Stamp::MAX.nanos() - object.last_observed.nanos();
    (nanos < left as f64).then(|| object.last_observed.plus_nanos(nanos as u64))
}

fn target(desk: &Desk<'_>, id: NodeId) -> Option<StaleTarget> {
    let world = desk.world();
    let object = world.graph().object(id)?;
    Some(StaleTarget {
        object: node_ref(world, id),
        room: Some(node_ref(world, object.room)),
        probability: object.probability_static(desk.at()),
        decay_rate: object.decay_rate,
        last_observed: object.last_observed,
    })
}
