//! [`Watch`]: a condition that follows a world, looking only at what has changed.

use std::collections::BTreeSet;

use super::expr::{Expr, Tally, Test, Who};
use crate::change::{Primitive, Step, World};
use crate::graph::{Label, Layer, Node, NodeId, Object};
use crate::time::Stamp;

/// A condition with what it knows of the world.
#[derive(Debug)]
pub(super) struct Watch<'a> {
    expr: &'a Expr,
    /// One for each test, in the order of the tree.
    tests: Vec<Watched<'a>>,
    /// Applied so far.
    changes: u64,
    /// Whether there is a world to speak of.
    begun: bool,
    /// Whether the last answer may be out of date.
    stale: bool,
    holds: bool,
}

/// A test, whom it speaks of, and its last answer.
#[derive(Debug)]
struct Watched<'a> {
    test: &'a Test,
    /// Objects that its first argument means, ever known.
    things: BTreeSet<NodeId>,
    /// Objects that its second argument means.
    others: BTreeSet<NodeId>,
    stale: bool,
    holds: bool,
}

impl<'a> Watch<'a> {
    pub fn new(expr: &'a Expr) -> Self {
        let mut tests = Vec::new();
        collect(expr, &mut tests);
        Self { expr, tests, changes: 0, begun: false, stale: true, holds: false }
    }

    /// The world is a new one.
    pub fn begin(&mut self, world: &World) {
        self.begun = true;
        self.stale = true;
        for watched in &mut self.tests {
            watched.things.clear();
            watched.others.clear();
            watched.stale = true;
            for (id, object) in world.graph().all_objects().chain(world.all_departed()) {
                watched.meet(id, &object.label);
            }
        }
    }

    /// `steps` were applied to the world.
    pub fn touch(&mut self, world: &World, steps: &[Step]) {
        self.begun = true;
        for step in steps {
            for watched in &mut self.tests {
                self.stale |= watched.touch(world, &step.primitive);
            }
        }
    }

    pub fn count_change(&mut self) {
        self.set_changes(self.changes + 1);
    }

    pub fn set_changes(&mut self, changes: u64) {
        self.changes = changes;
        for watched in &mut self.tests {
            if matches!(watched.test, Test::Tally(Tally::Changes, _)) {
                watched.stale = true;
                self.stale = true;
            }
        }
    }

    pub fn counts_changes(&self) -> bool {
        self.tests.iter().any(|watched| matches!(watched.test, Test::Tally(Tally::Changes, _)))
    }

    /// Whether the condition holds at `now`.
    pub fn holds(&mut self, world: &World, now: Stamp) -> bool {
        if !self.begun {
            return false;
        }
        for watched in &mut self.tests {
            let ages = matches!(watched.test, Test::Probability(..));
            if watched.stale || ages {
                let holds = watched.evaluate(world, now, self.changes);
                self.stale |= holds != watched.holds;
                (watched.holds, watched.stale) = (holds, false);
            }
        }
        if self.stale {
            let mut answers = self.tests.iter().map(|watched| watched.holds);
            self.holds = combine(self.expr, &mut answers);
            self.stale = false;
        }
        self.holds
    }
}

fn collect<'a>(expr: &'a Expr, into: &mut Vec<Watched<'a>>) {
    match expr {
        Expr::Test(test) => into.push(Watched {
            test,
            things: BTreeSet::new(),
            others: BTreeSet::new(),
            stale: true,
            holds: false,
        }),
        Expr::Not(inner) => collect(inner, into),
        Expr::All(parts) | Expr::Any(parts) => parts.iter().for_each(|part| collect(part, into)),
    }
}

/// Every test has an answer, and all of them are taken in order.
fn combine(expr: &Expr, answers: &mut impl Iterator<Item = bool>) -> bool {
    match expr {
        Expr::Test(_) => answers.next().expect("every test of the tree was collected"),
        Expr::Not(inner) => !combine(inner, answers),
        // No short cuts: the answers of all parts must be taken.
        Expr::All(parts) => {
            parts.iter().filter(|part| combine(part, answers)).count() == parts.len()
        }
        Expr::Any(parts) => parts.iter().filter(|part| combine(part, answers)).count() > 0,
    }
}

impl Watched<'_> {
    fn meet(&mut self, id: NodeId, label: &Label) {
        let (things, others) = match self.test {
            Test::Present(who)
            | Test::Absent(who)
            | Test::Held(who)
            | Test::In(who, _)
            | Test::Count(who, _)
            | Test::Probability(who, _) => (Some(who), None),
            Test::On(who, support) => (Some(who), Some(support)),
            Test::Tally(..) => (None, None),
        };
        keep(&mut self.things, things, id, label);
        keep(&mut self.others, others, id, label);
    }

    /// Notes what a primitive has changed; says whether the answer may be another now.
    fn touch(&mut self, world: &World, primitive: &Primitive) -> bool {
        let touched = match primitive {
            Primitive::Find { .. } => false,
            Primitive::Add { id, node } => {
                let knew = self.knows(*id);
                if let Node::Object(object) = node {
                    self.meet(*id, &object.label);
                }
                knew || self.knows(*id) || self.counts(*id)
            }
            Primitive::Remove { id, .. } => self.knows(*id) || self.counts(*id),
            Primitive::Move { id, .. } | Primitive::SetDecay { id, .. } => self.knows(*id),
            Primitive::Observe { seen, .. } => {
                matches!(self.test, Test::Probability(..))
                    && seen.iter().any(|sighting| self.knows(sighting.id))
            }
        };
        debug_assert!(self.things.iter().all(|id| world.known(*id).is_some()));
        self.stale |= touched;
        touched
    }

    fn knows(&self, id: NodeId) -> bool {
        self.things.contains(&id) || self.others.contains(&id)
    }

    /// Whether a node that comes or goes may matter though it has no name here.
    fn counts(&self, id: NodeId) -> bool {
        match self.test {
            Test::Tally(..) => true,
            Test::In(..) => id.layer() != Layer::Object,
            _ => false,
        }
    }

    fn evaluate(&self, world: &World, now: Stamp, changes: u64) -> bool {
        let graph = world.graph();
        let there = || self.present(world);
        match self.test {
            Test::Present(_) => there().next().is_some(),
            Test::Absent(_) => {
                self.things.iter().any(|id| graph.object(*id).is_none_or(Object::is_held))
            }
            Test::Held(_) => {
                self.things.iter().any(|id| graph.object(*id).is_some_and(Object::is_held))
            }
            Test::In(_, place) => there().any(|object| is_in(world, object, place)),
            Test::On(..) => there()
                .any(|object| object.support.is_some_and(|support| self.others.contains(&support))),
            Test::Count(_, comparison) => comparison.holds(there().count() as f64),
            Test::Probability(_, comparison) => {
                there().any(|object| comparison.holds(object.probability_static(now)))
            }
            Test::Tally(Tally::Objects, comparison) => {
                comparison.holds(graph.object_count() as f64)
            }
            Test::Tally(Tally::Rooms, comparison) => comparison.holds(graph.rooms().count() as f64),
            Test::Tally(Tally::Changes, comparison) => comparison.holds(changes as f64),
        }
    }

    /// Those it speaks of that are there.
    fn present<'w>(&'w self, world: &'w World) -> impl Iterator<Item = &'w Object> {
        let there = |id: &NodeId| world.graph().object(*id).filter(|object| !object.is_held());
        self.things.iter().filter_map(there)
    }
}

/// Notes whether `id` is one of those that `who` means; its label may have changed.
fn keep(known: &mut BTreeSet<NodeId>, who: Option<&Who>, id: NodeId, label: &Label) {
    if who.is_some_and(|who| who.means(id, label)) {
        known.insert(id);
    } else {
        known.remove(&id);
    }
}

fn is_in(world: &World, object: &Object, place: &Who) -> bool {
    let mut region = Some(object.room);
    while let Some(id) = region {
        let Some(found) = world.graph().region(id) else { return false };
        if place.means(id, &found.label) {
            return true;
        }
        region = found.parent;
    }
    false
}
