//! [`Nearest`]: which labels a model finds nearest to some names, and how near.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{LabelSimilarity, ReplyError};
use crate::event::MAX_ANSWER;

/// For each name the labels that a model finds nearest, the nearest first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Nearest(BTreeMap<String, Vec<NearestLabel>>);

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
    /// Some for each name, in whatever order.
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
        let read: NearestAnswer =
            serde_json::from_str(answer).map_err(|error| ReplyError::Schema(error.to_string()))?;
        let mut found: BTreeMap<String, Vec<NearestLabel>> = BTreeMap::new();
        for near in read.nearest {
            // Rounding may leave a cosine a little above 1.
            if !(-1.001..=1.001).contains(&near.similarity) {
                let (place, problem) = ("similarity", format!("{} is no cosine", near.similarity));
                return Err(ReplyError::Field { place: place.to_owned(), problem });
            }
            if near.similarity >= least {
                found.entry(near.name.clone()).or_default().push(near);
            }
        }
        for near in found.values_mut() {
            // Equally near ones stay as the model has them.
            near.sort_by(|a, b| b.similarity.total_cmp(&a.similarity));
        }
        Ok(Self(found))
    }

    /// The label nearest to `name`, if one is near enough.
    pub fn label(&self, name: &str) -> Option<&NearestLabel> {
        self.0.get(name)?.first()
    }

    /// Whether nothing is near enough to anything.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl LabelSimilarity for Nearest {
    fn nearest(&self, noun: &str, labels: &[&str]) -> Option<(usize, f64)> {
        self.0.get(noun)?.iter().find_map(|near| {
            let place = labels.iter().position(|label| *label == near.label)?;
            Some((place, near.similarity))
        })
    }
}
