//! [`LanguageReply`]: what a model answered to a question about a sentence, or why it did not.

use std::borrow::Cow;

use super::inputs::{MAX_NAME, MAX_SENTENCE, TooLong, check};
use crate::change::EvidenceRef;

/// Longest answer that is taken from a model, in bytes.
pub const MAX_ANSWER: usize = 64 << 10;

/// The answer of a model to one question about an utterance or a task.
///
/// Models are not deterministic; their answers are recorded right after the input they are
/// about, before it is interpreted, and every later run takes them from there. The key that
/// opens a server is no part of this.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LanguageReply {
    /// The message that was asked about.
    pub of: EvidenceRef,
    /// Kind and version of the back end: `server/1`, `embeddings/1`.
    pub back_end: Cow<'static, str>,
    /// Name of the model, as it was asked for.
    pub model: String,
    /// Name and version of the prompt: `reading/1`, `nearest/1`.
    pub prompt: Cow<'static, str>,
    /// The question as it was sent.
    pub request: String,
    /// The answer as it came.
    ///
    /// # Errors
    /// Why there is none, in words.
    pub answer: Result<String, String>,
    /// How many times the question was sent.
    pub attempts: u32,
    /// From the question to the answer, with all attempts, in nanoseconds.
    pub latency_nanos: u64,
}

impl LanguageReply {
    /// Checks that it is short enough to be recorded and read back.
    pub(super) fn check_length(&self) -> Result<(), TooLong> {
        check("back_end", self.back_end.len(), MAX_NAME)?;
        check("model", self.model.len(), MAX_NAME)?;
        check("prompt", self.prompt.len(), MAX_NAME)?;
        check("request", self.request.len(), MAX_SENTENCE)?;
        let (field, text) = match &self.answer {
            Ok(answer) => ("answer", answer),
            Err(error) => ("error", error),
        };
        check(field, text.len(), MAX_ANSWER)
    }
}
