//! [`Desk`]: where a detector's claims become change records and primitives.

use std::borrow::Cow;

use crate::change::{
    Cause, ChangeRecord, Claim, EvidenceRef, NodeRef, Outcome, Plan, PlanConfig, Primitive, Rejection,
    Step,
    Transaction, World, plan,
};
use crate::event::{Event, Interpretation, Staleness};
use crate::graph::NodeId;
use crate::time::Stamp;

/// Most steps of a transaction, so that readers take it. Only the rates of a huge initial graph
/// are more, and they do not depend on each other.
const STEPS_MAX: usize = 1 << 16;

/// Takes the claims of one update, applies them to the world one after the other, and collects
/// the records: evidence first, then changes, then one transaction.
#[derive(Debug)]
pub struct Desk<'a> {
    world: &'a mut World,
    config: &'a PlanConfig,
    at: Stamp,
    /// Number of the last change of the log.
    changes: u64,
    interpretations: Vec<Interpretation>,
    stale: Vec<Staleness>,
    records: Vec<ChangeRecord>,
    steps: Vec<Step>,
}

impl<'a> Desk<'a> {
    /// A desk for the update at `at`; `changes` is the number of the last change so far.
    pub fn new(world: &'a mut World, config: &'a PlanConfig, at: Stamp, changes: u64) -> Self {
        let (interpretations, stale) = (Vec::new(), Vec::new());
        let (records, steps) = (Vec::new(), Vec::new());
        Self { world, config, at, changes, interpretations, stale, records, steps }
    }

    /// The world as it is by now.
    pub fn world(&self) -> &World {
        self.world
    }

    /// The time of the update.
    pub fn at(&self) -> Stamp {
        self.at
    }

    /// What the update did so far.
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// Plans and applies `claim`; records it either way.
    ///
    /// # Errors
    /// The reason why it was rejected; the world is unchanged then.
    pub fn claim(&mut self, claim: Claim) -> Result<NodeRef, Rejection> {
        match self.carry_out(&claim) {
            Ok(claim) => {
                let object = claim.object.clone();
                self.record(claim, Outcome::Applied);
                Ok(object)
            }
            Err(rejection) => {
                self.reject(claim, rejection.clone());
                Err(rejection)
            }
        }
    }

    /// Records `claim` as rejected, with the label of what it names by id alone.
    pub fn reject(&mut self, mut claim: Claim, rejection: Rejection) {
        if let NodeRef { id: Some(id), label: None } = claim.object {
            claim.object = node_ref(self.world, id);
        }
        self.record(claim, rejection.into());
    }

    /// Records what was understood of an input.
    pub fn interpret(&mut self, interpretation: Interpretation) {
        self.interpretations.push(interpretation);
    }

    /// Records what is to be looked at.
    pub fn report_stale(&mut self, stale: Staleness) {
        self.stale.push(stale);
    }

    /// Sets λ of an object, in 1/s, for the reason given. What the graph refuses is left as it is.
    pub fn set_decay(&mut self, cause: Cause, id: NodeId, decay_rate: f64, origin: String) {
        let primitive = Primitive::SetDecay { id, decay_rate, origin };
        if primitive.apply(self.world).is_ok() {
            self.steps.push(Step { cause, primitive });
        }
    }

    /// The records of the update, in the order they stand in the log.
    pub fn into_events(self) -> Vec<Event> {
        let (at, mut rest, mut transactions) = (self.at, self.steps, Vec::new());
        while !rest.is_empty() {
            let after = rest.split_off(rest.len().min(STEPS_MAX));
            let steps = std::mem::replace(&mut rest, after);
            transactions.push(Event::Transaction(Transaction { at, steps }));
        }
        let changes = self.records.into_iter().map(Event::Change);
        let evidence = self.interpretations.into_iter().map(Event::Interpretation);
        let evidence = evidence.chain(self.stale.into_iter().map(Event::Staleness));
        evidence.chain(changes).chain(transactions).collect()
    }

    fn carry_out(&mut self, claim: &Claim) -> Result<Claim, Rejection> {
        let Plan { claim, primitives } = plan(self.world, claim, self.at, self.config)?;
        let cause = Cause::Change(self.changes + 1);
        let steps: Vec<Step> = primitives
            .into_iter()
            .map(|primitive| Step { cause: cause.clone(), primitive })
            .collect();
        let transaction = Transaction { at: self.at, steps };
        transaction.apply(self.world).map_err(|refused| Rejection::Refused(refused.error))?;
        self.steps.extend(transaction.steps);
        Ok(claim)
    }

    fn record(&mut self, claim: Claim, outcome: Outcome) {
        self.changes += 1;
        self.records.push(ChangeRecord { seq: self.changes, at: self.at, claim, outcome });
    }
}

/// A reference to the event with this number on this topic.
pub(crate) fn evidence(topic: &'static str, order: u64) -> EvidenceRef {
    EvidenceRef { topic: Cow::Borrowed(topic), order }
}

/// A node known by its id, with its label.
pub(crate) fn node_ref(world: &World, id: NodeId) -> NodeRef {
    let label = world.known(id).map(|object| &object.label);
    NodeRef { id: Some(id), label: label.or_else(|| world.graph().label(id)).cloned() }
}
