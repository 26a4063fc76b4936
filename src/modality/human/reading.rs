//! What a sentence says, before it is known which nodes are meant: [`Reading`].

use crate::change::Action;

/// What a sentence says, whoever read it. A reading without statements changes nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reading {
    /// What it reports, in the order it is to be applied.
    pub statements: Vec<Statement>,
    /// Why it says nothing, or what was left out, in words for people; may be empty.
    pub note: String,
}

/// One change that a sentence reports.
#[derive(Clone, Debug, PartialEq)]
pub struct Statement {
    /// Whether something was added, moved or removed.
    pub action: Action,
    /// What.
    pub object: Mention,
    /// What it stands on or lies in now; for a removal, what it was on.
    pub support: Option<Mention>,
    /// Where it was.
    pub source_room: Option<Mention>,
    /// Where it is now.
    pub target_room: Option<Mention>,
    /// When it happened, relative to when it was said; none if that was not said.
    pub when: Option<When>,
    /// How sure the reader is, 0 to 1.
    pub confidence: f64,
}

/// Words that name a thing or a room.
///
/// With [`Action::Added`], a definite mention ("I put the mug on the desk") is of something that
/// may be known: if it is, it has moved; with [`Action::Moved`] and [`Action::Removed`] it must be.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mention {
    /// The noun without articles and adjectives, singular where that is known: "tv remote".
    pub noun: String,
    /// Adjectives: "red", "old".
    pub adjectives: Vec<String>,
    /// How many are meant.
    pub quantity: Quantity,
    /// The id of a node, where the reader chose one ("O17"); checked like any other claim.
    pub id: Option<String>,
    /// Bytes of the sentence that the mention comes from, `start..end`.
    pub span: Option<(usize, usize)>,
    /// Whether it is spoken of as known: "the mug", "my keys", as opposed to "a new mug".
    pub definite: bool,
    /// Where it is said to be or to have been: rooms or things, any of which narrow it down.
    pub at: Vec<Mention>,
    /// What is meant is not this thing, but the place where it was before the sentence.
    pub its_place: bool,
}

/// How many things a mention means.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quantity {
    /// One of them.
    #[default]
    One,
    /// This many.
    Count(u32),
    /// All of them.
    All,
}

/// A stretch of time before the sentence was said, in seconds before it: `earliest ≥ latest ≥ 0`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct When {
    /// Seconds before, at most.
    pub earliest_s: f64,
    /// Seconds before, at least.
    pub latest_s: f64,
}
