//! [`Nearest`]: which labels a model finds nearest to some names, and how near.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::ReplyError;
use crate::event::MAX_ANSWER;

/// For each name the label that a model finds nearest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Nearest(BTreeMap<String, NearestLabel>);

/// A label that is near to a name.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NearestLabel {
    /// The name that was asked for.
    pub name: String,
    /// The nearest of the labels that were offered.
    pub label: String,
    /// Cosine of the angle between their embeddings, −1 to 1.
    pub similarity: f64,
}

/// The answer to [`super::nearest_request`].
#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NearestAnswer {
    /// One for each name.
    pub nearest: Vec<NearestLabel>,
}

impl Nearest {
    /// Reads the answer to [`super::nearest_request`]; pairs below `least` are left out.
    ///
    /// # Errors
    /// [`ReplyError`] if it is not of the schema, or a similarity is no cosine.
    pub fn parse(answer: &str, least: f64) -> Result<Self, ReplyError> {
        if answer.len() > MAX_ANSWER {
            return Err(ReplyError::TooLong { bytes: answer.len() });
        }
        let read: NearestAnswer = serde_json::from_str(answer)
            .map_err(|error| ReplyError::Schema(error.to_string()))?;
        let mut found = BTreeMap::new();
        for near in read.nearest {
            // Rounding may leave a cosine a little above 1.
            if !(-1.001..=1.001).contains(&near.similarity) {
                let (place, problem) = ("similarity", format!("{} is no cosine", near.similarity));
                return Err(ReplyError::Field { place: place.to_owned(), problem });
            }
            if near.similarity >= least {
                found.insert(near.name.clone(), near);
            }
        }
        Ok(Self(found))
    }

    /// The label nearest to `name`, if one is near enough.
    pub fn label(&self, name: &str) -> Option<&NearestLabel> {
        self.0.get(name)
    }

    /// Whether nothing is near enough to anything.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}
