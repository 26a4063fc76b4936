//! Label embeddings: which known label is nearest to a name, by a sentence-transformers model.
//!
//! Reads a folder as sentence-transformers saves it: `config.json`, `model.safetensors`,
//! `vocab.txt` or `tokenizer.json`, `1_Pooling/config.json`. The architecture is BERT (`MiniLM`,
//! BGE, GTE, E5 and many more); others are refused by name.
//!
//! # Why it is written out
//! A label has a handful of tokens, and the encoder is a few products of matrices. A release
//! build of a runtime that does this faster costs a newcomer 42 s (`rten`) or 237 s (`tract`);
//! this costs a crate for Unicode, embeds each label once, and adds numbers in one order, so that
//! every machine gives the same answer.
//!
//! The answer is recorded like every model's, and replayed from there.

mod bert;
mod matrix;
mod pooling;
mod tensors;
mod tokenizer;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

use self::bert::Bert;
use self::pooling::Pooling;
use self::tokenizer::Tokenizer;
use crate::change::EvidenceRef;
use crate::event::LanguageReply;
use crate::modality::human::{
    LanguageModel, LanguageRequest, NearestAnswer, NearestLabel, NearestQuestion, Question,
};

/// Name and version of this back end in recordings.
pub const BACK_END: &str = "embeddings/1";

/// Tokens of a text that are looked at: labels have fewer.
const MAX_TOKENS: usize = 64;
/// Labels that are named for each name: rooms and things among them.
const ANSWERED: usize = 5;
/// Embeddings that are kept, at most.
const KEPT: usize = 20_000;

/// Why a folder holds no model that can be used.
#[derive(Debug, thiserror::Error)]
#[error("{what}\n  {}", .path.display())]
pub struct EmbedError {
    /// Which file.
    pub path: PathBuf,
    /// What is wrong with it.
    pub what: String,
}

impl EmbedError {
    fn new(path: &Path, what: impl std::fmt::Display) -> Self {
        Self { path: path.to_owned(), what: what.to_string() }
    }
}

/// A sentence-transformers model.
pub struct Embeddings {
    name: String,
    tokenizer: Tokenizer,
    bert: Bert,
    pooling: Pooling,
    /// By text; of length 1 each.
    known: BTreeMap<String, Vec<f32>>,
}

impl Embeddings {
    /// Loads the model in `folder`.
    pub fn load(folder: &Path) -> Result<Self, EmbedError> {
        let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Self {
            name,
            tokenizer: Tokenizer::load(folder)?,
            bert: Bert::load(folder)?,
            pooling: Pooling::load(folder)?,
            known: BTreeMap::new(),
        })
    }

    /// The embedding of `text`, of length 1.
    ///
    /// # Errors
    /// If the vocabulary and the model do not fit each other.
    pub fn embed(&self, text: &str) -> Result<Vec<f32>, String> {
        let limit = MAX_TOKENS.min(self.bert.positions());
        let ids = self.tokenizer.encode(text, limit);
        let states = self.bert.forward(&ids)?;
        let mut pooled = self.pooling.pool(&states);
        let length = matrix::dot(&pooled, &pooled).sqrt().max(f32::MIN_POSITIVE);
        pooled.iter_mut().for_each(|x| *x /= length);
        Ok(pooled)
    }

    /// The cosine of the angle between the embeddings of two texts.
    ///
    /// # Errors
    /// As [`Embeddings::embed`].
    pub fn similarity(&self, a: &str, b: &str) -> Result<f32, String> {
        Ok(matrix::dot(&self.embed(a)?, &self.embed(b)?))
    }

    fn remember(&mut self, text: &str) -> Result<(), String> {
        if !self.known.contains_key(text) {
            if self.known.len() >= KEPT {
                self.known.clear();
            }
            self.known.insert(text.to_owned(), self.embed(text)?);
        }
        Ok(())
    }

    fn nearest(&mut self, asked: &NearestQuestion) -> Result<NearestAnswer, String> {
        let mut nearest = Vec::new();
        for name in &asked.names {
            let embedding = self.embed(name)?;
            let mut all = Vec::new();
            for label in &asked.labels {
                self.remember(label)?;
                let similarity = f64::from(matrix::dot(&embedding, &self.known[label]));
                let (name, label) = (name.clone(), label.clone());
                all.push(NearestLabel { name, label, similarity });
            }
            // Of equals the first in the order of the question.
            all.sort_by(|a, b| b.similarity.total_cmp(&a.similarity));
            nearest.extend(all.into_iter().take(ANSWERED));
        }
        Ok(NearestAnswer { nearest })
    }
}

impl LanguageModel for Embeddings {
    fn answer(&mut self, request: &LanguageRequest) -> LanguageReply {
        let Question::Nearest(asked) = &request.question else {
            return LanguageReply::nobody(request);
        };
        let start = Instant::now();
        let json = |answer| serde_json::to_string(&answer).map_err(|error| error.to_string());
        let answer = self.nearest(asked).and_then(json);
        LanguageReply {
            of: EvidenceRef { topic: "".into(), order: 0 },
            back_end: BACK_END.into(),
            model: self.name.clone(),
            prompt: request.prompt.into(),
            request: serde_json::to_string(asked).unwrap_or_default(),
            answer,
            attempts: 1,
            latency_nanos: u64::try_from(start.elapsed().as_nanos()).unwrap_or(u64::MAX),
        }
    }
}

/// The JSON document in a file of the folder, if the file is there.
fn json(path: &Path) -> Result<Option<serde_json::Value>, EmbedError> {
    let Some(bytes) = read(path)? else { return Ok(None) };
    serde_json::from_slice(&bytes).map(Some).map_err(|error| EmbedError::new(path, error))
}

fn read(path: &Path) -> Result<Option<Vec<u8>>, EmbedError> {
    match std::fs::read(path) {
        Ok(bytes) => Ok(Some(bytes)),
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
        Err(error) => Err(EmbedError::new(path, error)),
    }
}
