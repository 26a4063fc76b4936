//! [`DecayTable`]: λ by class, with half-lives that people can read.

use std::collections::BTreeMap;
use std::fmt;

use serde::{Deserialize, Serialize};

use super::duration::HumanDuration;
use super::near::nearest;
use super::{LN_3, half_life_s};
use crate::graph::{Label, class_key};

/// λ by class.
///
/// In JSON (`schemas/decay.schema.json`), with a half-life for people, a rate for programs, or
/// both:
/// `{"classes": {"mug": {"half_life": "2 hours"}, "oven": {"half_life": "never"}},
///   "like": {"beaker": "mug"}, "default": {"half_life": "12 hours"}}`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "RawTable", into = "RawTable")]
pub struct DecayTable {
    /// What the table is called where λ of a node is explained, such as a file name.
    pub name: String,
    /// λ of the classes that are known, by their name.
    classes: BTreeMap<String, ClassDecay>,
    /// By [`class_key`], for looking up.
    keys: BTreeMap<String, String>,
    /// Classes that are like one that is known: what a language model said of them.
    like: BTreeMap<String, String>,
    /// λ of what is like nothing in the table.
    default: Option<ClassDecay>,
}

/// How fast things of a class are moved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClassDecay {
    /// λ in 1/s, finite and at least 0; 0 means never.
    pub rate_per_s: f64,
}

/// Where λ of a node comes from, in words: recorded with every `SetDecay`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The class is in the table.
    Class(String),
    /// It is like this class, as the table says.
    Like(String),
    /// This class is nearest to its label, for the reason given.
    Nearest(String, &'static str),
    /// Nothing in the table is like it.
    Default,
}

/// Why a table was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum TableError {
    /// A rate that is none.
    #[error("{class}: rate_per_s is {value}: it must be a number ≥ 0, in 1/s")]
    Rate {
        /// Which class.
        class: String,
        /// Its rate.
        value: f64,
    },
    /// A half-life that is none.
    #[error("{class}: half_life {text}")]
    HalfLife {
        /// Which class.
        class: String,
        /// What is wrong with it.
        text: String,
    },
    /// Both were given, and they differ.
    #[error(
        "{class}: half_life {half_life:?} and rate_per_s {rate} contradict each other (ln 3 / \
         half-life = {implied:.4e}/s): leave one out"
    )]
    Contradiction {
        /// Which class.
        class: String,
        /// Its half-life.
        half_life: String,
        /// Its rate.
        rate: f64,
        /// The rate of the half-life.
        implied: f64,
    },
    /// Neither was given.
    #[error("{class}: give a half_life such as \"2 hours\", or a rate_per_s")]
    Empty {
        /// Which class.
        class: String,
    },
    /// Two spellings of one class.
    #[error("{class} and {other} are one class: leave one out")]
    Twice {
        /// One of them.
        class: String,
        /// The other.
        other: String,
    },
    /// A representative that is not in the table.
    #[error("like: {class} is said to be like {like}, which is not among the classes")]
    UnknownLike {
        /// Which class.
        class: String,
        /// What it is said to be like.
        like: String,
    },
}

impl ClassDecay {
    /// With this λ in 1/s; `None` if it is negative or not finite.
    pub fn of_rate(rate_per_s: f64) -> Option<Self> {
        let valid = rate_per_s.is_finite() && rate_per_s >= 0.0;
        valid.then_some(Self { rate_per_s: rate_per_s + 0.0 })
    }

    /// With this half-life: λ = ln 3 / half-life.
    pub fn of_half_life(half_life: HumanDuration) -> Self {
        Self { rate_per_s: half_life.as_seconds().map_or(0.0, |seconds| LN_3 / seconds) }
    }

    /// Its half-life.
    pub fn half_life(self) -> HumanDuration {
        half_life_s(self.rate_per_s).map_or(HumanDuration::NEVER, HumanDuration::seconds)
    }
}

impl DecayTable {
    /// A table of these classes.
    pub fn new(
        name: &str,
        classes: impl IntoIterator<Item = (String, ClassDecay)>,
        default: Option<ClassDecay>,
    ) -> Result<Self, TableError> {
        let mut table = Self { name: name.to_owned(), default, ..Self::default() };
        for (class, decay) in classes {
            if ClassDecay::of_rate(decay.rate_per_s).is_none() {
                return Err(TableError::Rate { class, value: decay.rate_per_s });
            }
            if let Some(other) = table.keys.insert(class_key(&class), class.clone()) {
                return Err(TableError::Twice { class, other });
            }
            table.classes.insert(class, decay);
        }
        Ok(table)
    }

    /// Says that a class is like one of the table, as a language model judged.
    pub fn add_like(&mut self, class: &str, like: &str) -> Result<(), TableError> {
        let known = self.keys.get(&class_key(like)).cloned().ok_or_else(|| {
            TableError::UnknownLike { class: class.to_owned(), like: like.to_owned() }
        })?;
        self.like.insert(class_key(class), known);
        Ok(())
    }

    /// The classes and their λ, in order of their names.
    pub fn classes(&self) -> impl Iterator<Item = (&str, ClassDecay)> {
        self.classes.iter().map(|(class, decay)| (class.as_str(), *decay))
    }

    /// Which class is said to be like which, in order.
    pub fn likes(&self) -> impl Iterator<Item = (&str, &str)> {
        self.like.iter().map(|(class, like)| (class.as_str(), like.as_str()))
    }

    /// λ of what is like nothing in the table.
    pub fn default_decay(&self) -> Option<ClassDecay> {
        self.default
    }

    /// λ of a label and where it comes from: the class itself, the one it is said to be like, the
    /// nearest label, the default; `None` if there is none.
    pub fn of(&self, label: &Label) -> Option<(ClassDecay, Origin)> {
        self.stated(label).or_else(|| {
            let known = self.classes.keys().map(String::as_str);
            if let Some((class, how)) = nearest(label.as_str(), known) {
                return Some((self.classes[class], Origin::Nearest(class.to_owned(), how)));
            }
            self.default.map(|decay| (decay, Origin::Default))
        })
    }

    /// As [`DecayTable::of`], but only where the table names the class or what it is like.
    pub fn stated(&self, label: &Label) -> Option<(ClassDecay, Origin)> {
        let key = label.class_key();
        if let Some(class) = self.keys.get(&key) {
            return Some((self.classes[class], Origin::Class(class.clone())));
        }
        let class = self.like.get(&key)?;
        Some((self.classes[class], Origin::Like(class.clone())))
    }

    /// λ of an object whose graph says `before`, and where it comes from. What the graph says is
    /// immovable (λ = 0) stays so unless the table names its class.
    pub fn for_object(&self, label: &Label, before: f64) -> Option<(ClassDecay, Origin)> {
        if before > 0.0 { self.of(label) } else { self.stated(label) }
    }

    /// The words that `SetDecay` records.
    pub fn explain(&self, decay: ClassDecay, origin: &Origin) -> String {
        let table = if self.name.is_empty() { "the decay table" } else { &self.name };
        let half_life = match decay.half_life() {
            HumanDuration::NEVER => "never moves".to_owned(),
            half_life => format!("half-life {half_life}"),
        };
        format!("{table}: {origin}, {half_life}")
    }
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Class(class) => write!(f, "class {class:?}"),
            Self::Like(class) => write!(f, "said to be like {class:?}"),
            Self::Nearest(class, how) => write!(f, "nearest is {class:?} ({how})"),
            Self::Default => f.write_str("nothing is like it, the default"),
        }
    }
}

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawTable {
    #[serde(default, skip_serializing_if = "String::is_empty")]
    name: String,
    #[serde(default)]
    classes: BTreeMap<String, RawDecay>,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    like: BTreeMap<String, String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    default: Option<RawDecay>,
}

#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawDecay {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    half_life: Option<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    rate_per_s: Option<f64>,
}

/// λ of a class from a half-life for people, a rate for programs, or both.
pub(crate) fn read_decay(
    class: &str,
    half_life: Option<&str>,
    rate_per_s: Option<f64>,
) -> Result<ClassDecay, TableError> {
    let class = || class.to_owned();
    let rate = |value| {
        ClassDecay::of_rate(value).ok_or_else(|| TableError::Rate { class: class(), value })
    };
    let Some(text) = half_life else {
        return rate(rate_per_s.ok_or_else(|| TableError::Empty { class: class() })?);
    };
    let parsed: HumanDuration = text.parse().map_err(|error: super::DurationError| {
        TableError::HalfLife { class: class(), text: error.to_string() }
    })?;
    let implied = ClassDecay::of_half_life(parsed);
    let Some(value) = rate_per_s else { return Ok(implied) };
    let exact = rate(value)?;
    // A half-life is printed to three digits.
    if (exact.rate_per_s - implied.rate_per_s).abs() > 0.01 * exact.rate_per_s {
        let (half_life, implied) = (text.to_owned(), implied.rate_per_s);
        return Err(TableError::Contradiction { class: class(), half_life, rate: value, implied });
    }
    Ok(exact)
}

impl TryFrom<RawTable> for DecayTable {
    type Error = TableError;

    fn try_from(raw: RawTable) -> Result<Self, TableError> {
        let read = |class: &str, decay: &RawDecay| {
            read_decay(class, decay.half_life.as_deref(), decay.rate_per_s)
        };
        let default = raw.default.as_ref().map(|it| read("default", it)).transpose()?;
        let classes = raw.classes.iter().map(|(class, it)| Ok((class.clone(), read(class, it)?)));
        let mut table = Self::new(&raw.name, classes.collect::<Result<Vec<_>, _>>()?, default)?;
        raw.like.iter().try_for_each(|(class, like)| table.add_like(class, like))?;
        Ok(table)
    }
}

impl From<DecayTable> for RawTable {
    fn from(table: DecayTable) -> Self {
        let raw = |decay: ClassDecay| RawDecay {
            half_life: Some(decay.half_life().to_string()),
            rate_per_s: Some(decay.rate_per_s),
        };
        Self {
            name: table.name,
            classes: table.classes.into_iter().map(|(class, it)| (class, raw(it))).collect(),
            like: table.like,
            default: table.default.map(raw),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TABLE: &str = r#"{"name": "home", "classes": {"mug": {"half_life": "2 hours"},
        "oven": {"half_life": "never"}, "book": {"rate_per_s": 1e-5}},
        "like": {"beaker": "mug"}, "default": {"half_life": "12 hours"}}"#;

    fn table(json: &str) -> Result<DecayTable, serde_json::Error> {
        serde_json::from_str(json)
    }

    #[track_caller]
    fn check(label: &str, half_life: &str, why: &str) {
        let table = table(TABLE).unwrap();
        let (decay, origin) = table.of(&Label::new(label).unwrap()).unwrap();
        assert_eq!(decay.half_life().to_string(), half_life, "{label}");
        assert!(table.explain(decay, &origin).contains(why), "{}", table.explain(decay, &origin));
    }

    #[test]
    fn a_class_has_its_own_rate_or_that_of_what_it_is_like() {
        check("Mug", "2 hours", "home: class \"mug\", half-life 2 hours");
        check("oven", "never", "never moves");
        check("beaker", "2 hours", "said to be like \"mug\"");
        check("coffee mug", "2 hours", "nearest is \"mug\" (same noun)");
        check("umbrella", "12 hours", "nothing is like it, the default");
    }

    #[test]
    fn what_the_graph_says_is_immovable_stays_so_unless_the_class_is_named() {
        let table = table(TABLE).unwrap();
        let of = |label: &str| table.for_object(&Label::new(label).unwrap(), 0.0);
        assert_eq!(of("wardrobe"), None);
        assert_eq!(of("shelf for mug"), None);
        assert!(of("mug").is_some());
    }

    #[test]
    fn a_table_reads_back_from_its_json() {
        let before = table(TABLE).unwrap();
        let json = serde_json::to_string(&before).unwrap();
        assert!(json.contains("\"half_life\":\"2 hours\""), "{json}");
        assert_eq!(table(&json).unwrap(), before);
    }

    #[test]
    fn a_table_that_cannot_be_is_refused_with_the_class() {
        for (json, words) in [
            (r#"{"classes": {"mug": {"rate_per_s": -1}}}"#, "mug: rate_per_s is -1"),
            (r#"{"classes": {"mug": {"half_life": "-2 hours"}}}"#, "mug: half_life"),
            (r#"{"classes": {"mug": {}}}"#, "mug: give a half_life"),
            (r#"{"classes": {"mug": {"half_life": "2 h", "rate_per_s": 1}}}"#, "contradict"),
            (r#"{"classes": {"mug": {"rate_per_s": 1}, "MUG": {"rate_per_s": 2}}}"#, "one class"),
            (r#"{"classes": {}, "like": {"a": "b"}}"#, "like: a is said to be like b"),
            (r#"{"classes": {"mug": {"speed": 1}}}"#, "speed"),
        ] {
            let error = table(json).unwrap_err().to_string();
            assert!(error.contains(words), "{error}");
        }
        let nan = [("mug".to_owned(), ClassDecay { rate_per_s: f64::NAN })];
        assert!(DecayTable::new("", nan, None).is_err());
    }
}
