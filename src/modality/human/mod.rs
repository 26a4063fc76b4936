//! Human language: what people say has changed, and what they ask the robot to do.
//!
//! A sentence becomes a [`Reading`], by the built-in interpreter or by a model; a reading is
//! grounded in the graph, statement by statement, and becomes claims ([`Grounding`]). Text is
//! data: whatever is in it, what comes out is a claim over known nodes, or a recorded rejection.
//!
//! # What the built-in interpreter does
//! Words (`token`) → expressions of time (`times`), noun phrases (`phrase`), clauses (`clause`)
//! → what the verb's frame says of its object (`report`, or `errand` for an instruction). The
//! words it knows are data: `lexicon/*.json`. What is asked, wished, ordered, planned, supposed,
//! denied, habitual, told by others or of other homes reports nothing.
//!
//! Invariant: the time it takes grows with the length of the text, no faster.

mod clause;
mod detector;
mod errand;
mod find;
mod ground;
mod lemma;
mod lexicon;
mod memory;
mod model;
mod model_excerpt;
mod model_nearest;
mod model_reply;
mod model_request;
mod names;
mod phrase;
mod reading;
mod report;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_model;
mod times;
mod token;

pub use model::{LanguageModel, LanguageRequest, NearestQuestion, Question};
pub use model_excerpt::{Excerpt, ObjectEntry, RoomEntry};
pub use model_nearest::{Nearest, NearestAnswer, NearestLabel};
pub use model_reply::{MAX_CHANGES, ReplyError, parse_reading, parse_task};
pub use model_request::{
    ANSWER_SCHEMA, MAX_ASKED, NEAREST_PROMPT, READING_PROMPT, TASK_PROMPT, nearest_request,
    reading_request, task_request,
};
pub use detector::{HumanDetector, Said};
pub(crate) use detector::spans;
pub use errand::{Errand, GroundedErrand, errands, ground_errand, read_task};
pub use find::LabelSimilarity;
pub use ground::{GroundConfig, Grounding, Places, Resolved, Verdict, ground};
pub use reading::{Mention, Quantity, Reading, Statement, When};

use crate::time::Stamp;

/// What `text`, said at `said_at`, reports by the built-in interpreter.
///
/// ```
/// use scenefold::modality::human;
/// use scenefold::time::Stamp;
/// let reading = human::interpret("I put the mug on the desk", Stamp::EPOCH);
/// assert_eq!(reading.statements[0].object.noun, "mug");
/// assert!(human::interpret("Put the mug on the desk", Stamp::EPOCH).statements.is_empty());
/// ```
pub fn interpret(text: &str, said_at: Stamp) -> Reading {
    report::read(text, said_at, &[]).reading
}
