//! Language models: what answers the questions of [`crate::modality::human`]. Does IO.
//!
//! | module | answers | by |
//! |---|---|---|
//! | [`chat`] | what a sentence reports | an OpenAI-compatible chat server, hosted or on this machine |
//! | `embed` (feature `embeddings`) | which label is nearest to a name | a sentence-transformers model, in this process |
//!
//! Nothing here decides anything: an answer is text that the core parses, checks against the
//! graph, and takes or refuses; a failure is an answer too. Both are recorded before they are
//! used, so that replay and reprocessing need none of this.
//!
//! # Why this HTTP client
//! `ureq` blocks, as the recorder does, and brings some twenty crates, TLS in Rust included. The
//! typed client `async-openai` needs an executor and an HTTP stack on top of it for the one
//! request that is made here, and has types for an API of which servers on one's own machine
//! speak dialects.

pub mod chat;
#[cfg(feature = "embeddings")]
pub mod embed;

use crate::event::LanguageReply;
use crate::modality::human::{LanguageModel, LanguageRequest, Question};

/// The models of one program, asked by the kind of question.
#[derive(Default)]
pub struct Models {
    /// Reads sentences.
    pub chat: Option<Box<dyn LanguageModel>>,
    /// Finds labels that are near to a name.
    pub nearest: Option<Box<dyn LanguageModel>>,
}

impl LanguageModel for Models {
    fn answer(&mut self, request: &LanguageRequest) -> LanguageReply {
        let model = match request.question {
            Question::Chat { .. } => &mut self.chat,
            Question::Nearest(_) => &mut self.nearest,
        };
        match model {
            Some(model) => model.answer(request),
            None => LanguageReply::nobody(request),
        }
    }
}
