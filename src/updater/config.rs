//! [`Config`]: every threshold of the detectors, recorded with the log.

use serde::{Deserialize, Serialize};

use crate::change::PlanConfig;
use crate::geometry::{GeometryError, Size};
use crate::modality::time::DecayTable;

/// Who reads sentences.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Language {
    /// The interpreter that is part of this program.
    #[default]
    Builtin,
    /// A chat server; the built-in interpreter where it gives no valid answer.
    Server,
}

/// Every number that detectors and planner go by. It is written into each recording, and
/// reprocess takes it from there unless told otherwise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Config {
    /// λ of objects that are added, in 1/s. The default is a half-life of 12 hours:
    /// λ = ln 3 / 43,200 s, since 2 / (1 + e^{λt}) = 1/2 where e^{λt} = 3.
    pub added_decay_rate: f64,
    /// Box of objects that are added without a measured one: (w, h, d) in metres.
    pub added_size_m: [f64; 3],
    /// Which detectors run over the inputs.
    #[serde(skip_serializing_if = "Detectors::is_all")]
    pub detectors: Detectors,
    /// Who reads sentences. Recordings made before there was a choice do not say.
    #[serde(skip_serializing_if = "is_default")]
    pub language: Language,
    /// Least cosine similarity, in (0, 1], at which a name that is not known is taken for the
    /// label that a model finds nearest; none if no model is asked.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub label_similarity: Option<f64>,
    /// λ by class: set when a graph is taken over and when an object is added. Without a table,
    /// λ is what the graph says, and [`Config::added_decay_rate`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub decay: Option<DecayTable>,
    /// The probability below which an object is a target to look at, above 0 and below 1. Without
    /// it, nothing is reported on `/evidence/staleness`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stale_below: Option<f64>,
    #[serde(skip)]
    added_size: CheckedSize,
}

/// Which detectors run over the inputs of a recording.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Detectors {
    /// All of them.
    #[default]
    All,
    /// None: the recording holds inputs only, to be run through `scenefold reprocess`.
    None,
    /// None, but `/truth/change` is carried out: the truth file of a simulation.
    Truth,
}

impl Detectors {
    #[allow(clippy::trivially_copy_pass_by_ref)] // as serde calls it
    fn is_all(&self) -> bool {
        *self == Self::All
    }
}

/// `added_size_m`, once it was seen to be a box.
#[derive(Clone, Copy, Debug, PartialEq)]
struct CheckedSize(Size);

/// Why a configuration was refused.
#[derive(Debug, thiserror::Error)]
pub enum ConfigError {
    /// Not the JSON of a configuration.
    #[error("the configuration is not valid: {0}")]
    Json(#[from] serde_json::Error),
    /// A box that is none.
    #[error("added_size_m: {0}")]
    Size(#[from] GeometryError),
    /// A rate that is none.
    #[error("added_decay_rate is {0}: it must be a number ≥ 0, in 1/s")]
    DecayRate(f64),
    /// A similarity that is none.
    #[error("label_similarity is {0}: it must be a cosine above 0, at most 1")]
    Similarity(f64),
    /// A threshold that is none.
    #[error("stale_below is {0}: it must be a probability above 0 and below 1, such as 0.5")]
    StaleBelow(f64),
}

fn is_default<T: Default + PartialEq>(value: &T) -> bool {
    *value == T::default()
}

/// ln 3 / 12 h.
const HALF_LIFE_12_H: f64 = 2.543_084_001_546_550_4e-5;

impl Default for CheckedSize {
    fn default() -> Self {
        Self(Size::from_micrometres([200_000; 3]).expect("20 cm is a size"))
    }
}

impl Default for Config {
    fn default() -> Self {
        let added_size = CheckedSize::default();
        let added_size_m = added_size.0.metres();
        Self {
            added_decay_rate: HALF_LIFE_12_H,
            added_size_m,
            detectors: Detectors::All,
            language: Language::Builtin,
            label_similarity: None,
            decay: None,
            stale_below: None,
            added_size,
        }
    }
}

impl Config {
    /// Reads a configuration; what it leaves out has the default value.
    pub fn from_json(text: &str) -> Result<Self, ConfigError> {
        let mut config: Self = serde_json::from_str(text)?;
        let [w, h, d] = config.added_size_m;
        config.added_size = CheckedSize(Size::new(w, h, d)?);
        if !(config.added_decay_rate.is_finite() && config.added_decay_rate >= 0.0) {
            return Err(ConfigError::DecayRate(config.added_decay_rate));
        }
        let threshold = config.stale_below.filter(|it| !(*it > 0.0 && *it < 1.0));
        if let Some(threshold) = threshold {
            return Err(ConfigError::StaleBelow(threshold));
        }
        match config.label_similarity {
            Some(least) if !(least > 0.0 && least <= 1.0) => Err(ConfigError::Similarity(least)),
            _ => Ok(config),
        }
    }

    /// The configuration as one line of JSON with every value, but for those that came later and
    /// have their default.
    pub fn to_json(&self) -> String {
        serde_json::to_string(self).expect("numbers and texts always have a JSON form")
    }

    pub(super) fn plan(&self) -> PlanConfig {
        PlanConfig { decay_rate: self.added_decay_rate, size: self.added_size.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_configuration_reads_back_from_its_json() {
        let config = Config {
            added_decay_rate: 0.25,
            detectors: Detectors::Truth,
            ..Config::default()
        };
        assert_eq!(Config::from_json(&config.to_json()).unwrap(), config);
        assert_eq!(Config::from_json("{}").unwrap(), Config::default());
        let asking =
            Config { language: Language::Server, label_similarity: Some(0.5), ..Config::default() };
        assert_eq!(Config::from_json(&asking.to_json()).unwrap(), asking);
    }

    /// The configuration is hashed with the recording: what came later must not show.
    #[test]
    fn the_default_configuration_is_written_as_the_first_version_did() {
        let json = Config::default().to_json();
        assert_eq!(
            json,
            r#"{"added_decay_rate":0.000025430840015465504,"added_size_m":[0.2,0.2,0.2]}"#
        );
    }

    #[test]
    fn what_is_no_configuration_is_refused_with_the_field() {
        for (json, field) in [
            (r#"{"added_decay_rate": -1}"#, "added_decay_rate"),
            (r#"{"added_size_m": [0, 1, 1]}"#, "added_size_m"),
            (r#"{"speed": 1}"#, "speed"),
            (r#"{"language": "oracle"}"#, "oracle"),
            (r#"{"label_similarity": 0}"#, "label_similarity"),
            (r#"{"stale_below": 1}"#, "stale_below"),
            (r#"{"stale_below": -0.5}"#, "stale_below"),
            (r#"{"decay": {"classes": {"mug": {"rate_per_s": -1}}}}"#, "mug: rate_per_s"),
        ] {
            let error = Config::from_json(json).unwrap_err().to_string();
            assert!(error.contains(field), "{error}");
        }
    }

    #[test]
    fn the_default_half_life_is_twelve_hours() {
        let p = 2.0 / (1.0 + libm::exp(HALF_LIFE_12_H * 43_200.0));
        assert!((p - 0.5).abs() < 1e-12, "{p}");
    }
}
