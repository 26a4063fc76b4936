//! [`HumanDetector`]: from utterances to claims.

use std::borrow::Cow;

use super::find::{self, LabelSimilarity};
use super::ground::{GroundConfig, Grounding, Resolved};
use super::memory::{Done, Memory};
use super::reading::{Mention, Reading, Statement};
use super::report::{self, Correction};
use crate::bytes::{Reader, Writer};
use crate::change::{Action, Claim, EvidenceRef, NodeRef, World};
use crate::event::{Interpretation, Span};
use crate::graph::{CanonicalError, NodeId};
use crate::modality::Desk;
use crate::time::Stamp;
use crate::modality::desk::{evidence, node_ref};

const UTTERANCE_TOPIC: &str = "/human/utterance";
const LANGUAGE_TOPIC: &str = "/model/language";

/// For so long an utterance may be corrected and "it" may go back to the one before.
const CONTEXT_S: f64 = 600.0;

/// Notices what people say has changed. See the module docs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HumanDetector {
    memory: Memory,
}

/// An utterance that is being understood.
pub struct Said<'a> {
    /// Number of its event.
    pub order: u64,
    /// The words.
    pub text: &'a str,
    /// Finds the nearest label where the lexicon knows none.
    pub similarity: Option<&'a dyn LabelSimilarity>,
    /// Numbers of the replies of models that it is understood by.
    pub replies: &'a [u64],
    /// Why the built-in interpreter reads it, if a model was to.
    pub instead: Option<&'a str>,
}

impl<'a> Said<'a> {
    /// An utterance that no model has to do with.
    pub fn new(order: u64, text: &'a str) -> Self {
        Self { order, text, similarity: None, replies: &[], instead: None }
    }

    /// What claims rest on.
    fn evidence(&self) -> Vec<EvidenceRef> {
        let replies = self.replies.iter().map(|order| evidence(LANGUAGE_TOPIC, *order));
        std::iter::once(evidence(UTTERANCE_TOPIC, self.order)).chain(replies).collect()
    }
}

impl HumanDetector {
    /// Name and version of the built-in interpreter, as change records carry it.
    pub const NAME: &'static str = "builtin/1";

    /// Somebody said something: read by the built-in interpreter.
    pub fn utterance(&mut self, desk: &mut Desk<'_>, said: &Said<'_>) {
        let (mut reading, correction) = self.read(desk.world(), desk.at(), said.text);
        if let Some(why) = said.instead {
            let dot = if reading.note.is_empty() { "" } else { "; " };
            reading.note = format!("{}{dot}read by the built-in interpreter: {why}", reading.note);
        }
        match correction {
            Some(correction) => self.corrected(desk, said, &correction),
            None => self.told(desk, said, &reading, Self::NAME.into()),
        }
    }

    /// What the built-in interpreter reads in `text`, and whether it corrects what was said
    /// before.
    fn read(&self, world: &World, at: Stamp, text: &str) -> (Reading, Option<Correction>) {
        let fresh = at.seconds_since(self.memory.said_at) <= CONTEXT_S;
        let context = if fresh { self.antecedents(world) } else { Vec::new() };
        let understood = report::read(text, at, &context);
        let corrects = |correction: &Correction| {
            let answered = correction.answer && !self.memory.done.is_empty();
            fresh && !self.memory.text.is_empty() && !answered
        };
        (understood.reading, understood.correction.filter(corrects))
    }

    /// Whether `text` corrects what was said before: that needs the memory of it, which models do
    /// not have.
    pub fn corrects(&self, world: &World, at: Stamp, text: &str) -> bool {
        self.read(world, at, text).1.is_some()
    }

    /// The names in `reading`, or in what the built-in interpreter reads if there is none, that
    /// neither the graph nor the lexicon knows.
    pub fn unknown_names(
        &self,
        world: &World,
        at: Stamp,
        text: &str,
        reading: Option<&Reading>,
    ) -> Vec<String> {
        match reading {
            Some(reading) => find::unknown_names(world, reading),
            None => find::unknown_names(world, &self.read(world, at, text).0),
        }
    }

    /// Somebody said something that `detector` reads as `reading`.
    pub fn told(
        &mut self,
        desk: &mut Desk<'_>,
        said: &Said<'_>,
        reading: &Reading,
        detector: Cow<'static, str>,
    ) {
        let rests_on = said.evidence();
        if reading.statements.is_empty() {
            // What the built-in interpreter finds to say nothing, it will find again; what a
            // model made of it is worth a record.
            if detector != Self::NAME || said.instead.is_some() {
                let note = reading.note.clone();
                desk.interpret(Interpretation { note, ..Interpretation::of(rests_on[0].clone()) });
            }
            return;
        }
        let config = self.config(said, detector, rests_on);
        let mut grounding = Grounding::new(desk.world(), reading, desk.at(), &config);
        self.memory.begin(said.text, desk.at());
        for statement in &reading.statements {
            self.state(desk, &mut grounding, statement, &config.evidence, &reading.note);
        }
    }

    fn config<'a>(
        &self,
        said: &Said<'a>,
        detector: Cow<'static, str>,
        evidence: Vec<EvidenceRef>,
    ) -> GroundConfig<'a> {
        let recent = self.memory.done.iter().map(|done| done.id).collect();
        let places = self.memory.places.clone();
        GroundConfig { detector, evidence, similarity: said.similarity, places, recent }
    }

    /// Claims what one statement comes to, and records how it was understood.
    fn state(
        &mut self,
        desk: &mut Desk<'_>,
        grounding: &mut Grounding<'_>,
        statement: &Statement,
        rests_on: &[EvidenceRef],
        note: &str,
    ) {
        let verdicts = grounding.statement(desk.world(), statement);
        let trail = grounding.take_trail();
        let first = verdicts.first().map(|it| it.as_ref().unwrap_or_else(|(claim, _)| claim));
        desk.interpret(interpretation(desk, &rests_on[0], first, &trail, note));
        for verdict in verdicts {
            match verdict {
                Ok(claim) => {
                    let id = self.claim(desk, claim);
                    if let Some(id) = id.filter(|_| statement.action == Action::Added) {
                        grounding.settle(statement.object.span, id);
                    }
                }
                Err((claim, rejection)) => desk.reject(claim, rejection),
            }
        }
    }

    /// Makes a claim and remembers where the thing was.
    fn claim(&mut self, desk: &mut Desk<'_>, claim: Claim) -> Option<NodeId> {
        let known = claim.object.id.and_then(|id| desk.world().known(id));
        let before = known.map(|object| (object.room, object.support));
        let action = claim.action;
        let id = desk.claim(claim).ok()?.id?;
        self.memory.add(Done { action, id, before });
        Some(id)
    }

    /// What "it" may mean: what the utterance before was about.
    fn antecedents(&self, world: &World) -> Vec<Mention> {
        let mention = |done: &Done| {
            let label = world.known(done.id)?.label.to_string();
            let id = Some(done.id.to_string());
            Some(Mention { noun: label, id, definite: true, ..Mention::default() })
        };
        self.memory.done.iter().filter_map(mention).collect()
    }

    /// Says the last utterance again with what was meant: takes back what it did to the wrong
    /// thing, then claims the right one.
    fn corrected(&mut self, desk: &mut Desk<'_>, said: &Said<'_>, correction: &Correction) {
        let before = report::read(&self.memory.text, self.memory.said_at, &[]).reading;
        let rests_on = said.evidence();
        let Some(last) = before.statements.last() else { return };
        let done = std::mem::take(&mut self.memory.done);
        let mut statement = without_spans(last);
        if let Some(object) = &correction.object {
            let one = matches!(object.noun.as_str(), "one" | "ones" | "other");
            let noun = if one { last.object.noun.clone() } else { object.noun.clone() };
            let at = [object.at.clone(), statement.object.at].concat();
            let definite = last.object.definite;
            statement.object = Mention { noun, definite, at, ..object.clone() };
        } else if let Some(same) = done.last() {
            statement.object.id = Some(same.id.to_string());
        }
        if correction.support.is_some() || correction.target_room.is_some() {
            statement.support.clone_from(&correction.support);
            statement.target_room.clone_from(&correction.target_room);
        }
        let text = std::mem::take(&mut self.memory.text);
        if correction.object.is_some() {
            let undone = done.last().copied();
            undone.into_iter().for_each(|done| Self::take_back(desk, done, &rests_on));
        }
        let note = "a correction of what was said before";
        let reading = Reading { statements: vec![statement.clone()], note: note.to_owned() };
        let config = GroundConfig { recent: Vec::new(), ..self.config(said, Self::NAME.into(), rests_on) };
        let mut grounding = Grounding::new(desk.world(), &reading, desk.at(), &config);
        self.memory.begin(&text, desk.at());
        self.state(desk, &mut grounding, &statement, &config.evidence, note);
    }

    /// Claims that what was done before did not happen to this thing.
    fn take_back(desk: &mut Desk<'_>, done: Done, rests_on: &[EvidenceRef]) {
        let object = node_ref(desk.world(), done.id);
        let room = done.before.map(|(room, _)| node_ref(desk.world(), room));
        let support = done.before.and_then(|(_, support)| support).map(|id| node_ref(desk.world(), id));
        let action = if done.action == Action::Added { Action::Removed } else { Action::Moved };
        let removed = action == Action::Removed;
        let claim = Claim {
            modality: crate::change::Modality::Human,
            detector: Self::NAME.into(),
            action,
            object,
            source_room: None,
            target_room: room.filter(|_| !removed),
            support: support.filter(|_| !removed),
            pose: None,
            size: None,
            confidence: 0.9,
            occurred: crate::change::Occurred { not_before: None, not_after: Some(desk.at()) },
            held: false,
            evidence: rests_on.to_vec(),
        };
        // The record says what became of it either way.
        let _ = desk.claim(claim);
    }

    /// Whether nothing is remembered.
    pub(crate) fn is_empty(&self) -> bool {
        self.memory == Memory::default()
    }

    pub(crate) fn write_bytes(&self, out: &mut Writer) {
        self.memory.write(out);
    }

    pub(crate) fn read_bytes(input: &mut Reader<'_>) -> Result<Self, CanonicalError> {
        Ok(Self { memory: Memory::read(input)? })
    }
}

/// The statement without places in a text that was said before.
fn without_spans(statement: &Statement) -> Statement {
    fn clear(mention: &mut Mention) {
        mention.span = None;
        mention.at.iter_mut().for_each(clear);
    }
    let mut statement = statement.clone();
    clear(&mut statement.object);
    let others = [&mut statement.support, &mut statement.source_room, &mut statement.target_room];
    others.into_iter().flatten().for_each(clear);
    statement
}

/// How a statement was understood, with the words it rests on.
fn interpretation(
    desk: &Desk<'_>,
    of: &EvidenceRef,
    claim: Option<&Claim>,
    trail: &[Resolved],
    note: &str,
) -> Interpretation {
    let known = |node: Option<&NodeRef>| node.filter(|it| it.id.is_some()).cloned();
    Interpretation {
        object: known(claim.map(|it| &it.object)),
        source_room: known(claim.and_then(|it| it.source_room.as_ref())),
        target_room: known(claim.and_then(|it| it.target_room.as_ref())),
        support: known(claim.and_then(|it| it.support.as_ref())),
        note: note.to_owned(),
        spans: spans(desk, trail),
        ..Interpretation::of(of.clone())
    }
}

/// The spans of a trail, as evidence.
pub(crate) fn spans(desk: &Desk<'_>, trail: &[Resolved]) -> Vec<Span> {
    let span = |it: &Resolved| {
        let (start, end) = it.mention.span.unwrap_or_default();
        let node = |id: &NodeId| node_ref(desk.world(), *id);
        Span {
            role: it.role.into(),
            start: start as u32,
            end: end as u32,
            chosen: it.chosen.iter().take(64).map(node).collect(),
            candidates: it.candidates.iter().take(64).map(node).collect(),
            why: it.why.clone(),
        }
    };
    trail.iter().take(64).map(span).collect()
}
