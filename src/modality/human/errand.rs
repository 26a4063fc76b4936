//! Tasks from instructions: what to take, where it is, where it goes.

use super::clause::{Clause, Place, Subject, Unreal, parse};
use super::find::{Candidate, Finder, LabelSimilarity, closest};
use super::ground::Resolved;
use super::lexicon::{Frame, Lexicon, Preposition, lexicon};
use super::names::Name;
use super::phrase::Phrase;
use super::reading::{Mention, Reading, Statement};
use super::token::{Sentence, is_no_speech, sentences};
use crate::change::{NodeRef, World};
use crate::graph::NodeId;
use crate::time::Stamp;

/// One thing to be taken somewhere, in words.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Errand {
    /// What.
    pub object: Option<Mention>,
    /// Where it is: rooms or things.
    pub source: Vec<Mention>,
    /// Where it goes: the thing or room named first, and what tells that apart.
    pub target: Option<Mention>,
}

/// An errand with the nodes it means; what was not said or is not known is `None`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GroundedErrand {
    /// What.
    pub object: Option<NodeRef>,
    /// The room it is in, if that was said.
    pub source_room: Option<NodeRef>,
    /// The room it goes to.
    pub target_room: Option<NodeRef>,
    /// What it is to be put on or in.
    pub support: Option<NodeRef>,
    /// How the words were understood.
    pub trail: Vec<Resolved>,
}

/// Errands of one instruction that are taken.
const MAX_ERRANDS: usize = 16;

/// The errands that a model reads in an instruction: each statement is one.
pub fn errands(reading: &Reading) -> Vec<Errand> {
    let errand = |it: &Statement| {
        let target = match &it.support {
            Some(support) => {
                let at = it.target_room.iter().cloned().collect();
                Some(Mention { at, ..support.clone() })
            }
            None => it.target_room.clone(),
        };
        let source = it.source_room.iter().cloned().collect();
        Errand { object: Some(it.object.clone()), source, target }
    };
    reading.statements.iter().take(MAX_ERRANDS).map(errand).collect()
}

/// The errands of an instruction, in order.
pub fn read_task(text: &str) -> Vec<Errand> {
    let lexicon = lexicon();
    let mut reader = Reader { lexicon, errands: Vec::new(), at: Vec::new(), done: true };
    if is_no_speech(text) {
        return Vec::new();
    }
    for sentence in sentences(text).take(32) {
        if sentence.tokens.len() > 160 || reader.errands.len() >= MAX_ERRANDS {
            break;
        }
        let clauses = parse(lexicon, &imperative(lexicon, sentence), Stamp::EPOCH);
        clauses.iter().for_each(|clause| reader.clause(clause));
    }
    reader.errands.retain(|it| it.object.is_some());
    reader.errands.truncate(MAX_ERRANDS);
    reader.errands
}

/// "Can you bring …", "To move …", "I want you to put …" and "Load …" as plain imperatives.
fn imperative(lexicon: &Lexicon, mut sentence: Sentence) -> Sentence {
    let words = &lexicon.words;
    let tokens = &mut sentence.tokens;
    // "John, can you …", "Robot go …".
    let called = tokens.len() > 2 && !lexicon.forms.contains_key(&tokens[0].text)
        && matches!(tokens[1].text.as_str(), "can" | "could" | "would" | "will" | "please" | "go" | ",")
        && !words.subjects.contains(&tokens[0].text);
    if called {
        tokens.remove(0);
    }
    let is_verb = |text: &str| lexicon.forms.contains_key(text) && !words.adjectives.contains(text);
    let wants = |text: &str| matches!(text, "want" | "need" | "would" | "like" | "could" | "can" | "will" | "should" | "must" | "to" | "please" | "robot" | "you" | "your" | "job" | "is" | "task" | "have" | "i" | "'d" | "kindly" | "just" | "now" | "go" | "and" | "then" | "love");
    let polite = tokens.iter().take_while(|token| !token.word || wants(&token.text)).count();
    let keep = tokens[..polite].iter().rposition(|token| token.is("go"));
    let from = match keep {
        Some(at) if tokens.get(at + 1).is_some_and(|next| next.is("to") || next.is("and")) && polite > at + 1 && !is_verb(&tokens.get(polite).map_or(String::new(), |it| it.text.clone())) => at,
        _ => polite,
    };
    tokens.drain(..from.min(tokens.len()));
    let opens_phrase = tokens.get(1).is_some_and(|next| words.determiners.contains(&next.text) || words.possessives.contains(&next.text));
    if let Some(first) = tokens.first_mut() {
        let noun = words.determiners.contains(&first.text) || words.subjects.contains(&first.text) || words.possessives.contains(&first.text);
        if !is_verb(&first.text) && opens_phrase && !noun && !lexicon.prepositions.contains_key(&first.text) {
            "place".clone_into(&mut first.text);
        }
    }
    for n in 0..tokens.len() {
        // "putting" and "to put" order as "put" does.
        let form = lexicon.forms.get(&tokens[n].text).and_then(|of| of.iter().find(|it| it.form == super::lemma::Form::Gerund));
        let begins = n == 0 || matches!(tokens[n - 1].text.as_str(), "and" | "," | "then" | "by");
        if let Some(form) = form.filter(|_| begins) {
            tokens[n].text.clone_from(&lexicon.verbs[form.verb].base);
        }
        let next_is_verb = tokens.get(n + 1).is_some_and(|next| lexicon.forms.get(&next.text).is_some_and(|of| of.iter().any(|it| it.form == super::lemma::Form::Base && lexicon.verbs[it.verb].frame != Frame::None)));
        if n > 0 && (tokens[n].is("to") || tokens[n].is("so")) && next_is_verb {
            "and".clone_into(&mut tokens[n].text);
        }
    }
    sentence
}

struct Reader<'a> {
    lexicon: &'a Lexicon,
    errands: Vec<Errand>,
    /// Where the robot was sent: "go to the bathroom".
    at: Vec<Mention>,
    /// Whether the last errand has all it needs.
    done: bool,
}

impl Reader<'_> {
    fn clause(&mut self, clause: &Clause) {
        if clause.unreal == Some(Unreal::Negated) {
            return;
        }
        let frame = clause.verb.as_ref().map_or(Frame::None, |verb| verb.frame);
        let lemma = clause.verb.as_ref().map_or("", |verb| verb.lemma.as_str());
        if matches!(lemma, "go" | "walk" | "head" | "come" | "turn" | "look" | "enter") {
            self.at = clause.places.iter().flat_map(|place| &place.things).map(|it| it.mention.clone()).collect();
            return;
        }
        let objects = self.objects(clause);
        let strong = clause.places.iter().position(|place| place.role == Preposition::Goal(true));
        let puts = match frame {
            Frame::Place
            | Frame::Store
            | Frame::Toss
            | Frame::Return
            | Frame::Have
            | Frame::Move
            | Frame::Bring => true,
            Frame::Take | Frame::Get | Frame::Out | Frame::Seen | Frame::None | Frame::Make | Frame::Acquire => strong.is_some(),
            _ => false,
        };
        if clause.copula {
            // "it is on the table": where the thing is.
            let pronoun = matches!(&clause.subject, Subject::Pronoun(_));
            if let Some(last) = self.errands.last_mut().filter(|_| pronoun) {
                last.source.extend(mentions(&clause.places, |_| true));
            } else if let Subject::There = clause.subject {
                let object = objects.first().map(|it| it.mention.clone());
                self.errands.push(Errand { object, source: mentions(&clause.places, |_| true), target: None });
                self.done = false;
            }
            return;
        }
        let whole = matches!(frame, Frame::Place | Frame::Store);
        let strong = strong.filter(|n| !whole || clause.places[*n].preposition != "to");
        let from = strong.unwrap_or(if puts { 0 } else { clause.places.len() });
        let goal = |n: usize, place: &Place| puts && n >= from && matches!(place.role, Preposition::Goal(_) | Preposition::Near);
        let mut target: Option<Mention> = None;
        let mut source = Vec::new();
        let (mut near, mut under) = (false, false);
        for (n, place) in clause.places.iter().enumerate() {
            for thing in place.things.iter().take(1) {
                let mention = thing.mention.clone();
                if goal(n, place) && !thing.pronoun && !self.is_person(thing) {
                    let on = place.role != Preposition::Near && !self.is_room(&mention);
                    match &mut target {
                        None => {
                            near = place.role == Preposition::Near;
                            under = near && matches!(place.preposition.as_str(), "under" | "underneath" | "below" | "beneath");
                            target = Some(mention);
                        }
                        // "next to the remote on the sofa".
                        Some(first) if near && on => {
                            near = false;
                            under = false;
                            *first = mention;
                        }
                        Some(first) => first.at.push(mention),
                    }
                } else if place.role != Preposition::Other && !goal(n, place) {
                    source.push(mention);
                }
            }
        }
        // What is under a sink is mostly in the cabinet there.
        if let Some(sink) = target.as_mut().filter(|it| under && it.noun.ends_with("sink")) {
            "cabinet".clone_into(&mut sink.noun);
        }
        if frame == Frame::Toss || frame == Frame::Gone && target.is_none() && clause.verb.is_some() {
            let bin = Mention { noun: "trash can".to_owned(), ..Mention::default() };
            target = target.or(Some(bin).filter(|_| matches!(lemma, "throw" | "toss" | "discard" | "dispose" | "trash" | "recycle" | "dump" | "chuck")));
        }
        self.errand(objects, source, target);
    }

    fn is_room(&self, mention: &Mention) -> bool {
        self.lexicon.words.rooms.contains(mention.noun.rsplit(' ').next().unwrap_or_default()) || mention.noun.ends_with("room")
    }

    fn alike(&self, a: &str, b: &str) -> bool {
        let (a, b) = (Name::new(a), Name::new(b));
        let names = &self.lexicon.names;
        names.compare(&a, &b).or_else(|| names.compare(&b, &a)).is_some()
    }

    fn is_person(&self, phrase: &Phrase) -> bool {
        let head = phrase.mention.noun.rsplit(' ').next().unwrap_or_default();
        self.lexicon.words.persons.contains(head) || self.lexicon.words.beings.contains(head)
            && !phrase.mention.adjectives.iter().any(|it| self.lexicon.words.colours.contains(it))
    }

    /// What is to be taken: the second object where the first is who it is for.
    fn objects(&self, clause: &Clause) -> Vec<Phrase> {
        let persons = |all: &[Phrase]| all.iter().all(|it| self.is_person(it));
        let objects = if clause.second.is_empty() || !persons(&clause.objects) { &clause.objects } else { &clause.second };
        objects.iter().filter(|it| !self.is_person(it)).cloned().collect()
    }

    fn errand(&mut self, objects: Vec<Phrase>, source: Vec<Mention>, target: Option<Mention>) {
        let pronoun = objects.first().is_some_and(|it| it.pronoun || matches!(it.mention.noun.as_str(), "one" | "ones"));
        if objects.is_empty() || pronoun {
            let open = self.errands.last_mut().filter(|it| it.target.is_none() || pronoun);
            if let Some(last) = open {
                if target.is_some() {
                    last.target = target;
                    self.done = true;
                }
                last.source.extend(source);
            }
            return;
        }
        // "take the mug and the mug …": the same thing again goes on with its errand.
        let same = !self.done
            && self.errands.last().is_some_and(|last| last.target.is_none() && last.object.as_ref().is_some_and(|it| self.alike(&it.noun, &objects[0].mention.noun)));
        if same {
            if let Some(last) = self.errands.last_mut() {
                last.target = target;
                last.source.extend(source);
            }
            return;
        }
        // Where the robot was sent holds for what it is to take there.
        let at = std::mem::take(&mut self.at);
        for phrase in objects {
            let mut source = source.clone();
            source.extend(phrase.mention.at.clone());
            source.extend(at.clone());
            self.errands.push(Errand { object: Some(phrase.mention), source, target: target.clone() });
        }
        self.done = target.is_some();
    }
}

fn mentions(places: &[Place], fits: impl Fn(&Place) -> bool) -> Vec<Mention> {
    let fitting = places.iter().filter(|place| fits(place) && place.role != Preposition::Other);
    fitting.flat_map(|place| &place.things).map(|it| it.mention.clone()).collect()
}

/// Finds the nodes of an errand. What is not known stays open; ties are broken by a guess, and
/// the trail says so: a robot that asks can still be answered, and what it then does is reported
/// by its statuses.
pub fn ground_errand(
    world: &World,
    errand: &Errand,
    similarity: Option<&dyn LabelSimilarity>,
) -> GroundedErrand {
    let mut grounder = Grounder { world, finder: Finder { similarity, guess: true }, trail: Vec::new() };
    let sources: Vec<NodeId> = errand.source.iter().flat_map(|it| grounder.anything("source", it, &[])).collect();
    let object = errand.object.as_ref().and_then(|it| grounder.object(it, &sources));
    let rooms: Vec<NodeId> = sources.iter().copied().filter(|id| world.graph().region(*id).is_some()).collect();
    let source_room = rooms.first().copied().or_else(|| {
        let on = sources.first()?;
        world.graph().object(*on).map(|it| it.room)
    });
    let (support, target_room) = errand.target.as_ref().map_or((None, None), |it| grounder.target(it, object));
    let named = |id: Option<NodeId>| id.map(|id| crate::modality::desk::node_ref(world, id));
    GroundedErrand {
        object: named(object),
        source_room: named(source_room),
        target_room: named(target_room),
        support: named(support),
        trail: grounder.trail,
    }
}

struct Grounder<'a> {
    world: &'a World,
    finder: Finder<'a>,
    trail: Vec<Resolved>,
}

impl Grounder<'_> {
    /// Rooms or things of this name.
    fn anything(&mut self, role: &'static str, mention: &Mention, near: &[NodeId]) -> Vec<NodeId> {
        let rooms = self.finder.rooms(mention, self.world);
        let things = self.finder.objects(mention, self.world.graph().objects());
        let closer = match (rooms.first(), things.first()) {
            (Some(room), Some(thing)) => (room.closeness, room.missing) <= (thing.closeness, thing.missing),
            (room, _) => room.is_some(),
        };
        let best = closest(if closer { &rooms } else { &things });
        self.pick(role, mention, &best, near).into_iter().collect()
    }

    fn object(&mut self, mention: &Mention, sources: &[NodeId]) -> Option<NodeId> {
        let all = self.finder.objects(mention, self.world.graph().all_objects());
        let there = |it: &&Candidate| {
            let object = self.world.graph().object(it.id);
            object.is_some_and(|object| sources.iter().any(|at| object.room == *at || object.support == Some(*at)))
        };
        let at_source: Vec<Candidate> = all.iter().filter(there).filter(|it| it.closeness < super::names::Closeness::Part).copied().collect();
        let best = closest(if at_source.is_empty() { &all } else { &at_source });
        self.pick("object", mention, &best, sources)
    }

    fn target(&mut self, mention: &Mention, object: Option<NodeId>) -> (Option<NodeId>, Option<NodeId>) {
        let world = self.world;
        let mut rooms: Vec<NodeId> =
            mention.at.iter().flat_map(|it| self.anything("target", it, &[])).collect();
        rooms.retain(|id| world.graph().region(*id).is_some());
        let mut things = self.finder.objects(mention, self.world.graph().objects());
        things.retain(|it| Some(it.id) != object);
        let own_rooms = self.finder.rooms(mention, self.world);
        let room_first = match (own_rooms.first(), things.first()) {
            (Some(room), Some(thing)) => (room.closeness, room.missing) <= (thing.closeness, thing.missing),
            (room, _) => room.is_some(),
        };
        if room_first {
            let room = self.pick("target", mention, &closest(&own_rooms), &[]);
            return (None, room);
        }
        let in_room: Vec<Candidate> = things.iter().filter(|it| self.world.known(it.id).is_some_and(|object| rooms.contains(&object.room))).copied().collect();
        let best = closest(if in_room.is_empty() { &things } else { &in_room });
        let support = self.pick("support", mention, &best, &rooms);
        let room = support.and_then(|id| self.world.known(id)).map(|it| it.room);
        (support, room.or(rooms.first().copied()))
    }

    fn pick(&mut self, role: &'static str, mention: &Mention, best: &[Candidate], near: &[NodeId]) -> Option<NodeId> {
        let candidates: Vec<NodeId> = best.iter().map(|it| it.id).collect();
        let rank = |id: &NodeId| self.rank(mention, *id, near);
        let chosen = candidates.iter().copied().min_by_key(rank);
        let why = match candidates.len() {
            0 => "nothing of that name is known".to_owned(),
            1 => best[0].closeness.words().to_owned(),
            n => format!("{}; the most likely of {n}", best[0].closeness.words()),
        };
        let mention = mention.clone();
        self.trail.push(Resolved { role, mention, candidates, chosen: chosen.into_iter().collect(), why });
        chosen
    }

    /// What breaks ties: where it was said to be, what is mostly meant, the smaller id.
    fn rank(&self, mention: &Mention, id: NodeId, near: &[NodeId]) -> (bool, usize, NodeId) {
        let object = self.world.known(id);
        let away = !near.is_empty() && !object.is_some_and(|it| near.contains(&it.room));
        let label = self.world.graph().label(id).map_or("", |label| label.as_str());
        let (wanted, label) = (Name::new(&mention.noun), Name::new(label));
        let with_adjectives = Name::new(&format!("{} {}", mention.adjectives.join(" "), mention.noun));
        let names = &lexicon().names;
        let typical = names.typical(&with_adjectives, &label).or_else(|| names.typical(&wanted, &label));
        let typical = typical.or_else(|| names.often(&with_adjectives, &label)).or_else(|| names.often(&wanted, &label));
        (away, typical.unwrap_or(usize::MAX), id)
    }
}
