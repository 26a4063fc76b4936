//! Learning how long things stay where they are, from recordings, and how good that is.
//!
//! Knows nothing of files: a log is an [`EventLog`](crate::history::EventLog).
//!
//! | from | to |
//! |---|---|
//! | a log | [`Histories`]: where each object is known to have been, and when |
//! | histories | [`Dwell`]s: how long things stayed, where the end may lie between two looks, or not have come yet; [`Look`] pairs: where a thing was, and where it was some time later |
//! | dwells of many classes | [`DwellFit`]s: λ of the paper's sigmoid with its 95 % interval, shrunk to the family of all classes where data is thin ([`fit_dwells`]) |
//! | pairs | [`BirthDeath`]: a thing may come back ([`fit_pairs`]); [`PlaceModel`]: where it is, by the hour of the day |
//! | noisy detections | [`PresenceFilter`]: a birth-death model that misses and imagines ([`fit_presence`]) |
//! | all of it | [`Learned`]: `decay.json`, read by every command that takes `--decay` |
//! | predictions and outcomes | [`Score`]: Brier score, log loss, reliability |
//!
//! Invariant: training and test never mix: what is learned up to an instant rests on nothing
//! that was logged after it.
//! Invariant: time and memory grow linearly with what is learned from.

mod belief;
mod birth_death;
mod calibrate;
mod document;
mod dwell;
mod fit;
mod history;
mod learner;
mod looks;
mod optimise;
mod places;
mod pool;
mod presence;
mod presence_trial;
mod score;
mod sigmoid;
#[cfg(test)]
mod tests;

pub use belief::{Beliefs, TimeModel};
pub use birth_death::{BirthDeath, BirthDeathFit, PairCounts, fit_pairs};
pub use calibrate::{Calibration, ModelReport, Protocol, calibrate};
pub use document::{Learned, LearnedClass, LearnedError, PlaceShare};
pub use dwell::{Dwell, DwellData, DwellError};
pub use fit::{DwellFit, fit_dwells};
pub use history::{Histories, HistoryError, ObjectHistory, Spot, Stay, histories, unify};
pub use learner::{LearnError, LearnOptions, learn};
pub use looks::{Look, LookPlan};
pub use places::PlaceModel;
pub use pool::Family;
pub use presence::{PresenceFilter, PresenceModel, Sense, fit_presence};
pub use presence_trial::{PresenceError, PresenceLog, PresenceTrial, Visits, presence_trial};
pub use score::{Bin, Score, Tally};
