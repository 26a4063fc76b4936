//! The side of a language model that the core sees: questions out, recorded answers in.
//!
//! The core never calls a model. It says what it needs to know ([`LanguageRequest`]); whoever
//! runs it asks a [`LanguageModel`], records the reply, and hands it back with the input. Replay
//! and reprocessing hand back the recorded one, so nothing of them depends on a model.

use serde::Serialize;

use crate::change::EvidenceRef;
use crate::event::LanguageReply;

/// What a model is asked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Question {
    /// For a chat server: the answer must be JSON that holds to [`super::ANSWER_SCHEMA`].
    Chat {
        /// The system message.
        system: String,
        /// The user message: a JSON document.
        user: String,
    },
    /// For label embeddings: which labels are nearest; see [`super::NearestAnswer`].
    Nearest(NearestQuestion),
}

/// Which labels are nearest to some names?
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct NearestQuestion {
    /// What was said.
    pub names: Vec<String>,
    /// What is known.
    pub labels: Vec<String>,
}

/// A question to a model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LanguageRequest {
    /// Name and version of its wording: `reading/1`.
    pub prompt: &'static str,
    /// What is asked.
    pub question: Question,
}

/// What answers questions: a server, a neural network. The only part that may take its time.
pub trait LanguageModel {
    /// Answers, or says why it cannot: an error is an answer too, and is recorded.
    ///
    /// [`LanguageReply::of`] is set by the updater, whatever is given here.
    fn answer(&mut self, request: &LanguageRequest) -> LanguageReply;
}

impl LanguageReply {
    /// What is recorded where nobody was there to ask.
    pub fn nobody(request: &LanguageRequest) -> Self {
        Self {
            of: EvidenceRef { topic: "".into(), order: 0 },
            back_end: "none".into(),
            model: String::new(),
            prompt: request.prompt.into(),
            request: String::new(),
            answer: Err("no back end is connected".to_owned()),
            attempts: 0,
            latency_nanos: 0,
        }
    }
}
