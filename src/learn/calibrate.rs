//! [`calibrate`]: how far predictions are to be believed: look, predict, and see what came.

use std::collections::BTreeMap;

use super::birth_death::{BirthDeath, PairCounts, fit_pairs};
use super::document::Learned;
use super::dwell::{Dwell, DwellData};
use super::fit::fit_dwells;
use super::history::{Histories, Spot};
use super::looks::{Look, LookPlan};
use super::places::PlaceModel;
use super::score::Tally;
use crate::modality::time::probability_static;
use crate::time::Stamp;

/// What is predicted and from what.
#[derive(Clone, Debug, Default)]
pub struct Protocol<'p> {
    /// When things are looked at.
    pub plan: LookPlan,
    /// Learn from looks up to there, test on those after; of each log. Without it nothing is
    /// learned, and every look is a test.
    pub train_until: Vec<Option<Stamp>>,
    /// What was learned before, to be tested too.
    pub learned: Option<&'p Learned>,
}

/// How good a model is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ModelReport {
    /// All predictions.
    pub all: Tally,
    /// By class.
    pub by_class: BTreeMap<String, Tally>,
    /// By seconds since the thing was last seen.
    pub by_age_s: BTreeMap<u64, Tally>,
    /// How often the place it thought likeliest was right, of how many; for models that name one.
    pub top_1: Option<(u64, u64)>,
}

/// How good the models are, by name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Calibration {
    /// By name.
    pub models: BTreeMap<&'static str, ModelReport>,
    /// How many looks were learned from.
    pub trained_on: u64,
    /// How many were predicted.
    pub tested_on: u64,
}

/// What a model says of a look: that it has stayed, and where it most probably is.
type Prediction = (f64, Option<Spot>);

/// Looks at the things of `logs` as the protocol says, and scores every model on what came.
///
/// | model | says |
/// |---|---|
/// | `never-changes` | 1; and that it is where it was last seen |
/// | `training-mean` | the share of training looks that found the thing in its place |
/// | `most-frequent-place` | the share of training looks at which its class was found there |
/// | `sigmoid-one` | one λ for all |
/// | `sigmoid` | λ by class |
/// | `birth-death` | two rates by class |
/// | `places` | counts by class, place and hour of the day |
/// | `graph` | λ as the nodes have it |
/// | `given-sigmoid`, `given-birth-death`, `given-places` | what was learned before |
pub fn calibrate(logs: &[Histories], protocol: &Protocol<'_>) -> Calibration {
    let trained = Trained::new(logs, protocol);
    let mut out = Calibration { trained_on: trained.looks, ..Calibration::default() };
    for (n, log) in logs.iter().enumerate() {
        let cut = protocol.train_until.get(n).copied().flatten();
        let window = (cut.unwrap_or(Stamp::EPOCH), Stamp::MAX);
        protocol.plan.visit(log, window, cut.unwrap_or(Stamp::MAX), &mut |look| {
            out.tested_on += 1;
            for (name, (probability, place)) in trained.predict(look) {
                out.models.entry(name).or_default().add(look, probability, place);
            }
            let given = protocol.learned.map(|learned| given(learned, look, log));
            for (name, probability) in given.into_iter().flatten() {
                out.models.entry(name).or_default().add(look, probability, None);
            }
        });
    }
    out
}

impl ModelReport {
    fn add(&mut self, look: &Look<'_>, probability: f64, place: Option<Spot>) {
        let came = look.stayed();
        self.all.add(probability, came);
        self.by_class.entry(look.class.to_owned()).or_default().add(probability, came);
        self.by_age_s.entry(look.gap_s as u64).or_default().add(probability, came);
        if let Some(place) = place {
            let (right, of) = self.top_1.get_or_insert((0, 0));
            *right += u64::from(look.then == Some(place));
            *of += 1;
        }
    }
}

fn given(
    learned: &Learned,
    look: &Look<'_>,
    log: &Histories,
) -> impl Iterator<Item = (&'static str, f64)> {
    let place = log.names.get(&look.spot).map_or("", String::as_str);
    let said = [
        ("given-sigmoid", learned.sigmoid(look.class, look.gap_s)),
        ("given-birth-death", learned.birth_death(look.class, look.gap_s)),
        ("given-places", learned.places(look.class, place, look.hour(), look.gap_s)),
    ];
    said.into_iter().filter_map(|(name, said)| Some((name, said?)))
}

/// What was learned from the training looks.
struct Trained {
    looks: u64,
    mean: f64,
    one: f64,
    sigmoid: BTreeMap<String, f64>,
    birth_death: BTreeMap<String, BirthDeath>,
    places: PlaceModel,
}

impl Trained {
    fn new(logs: &[Histories], protocol: &Protocol<'_>) -> Self {
        let plan = &protocol.plan;
        let mut dwells: BTreeMap<String, DwellData> = BTreeMap::new();
        let mut pairs: BTreeMap<String, PairCounts> = BTreeMap::new();
        let gaps = plan.gaps.iter().map(|nanos| *nanos as f64 / 1e9).collect();
        let mut places = PlaceModel::new(gaps);
        let (mut looks, mut stays) = (0_u64, 0_u64);
        for (log, cut) in logs.iter().zip(&protocol.train_until) {
            let Some(cut) = cut else { continue };
            let before = Stamp::from_nanos(cut.nanos().saturating_sub(1));
            plan.visit(log, (Stamp::EPOCH, before), *cut, &mut |look| {
                looks += 1;
                stays += u64::from(look.stayed());
                dwells.entry(look.class.to_owned()).or_default().add(dwell(look));
                let pairs = pairs.entry(look.class.to_owned()).or_default();
                pairs.pair(true, look.stayed(), look.gap_s);
                places.look(look);
            });
        }
        let mut all = DwellData::default();
        dwells.values().for_each(|data| all.extend(data));
        let one = fit_dwells(&BTreeMap::from([(String::new(), all)])).0;
        let rate = |fit: &super::fit::DwellFit| fit.rate_per_s;
        Self {
            looks,
            mean: stays as f64 / (looks.max(1)) as f64,
            one: one.get("").map_or(0.0, rate),
            sigmoid: fit_dwells(&dwells).0.into_iter().map(|(c, fit)| (c, rate(&fit))).collect(),
            birth_death: fit_pairs(&pairs).into_iter().map(|(c, fit)| (c, fit.model)).collect(),
            places,
        }
    }

    fn predict(&self, look: &Look<'_>) -> Vec<(&'static str, Prediction)> {
        let graph = probability_static(look.decay_rate, look.gap_s);
        let mut said = vec![("never-changes", (1.0, Some(look.spot))), ("graph", (graph, None))];
        if self.looks == 0 {
            return said;
        }
        let rate = self.sigmoid.get(look.class).copied().unwrap_or(self.one);
        let (usual, usual_share) = self.usual(look);
        said.extend([
            ("training-mean", (self.mean, None)),
            ("most-frequent-place", (usual_share, usual)),
            ("sigmoid-one", (probability_static(self.one, look.gap_s), None)),
            ("sigmoid", (probability_static(rate, look.gap_s), None)),
            ("places", self.place(look)),
        ]);
        let model = self.birth_death.get(look.class).or_else(|| self.birth_death.get(""));
        said.extend(model.map(|model| ("birth-death", (model.here(1.0, look.gap_s), None))));
        said
    }

    /// The place where its class is most of the time, and the share of the place it is at.
    fn usual(&self, look: &Look<'_>) -> (Option<Spot>, f64) {
        let places = self.places.places(look.class);
        let here = places.iter().find(|(place, _)| **place == look.spot);
        (places.first().map(|(place, _)| **place), here.map_or(0.0, |(_, share)| *share))
    }

    fn place(&self, look: &Look<'_>) -> Prediction {
        let (class, spot, hour) = (look.class, &look.spot, look.hour());
        let stays = self.places.stays_for(class, spot, hour, look.gap);
        (stays, Some(self.places.likeliest(class, spot, hour, look.gap_s)))
    }
}

/// A look that found it gone says that it left before; one that found it, that it had not left.
fn dwell(look: &Look<'_>) -> Dwell {
    let until_s = if look.stayed() { f64::INFINITY } else { look.gap_s };
    let from_s = if look.stayed() { look.gap_s } else { 0.0 };
    Dwell { from_s, until_s }
}
