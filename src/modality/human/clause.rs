//! Clauses: subject, verb group, objects, places. A shallow grammar that reads from left to right.

use super::lemma::Form;
use super::lexicon::{Frame, Lexicon, Preposition};
use super::phrase::{Phrase, Words};
use super::reading::When;
use super::times::{self, TimeSpan};
use super::token::Sentence;
use crate::time::Stamp;

/// Who or what a clause is about.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) enum Subject {
    /// None said: "Moved the mug."
    #[default]
    Nobody,
    /// A pronoun: "I", "it".
    Pronoun(String),
    /// Things or people.
    Things(Vec<Phrase>),
    /// "there is".
    There,
}

/// What is not told as having happened, and why.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unreal {
    Negated,
    /// "will", "should", "want to".
    Possible,
    /// "always", "used to".
    Habit,
    /// "Anna says".
    Reported,
}

/// The verb of a clause.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Verb {
    pub frame: Frame,
    pub lemma: String,
    pub form: Form,
    /// "was moved": the subject is what changed.
    pub passive: bool,
    /// "is moving".
    pub progressive: bool,
    /// "have moved", "had moved".
    pub perfect: bool,
    /// "the vase broke".
    pub of_subject: bool,
    pub stative: bool,
}

/// A place or the like, after a preposition.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Place {
    pub role: Preposition,
    /// "with", "on".
    pub preposition: String,
    pub things: Vec<Phrase>,
}

/// One clause.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Clause {
    pub subject: Subject,
    /// None for a form of "be" alone, and where there is none at all.
    pub verb: Option<Verb>,
    /// A form of "be" is the verb.
    pub copula: bool,
    pub past: bool,
    pub objects: Vec<Phrase>,
    /// A second object without a preposition: "gave Anna the book".
    pub second: Vec<Phrase>,
    pub places: Vec<Place>,
    /// "here", "there", "outside".
    pub adverb: Option<String>,
    /// Words after "be" that are neither places nor things: "gone".
    pub state: Vec<String>,
    pub unreal: Option<Unreal>,
    pub when: Option<When>,
    /// It lies ahead: "tomorrow".
    pub future: bool,
    pub just: bool,
    pub already: bool,
    /// "no longer", "not … any more", "left".
    pub no_longer: bool,
    /// "now", "again".
    pub now: bool,
    /// "instead", "not the mug but".
    pub belief: bool,
    /// Bytes of the text.
    pub span: (usize, usize),
}

/// The clauses of a sentence, or why it is no report as a whole.
pub(super) fn parse(lexicon: &Lexicon, sentence: &Sentence, said_at: Stamp) -> Vec<Clause> {
    let spans = times::find(lexicon, &sentence.tokens, said_at);
    let mut time = vec![false; sentence.tokens.len()];
    for span in &spans {
        time[span.from..span.to].fill(true);
    }
    let words = Words { lexicon, tokens: &sentence.tokens, time };
    let mut parser = Parser { words, spans, clauses: Vec::new(), reported: false, belief: false };
    parser.sentence();
    parser.clauses
}

struct Parser<'a> {
    words: Words<'a>,
    spans: Vec<TimeSpan>,
    clauses: Vec<Clause>,
    reported: bool,
    belief: bool,
}

/// What was read of a verb group.
#[derive(Clone, Debug, Default)]
struct Group {
    verb: Option<Verb>,
    copula: bool,
    past: bool,
    unreal: Option<Unreal>,
    no_longer: bool,
    just: bool,
    already: bool,
    now: bool,
    next: usize,
}

impl Parser<'_> {
    fn sentence(&mut self) {
        let mut at = 0;
        while at < self.words.tokens.len() {
            let next = self.clause(at);
            at = next.max(at + 1);
        }
        // A time at the beginning is that of the whole sentence.
        let leading = self.spans.iter().find(|span| span.from <= 2 && span.when.is_some());
        let leading = leading.and_then(|span| span.when);
        for clause in &mut self.clauses {
            clause.when = clause.when.or(leading);
        }
    }

    /// Reads the clause that begins at `at`; where it ends.
    fn clause(&mut self, at: usize) -> usize {
        let mut clause = Clause { belief: self.belief, ..Clause::default() };
        let mut next = self.opening(at, &mut clause);
        let start = next;
        let mut unreal = None;
        if self.words.word(next) == "there" && self.be_follows(next + 1) {
            clause.subject = Subject::There;
            next += 1;
        } else if let Some(after) = self.subject(next, &mut clause) {
            next = after;
        } else if let Some(before) = self.inherits(next) {
            clause.subject = before.subject;
            unreal = before.unreal.filter(|_| self.words.has_form(next, &[Form::Base, Form::Gerund]));
        }
        let group = self.verb_group(next, &clause.subject);
        if group.verb.is_none() && !group.copula {
            return self.without_verb(start, next, clause);
        }
        unreal = unreal.or(group.unreal);
        clause.verb = group.verb;
        clause.copula = group.copula;
        clause.past = group.past;
        clause.no_longer |= group.no_longer;
        clause.just |= group.just;
        clause.now |= group.now;
        clause.already |= group.already;
        clause.unreal = if self.reported { Some(Unreal::Reported) } else { unreal };
        let next = self.arguments(group.next, &mut clause);
        self.finish(at, next, clause)
    }

    fn finish(&mut self, from: usize, to: usize, mut clause: Clause) -> usize {
        let tokens = self.words.tokens;
        let to = to.max(from + 1).min(tokens.len());
        clause.span = (tokens[from].span.0, tokens[to - 1].span.1);
        for span in self.spans.iter().filter(|span| span.from >= from && span.from < to) {
            clause.when = clause.when.or(span.when);
            clause.future |= span.when.is_none();
        }
        let frame = clause.verb.as_ref().map(|verb| verb.frame);
        let speaker = matches!(&clause.subject, Subject::Pronoun(who) if who == "i");
        match frame {
            Some(Frame::Belief) if speaker && clause.unreal.is_none() && !clause.past => {
                self.belief = true;
            }
            // "I told you that …" is still the speaker's own report.
            Some(Frame::Report) if speaker && clause.verb.as_ref().is_some_and(|it| matches!(it.lemma.as_str(), "tell" | "say" | "mention")) => {}
            // "I thought" tells of an error.
            Some(Frame::Report | Frame::Belief) => self.reported = true,
            // "I hope the keys are …".
            Some(Frame::Wish) => self.reported |= tokens.get(to).is_some_and(|next| next.word && !self.words.is_in(&self.words.lexicon.words.conjunctions, to)),
            _ => {}
        }
        self.clauses.push(clause);
        to
    }

    /// Skips what may stand before a clause.
    fn opening(&self, at: usize, clause: &mut Clause) -> usize {
        let lists = &self.words.lexicon.words;
        let mut next = at;
        while next < self.words.tokens.len() {
            let word = self.words.word(next);
            clause.just |= word == "just";
            clause.already |= word == "already";
            clause.now |= word == "now";
            let comma = !self.words.tokens[next].word;
            let skipped = comma
                || self.words.is_time(next)
                || self.words.is_in(&lists.conjunctions, next)
                || self.words.is_in(&lists.subordinators, next)
                || (word == "that" && next > at && self.words.word(next + 1) != "is")
                || (word == "that" && self.words.is_in(&lists.subjects, next + 1))
                || (self.words.is_in(&lists.adverbs, next) && !self.words.is_in(&lists.determiners, next) && !(word == "all" || word == "both"))
                || (self.words.is_in(&lists.interjections, next) && !self.negative_noun(next));
            if skipped {
                next += 1;
                continue;
            }
            // "In the kitchen there is …": the place comes first.
            if clause.places.is_empty() && self.words.verb(next).is_empty()
                && let Some((place, after)) = self.place(next)
                && !matches!(place.preposition.as_str(), "like")
            {
                clause.places.push(place);
                next = after;
                continue;
            }
            break;
        }
        next
    }

    /// "no" as in "no milk", not as in "no, …".
    fn negative_noun(&self, at: usize) -> bool {
        matches!(self.words.word(at), "no") && (self.words.is_plain(at + 1) || matches!(self.words.word(at + 1), "more"))
    }

    fn be_follows(&self, at: usize) -> bool {
        self.words.is_in(&self.words.lexicon.words.be, at)
            || (self.words.is_in(&self.words.lexicon.words.adverbs, at) && self.words.is_in(&self.words.lexicon.words.be, at + 1))
            || self.words.is_in(&self.words.lexicon.words.modals, at)
            || (self.words.is_in(&self.words.lexicon.words.have, at) && self.words.word(at + 1) == "been")
            || matches!(self.words.word(at), "used")
    }

    fn subject(&self, at: usize, clause: &mut Clause) -> Option<usize> {
        let lists = &self.words.lexicon.words;
        let word = self.words.word(at);
        let demonstrative = matches!(word, "this" | "that" | "these" | "those") && self.verb_follows(at + 1);
        if self.words.is_in(&lists.subjects, at) || demonstrative {
            clause.subject = Subject::Pronoun(word.to_owned());
            return Some(at + 1);
        }
        // A verb without a subject: "put", unless it is a noun here.
        let (mut things, mut next) = self.list(at, true)?;
        // "the mug on the desk is …": the place tells which.
        if let (Some((place, after)), Some(last)) = (self.place(next), things.last_mut())
            && place.role != Preposition::Other
            && self.verb_follows(after)
            && !self.verb_follows(next)
        {
            last.mention.at.extend(place.things.into_iter().map(|it| it.mention));
            next = after;
        }
        if !self.verb_follows(next) && self.words.has_form(at, &[Form::Base, Form::Past]) {
            return None;
        }
        clause.subject = Subject::Things(things);
        Some(next)
    }

    /// The clause whose subject a verb without one shares.
    fn inherits(&self, at: usize) -> Option<Clause> {
        let before = self.clauses.last()?;
        (!self.words.verb(at).is_empty()).then(|| before.clone())
    }

    /// Whether a finite verb begins here.
    fn verb_follows(&self, at: usize) -> bool {
        let lists = &self.words.lexicon.words;
        let mut next = at;
        while self.words.is_in(&lists.adverbs, next) || self.words.is_time(next) || self.words.is_in(&lists.habits, next) {
            next += 1;
        }
        let auxiliary = [&lists.be, &lists.have, &lists.r#do, &lists.modals];
        auxiliary.iter().any(|list| self.words.is_in(list, next))
            || self.words.has_form(next, &[Form::Past, Form::Present, Form::Base])
            || (self.words.has_form(next, &[Form::Participle]) && next == at)
    }

    fn verb_group(&self, at: usize, subject: &Subject) -> Group {
        let lists = &self.words.lexicon.words;
        let mut group = Group { next: at, ..Group::default() };
        let (mut be, mut perfect, mut next) = (false, false, at);
        while next < self.words.tokens.len() {
            let word = self.words.word(next);
            if self.words.is_time(next) {
                next += 1;
            } else if (word == "no" && self.words.word(next + 1) == "longer") || word == "longer" {
                group.no_longer = true;
                next += if word == "no" { 2 } else { 1 };
            } else if self.words.is_in(&lists.negations, next) {
                group.unreal = Some(Unreal::Negated);
                next += 1;
            } else if self.words.is_in(&lists.habits, next) {
                group.unreal = Some(Unreal::Habit);
                next += 1;
            } else if self.words.is_in(&lists.guesses, next) {
                group.unreal = Some(Unreal::Possible);
                next += 1;
            } else if self.words.is_in(&lists.adverbs, next) && !(be && word == "off") {
                group.just |= word == "just";
                group.already |= word == "already";
                group.now |= matches!(word, "now" | "currently");
                next += 1;
            } else if word == "used" && self.words.word(next + 1) == "to" {
                group.unreal = Some(Unreal::Habit);
                next += 2;
            } else if matches!(word, "going" | "about" | "supposed" | "able" | "ready" | "meant") && be && self.words.word(next + 1) == "to" {
                group.unreal = Some(Unreal::Possible);
                next += 2;
            } else if self.words.is_in(&lists.modals, next) {
                group.unreal = group.unreal.or(Some(Unreal::Possible));
                next += 1;
            } else if self.words.is_in(&lists.r#do, next) {
                group.past |= word == "did";
                next += 1;
            } else if self.is_have(next, word) {
                let past = word == "had";
                if self.words.word(next + 1) == "to" {
                    // "had to throw it away" tells that it was done; "have to" does not.
                    group.unreal = group.unreal.or((!past).then_some(Unreal::Possible));
                    group.past |= past;
                    next += 2;
                    perfect = past;
                    continue;
                }
                if self.perfect_follows(next + 1) {
                    perfect = true;
                    next += 1;
                    continue;
                }
                group.verb = self.main_verb(next, Form::Base);
                group.past |= past;
                group.next = next + 1;
                break;
            } else if self.words.is_in(&lists.be, next) && !be {
                if word == "'s" && self.perfect_follows(next + 1) && self.object_after_participle(next + 1) {
                    perfect = true;
                } else {
                    be = true;
                    group.past |= self.words.is_in(&lists.be_past, next);
                }
                next += 1;
            } else if self.words.is_in(&lists.be, next) {
                next += 1;
            } else if self.words.is_in(&lists.gone_words, next) && !perfect && (be || self.words.word(next) == "gone") {
                break;
            } else if !self.words.verb(next).is_empty() && !(be && self.noun_after_be(next)) {
                self.take_verb(next, be, perfect, &mut group);
                break;
            } else {
                break;
            }
        }
        if group.verb.is_none() && be {
            group.copula = true;
            group.next = next;
        } else if group.verb.is_none() {
            self.unknown_verb(next, subject, &mut group);
        }
        group
    }

    fn is_have(&self, at: usize, word: &str) -> bool {
        self.words.is_in(&self.words.lexicon.words.have, at) && word != "having"
    }

    /// "is a watch", "is the book": a noun that could be a verb.
    fn noun_after_be(&self, at: usize) -> bool {
        !self.words.has_form(at, &[Form::Participle, Form::Gerund, Form::Past])
    }

    fn perfect_follows(&self, at: usize) -> bool {
        let lists = &self.words.lexicon.words;
        let mut next = at;
        while self.words.is_in(&lists.adverbs, next) || self.words.is_in(&lists.negations, next) || self.words.is_in(&lists.habits, next) {
            next += 1;
        }
        self.words.word(next) == "been"
            || self.words.has_form(next, &[Form::Participle])
            || (next > at && self.words.has_form(next, &[Form::Past]))
    }

    fn object_after_participle(&self, at: usize) -> bool {
        let mut next = at;
        while self.words.verb(next).is_empty() && next < at + 3 {
            next += 1;
        }
        self.words.noun_starts(next + 1) || self.words.is_plain(next + 1)
    }

    fn main_verb(&self, at: usize, wanted: Form) -> Option<Verb> {
        let forms = self.words.verb(at);
        let form = forms.iter().find(|it| it.form == wanted).or(forms.first())?;
        let entry = &self.words.lexicon.verbs[form.verb];
        Some(Verb {
            frame: entry.frame,
            lemma: entry.verb.clone(),
            form: form.form,
            passive: false,
            progressive: false,
            perfect: false,
            of_subject: entry.subject,
            stative: entry.stative,
        })
    }

    fn take_verb(&self, at: usize, be: bool, perfect: bool, group: &mut Group) {
        let gerund = self.words.has_form(at, &[Form::Gerund]);
        let wanted = match (be || perfect, gerund) {
            (_, true) => Form::Gerund,
            (true, _) => Form::Participle,
            _ => Form::Past,
        };
        let Some(mut verb) = self.main_verb(at, wanted) else { return };
        verb.passive = be && !gerund && !perfect || be && perfect && !gerund;
        verb.progressive = be && gerund;
        verb.perfect = perfect;
        group.past |= matches!(verb.form, Form::Past) || perfect;
        group.next = at + 1;
        group.verb = Some(verb);
    }

    /// After "I", whatever is no function word is a verb, known or not.
    fn unknown_verb(&self, at: usize, subject: &Subject, group: &mut Group) {
        let word = self.words.word(at);
        let looks = word.ends_with("ed") && matches!(subject, Subject::Things(_));
        if (matches!(subject, Subject::Pronoun(_)) && self.words.is_plain(at)) || looks {
            group.verb = Some(Verb {
                frame: Frame::None,
                lemma: word.to_owned(),
                form: Form::Past,
                passive: false,
                progressive: false,
                perfect: false,
                of_subject: false,
                stative: false,
            });
            group.next = at + 1;
        }
    }

    /// "and the vase to the bedroom": the verb is that of the clause before; or a headline:
    /// "No more milk", "New plant in the bedroom".
    fn without_verb(&mut self, start: usize, next: usize, mut clause: Clause) -> usize {
        let Subject::Things(things) = std::mem::take(&mut clause.subject) else {
            // "no, in the bathroom": a place alone.
            if clause.places.is_empty() || next < self.words.tokens.len() {
                return next.max(start + 1);
            }
            return self.finish(start.min(next - 1), next, clause);
        };
        let before = self.clauses.last().cloned();
        let mut to = next;
        clause.objects = things;
        if let Some(before) = before.filter(|it| it.verb.is_some() && !it.objects.is_empty()) {
            clause.subject = before.subject.clone();
            clause.verb.clone_from(&before.verb);
            clause.unreal = before.unreal;
            clause.past = before.past;
            clause.when = before.when;
            clause.just = before.just;
            to = self.arguments(next, &mut clause);
            if clause.places.is_empty() {
                clause.places = before.places;
            }
        } else {
            clause.subject = Subject::Nobody;
            to = self.arguments(to, &mut clause);
        }
        clause.unreal = if self.reported { Some(Unreal::Reported) } else { clause.unreal };
        self.finish(start, to, clause)
    }

    /// Noun phrases joined by commas and "and".
    fn list(&self, at: usize, subject: bool) -> Option<(Vec<Phrase>, usize)> {
        let (first, mut next) = self.words.noun_phrase(at)?;
        let mut all = vec![first];
        loop {
            let mut after = next;
            let mut joined = false;
            while matches!(self.words.word(after), "," | "and" | "&" | "plus") || (joined && self.words.word(after) == "also") {
                joined = true;
                after += 1;
            }
            if self.words.word(after) == "as" && self.words.word(after + 1) == "well" && self.words.word(after + 2) == "as" {
                joined = true;
                after += 3;
            }
            let verb = self.words.has_form(after, &[Form::Base])
                && (self.words.preposition(after + 1).is_some() || self.words.noun_starts(after + 1) || self.words.is_plain(after + 1));
            let Some((phrase, end)) = self.words.noun_phrase(after).filter(|_| joined && !verb) else { break };
            if phrase.pronoun && !subject && self.verb_follows(end) {
                break;
            }
            // "… and the vase broke": another clause.
            let clause = !subject && self.verb_follows(end);
            // "… and the vase to the bedroom", after a first thing that already has its place.
            if clause || all.len() >= 64 {
                break;
            }
            all.push(phrase);
            next = end;
        }
        Some((all, next))
    }

    /// A preposition and what follows it.
    fn place(&self, at: usize) -> Option<(Place, usize)> {
        let (length, role) = self.words.preposition(at)?;
        let preposition: Vec<&str> = (at..at + length).map(|n| self.words.word(n)).collect();
        let preposition = preposition.join(" ");
        let (things, next) = match (preposition.as_str(), role) {
            ("between" | "with" | "for", _) | (_, Preposition::Source) => self.list(at + length, false)?,
            _ => {
                let (thing, next) = self.words.noun_phrase(at + length)?;
                (vec![thing], next)
            }
        };
        Some((Place { role, preposition, things }, next))
    }

    /// Everything after the verb.
    fn arguments(&mut self, at: usize, clause: &mut Clause) -> usize {
        let lists = &self.words.lexicon.words;
        let mut next = at;
        while next < self.words.tokens.len() {
            let word = self.words.word(next);
            if self.words.is_time(next) {
                next += 1;
            } else if let Some(after) = self.particle(next, clause) {
                next = after;
            } else if matches!(word, "," | "and" | "then" | "but" | "or" | "&" | "so") {
                if word == "," && self.goes_on_after_comma(next + 1) {
                    next += 1;
                    continue;
                }
                break;
            } else if self.words.is_in(&lists.subordinators, next) {
                break;
            } else if word == "to" && self.infinitive(next + 1) {
                return self.to_boundary(next + 1);
            } else if let Some((place, after)) = self.place(next) {
                clause.places.push(place);
                next = after;
            } else if self.words.is_in(&lists.places_adverbs, next) {
                clause.adverb = Some(word.to_owned());
                next += 1;
            } else if self.words.is_in(&lists.negations, next) {
                clause.unreal = clause.unreal.or(Some(Unreal::Negated));
                next += 1;
            } else if self.words.is_in(&lists.guesses, next) {
                clause.unreal = clause.unreal.or(Some(Unreal::Possible));
                next += 1;
            } else if word == "anymore" || (word == "any" && matches!(self.words.word(next + 1), "more" | "longer")) {
                clause.no_longer = true;
                next += if word == "any" { 2 } else { 1 };
            } else if matches!(word, "more" | "left") && (clause.copula || clause.verb.as_ref().is_none_or(|it| it.frame == Frame::Have)) {
                clause.state.push(word.to_owned());
                next += 1;
            } else if lists.gone_words.contains(word) && (clause.copula || clause.verb.is_none()) {
                clause.state.push(word.to_owned());
                next += 1;
            } else if self.adverb(next, clause) {
                next += 1;
            } else if let Some(after) = self.second_verb(next, clause) {
                next = after;
            } else if self.new_clause(next, clause) {
                break;
            } else if let Some((things, after)) = self.list(next, false) {
                if clause.objects.is_empty() {
                    clause.objects = things;
                } else if clause.second.is_empty() {
                    clause.second = things;
                }
                next = after;
            } else if !self.words.verb(next).is_empty() && clause.verb.is_some() {
                break;
            } else {
                if clause.copula {
                    clause.state.push(word.to_owned());
                }
                next += 1;
            }
        }
        next
    }

    fn adverb(&self, at: usize, clause: &mut Clause) -> bool {
        let lists = &self.words.lexicon.words;
        let word = self.words.word(at);
        let adjective = self.words.is_in(&lists.adjectives, at) && self.words.is_plain(at + 1);
        let determiner = self.words.is_in(&lists.determiners, at) || matches!(word, "all" | "both");
        if adjective || determiner || !(self.words.is_in(&lists.adverbs, at) || self.words.is_in(&lists.interjections, at)) {
            return false;
        }
        clause.just |= word == "just";
        clause.already |= word == "already";
        clause.now |= matches!(word, "now" | "currently" | "again");
        true
    }

    /// ", from the kitchen" goes on; ", I …" does not.
    fn goes_on_after_comma(&self, at: usize) -> bool {
        self.place(at).is_some_and(|(_, after)| !self.verb_follows(after) && self.words.word(after) != "there")
    }

    fn infinitive(&self, at: usize) -> bool {
        let mut next = at;
        while self.words.is_in(&self.words.lexicon.words.adverbs, next) {
            next += 1;
        }
        self.words.has_form(next, &[Form::Base]) && !self.words.is_in(&self.words.lexicon.words.nouns_too, next)
            || (self.words.has_form(next, &[Form::Base]) && self.words.noun_starts(next + 1))
            || self.words.word(next) == "be"
            || self.words.word(next) == "have"
    }

    /// Skips an infinitive to the next comma or conjunction.
    fn to_boundary(&self, at: usize) -> usize {
        let stops = |n: &usize| matches!(self.words.word(*n), "," | "and" | "but" | "then" | "so" | "because");
        (at..self.words.tokens.len()).find(stops).unwrap_or(self.words.tokens.len())
    }

    /// The particle of the verb, which may change what it means.
    fn particle(&self, at: usize, clause: &mut Clause) -> Option<usize> {
        let verb = clause.verb.as_mut()?;
        let entry = self.words.lexicon.verbs.iter().find(|it| it.verb == verb.lemma)?;
        let of_two = [self.words.word(at), self.words.word(at + 1)].join(" ");
        if let Some(frame) = entry.with.get(&of_two) {
            verb.frame = *frame;
            return Some(at + 2);
        }
        let word = self.words.word(at);
        let longer = self.words.preposition(at).is_some_and(|(length, _)| length > 1);
        let place = matches!(word, "in" | "on" | "over" | "along" | "behind" | "off") && self.words.noun_phrase(at + 1).is_some();
        if let Some(frame) = entry.with.get(word).filter(|_| !longer && !place) {
            verb.frame = *frame;
            return Some(at + 1);
        }
        let loose = self.words.is_in(&self.words.lexicon.words.particles, at)
            && !longer
            && self.words.noun_phrase(at + 1).is_none()
            && !self.words.is_in(&self.words.lexicon.words.places_adverbs, at)
            && self.place(at).is_none();
        loose.then_some(at + 1)
    }

    /// "finished eating the soup", "had the sofa moved", "got eaten": the second verb tells.
    fn second_verb(&self, at: usize, clause: &mut Clause) -> Option<usize> {
        let verb = clause.verb.as_ref()?;
        let entry = self.words.lexicon.verbs.iter().find(|it| it.verb == verb.lemma)?;
        let gerund = self.words.has_form(at, &[Form::Gerund]) && entry.aspect && clause.objects.is_empty();
        let participle = self.words.has_form(at, &[Form::Participle]) && matches!(verb.frame, Frame::Have | Frame::Get);
        if !gerund && !participle {
            return None;
        }
        let (form, past) = (verb.form, verb.perfect);
        let mut second = self.main_verb(at, if gerund { Form::Gerund } else { Form::Participle })?;
        second.perfect = past;
        second.form = if gerund { form } else { Form::Past };
        second.passive = participle && clause.objects.is_empty();
        clause.verb = Some(second);
        Some(at + 1)
    }

    /// Whether a clause with a subject of its own begins here: "I think I left …".
    fn new_clause(&self, at: usize, clause: &Clause) -> bool {
        let lists = &self.words.lexicon.words;
        let word = self.words.word(at);
        let verb = clause.verb.is_some();
        if word == "that" && verb && (self.words.is_in(&lists.subjects, at + 1) || clause.verb.as_ref().is_some_and(|it| matches!(it.frame, Frame::Report | Frame::Belief))) {
            return true;
        }
        if self.words.is_in(&lists.subjects, at) && !matches!(word, "it" | "you") {
            return true;
        }
        if matches!(word, "it" | "you" | "there") && self.verb_follows(at + 1) && verb {
            return true;
        }
        // "I think the mug is …".
        let believes = clause.verb.as_ref().is_some_and(|it| matches!(it.frame, Frame::Report | Frame::Belief | Frame::Wish | Frame::Seen | Frame::None));
        believes && self.list(at, true).is_some_and(|(_, after)| self.verb_follows(after) && !self.words.has_form(after, &[Form::Base]))
    }
}

impl Clause {
    /// Whether one of its things is of another household.
    pub fn elsewhere(&self, lexicon: &Lexicon) -> bool {
        let lists = &lexicon.words;
        let home = |phrase: &Phrase| {
            let head = phrase.mention.noun.rsplit(' ').next().unwrap_or_default();
            (phrase.others && lists.other_homes.contains(head)) || lists.elsewhere.contains(head)
        };
        let outsider = match &self.subject {
            Subject::Things(things) => things.iter().any(|it| it.others),
            _ => false,
        };
        let their = |phrase: &Phrase| (phrase.theirs && outsider) || phrase.others && phrase.mention.adjectives.iter().any(|it| lists.outsiders.contains(it.rsplit(' ').next().unwrap_or_default()));
        let old_home = |phrase: &Phrase| {
            let head = phrase.mention.noun.rsplit(' ').next().unwrap_or_default();
            lists.other_homes.contains(head) && (phrase.theirs || phrase.mention.adjectives.iter().any(|it| matches!(it.as_str(), "old" | "previous" | "former" | "first"))) && !matches!(head, "kitchen" | "garden" | "garage")
        };
        let places = self.places.iter().flat_map(|place| &place.things);
        let things = self.objects.iter().chain(&self.second);
        let subject = match &self.subject {
            Subject::Things(things) => things.as_slice(),
            _ => &[],
        };
        places.clone().any(|it| home(it) || old_home(it) || (it.theirs && outsider))
            || things.chain(subject).chain(places).any(their)
    }
}
