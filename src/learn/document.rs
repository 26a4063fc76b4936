//! [`Learned`]: what was learned, as `decay.json`; a table written by hand is one with less in it.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::birth_death::{BirthDeath, BirthDeathFit};
use super::fit::DwellFit;
use super::places::PlaceModel;
use super::pool::Family;
use crate::graph::Label;
use crate::modality::time::{
    ClassDecay, DecayTable, HumanDuration, TableError, probability_static, read_decay,
};

/// What the file calls itself.
const FORMAT: &str = "scenefold.decay/1";

/// What was learned of how long things stay where they are (`schemas/decay.schema.json`). Rates
/// are in 1/s, with a length of time beside each for people to read.
#[derive(Clone, Debug, PartialEq)]
pub struct Learned {
    /// λ by class, and the default for classes that are like none.
    pub table: DecayTable,
    /// By class.
    pub classes: BTreeMap<String, LearnedClass>,
    /// Birth-death rates of all classes together.
    pub common: Option<BirthDeath>,
    /// Stays and places by hour of the day, by the names of the places.
    pub by_hour: PlaceModel<String>,
    /// What it was learned from, for people.
    pub learned_from: Vec<String>,
}

/// What was learned of a class.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LearnedClass {
    /// λ of the sigmoid.
    pub decay: Option<DwellFit>,
    /// Rates of leaving and returning.
    pub birth_death: Option<BirthDeathFit>,
    /// Where things of the class are, most probable first.
    pub places: Vec<PlaceShare>,
}

/// A place and how much of the time a thing is there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlaceShare {
    /// Its name.
    pub place: String,
    /// 0 to 1.
    pub share: f64,
}

/// Why a file is none of these.
#[derive(Debug, thiserror::Error)]
pub enum LearnedError {
    /// Not the JSON of one.
    #[error("not a decay table: {0}")]
    Json(#[from] serde_json::Error),
    /// Of another version.
    #[error("format is {found:?}, this program reads {FORMAT:?}")]
    Format {
        /// What it says.
        found: String,
    },
    /// A rate that is none.
    #[error(transparent)]
    Table(#[from] TableError),
    /// A count that cannot be.
    #[error("by_hour: {problem}")]
    Counts {
        /// What is wrong with it.
        problem: String,
    },
}

impl Learned {
    /// What was learned of dwells and pairs; a class without data takes the family's λ, which is
    /// the default too.
    pub fn new(
        name: &str,
        (decays, family): (BTreeMap<String, DwellFit>, Option<Family>),
        mut pairs: BTreeMap<String, BirthDeathFit>,
        by_hour: PlaceModel<String>,
    ) -> Result<Self, TableError> {
        let common = pairs.remove("").map(|fit| fit.model);
        let rates = decays.iter().map(|(class, fit)| {
            (class.clone(), ClassDecay { rate_per_s: fit.rate_per_s })
        });
        let default = family.map(|it| ClassDecay { rate_per_s: libm::exp(it.mean) });
        let table = DecayTable::new(name, rates, default)?;
        let names: Vec<String> = decays.keys().chain(pairs.keys()).cloned().collect();
        let class = |class: &String| LearnedClass {
            decay: decays.get(class).copied(),
            birth_death: pairs.get(class).copied(),
            places: shares(&by_hour, class),
        };
        let classes = names.iter().map(|it| (it.clone(), class(it))).collect();
        Ok(Self { table, classes, common, by_hour, learned_from: Vec::new() })
    }

    /// Reads a file: one that was learned, or one written by hand.
    pub fn from_json(text: &str) -> Result<Self, LearnedError> {
        let raw: Raw = serde_json::from_str(text)?;
        match raw.format {
            Some(found) if found != FORMAT => Err(LearnedError::Format { found }),
            _ => Ok(Self::try_from(raw)?),
        }
    }

    /// The file, for people and programs.
    pub fn to_json(&self) -> String {
        let raw = Raw::from(self);
        serde_json::to_string_pretty(&raw).expect("numbers and texts always have a JSON form")
    }

    /// p(static) after `after_s` seconds by λ of the class, or of the one nearest to it.
    pub fn sigmoid(&self, class: &str, after_s: f64) -> Option<f64> {
        let (decay, _) = self.table.of(&Label::new(class).ok()?)?;
        Some(probability_static(decay.rate_per_s, after_s))
    }

    /// Probability that it is where it was, by the birth-death rates of the class, or of all.
    pub fn birth_death(&self, class: &str, after_s: f64) -> Option<f64> {
        let own = self.class(class).and_then(|it| it.birth_death).map(|fit| fit.model);
        Some(own.or(self.common)?.here(1.0, after_s))
    }

    /// Probability that it is where it was, by class, place and hour of the day; `None` where
    /// the class was never counted.
    pub fn places(&self, class: &str, place: &str, hour: usize, after_s: f64) -> Option<f64> {
        let known = self.by_hour.knows(class);
        known.then(|| self.by_hour.stays(class, &place.to_owned(), hour, after_s))
    }

    fn class(&self, class: &str) -> Option<&LearnedClass> {
        self.classes.get(class).or_else(|| {
            let label = Label::new(class).ok()?;
            self.classes.iter().find(|(name, _)| label.same_class(name)).map(|(_, it)| it)
        })
    }
}

/// Places with at least a hundredth of the time.
fn shares(by_hour: &PlaceModel<String>, class: &str) -> Vec<PlaceShare> {
    let places = by_hour.places(class).into_iter().filter(|(_, share)| *share >= 0.01);
    let rounded = |share: f64| libm::round(share * 1e4) / 1e4;
    places.map(|(place, share)| PlaceShare { place: place.clone(), share: rounded(share) }).collect()
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Raw {
    #[serde(default)]
    format: Option<String>,
    #[serde(default, skip_serializing_if = "String::is_empty")]
    name: String,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    learned_from: Vec<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    default: Option<RawClass>,
    #[serde(default)]
    classes: BTreeMap<String, RawClass>,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    like: BTreeMap<String, String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    by_hour: Option<RawHours>,
}

#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawClass {
    #[serde(default, skip_serializing_if = "Option::is_none")]
    half_life: Option<String>,
    /// From the shortest to the longest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    half_life_95: Option<[String; 2]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    rate_per_s: Option<f64>,
    /// Low and high; the high one is null where the data sets none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    rate_95_per_s: Option<[Option<f64>; 2]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    dwells: Option<u64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    ended: Option<u64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    from_family: Option<f64>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    birth_death: Option<RawBirthDeath>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    places: Vec<PlaceShare>,
}

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawBirthDeath {
    leaves_after: String,
    returns_after: String,
    leave_per_s: f64,
    return_per_s: f64,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    leave_95_per_s: Option<[Option<f64>; 2]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    return_95_per_s: Option<[Option<f64>; 2]>,
    #[serde(default)]
    count: u64,
}

/// Counts by hour of the day.
#[derive(Debug, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawHours {
    gaps: Vec<String>,
    /// Class, place, gap: for each hour with data `[hour, stays, looks]`.
    stays: Nested<Vec<[f64; 3]>>,
    /// Class, place: how often it was found there, by hour from 0 to 23.
    found: BTreeMap<String, BTreeMap<String, Vec<f64>>>,
}

fn ends((low, high): (f64, f64)) -> [Option<f64>; 2] {
    [low, high].map(|end| Some(end).filter(|it| it.is_finite()))
}

fn from_ends(ends: Option<[Option<f64>; 2]>) -> (f64, f64) {
    let [low, high] = ends.unwrap_or_default();
    (low.unwrap_or(0.0), high.unwrap_or(f64::INFINITY))
}

fn half_life(rate_per_s: f64) -> String {
    let rate = ClassDecay::of_rate(rate_per_s);
    rate.map_or("0 seconds".to_owned(), |rate| rate.half_life().to_string())
}

impl From<&Learned> for Raw {
    fn from(learned: &Learned) -> Self {
        let decay = |it: ClassDecay| RawClass {
            half_life: Some(it.half_life().to_string()),
            rate_per_s: Some(it.rate_per_s),
            ..RawClass::default()
        };
        let mut classes: BTreeMap<String, RawClass> =
            learned.table.classes().map(|(class, it)| (class.to_owned(), decay(it))).collect();
        for (class, it) in &learned.classes {
            it.add_to(classes.entry(class.clone()).or_default());
        }
        let mut default = learned.table.default_decay().map(decay);
        if let Some(model) = learned.common {
            default.get_or_insert_default().birth_death = Some(RawBirthDeath::of(model));
        }
        Self {
            format: Some(FORMAT.to_owned()),
            name: learned.table.name.clone(),
            learned_from: learned.learned_from.clone(),
            default,
            classes,
            like: learned.table.likes().map(|(a, b)| (a.to_owned(), b.to_owned())).collect(),
            by_hour: RawHours::of(&learned.by_hour),
        }
    }
}

impl LearnedClass {
    fn add_to(&self, raw: &mut RawClass) {
        if let Some(fit) = self.decay {
            raw.half_life_95 = Some([half_life(fit.high_per_s), half_life(fit.low_per_s)]);
            raw.rate_95_per_s = Some(ends((fit.low_per_s, fit.high_per_s)));
            (raw.dwells, raw.ended) = (Some(fit.count), Some(fit.ended));
            raw.from_family = Some(libm::round(fit.pooled * 1e4) / 1e4);
        }
        raw.birth_death = self.birth_death.map(|fit| RawBirthDeath {
            leave_95_per_s: Some(ends(fit.leave_95)),
            return_95_per_s: Some(ends(fit.return_95)),
            count: fit.count,
            ..RawBirthDeath::of(fit.model)
        });
        raw.places.clone_from(&self.places);
    }
}

impl RawBirthDeath {
    fn of(model: BirthDeath) -> Self {
        let mean = |rate: f64| HumanDuration::seconds(1.0 / rate).to_string();
        Self {
            leaves_after: mean(model.leave_per_s),
            returns_after: mean(model.return_per_s),
            leave_per_s: model.leave_per_s,
            return_per_s: model.return_per_s,
            leave_95_per_s: None,
            return_95_per_s: None,
            count: 0,
        }
    }

    fn read(&self, class: &str) -> Result<BirthDeathFit, TableError> {
        let rate = |value: f64| match value.is_finite() && value > 0.0 {
            true => Ok(value),
            false => Err(TableError::Rate { class: format!("{class}: birth_death"), value }),
        };
        Ok(BirthDeathFit {
            model: BirthDeath {
                leave_per_s: rate(self.leave_per_s)?,
                return_per_s: rate(self.return_per_s)?,
            },
            leave_95: from_ends(self.leave_95_per_s),
            return_95: from_ends(self.return_95_per_s),
            count: self.count,
        })
    }
}

impl RawHours {
    fn of(model: &PlaceModel<String>) -> Option<Self> {
        if model.gaps_s().is_empty() {
            return None;
        }
        let gaps: Vec<String> =
            model.gaps_s().iter().map(|gap| HumanDuration::seconds(*gap).to_string()).collect();
        let mut raw = Self { gaps, ..Self::default() };
        for (class, place, hour, gap, [stays, looks]) in model.counts() {
            let places = raw.stays.entry(class.to_owned()).or_default();
            let gaps = places.entry(place.clone()).or_default();
            gaps.entry(raw.gaps[gap].clone()).or_default().push([hour as f64, stays, looks]);
        }
        for (class, place, hours) in model.found() {
            let places = raw.found.entry(class.to_owned()).or_default();
            places.insert(place.clone(), hours.to_vec());
        }
        Some(raw)
    }

    fn read(&self) -> Result<PlaceModel<String>, LearnedError> {
        let bad = |problem: String| LearnedError::Counts { problem };
        let seconds = |text: &String| {
            let parsed: Result<HumanDuration, _> = text.parse();
            parsed.ok().and_then(HumanDuration::as_seconds).ok_or_else(|| bad(format!("gap {text:?}")))
        };
        let gaps_s: Vec<f64> = self.gaps.iter().map(seconds).collect::<Result<_, _>>()?;
        if !gaps_s.is_sorted_by(|a, b| a < b) {
            return Err(bad("the gaps must rise".to_owned()));
        }
        let mut model = PlaceModel::new(gaps_s);
        for (class, place, gap, counts) in flat(&self.stays) {
            let known = self.gaps.iter().position(|it| it == gap);
            let gap = known.ok_or_else(|| bad(format!("gap {gap:?} is not among the gaps")))?;
            for [hour, stays, looks] in counts {
                if !(0.0..24.0).contains(hour) || !(0.0..=*looks).contains(stays) {
                    let what = format!("{class}, {place}: [{hour}, {stays}, {looks}]");
                    return Err(bad(format!("{what} is not [hour, stays, looks]")));
                }
                model.count(class, place, *hour as usize, gap, [*stays, *looks]);
            }
        }
        for (class, places) in &self.found {
            for (place, hours) in places {
                if hours.len() != 24 || hours.iter().any(|it| it.is_nan() || *it < 0.0) {
                    return Err(bad(format!("found, {class}, {place}: 24 counts are needed")));
                }
                (0..24).for_each(|hour| model.count_found(class, place, hour, hours[hour]));
            }
        }
        Ok(model)
    }
}

type Nested<T> = BTreeMap<String, BTreeMap<String, BTreeMap<String, T>>>;

fn flat<T>(nested: &Nested<T>) -> impl Iterator<Item = (&String, &String, &String, &T)> {
    nested.iter().flat_map(|(a, rest)| {
        rest.iter().flat_map(move |(b, rest)| rest.iter().map(move |(c, it)| (a, b, c, it)))
    })
}

impl TryFrom<Raw> for Learned {
    type Error = LearnedError;

    fn try_from(raw: Raw) -> Result<Self, LearnedError> {
        let rated = |it: &&RawClass| it.half_life.is_some() || it.rate_per_s.is_some();
        let read = |class: &str, it: &RawClass| {
            read_decay(class, it.half_life.as_deref(), it.rate_per_s)
        };
        let default = raw.default.as_ref().filter(rated);
        let default = default.map(|it| read("default", it)).transpose()?;
        let mut rates = Vec::new();
        for (class, it) in raw.classes.iter().filter(|(_, it)| rated(it) || it.birth_death.is_none()) {
            rates.push((class.clone(), read(class, it)?));
        }
        let mut table = DecayTable::new(&raw.name, rates, default)?;
        raw.like.iter().try_for_each(|(class, like)| table.add_like(class, like))?;
        let common = raw.default.as_ref().and_then(|it| it.birth_death.as_ref());
        let common = common.map(|it| it.read("default")).transpose()?.map(|fit| fit.model);
        let class = |(class, it): (&String, &RawClass)| Ok((class.clone(), it.read(class)?));
        let classes = raw.classes.iter().map(class).collect::<Result<_, TableError>>()?;
        let by_hour = raw.by_hour.as_ref().map(RawHours::read).transpose()?;
        let by_hour = by_hour.unwrap_or_else(|| PlaceModel::new(Vec::new()));
        Ok(Self { table, classes, common, by_hour, learned_from: raw.learned_from })
    }
}

impl RawClass {
    fn read(&self, class: &str) -> Result<LearnedClass, TableError> {
        let (low_per_s, high_per_s) = from_ends(self.rate_95_per_s);
        let decay = self.rate_per_s.zip(self.dwells).map(|(rate_per_s, count)| DwellFit {
            rate_per_s,
            low_per_s,
            high_per_s,
            count,
            ended: self.ended.unwrap_or_default(),
            pooled: self.from_family.unwrap_or_default(),
        });
        let birth_death = self.birth_death.as_ref().map(|it| it.read(class)).transpose()?;
        Ok(LearnedClass { decay, birth_death, places: self.places.clone() })
    }
}
