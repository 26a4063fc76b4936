//! From what a model answered to a [`Reading`], or the reason why it is none.
//!
//! A model may answer anything. What is taken holds to the schema, is short, and names things by
//! words that the sentence has: whatever a sentence or a label tells a model to do, it can speak
//! only of what the person spoke of. Whether an id exists, and is what the words say, is for
//! grounding to check against the graph.

use serde::Deserialize;

use super::model_excerpt::words;
use super::model_request::KINDS;
use super::{Mention, Quantity, Reading, Statement, When};
use crate::change::Action;
use crate::event::MAX_ANSWER;
use crate::graph::{Label, NodeId};

/// Changes that one sentence may report.
pub const MAX_CHANGES: usize = 16;
const MAX_ADJECTIVES: usize = 8;
const MAX_COUNT: i64 = 100;
/// A hundred years.
const MAX_HOURS: f64 = 24.0 * 366.0 * 100.0;
const S_PER_HOUR: f64 = 3600.0;

/// Why the answer of a model is not taken.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ReplyError {
    /// Nobody says so much.
    #[error("the answer has {bytes} bytes, at most {MAX_ANSWER} are read")]
    TooLong {
        /// How many.
        bytes: usize,
    },
    /// Not JSON, or not of the schema.
    #[error("the answer is not of the schema: {0}")]
    Schema(String),
    /// Of the schema, but not about the sentence.
    #[error("{place}: {problem}")]
    Field {
        /// Where in the answer: `changes[0].object.words`.
        place: String,
        /// What is wrong.
        problem: String,
    },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Answer {
    kind: String,
    changes: Vec<Change>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Change {
    action: Did,
    object: Named,
    support: Option<Named>,
    source_room: Option<Named>,
    target_room: Option<Named>,
    when: Option<Hours>,
    confidence: f64,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Did {
    Added,
    Moved,
    Removed,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Named {
    words: String,
    name: String,
    adjectives: Vec<String>,
    id: Option<String>,
    count: i64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Hours {
    earliest: f64,
    latest: f64,
}

/// Reads the answer to [`super::reading_request`] for `sentence`.
///
/// # Errors
/// [`ReplyError`] if anything in it is not as it was asked for: then nothing of it is taken.
pub fn parse_reading(sentence: &str, answer: &str) -> Result<Reading, ReplyError> {
    parse(sentence, answer, "report")
}

/// Reads the answer to [`super::task_request`] for `instruction`: each statement is something to
/// be carried, in order.
///
/// # Errors
/// As [`parse_reading`].
pub fn parse_task(instruction: &str, answer: &str) -> Result<Reading, ReplyError> {
    parse(instruction, answer, "command")
}

fn parse(sentence: &str, answer: &str, wanted: &str) -> Result<Reading, ReplyError> {
    if answer.len() > MAX_ANSWER {
        return Err(ReplyError::TooLong { bytes: answer.len() });
    }
    let schema = |error: serde_json::Error| ReplyError::Schema(error.to_string());
    let Answer { kind, changes } = serde_json::from_str(answer).map_err(schema)?;
    let Some(kind) = KINDS.iter().find(|known| **known == kind) else {
        return Err(field("kind", format!("{:?} is no kind of sentence", shown(&kind))));
    };
    if changes.len() > MAX_CHANGES {
        let problem = format!("{} are more than {MAX_CHANGES}", changes.len());
        return Err(field("changes", problem));
    }
    let statement = |(n, change): (usize, &Change)| {
        statement(sentence, change)
            .map_err(|error| field(&format!("changes[{n}].{}", error.0), error.1))
    };
    let statements: Vec<Statement> =
        changes.iter().enumerate().map(statement).collect::<Result<_, _>>()?;
    check_apart(&statements)?;
    if *kind == wanted {
        return Ok(Reading { statements, note: format!("read as {kind}") });
    }
    // Told apart first, listed second: the first is the surer judgement, and the safer one.
    let note = match statements.len() {
        0 => format!("read as {kind}"),
        n => format!("read as {kind}: the {n} change(s) that the model lists are left out"),
    };
    Ok(Reading { statements: Vec::new(), note })
}

/// The same words cannot name different things: a model that is talked into listing the house
/// has no words for it.
fn check_apart(statements: &[Statement]) -> Result<(), ReplyError> {
    let objects = || statements.iter().enumerate().map(|(n, it)| (n, &it.object));
    for (n, a) in objects() {
        for (_, b) in objects().take(n) {
            let overlap = match (a.span, b.span) {
                (Some(a), Some(b)) => a.0 < b.1 && b.0 < a.1,
                _ => false,
            };
            if overlap && (&a.noun, &a.id) != (&b.noun, &b.id) {
                let problem = format!("the same words name {} and {}", b.noun, a.noun);
                return Err(field(&format!("changes[{n}].object.words"), problem));
            }
        }
    }
    Ok(())
}

/// Where in a change, and what is wrong.
type Problem = (String, String);

fn field(place: &str, problem: String) -> ReplyError {
    ReplyError::Field { place: place.to_owned(), problem }
}

fn statement(sentence: &str, change: &Change) -> Result<Statement, Problem> {
    let mention = |place: &str, named: &Option<Named>| {
        let named = named.as_ref().map(|named| mention(sentence, named));
        named.transpose().map_err(|(field, problem)| (format!("{place}.{field}"), problem))
    };
    let within = |place: &str, (field, problem): Problem| (format!("{place}.{field}"), problem);
    Ok(Statement {
        action: match change.action {
            Did::Added => Action::Added,
            Did::Moved => Action::Moved,
            Did::Removed => Action::Removed,
        },
        object: self::mention(sentence, &change.object).map_err(|e| within("object", e))?,
        support: mention("support", &change.support)?,
        source_room: mention("source_room", &change.source_room)?,
        target_room: mention("target_room", &change.target_room)?,
        when: change.when.as_ref().map(when).transpose()?,
        confidence: confidence(change.confidence)?,
    })
}

fn mention(sentence: &str, named: &Named) -> Result<Mention, Problem> {
    let wrong = |place: &str, problem: String| Err((place.to_owned(), problem));
    let Some(span) = find_words(sentence, named.words.trim()) else {
        return wrong("words", format!("{:?} is not in the sentence", shown(&named.words)));
    };
    if !names_something(&named.words) {
        return wrong("words", format!("{:?} names nothing", shown(&named.words)));
    }
    let name = named.name.trim();
    if let Err(error) = Label::new(name) {
        return wrong("name", error.to_string());
    }
    if let Some(id) = &named.id
        && id.parse::<NodeId>().is_err()
    {
        return wrong("id", format!("{:?} is no id", shown(id)));
    }
    let said = |word: &String| find_words(sentence, word.trim()).is_some();
    if named.adjectives.len() > MAX_ADJECTIVES || !named.adjectives.iter().all(said) {
        return wrong("adjectives", "they are not all in the sentence".to_owned());
    }
    let quantity = match named.count {
        0 => Quantity::All,
        1 => Quantity::One,
        n @ 2..=MAX_COUNT => Quantity::Count(n as u32),
        n => return wrong("count", format!("{n} is not between 0 and {MAX_COUNT}")),
    };
    let adjectives = named.adjectives.iter().map(|word| word.trim().to_lowercase()).collect();
    // One thing may go by a name that only the model knows; many may not.
    let alike = || words(name).iter().any(|word| words(&named.words).contains(word));
    if quantity != Quantity::One && !alike() {
        let words = shown(&named.words);
        return wrong("count", format!("{words:?} does not name several of {name}"));
    }
    let definite = quantity != Quantity::One || is_definite(sentence, span);
    let (id, noun, span) = (named.id.clone(), name.to_owned(), Some(span));
    Ok(Mention { noun, adjectives, quantity, id, span, definite, ..Mention::default() })
}

/// Words that name nothing by themselves: whoever tells a model of "everything" names nothing.
const EMPTY: [&str; 48] = [
    "a",
    "all",
    "an",
    "and",
    "another",
    "any",
    "anything",
    "both",
    "each",
    "every",
    "everybody",
    "everyone",
    "everything",
    "from",
    "he",
    "her",
    "hers",
    "him",
    "his",
    "i",
    "in",
    "into",
    "it",
    "its",
    "me",
    "my",
    "of",
    "on",
    "one",
    "ones",
    "our",
    "she",
    "some",
    "something",
    "stuff",
    "that",
    "the",
    "their",
    "them",
    "these",
    "they",
    "thing",
    "things",
    "this",
    "those",
    "to",
    "we",
    "you",
];

fn names_something(words: &str) -> bool {
    let mut each = words.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    each.any(|word| !EMPTY.contains(&&*word.to_lowercase()))
}

/// Whether the words are of something known: "the mug", not "a mug".
fn is_definite(sentence: &str, (start, end): (usize, usize)) -> bool {
    let article = |word: &str| matches!(&*word.to_lowercase(), "a" | "an" | "another" | "some");
    let first = sentence[start..end].split_whitespace().next();
    let before = sentence[..start].split_whitespace().next_back();
    !first.into_iter().chain(before).any(article)
}

fn when(hours: &Hours) -> Result<When, Problem> {
    let Hours { earliest, latest } = *hours;
    if (0.0..=MAX_HOURS).contains(&latest) && (latest..=MAX_HOURS).contains(&earliest) {
        // Adding zero turns −0.0 into 0.0.
        let seconds = |hours: f64| hours * S_PER_HOUR + 0.0;
        return Ok(When { earliest_s: seconds(earliest), latest_s: seconds(latest) });
    }
    let problem = format!("{earliest} to {latest} is no stretch of hours before now");
    Err(("when".to_owned(), problem))
}

fn confidence(value: f64) -> Result<f64, Problem> {
    match (0.0..=1.0).contains(&value) {
        true => Ok(value + 0.0),
        false => Err(("confidence".to_owned(), format!("{value} is not between 0 and 1"))),
    }
}

/// Where `words` stand in `sentence`, whole words and in whatever case; the first place.
fn find_words(sentence: &str, words: &str) -> Option<(usize, usize)> {
    if words.is_empty() {
        return None;
    }
    let inner = |c: Option<char>| c.is_some_and(char::is_alphanumeric);
    sentence.char_indices().find_map(|(start, _)| {
        let length = prefix_length(&sentence[start..], words)?;
        let end = start + length;
        let (before, after) =
            (sentence[..start].chars().next_back(), sentence[end..].chars().next());
        let cuts_in = inner(before) && inner(words.chars().next());
        let cuts_off = inner(after) && inner(words.chars().next_back());
        (!cuts_in && !cuts_off).then_some((start, end))
    })
}

/// Bytes of the beginning of `text` that are `words` but for case.
fn prefix_length(text: &str, words: &str) -> Option<usize> {
    let mut characters = text.chars();
    for wanted in words.chars() {
        let found = characters.next()?;
        if found != wanted && !found.to_lowercase().eq(wanted.to_lowercase()) {
            return None;
        }
    }
    Some(text.len() - characters.as_str().len())
}

/// The beginning of a text that a model made up.
fn shown(text: &str) -> String {
    text.chars().take(60).collect()
}
