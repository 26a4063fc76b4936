//! [`learn`]: from histories to what every command can use.

use std::collections::BTreeMap;

use super::birth_death::{PairCounts, fit_pairs};
use super::document::Learned;
use super::dwell::{DwellData, DwellError};
use super::fit::fit_dwells;
use super::history::{Histories, Spot};
use super::looks::{HOUR_NANOS, LookPlan};
use super::places::PlaceModel;
use crate::modality::time::TableError;
use crate::time::Stamp;

/// From what, and how.
#[derive(Clone, Debug)]
pub struct LearnOptions {
    /// What the table is called where λ of a node is explained.
    pub name: String,
    /// The looks at which stays and places are counted by the hour.
    pub plan: LookPlan,
    /// Learn from what was logged up to then, of each log; all of it where there is none.
    pub until: Vec<Option<Stamp>>,
}

impl Default for LearnOptions {
    /// Every hour; 1, 2, 4, 8, 16 and 24 hours later.
    fn default() -> Self {
        let gaps = [1, 2, 4, 8, 16, 24].map(|hours| hours * HOUR_NANOS).to_vec();
        let plan = LookPlan { every: HOUR_NANOS, first: 0, last: 23 * HOUR_NANOS, gaps, same_day: false };
        Self { name: "learned".to_owned(), plan, until: Vec::new() }
    }
}

/// Why nothing was learned.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LearnError {
    /// No object was ever known to be anywhere for any time.
    #[error(
        "there is nothing to learn from: no object that can move was seen for any length of time; \
         give recordings in which things are moved or looked at again"
    )]
    Nothing,
    /// Times that contradict each other.
    #[error("{object}: {error}")]
    Times {
        /// Of which object.
        object: String,
        /// How.
        error: DwellError,
    },
    /// A rate that no table holds.
    #[error(transparent)]
    Table(#[from] TableError),
}

/// Learns λ, rates of leaving and returning, and places by the hour, for every class of objects
/// that can move.
pub fn learn(logs: &[Histories], options: &LearnOptions) -> Result<Learned, LearnError> {
    let mut dwells: BTreeMap<String, DwellData> = BTreeMap::new();
    let mut pairs: BTreeMap<String, PairCounts> = BTreeMap::new();
    let mut plan = options.plan.clone();
    // On the day of the look nothing can be asked a day later.
    let longest = if plan.same_day { plan.last.max(12 * HOUR_NANOS) } else { u64::MAX };
    plan.gaps.retain(|gap| *gap < longest);
    let gaps = plan.gaps.iter().map(|nanos| *nanos as f64 / 1e9).collect();
    let mut by_hour = PlaceModel::new(gaps);
    for (n, log) in logs.iter().enumerate() {
        let Some((_, last)) = log.span else { continue };
        let end = options.until.get(n).copied().flatten().map_or(last, |until| until.min(last));
        let times = |(object, error)| LearnError::Times { object, error };
        log.dwells(end, &mut dwells).map_err(times)?;
        log.comings_and_goings(end, &mut pairs);
        plan.visit(log, (Stamp::EPOCH, end), end, &mut |look| by_hour.look(look));
    }
    if dwells.values().all(DwellData::is_empty) {
        return Err(LearnError::Nothing);
    }
    let by_hour = named(&by_hour, logs);
    Ok(Learned::new(&options.name, fit_dwells(&dwells), fit_pairs(&pairs), by_hour)?)
}

/// The same counts by the names of the places.
fn named(model: &PlaceModel, logs: &[Histories]) -> PlaceModel<String> {
    let name = |spot: &Spot| {
        let log = logs.get(spot.log as usize);
        log.and_then(|log| log.names.get(spot)).cloned().unwrap_or_default()
    };
    let mut out = PlaceModel::new(model.gaps_s().to_vec());
    for (class, spot, hour, gap, count) in model.counts() {
        out.count(class, &name(spot), hour, gap, count);
    }
    for (class, spot, hours) in model.found() {
        (0..24).for_each(|hour| out.count_found(class, &name(spot), hour, hours[hour]));
    }
    out
}
