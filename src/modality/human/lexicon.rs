//! The lexicon: verbs, function words, names of things and expressions of time, as data.
//!
//! The files in `lexicon/` are JSON with a schema in `schemas/lexicon/`; to teach the interpreter
//! a word, add it there. They are embedded and read once.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::LazyLock;

use serde::Deserialize;

use super::lemma::{self, Form};
use super::names::Names;

/// What a verb says of its object.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Frame {
    /// It is not there any more: eaten, sold, broken.
    Gone,
    /// "ran out of milk", "the milk ran out".
    Spent,
    /// Thrown: gone if into the bin or nowhere, put elsewhere otherwise.
    Toss,
    /// Taken from where it was; where to is told elsewhere, or it is gone.
    Take,
    /// "took out": from something, or to the bin.
    Out,
    /// Now where it was put.
    Place,
    /// Put away: where, nobody says.
    Store,
    /// Known, and elsewhere now.
    Move,
    /// Brought: known or new.
    Bring,
    /// New.
    Acquire,
    /// "made a cake" is new, "made the bed" is nothing.
    Make,
    /// Bought or fetched: "got a new lamp", "got the mug from the kitchen".
    Get,
    /// Back where it was before.
    Return,
    /// Each in the place of the other.
    Swap,
    /// One gone, the other in its place.
    Replace,
    /// The subject is new.
    Arrive,
    /// Seen there, so it is there.
    Seen,
    /// "we have a new lamp in the hall".
    Have,
    /// What somebody says, thinks up or asks: what follows is not told as true.
    Report,
    /// What the speaker believes: told, with less confidence.
    Belief,
    /// What is wanted, planned or tried.
    Wish,
    /// "I mean the red one".
    Mean,
    /// Changes nothing.
    None,
}

/// A verb.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Verb {
    pub verb: String,
    past: Option<String>,
    part: Option<String>,
    ing: Option<String>,
    pub frame: Frame,
    /// Other frames, by the particle that goes with the verb: "throw … away".
    #[serde(default)]
    pub with: BTreeMap<String, Frame>,
    /// Without an object, the subject is what changes: "the vase broke".
    #[serde(default)]
    pub subject: bool,
    /// "finished eating": the verb that follows tells what was done.
    #[serde(default)]
    pub aspect: bool,
    /// "the vase stands on the shelf": its present tense tells a place.
    #[serde(default)]
    pub stative: bool,
}

#[derive(Debug, Deserialize)]
struct VerbFile {
    verbs: Vec<Verb>,
}

macro_rules! word_lists {
    ($($name:ident),* $(,)?) => {
        /// Function words, by what they do.
        #[derive(Debug, Deserialize)]
        pub(super) struct Words {
            pub numbers: BTreeMap<String, u32>,
            $(pub $name: BTreeSet<String>,)*
        }
    };
}

word_lists!(
    determiners, indefinite, possessives, subjects, objects, persons, be, be_past, have, r#do, modals,
    negations, conditionals, guesses, habits, subordinators, conjunctions, questions, interjections,
    adverbs, particles, places_adverbs, goal, strong_goal, near, source,
    other_prepositions, adjectives, colours, sizes, novelty, nouns_too, foreign,
    outsiders, elsewhere, other_homes, away_places, waste, rooms, partitives, parts, pluralia,
    gone_words, beings, abstract_nouns, light_objects, consumables, openers,
);

/// Expressions of time.
#[derive(Debug, Deserialize)]
pub(super) struct Times {
    /// Seconds of a unit.
    pub units: BTreeMap<String, f64>,
    /// Phrases and the seconds before now they mean: at most, at least.
    pub spans: BTreeMap<String, [f64; 2]>,
    /// Hours of a part of the day, from midnight.
    pub parts: BTreeMap<String, [u32; 2]>,
    pub weekdays: Vec<String>,
}

#[derive(Debug, Deserialize)]
struct ThingFile {
    synonyms: Vec<Vec<String>>,
    kinds: BTreeMap<String, Vec<String>>,
    typical: BTreeMap<String, Vec<String>>,
}

/// A form of a verb.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct VerbForm {
    /// Which verb, in [`Lexicon::verbs`].
    pub verb: usize,
    pub form: Form,
}

/// Everything the interpreter knows of words.
#[derive(Debug)]
pub(super) struct Lexicon {
    pub verbs: Vec<Verb>,
    pub forms: BTreeMap<String, Vec<VerbForm>>,
    pub words: Words,
    pub times: Times,
    pub names: Names,
    /// Prepositions by their first word, those of most words first.
    pub prepositions: BTreeMap<String, Vec<(Vec<String>, Preposition)>>,
}

/// What a preposition tells of the thing that follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Preposition {
    /// Where to: "into"; `true` if it can be nothing else.
    Goal(bool),
    /// Near it, not on it.
    Near,
    /// Where from.
    Source,
    /// Something else.
    Other,
}

/// The embedded lexicon.
pub(super) fn lexicon() -> &'static Lexicon {
    static LEXICON: LazyLock<Lexicon> = LazyLock::new(Lexicon::load);
    &LEXICON
}

fn parse<'a, T: Deserialize<'a>>(text: &'a str) -> T {
    serde_json::from_str(text).expect("the embedded lexicon follows its schema; a test reads it")
}

impl Lexicon {
    fn load() -> Self {
        let verbs = parse::<VerbFile>(include_str!("lexicon/verbs.json")).verbs;
        let words: Words = parse(include_str!("lexicon/words.json"));
        let things: ThingFile = parse(include_str!("lexicon/things.json"));
        let prepositions = prepositions(&words);
        let names = Names::new(&things.synonyms, &things.kinds, &things.typical);
        let times = parse(include_str!("lexicon/times.json"));
        Self { forms: forms(&verbs), verbs, words, times, names, prepositions }
    }
}

fn forms(verbs: &[Verb]) -> BTreeMap<String, Vec<VerbForm>> {
    let mut forms: BTreeMap<String, Vec<VerbForm>> = BTreeMap::new();
    for (verb, entry) in verbs.iter().enumerate() {
        let base = entry.verb.as_str();
        let past = entry.past.clone().unwrap_or_else(|| lemma::past(base));
        let part = entry.part.clone().unwrap_or_else(|| past.clone());
        let ing = entry.ing.clone().unwrap_or_else(|| lemma::gerund(base));
        let all = [
            (base.to_owned(), Form::Base),
            (lemma::third_person(base), Form::Present),
            (past, Form::Past),
            (part, Form::Participle),
            (ing, Form::Gerund),
        ];
        for (word, form) in all {
            forms.entry(word).or_default().push(VerbForm { verb, form });
        }
    }
    if let Some(verb) = verbs.iter().position(|it| it.verb == "have") {
        forms.entry("has".to_owned()).or_default().push(VerbForm { verb, form: Form::Present });
    }
    for (word, regular) in [("burned", "burn"), ("broke", "break"), ("dreamed", "dream"), ("hanged", "hang")] {
        if let Some(verb) = verbs.iter().position(|it| it.verb == regular) {
            for form in [Form::Past, Form::Participle] {
                forms.entry(word.to_owned()).or_default().push(VerbForm { verb, form });
            }
        }
    }
    forms
}

fn prepositions(words: &Words) -> BTreeMap<String, Vec<(Vec<String>, Preposition)>> {
    let mut all: BTreeMap<String, Vec<(Vec<String>, Preposition)>> = BTreeMap::new();
    let mut add = |list: &BTreeSet<String>, role: &dyn Fn(&str) -> Preposition| {
        for phrase in list {
            let words: Vec<String> = phrase.split(' ').map(str::to_owned).collect();
            all.entry(words[0].clone()).or_default().push((words, role(phrase)));
        }
    };
    add(&words.goal, &|phrase| Preposition::Goal(words.strong_goal.contains(phrase)));
    add(&words.near, &|_| Preposition::Near);
    add(&words.source, &|_| Preposition::Source);
    add(&words.other_prepositions, &|_| Preposition::Other);
    all.values_mut().for_each(|of| of.sort_by_key(|(words, _)| std::cmp::Reverse(words.len())));
    all
}
