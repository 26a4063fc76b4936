//! From clauses to statements: what a sentence reports as having changed.

use super::clause::{Clause, Place, Subject, Unreal, Verb, parse};
use super::lemma::Form;
use super::lexicon::{Frame, Lexicon, Preposition, lexicon};
use super::phrase::Phrase;
use super::reading::{Mention, Quantity, Reading, Statement, When};
use super::token::{Sentence, is_no_speech, sentences};
use crate::change::Action;
use crate::time::Stamp;

/// Statements taken from one utterance; nobody reports more in one breath.
pub(super) const MAX_STATEMENTS: usize = 32;
/// Words of a sentence that is still read.
const MAX_WORDS: usize = 160;

/// What the built-in interpreter makes of an utterance.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Understood {
    pub reading: Reading,
    /// What it corrects of the utterance before.
    pub correction: Option<Correction>,
}

/// "no, I meant the red one", "no, in the bedroom".
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Correction {
    pub object: Option<Mention>,
    pub support: Option<Mention>,
    pub target_room: Option<Mention>,
}

/// Reads `text`, said at `said_at`; `antecedents` are what "it" and "them" may mean.
pub(super) fn read(text: &str, said_at: Stamp, antecedents: &[Mention]) -> Understood {
    let lexicon = lexicon();
    let mut reporter = Reporter {
        lexicon,
        drafts: Vec::new(),
        antecedents: antecedents.to_vec(),
        note: String::new(),
        correction: None,
    };
    if is_no_speech(text) {
        reporter.note("it holds marks that nobody speaks");
        return reporter.finish();
    }
    for sentence in sentences(text) {
        if reporter.drafts.len() > MAX_STATEMENTS {
            reporter.note("it says too much at once: the rest was left out");
            break;
        }
        match no_report(lexicon, &sentence) {
            Some(why) => reporter.note(why),
            None => reporter.sentence(&sentence, said_at),
        }
    }
    reporter.finish()
}

/// Why a sentence as a whole reports nothing.
fn no_report(lexicon: &Lexicon, sentence: &Sentence) -> Option<&'static str> {
    let words = &lexicon.words;
    let tokens = &sentence.tokens;
    let any = |list: &std::collections::BTreeSet<String>| tokens.iter().any(|token| list.contains(&token.text));
    if tokens.len() > MAX_WORDS {
        return Some("the sentence is too long to be spoken");
    }
    if sentence.question {
        return Some("a question");
    }
    if sentence.quoted {
        return Some("words in quotes are somebody else's");
    }
    if any(&words.conditionals) {
        return Some("a condition");
    }
    if any(&words.foreign) {
        return Some("another language");
    }
    let first = tokens.iter().position(|token| {
        token.word && !words.interjections.contains(&token.text) && !words.conjunctions.contains(&token.text)
    });
    let first = first.map_or("", |n| tokens[n].text.as_str());
    let asks = words.questions.contains(first)
        || words.r#do.contains(first)
        || words.modals.contains(first)
        || words.be.contains(first)
        || (words.have.contains(first) && tokens.iter().any(|token| words.subjects.contains(&token.text)));
    asks.then_some("a question")
}

/// A statement that may still be completed by what follows.
#[derive(Clone, Debug)]
struct Draft {
    statement: Statement,
    /// Its place is not told yet: "I took the mug and put it …".
    open: bool,
    /// Without a place it says nothing.
    needs_place: bool,
}

struct Reporter<'a> {
    lexicon: &'a Lexicon,
    drafts: Vec<Draft>,
    antecedents: Vec<Mention>,
    note: String,
    correction: Option<Correction>,
}

/// Where something is now.
#[derive(Clone, Debug, Default)]
struct Target {
    support: Option<Mention>,
    room: Option<Mention>,
}

impl Target {
    fn is_empty(&self) -> bool {
        self.support.is_none() && self.room.is_none()
    }
}

impl Reporter<'_> {
    fn note(&mut self, why: &str) {
        if self.note.len() < 200 && !self.note.contains(why) {
            let comma = if self.note.is_empty() { "" } else { "; " };
            self.note = format!("{}{comma}{why}", self.note);
        }
    }

    fn finish(mut self) -> Understood {
        let kept = self.drafts.drain(..).filter(|draft| !(draft.open && draft.needs_place));
        let mut statements: Vec<Statement> = kept.map(|draft| draft.statement).collect();
        statements.truncate(MAX_STATEMENTS);
        if statements.is_empty() && self.note.is_empty() {
            self.note("nothing in it says that something changed");
        }
        let reading = Reading { statements, note: self.note };
        Understood { reading, correction: self.correction }
    }

    fn sentence(&mut self, sentence: &Sentence, said_at: Stamp) {
        let clauses = parse(self.lexicon, sentence, said_at);
        if self.corrects(sentence, &clauses) {
            return;
        }
        let mut told = false;
        for clause in &clauses {
            told = match self.unreal(clause, told) {
                Some(why) => {
                    self.note(why);
                    false
                }
                None => {
                    self.clause(clause);
                    true
                }
            };
            self.remember(clause);
        }
    }

    /// Why a clause reports nothing, whatever its verb.
    fn unreal(&self, clause: &Clause, told_before: bool) -> Option<&'static str> {
        if clause.elsewhere(self.lexicon) {
            return Some("it is about another household");
        }
        if clause.future {
            return Some("it lies ahead");
        }
        match clause.unreal {
            Some(Unreal::Negated) if !clause.no_longer && !self.is_used_up(clause) => return Some("a negation"),
            Some(Unreal::Possible) => return Some("a wish, a plan or a guess"),
            Some(Unreal::Habit) => return Some("a habit"),
            Some(Unreal::Reported) => return Some("what somebody else says or thinks"),
            _ => {}
        }
        let verb = clause.verb.as_ref()?;
        if verb.frame == Frame::Wish {
            return Some("a wish or a plan");
        }
        self.tense(clause, verb, told_before)
    }

    /// "we don't have any milk left".
    fn is_used_up(&self, clause: &Clause) -> bool {
        let left = clause.state.iter().any(|word| word == "left" || word == "more");
        left && (clause.subject == Subject::There || clause.verb.as_ref().is_some_and(|verb| verb.frame == Frame::Have))
    }

    fn tense(&self, clause: &Clause, verb: &Verb, told_before: bool) -> Option<&'static str> {
        if verb.frame == Frame::Have || verb.passive && !matches!(verb.frame, Frame::None) {
            return None;
        }
        if verb.progressive {
            return (!verb.stative).then_some("it is not over yet");
        }
        let past_word = matches!(verb.form, Form::Past | Form::Participle) || verb.perfect || clause.past;
        let told = clause.when.is_some() || clause.already || clause.just || told_before;
        let also_base = matches!(verb.lemma.as_str(), "put" | "set" | "cut" | "let" | "shut" | "read");
        match &clause.subject {
            Subject::Nobody if !past_word => Some("a command"),
            Subject::Nobody if also_base && !verb.perfect && !told => Some("a command"),
            _ if past_word || verb.stative || verb.frame == Frame::None => None,
            _ => Some("a habit or a command"),
        }
    }

    /// What "it" may mean from here on.
    fn remember(&mut self, clause: &Clause) {
        let subject = match &clause.subject {
            Subject::Things(things) => things.as_slice(),
            _ => &[],
        };
        let second = if clause.second.is_empty() { &clause.objects } else { &clause.second };
        for things in [second.as_slice(), subject] {
            let known = things.iter().filter(|it| !it.pronoun && it.mention.noun != "one" && !self.is_being(&it.mention));
            let mentions: Vec<Mention> = known.map(|it| it.mention.clone()).collect();
            if !mentions.is_empty() {
                self.antecedents = mentions;
                return;
            }
        }
    }

    fn is_being(&self, mention: &Mention) -> bool {
        let head = mention.noun.rsplit(' ').next().unwrap_or_default();
        self.lexicon.words.beings.contains(head) || self.lexicon.words.persons.contains(head)
    }

    fn is_abstract(&self, mention: &Mention) -> bool {
        let words = &self.lexicon.words;
        let head = mention.noun.rsplit(' ').next().unwrap_or_default();
        words.abstract_nouns.contains(&mention.noun) || words.abstract_nouns.contains(head)
    }

    /// The mentions that a phrase means.
    fn resolve(&self, phrase: &Phrase) -> Vec<Mention> {
        let mention = &phrase.mention;
        if phrase.pronoun {
            let all = self.antecedents.clone();
            return if phrase.plural { all } else { all.into_iter().rev().take(1).collect() };
        }
        if matches!(mention.noun.as_str(), "one" | "ones") {
            let Some(head) = self.antecedents.last() else { return Vec::new() };
            return vec![Mention { noun: head.noun.clone(), ..mention.clone() }];
        }
        vec![mention.clone()]
    }

    /// What a clause is about, as mentions with the phrase each comes from.
    fn things(&self, phrases: &[Phrase]) -> Vec<(Mention, Phrase)> {
        let usable = phrases.iter().filter(|it| !it.partial);
        let all = usable.flat_map(|it| self.resolve(it).into_iter().map(|mention| (mention, it.clone())));
        all.filter(|(mention, _)| !self.is_being(mention) && !self.is_abstract(mention)).collect()
    }

    fn subject_things(&self, clause: &Clause) -> Vec<(Mention, Phrase)> {
        match &clause.subject {
            Subject::Things(things) => self.things(things),
            Subject::Pronoun(word) if matches!(word.as_str(), "it" | "they" | "that" | "this" | "these" | "those" | "both") => {
                let plural = matches!(word.as_str(), "they" | "these" | "those" | "both");
                let phrase = Phrase { pronoun: true, plural, ..Phrase::default() };
                self.things(&[phrase])
            }
            _ => Vec::new(),
        }
    }

    fn clause(&mut self, clause: &Clause) {
        let Some(verb) = &clause.verb else {
            if clause.copula {
                self.state(clause);
            } else {
                self.headline(clause);
            }
            return;
        };
        let mut things = if verb.passive { self.subject_things(clause) } else { self.things(&clause.objects) };
        if things.is_empty() && clause.objects.is_empty() && !verb.passive && (verb.of_subject || matches!(verb.frame, Frame::Spent)) {
            things = self.subject_things(clause);
        }
        if !clause.second.is_empty() && !verb.passive {
            things = self.things(&clause.second);
        }
        if verb.stative && clause.objects.is_empty() {
            let now = !clause.past || verb.progressive && !clause.past;
            if now {
                self.is_at(clause, &self.subject_things(clause));
            }
            return;
        }
        self.event(clause, verb, &things);
    }

    fn event(&mut self, clause: &Clause, verb: &Verb, things: &[(Mention, Phrase)]) {
        let target = self.target(clause, verb);
        let negative = things.iter().any(|(_, phrase)| phrase.negative);
        if negative && verb.frame != Frame::Have {
            return self.note("a negation");
        }
        match verb.frame {
            Frame::Gone | Frame::Spent => self.gone_verb(clause, verb, things),
            Frame::Toss => self.toss(clause, verb, things, target),
            Frame::Take | Frame::Out => self.take(clause, verb, things, target),
            Frame::Place | Frame::Store => self.placed(clause, things, target),
            Frame::Move => self.moved(clause, things, target),
            Frame::Bring => self.bring(clause, things, target),
            Frame::Get => self.get(clause, verb, things, target),
            Frame::Acquire => self.acquire(clause, things, target, false),
            Frame::Make | Frame::Arrive => self.acquire(clause, things, target, true),
            Frame::Return => self.put_back(clause, things, target),
            Frame::Swap => self.swap(clause, verb, things),
            Frame::Replace => self.replace(clause, verb, things),
            Frame::Seen => self.seen(clause, things),
            Frame::Have => self.have(clause, things, target),
            Frame::Report | Frame::Belief | Frame::Wish | Frame::Mean | Frame::None => {}
        }
    }

    // ---- one frame each -------------------------------------------------------------------

    fn gone_verb(&mut self, clause: &Clause, verb: &Verb, things: &[(Mention, Phrase)]) {
        let to_speaker = |phrase: &Phrase| matches!(phrase.mention.noun.as_str(), "me" | "us");
        let received = verb.lemma == "give" && clause.objects.first().is_some_and(to_speaker);
        let speaker = matches!(&clause.subject, Subject::Pronoun(who) if matches!(who.as_str(), "i" | "we"));
        if received || (verb.lemma == "borrow" && speaker && !things.iter().all(|it| it.0.definite)) {
            return self.acquire(clause, things, Target::default(), false);
        }
        self.gone(clause, things, 0.9);
    }

    fn toss(&mut self, clause: &Clause, verb: &Verb, things: &[(Mention, Phrase)], target: Target) {
        let words = &self.lexicon.words;
        let to_waste = target.support.as_ref().is_some_and(|it| words.waste.contains(&it.noun) || words.waste.contains(it.noun.rsplit(' ').next().unwrap_or_default()));
        let nowhere = target.is_empty() && verb.lemma != "throw" && clause.places.is_empty();
        if to_waste || nowhere {
            let without = Clause { places: only_sources(clause), ..clause.clone() };
            self.gone(&without, things, 0.9);
        } else if !target.is_empty() {
            self.placed(clause, things, target);
        }
    }

    fn take(&mut self, clause: &Clause, verb: &Verb, things: &[(Mention, Phrase)], target: Target) {
        let light = |it: &(Mention, Phrase)| {
            (!it.0.definite && self.lexicon.words.light_objects.contains(&it.0.noun)) || (it.1.bare && it.0.noun == "place")
        };
        if things.iter().any(light) {
            return;
        }
        let along = clause.places.iter().any(|place| place.preposition == "with" && place.things.iter().any(|it| it.pronoun || self.is_being(&it.mention)));
        let strong = clause.places.iter().any(|place| place.role == Preposition::Goal(true));
        if !along && strong && !target.is_empty() {
            return self.moved(clause, things, target);
        }
        let out_of = clause.places.iter().any(|place| place.role == Preposition::Source);
        if along || (verb.frame == Frame::Out && !out_of) {
            let places = clause.places.iter().filter(|place| place.role != Preposition::Goal(true)).cloned().collect();
            return self.gone(&Clause { places, ..clause.clone() }, things, 0.9);
        }
        let from = self.drafts.len();
        self.gone(clause, things, 0.7);
        self.drafts[from..].iter_mut().for_each(|draft| draft.open = true);
    }

    fn placed(&mut self, clause: &Clause, things: &[(Mention, Phrase)], target: Target) {
        if is_own_place(&target) {
            return self.put_back(clause, things, Target::default());
        }
        if target.is_empty() {
            return self.note("it does not say where it was put");
        }
        for (mention, phrase) in things {
            let bare = phrase.bare && !phrase.plural && !phrase.pronoun && !self.knows(mention);
            let action = if bare { Action::Moved } else { Action::Added };
            let definite = !phrase.novel;
            let object = Mention { definite, ..self.with_hints(clause, mention, false) };
            self.push(clause, action, object, &target, 0.9);
        }
    }

    fn moved(&mut self, clause: &Clause, things: &[(Mention, Phrase)], target: Target) {
        if is_own_place(&target) {
            return self.put_back(clause, things, Target::default());
        }
        for (mention, phrase) in things {
            let novel = phrase.novel && !target.is_empty();
            let action = if novel { Action::Added } else { Action::Moved };
            let object = Mention { definite: !novel, ..self.with_hints(clause, mention, false) };
            let from = self.drafts.len();
            self.push(clause, action, object, &target, 0.9);
            if target.is_empty() {
                self.drafts[from..].iter_mut().for_each(|draft| draft.open = true);
            }
        }
    }

    fn bring(&mut self, clause: &Clause, things: &[(Mention, Phrase)], target: Target) {
        for (mention, phrase) in things {
            let definite = mention.definite && !phrase.novel;
            let object = Mention { definite, ..self.with_hints(clause, mention, false) };
            let from = self.drafts.len();
            self.push(clause, Action::Added, object, &target, 0.9);
            self.mark(from, target.is_empty(), definite || (phrase.bare && !phrase.plural));
        }
    }

    fn get(&mut self, clause: &Clause, verb: &Verb, things: &[(Mention, Phrase)], target: Target) {
        let sourced = clause.places.iter().any(|place| place.role == Preposition::Source);
        let definite = things.iter().any(|(mention, phrase)| mention.definite && !phrase.novel);
        if definite {
            return self.take(clause, verb, things, target);
        }
        let novel = things.iter().any(|(_, phrase)| phrase.novel);
        self.acquire(clause, things, target, !novel || sourced);
    }

    fn acquire(&mut self, clause: &Clause, things: &[(Mention, Phrase)], target: Target, needs_place: bool) {
        for (mention, _) in things {
            let at = Vec::new();
            let object = Mention { definite: false, at, ..mention.clone() };
            let from = self.drafts.len();
            self.push(clause, Action::Added, object, &target, 0.9);
            self.mark(from, target.is_empty(), needs_place);
        }
    }

    fn put_back(&mut self, clause: &Clause, things: &[(Mention, Phrase)], target: Target) {
        if !target.is_empty() {
            return self.placed(clause, things, target);
        }
        for (mention, _) in things {
            let object = Mention { definite: true, ..mention.clone() };
            let room = Some(Mention { its_place: true, ..object.clone() });
            self.push(clause, Action::Moved, object, &Target { support: None, room }, 0.9);
        }
    }

    fn swap(&mut self, clause: &Clause, verb: &Verb, things: &[(Mention, Phrase)]) {
        let mut both: Vec<Mention> = things.iter().map(|it| it.0.clone()).collect();
        let with = clause.places.iter().find(|place| matches!(place.preposition.as_str(), "with" | "for"));
        if let Some(place) = with {
            both.extend(self.things(&place.things).into_iter().map(|it| it.0));
        }
        let lasting = |it: &Mention| Mention { definite: true, ..it.clone() };
        if let [a, b] = both.as_slice() {
            if !b.definite && with.is_some() {
                // "I swapped the lamp for a new one".
                return self.replace(clause, verb, things);
            }
            for (object, place) in [(a, b), (b, a)] {
                let room = Some(Mention { its_place: true, ..lasting(place) });
                self.push(clause, Action::Moved, lasting(object), &Target { support: None, room }, 0.9);
            }
        }
    }

    fn replace(&mut self, clause: &Clause, verb: &Verb, things: &[(Mention, Phrase)]) {
        let by = |place: &&Place| matches!(place.preposition.as_str(), "with" | "by" | "for");
        let with = clause.places.iter().find(by);
        let Some(new) = with.map(|place| &place.things).filter(|_| verb.frame != Frame::None) else { return };
        let without = Clause { places: Vec::new(), ..clause.clone() };
        self.gone(&without, things, 0.9);
        let Some((old, _)) = things.first() else { return };
        let antecedents = std::mem::replace(&mut self.antecedents, vec![old.clone()]);
        let new = self.things(new);
        self.antecedents = antecedents;
        for (mention, phrase) in new {
            let definite = mention.definite && !phrase.novel;
            let room = Some(Mention { its_place: true, definite: true, ..old.clone() });
            let object = Mention { definite, ..mention };
            self.push(clause, Action::Added, object, &Target { support: None, room }, 0.9);
        }
    }

    fn seen(&mut self, clause: &Clause, things: &[(Mention, Phrase)]) {
        let known: Vec<_> = things.iter().filter(|(mention, phrase)| !phrase.bare || phrase.plural || self.knows(mention)).cloned().collect();
        let from = self.drafts.len();
        self.is_at(clause, &known);
        self.drafts[from..].iter_mut().for_each(|draft| draft.statement.confidence *= 0.9);
    }

    fn have(&mut self, clause: &Clause, things: &[(Mention, Phrase)], target: Target) {
        if clause.past {
            return;
        }
        if self.is_used_up(clause) || things.iter().any(|(_, phrase)| phrase.negative && phrase.more) {
            return self.gone(clause, things, 0.9);
        }
        let mut target = target;
        if let (Subject::Things(subject), true) = (&clause.subject, target.is_empty()) {
            target.room = subject.first().map(|it| it.mention.clone()).filter(|it| self.is_room(it));
        }
        let light = |it: &(Mention, Phrase)| self.lexicon.words.light_objects.contains(&it.0.noun) || it.1.negative;
        if target.is_empty() || things.iter().any(light) {
            return;
        }
        for (mention, phrase) in things {
            let definite = mention.definite && !phrase.novel;
            let object = Mention { definite, ..mention.clone() };
            self.push(clause, Action::Added, object, &target, 0.9);
        }
    }

    // ---- places and states ----------------------------------------------------------------

    /// "is gone", "is on the table", "there is a plant in the hall".
    fn state(&mut self, clause: &Clause) {
        let gone = clause.state.iter().any(|word| self.lexicon.words.gone_words.contains(word));
        if clause.subject == Subject::There {
            return self.there_is(clause);
        }
        if clause.past {
            return;
        }
        let things = self.subject_things(clause);
        let out_of = clause.places.iter().find(|place| place.preposition == "out of" && place.things.iter().all(|it| it.bare));
        if let (Some(place), Subject::Pronoun(_)) = (out_of, &clause.subject) {
            let used = self.things(&place.things);
            return self.gone(&Clause { places: Vec::new(), ..clause.clone() }, &used, 0.9);
        }
        if gone || clause.no_longer {
            self.gone(clause, &things, 0.9);
        } else if clause.places.is_empty() && clause.state.iter().any(|word| word == "back") {
            self.put_back(clause, &things, Target::default());
        } else {
            self.is_at(clause, &things);
        }
    }

    fn there_is(&mut self, clause: &Clause) {
        if clause.past && !clause.no_longer {
            return;
        }
        let things = self.things(&clause.objects);
        let negative = things.iter().any(|(_, phrase)| phrase.negative) || clause.unreal == Some(Unreal::Negated);
        if negative {
            let used_up = self.is_used_up(clause) || things.iter().any(|(_, phrase)| phrase.more) || clause.no_longer;
            return if used_up { self.gone(clause, &things, 0.9) } else { self.note("a negation") };
        }
        let lists = &self.lexicon.words;
        if clause.state.iter().any(|word| lists.gone_words.contains(word)) {
            return;
        }
        let target = self.where_it_is(clause);
        if target.is_empty() {
            return;
        }
        for (mention, phrase) in &things {
            let definite = mention.definite && !phrase.novel && !matches!(mention.quantity, Quantity::Count(_));
            let object = Mention { definite, ..mention.clone() };
            self.push(clause, Action::Added, object, &target, 0.9);
        }
    }

    /// It is there now, wherever it was before.
    fn is_at(&mut self, clause: &Clause, things: &[(Mention, Phrase)]) {
        let target = self.where_it_is(clause);
        if target.is_empty() {
            return;
        }
        for (mention, phrase) in things {
            let unknown = phrase.bare && !phrase.plural && !phrase.pronoun && !self.knows(mention);
            let action = if unknown { Action::Moved } else { Action::Added };
            let definite = (mention.definite || phrase.bare || phrase.pronoun) && !phrase.novel;
            let object = Mention { definite, ..mention.clone() };
            self.push(clause, action, object, &target, 0.9);
        }
    }

    /// "No more milk", "Banana gone", "New plant in the bedroom", "Keys on the counter now".
    fn headline(&mut self, clause: &Clause) {
        let things = self.things(&clause.objects);
        let gone = clause.state.iter().any(|word| self.lexicon.words.gone_words.contains(word));
        let used_up = things.iter().any(|(_, phrase)| phrase.negative && (phrase.more || clause.state.iter().any(|word| word == "left")));
        if gone || used_up {
            self.gone(clause, &things, 0.9);
        } else if things.iter().all(|(_, phrase)| phrase.novel) || clause.now {
            self.is_at(clause, &things);
        }
    }

    fn where_it_is(&self, clause: &Clause) -> Target {
        let places = clause.places.iter().filter(|place| place.role != Preposition::Source && place.preposition != "to");
        let places: Vec<Place> = places.cloned().collect();
        self.target_of(&places)
    }

    /// Where the verb puts its object.
    fn target(&self, clause: &Clause, verb: &Verb) -> Target {
        let strong = clause.places.iter().position(|place| place.role == Preposition::Goal(true));
        let from = match verb.frame {
            Frame::Take | Frame::Out | Frame::Move | Frame::Bring | Frame::Get => strong.unwrap_or(0),
            _ => 0,
        };
        let mut target = self.target_of(&clause.places[from.min(clause.places.len())..]);
        // "a new lamp for the bedroom".
        let for_room = clause.places.iter().find(|place| place.preposition == "for");
        if let (Some(place), true) = (for_room, target.is_empty() && matches!(verb.frame, Frame::Acquire | Frame::Get | Frame::Bring)) {
            target.room = place.things.first().map(|it| it.mention.clone()).filter(|it| self.is_room(it));
        }
        target
    }

    fn target_of(&self, places: &[Place]) -> Target {
        let mut target = Target::default();
        let goals = places.iter().filter(|place| matches!(place.role, Preposition::Goal(_) | Preposition::Near));
        for place in goals {
            let Some(thing) = place.things.first() else { continue };
            if thing.bare && !thing.plural && !self.knows(&thing.mention) && !thing.pronoun && !self.is_away(&thing.mention) {
                continue;
            }
            let Some(mention) = self.resolve(thing).into_iter().next() else { continue };
            let first = target.is_empty();
            if self.is_room(&mention) {
                if let Some(support) = &mut target.support {
                    support.at.push(mention.clone());
                }
                target.room.get_or_insert(mention);
            } else if first && place.role == Preposition::Near {
                target.room = Some(mention);
            } else if first {
                target.room = mention.at.first().filter(|at| self.is_room(at)).cloned();
                target.support = Some(mention);
            } else if let Some(support) = &mut target.support {
                support.at.push(mention);
            } else if target.room.as_ref().is_some_and(|room| self.is_room(room)) {
                // "in the kitchen on the table".
                if place.role != Preposition::Near {
                    let at = target.room.iter().cloned().collect();
                    target.support = Some(Mention { at, ..mention });
                }
            }
        }
        target
    }

    fn is_room(&self, mention: &Mention) -> bool {
        let head = mention.noun.rsplit(' ').next().unwrap_or_default();
        let one_word = head.len() > 4 && head.ends_with("room") && head != "mushroom";
        (self.lexicon.words.rooms.contains(head) || one_word) && !matches!(mention.noun.as_str(), "toilet")
    }

    fn is_away(&self, mention: &Mention) -> bool {
        self.lexicon.words.away_places.contains(mention.noun.rsplit(' ').next().unwrap_or_default())
    }

    /// Whether the lexicon knows the noun, so that it needs no determiner to be a thing.
    fn knows(&self, mention: &Mention) -> bool {
        let names = &self.lexicon.names;
        let head = mention.noun.rsplit(' ').next().unwrap_or_default();
        let name = |text: &str| names.knows(&super::names::Name::new(text));
        name(&mention.noun) || name(head) || self.is_room(mention) || self.lexicon.words.waste.contains(head)
    }

    // ---- making statements ----------------------------------------------------------------

    /// The mention with where it is said to have been.
    fn with_hints(&self, clause: &Clause, mention: &Mention, removal: bool) -> Mention {
        let mut mention = mention.clone();
        let strong = clause.places.iter().position(|place| place.role == Preposition::Goal(true));
        for (n, place) in clause.places.iter().enumerate() {
            let source = place.role == Preposition::Source;
            let was_there = matches!(place.role, Preposition::Goal(false) | Preposition::Near)
                && (removal || strong.is_some_and(|strong| n < strong));
            if source || was_there {
                let there = place.things.iter().flat_map(|it| self.resolve(it));
                mention.at.extend(there.filter(|it| !self.is_being(it)));
            }
        }
        mention
    }

    fn gone(&mut self, clause: &Clause, things: &[(Mention, Phrase)], confidence: f64) {
        for (mention, _) in things {
            let object = Mention { definite: true, ..self.with_hints(clause, mention, true) };
            self.push(clause, Action::Removed, object, &Target::default(), confidence);
        }
    }

    fn mark(&mut self, from: usize, open: bool, needs_place: bool) {
        for draft in &mut self.drafts[from..] {
            draft.open = open;
            draft.needs_place = needs_place;
        }
    }

    fn push(&mut self, clause: &Clause, action: Action, object: Mention, target: &Target, confidence: f64) {
        let just = When { earliest_s: 600.0, latest_s: 0.0 };
        let when = clause.when.or(clause.just.then_some(just));
        let confidence = if clause.belief { confidence * 0.65 } else { confidence };
        let statement = Statement {
            action,
            object,
            support: target.support.clone(),
            source_room: None,
            target_room: target.room.clone(),
            when,
            confidence,
        };
        let draft = Draft { statement, open: false, needs_place: false };
        if !self.complete(&draft) && self.drafts.len() <= MAX_STATEMENTS {
            self.drafts.push(draft);
        }
    }

    /// "I took the mug and put it on the desk" is one change: the place completes the first.
    fn complete(&mut self, with: &Draft) -> bool {
        let new = &with.statement;
        let same = |draft: &&mut Draft| draft.statement.object.span == new.object.span && new.object.span.is_some();
        let Some(before) = self.drafts.iter_mut().rev().find(same) else { return false };
        let old = &mut before.statement;
        let told = new.support.is_some() || new.target_room.is_some();
        let refines = !before.open
            && old.action != Action::Removed
            && new.action != Action::Removed
            && new.support.is_some()
            && new.target_room.is_none()
            && old.support.is_none();
        if !(before.open && told || refines) {
            return false;
        }
        let (definite, added) = (old.object.definite, old.action == Action::Added);
        let at = std::mem::take(&mut old.object.at);
        let room = old.target_room.take().filter(|_| refines);
        let when = new.when.or(old.when);
        let action = if added || old.action == new.action { old.action } else { new.action };
        let action = if refines { action } else if added { Action::Added } else { new.action };
        *old = Statement { when, action, ..new.clone() };
        old.object.definite = definite;
        old.object.at = at;
        if let Some(room) = room {
            if let Some(support) = &mut old.support {
                support.at.push(room.clone());
            }
            old.target_room = Some(room);
        }
        before.open = false;
        true
    }

    // ---- corrections ----------------------------------------------------------------------

    /// "no, I meant the red one", "sorry, in the bedroom".
    fn corrects(&mut self, sentence: &Sentence, clauses: &[Clause]) -> bool {
        let Some(clause) = clauses.last() else { return false };
        let starts = |word: &str| sentence.tokens.first().is_some_and(|token| token.is(word));
        let opens = ["no", "nope", "sorry", "actually", "wait", "not", "oops", "correction"].iter().any(|word| starts(word));
        let means = clauses.iter().any(|it| it.verb.as_ref().is_some_and(|verb| verb.frame == Frame::Mean));
        let fragment = clause.verb.is_none() && !clause.copula && opens && !clause.objects.iter().any(|it| it.negative);
        let is_one = clause.copula && clause.places.is_empty()
            && matches!(&clause.subject, Subject::Pronoun(it) if it == "it" || it == "that")
            && clause.objects.iter().any(|it| it.mention.noun == "one");
        if !(means || fragment || is_one) || !self.drafts.is_empty() {
            return false;
        }
        let target = self.target_of(&clause.places);
        let object = clause.objects.first().map(|it| it.mention.clone());
        if object.is_none() && target.is_empty() {
            return means;
        }
        self.correction = Some(Correction { object, support: target.support, target_room: target.room });
        true
    }
}

fn only_sources(clause: &Clause) -> Vec<Place> {
    clause.places.iter().filter(|place| place.role == Preposition::Source).cloned().collect()
}

/// "in its place", "where it belongs".
fn is_own_place(target: &Target) -> bool {
    let own = |it: &Mention| matches!(it.noun.as_str(), "place" | "spot" | "usual place" | "usual spot" | "original place");
    target.support.as_ref().is_some_and(own)
}
