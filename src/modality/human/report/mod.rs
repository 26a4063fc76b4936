//! From clauses to statements: what a sentence reports as having changed.

mod correct;
mod drafts;
mod frames;
mod places;
mod states;

use crate::modality::human::clause::{Clause, Subject, Unreal, Verb, parse};
use crate::modality::human::lemma::Form;
use crate::modality::human::lexicon::{Frame, Lexicon, lexicon};
use crate::modality::human::phrase::Phrase;
use crate::modality::human::reading::{Mention, Reading, Statement};
use crate::modality::human::token::{Sentence, Token, is_no_speech, sentences};
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
    /// It may only answer the question which one is meant: "the blue one".
    pub answer: bool,
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
    for mut sentence in sentences(text) {
        leave_out_opener(lexicon, &mut sentence);
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

/// "It turns out that I broke the vase" is "I broke the vase".
fn leave_out_opener(lexicon: &Lexicon, sentence: &mut Sentence) {
    let tokens = &sentence.tokens;
    let interjection = |token: &Token| {
        !token.word || lexicon.words.interjections.contains(&token.text)
    };
    let from = tokens.iter().take_while(|token| interjection(token)).count();
    let fits = |phrase: &&String| {
        let words = phrase.split([' ', '\'']).filter(|word| !word.is_empty());
        let mut at = from;
        for word in words {
            let same = tokens.get(at).is_some_and(|token| token.text.trim_start_matches('\'') == word);
            if !same {
                return None;
            }
            at += 1;
        }
        Some(at)
    };
    let end = lexicon.words.openers.iter().filter_map(|phrase| fits(&phrase)).max();
    if let Some(end) = end.filter(|end| *end < tokens.len()) {
        sentence.tokens.drain(..end);
    }
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
    let pair = |a: &str, b: &[&str]| tokens.windows(2).any(|two| two[0].is(a) && b.iter().any(|b| two[1].is(b)));
    if pair("in", &["case"]) {
        return Some("a condition");
    }
    if pair("every", &["day", "morning", "evening", "night", "week", "time", "month", "year", "weekend", "afternoon"]) {
        return Some("a habit");
    }
    let first = tokens.iter().position(|token| {
        token.word && !words.interjections.contains(&token.text) && !words.conjunctions.contains(&token.text)
    });
    let first = first.map_or("", |n| tokens[n].text.as_str());
    if matches!(first, "none" | "nobody" | "neither" | "nothing") || pair("no", &["one"]) {
        return Some("a negation");
    }
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
        let find = clause.verb.as_ref().is_some_and(|verb| verb.lemma == "find");
        if find && clause.unreal == Some(Unreal::Possible) && clause.subject == Subject::Pronoun("you".to_owned()) {
            return None;
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
        if (verb.frame == Frame::Have && !clause.past) || verb.passive && !matches!(verb.frame, Frame::None) {
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
        let subject = if second.is_empty() { subject } else { &[] };
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
}
