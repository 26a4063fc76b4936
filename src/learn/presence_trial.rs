//! [`presence_trial`]: a robot that looks in now and then, against what was there all the time.

use std::collections::BTreeMap;

use super::dwell::{Dwell, DwellData};
use super::fit::fit_dwells;
use super::presence::{Detections, PresenceFilter, PresenceModel, fit_presence, smoothed};
use super::score::Tally;
use crate::modality::time::probability_static;

/// Detections of things by a sensor that errs, and what was really there.
///
/// As CSV: `landmark,kind,time_s,present` with kind `detection` or `truth`, present 0 or 1, the
/// rows of one landmark and kind in order of time; a truth holds until the next.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PresenceLog {
    detections: BTreeMap<String, Detections>,
    truth: BTreeMap<String, Detections>,
}

/// When the robot looks: for `length_s` at the beginning of every `every_s`, counted from 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Visits {
    /// Seconds.
    pub length_s: f64,
    /// Seconds.
    pub every_s: f64,
}

/// How good the two models are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PresenceTrial {
    /// The sigmoid, by landmark.
    pub sigmoid: BTreeMap<String, Tally>,
    /// The birth-death filter, by landmark.
    pub birth_death: BTreeMap<String, Tally>,
    /// The share of training detections that saw it, by landmark.
    pub training_mean: BTreeMap<String, Tally>,
    /// Landmarks that really come and go.
    pub changing: Vec<String>,
}

/// Why a file is no log of presence.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PresenceError {
    /// A line that cannot be.
    #[error("line {line}: {problem}")]
    Line {
        /// From 1, the header being the first.
        line: u64,
        /// What is wrong, and how to mend it.
        problem: String,
    },
    /// The columns are others.
    #[error("the header is {found:?}, it must be \"landmark,kind,time_s,present\"")]
    Header {
        /// What is there.
        found: String,
    },
    /// A plan of visits that is none.
    #[error("a visit of {length_s} s every {every_s} s: both must be above 0")]
    Visits {
        /// What was given.
        length_s: f64,
        /// What was given.
        every_s: f64,
    },
    /// Nothing before or nothing after the split.
    #[error("nothing to {what}: the split at {split_s} s leaves no {kind} on that side")]
    Empty {
        /// What it would be for.
        what: &'static str,
        /// Of which kind.
        kind: &'static str,
        /// The split.
        split_s: f64,
    },
}

const COLUMNS: [&str; 4] = ["landmark", "kind", "time_s", "present"];

impl PresenceLog {
    /// Reads the CSV.
    pub fn from_csv(text: &str) -> Result<Self, PresenceError> {
        let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
        let header = reader.headers().map(|it| it.iter().collect::<Vec<_>>().join(","));
        let header = header.unwrap_or_default();
        if header != COLUMNS.join(",") {
            return Err(PresenceError::Header { found: header.chars().take(80).collect() });
        }
        let mut log = Self::default();
        for (n, record) in reader.records().enumerate() {
            let line = n as u64 + 2;
            let problem = |problem: String| PresenceError::Line { line, problem };
            let record = record.map_err(|_| problem("it must have four columns of text".into()))?;
            log.row(&record).map_err(problem)?;
        }
        Ok(log)
    }

    fn row(&mut self, record: &csv::StringRecord) -> Result<(), String> {
        let field = |n: usize| record.get(n).unwrap_or_default();
        let time = field(2).parse().ok().filter(|it: &f64| it.is_finite() && *it >= 0.0);
        let at_s = time.ok_or_else(|| format!("time_s is {:?}: a number ≥ 0 is needed", field(2)))?;
        let present = match field(3) {
            "1" => true,
            "0" => false,
            other => return Err(format!("present is {other:?}: it must be 0 or 1")),
        };
        let rows = match field(1) {
            "detection" => self.detections.entry(field(0).to_owned()).or_default(),
            "truth" => self.truth.entry(field(0).to_owned()).or_default(),
            other => return Err(format!("kind is {other:?}: it must be detection or truth")),
        };
        match rows.last() {
            Some((before, _)) if *before > at_s => Err(format!(
                "time runs backwards: {at_s} s after {before} s of the same landmark; sort the rows"
            )),
            _ => {
                rows.push((at_s, present));
                Ok(())
            }
        }
    }

    fn end_s(&self) -> f64 {
        let ends = self.truth.values().filter_map(|rows| rows.last());
        ends.map(|(at_s, _)| *at_s).fold(0.0, f64::max)
    }
}

/// Seconds between the moments at which predictions are scored.
const STEP_S: f64 = 0.5;

/// Learns from every detection before `split_s`; after it, sees only the detections during the
/// visits, and predicts all the time, every half second, whether each landmark is there. Scored
/// against the truth. What was learned from and what is predicted never mix: the filters begin
/// at the split knowing nothing but the rates.
///
/// The sigmoid believes what most detections of the last visit said, and decays from there; what
/// is gone does not come back, since it cannot express that.
pub fn presence_trial(
    log: &PresenceLog,
    split_s: f64,
    visits: Visits,
) -> Result<PresenceTrial, PresenceError> {
    let Visits { length_s, every_s } = visits;
    if !(length_s > 0.0 && every_s > 0.0 && every_s.is_finite()) {
        return Err(PresenceError::Visits { length_s, every_s });
    }
    let training: Vec<Detections> = log.detections.values().map(|all| before(all, split_s)).collect();
    if training.iter().all(Vec::is_empty) {
        return Err(PresenceError::Empty { what: "learn from", kind: "detection", split_s });
    }
    let models = fit_presence(&training);
    let rates = sigmoid_rates(log.detections.keys(), &training, &models);
    let mut trial = PresenceTrial::default();
    for (n, (landmark, detections)) in log.detections.iter().enumerate() {
        let Some(truth) = log.truth.get(landmark) else { continue };
        let seen = training[n].iter().filter(|(_, seen)| *seen).count() as f64;
        let one = One {
            detections: detections.iter().filter(|(at, _)| *at >= split_s && at % every_s < length_s).copied().collect(),
            truth,
            mean: (seen + 1.0) / (training[n].len() as f64 + 2.0),
            model: models[n],
            rate: rates.get(landmark).copied().unwrap_or_default(),
        };
        let [sigmoid, birth_death, mean] = one.score((split_s, log.end_s()), every_s);
        trial.sigmoid.insert(landmark.clone(), sigmoid);
        trial.birth_death.insert(landmark.clone(), birth_death);
        trial.training_mean.insert(landmark.clone(), mean);
        if truth.iter().any(|(_, present)| *present != truth[0].1) {
            trial.changing.push(landmark.clone());
        }
    }
    if trial.sigmoid.values().all(|tally| tally.score().n == 0) {
        return Err(PresenceError::Empty { what: "predict", kind: "truth", split_s });
    }
    Ok(trial)
}

fn before(detections: &Detections, split_s: f64) -> Detections {
    detections.iter().take_while(|(at_s, _)| *at_s < split_s).copied().collect()
}

/// λ of each landmark, from how long it stayed whenever it was there, in hindsight.
fn sigmoid_rates<'l>(
    landmarks: impl Iterator<Item = &'l String>,
    training: &[Detections],
    models: &[PresenceModel],
) -> BTreeMap<String, f64> {
    let mut dwells: BTreeMap<String, DwellData> = BTreeMap::new();
    for ((landmark, detections), model) in landmarks.zip(training).zip(models) {
        let data = dwells.entry(landmark.clone()).or_default();
        let (mut since, mut last) = (None, 0.0);
        for ((at_s, _), here) in detections.iter().zip(smoothed(detections, *model)) {
            match (since, here > 0.5) {
                (None, true) => since = Some(*at_s),
                (Some(start), false) => {
                    data.add(Dwell { from_s: last - start, until_s: at_s - start });
                    since = None;
                }
                _ => {}
            }
            last = *at_s;
        }
        if let Some(start) = since {
            data.add(Dwell { from_s: last - start, until_s: f64::INFINITY });
        }
    }
    fit_dwells(&dwells).0.into_iter().map(|(landmark, fit)| (landmark, fit.rate_per_s)).collect()
}

/// One landmark after the split.
struct One<'l> {
    /// During visits.
    detections: Detections,
    truth: &'l Detections,
    mean: f64,
    model: PresenceModel,
    rate: f64,
}

impl One<'_> {
    /// The sigmoid, the birth-death filter and the training mean, scored every [`STEP_S`].
    fn score(&self, (from_s, to_s): (f64, f64), every_s: f64) -> [Tally; 3] {
        let (mut sigmoid, mut birth_death, mut mean) =
            (Tally::default(), Tally::default(), Tally::default());
        let (mut filter, mut look) = (PresenceFilter::new(self.model), LastVisit::default());
        let mut detections = self.detections.iter().peekable();
        for n in 0..((to_s - from_s) / STEP_S).max(0.0) as u64 {
            let now_s = from_s + n as f64 * STEP_S;
            while let Some((at_s, seen)) = detections.next_if(|(at_s, _)| *at_s <= now_s) {
                // In order, as the reader saw to.
                let _ = filter.observe(*at_s, *seen);
                look.take(*at_s, *seen, every_s);
            }
            let after = self.truth.partition_point(|(at_s, _)| *at_s <= now_s);
            let Some((_, present)) = self.truth[..after].last() else { continue };
            birth_death.add(filter.here_at(now_s), *present);
            sigmoid.add(look.here(self.rate, now_s).unwrap_or(self.mean), *present);
            mean.add(self.mean, *present);
        }
        [sigmoid, birth_death, mean]
    }
}

/// What the detections of the last visit said.
#[derive(Clone, Copy, Debug, Default)]
struct LastVisit {
    number: u64,
    at_s: f64,
    seen: u32,
    of: u32,
}

impl LastVisit {
    fn take(&mut self, at_s: f64, seen: bool, every_s: f64) {
        let number = (at_s / every_s) as u64;
        if number != self.number {
            *self = Self { number, ..Self::default() };
        }
        self.at_s = at_s;
        self.seen += u32::from(seen);
        self.of += 1;
    }

    fn here(self, rate: f64, now_s: f64) -> Option<f64> {
        let there = 2 * self.seen >= self.of;
        let decayed = probability_static(rate, now_s - self.at_s);
        (self.of > 0).then_some(if there { decayed } else { 0.0 })
    }
}

#[cfg(test)]
mod tests {
    use std::fmt::Write;

    use super::*;

    fn log() -> String {
        let mut text = String::from("landmark,kind,time_s,present\n");
        for n in 0..6000_u32 {
            let here = u8::from(n % 1000 < 300);
            let seen = if n % 10 == 3 { 1 - here } else { here };
            let _ = writeln!(text, "cup,detection,{n},{seen}");
            if n % 1000 == 0 || n % 1000 == 300 || n == 5999 {
                let _ = writeln!(text, "cup,truth,{n},{here}");
            }
        }
        text
    }

    #[test]
    fn what_comes_back_is_predicted_better_by_birth_and_death() {
        let log = PresenceLog::from_csv(&log()).unwrap();
        let visits = Visits { length_s: 20.0, every_s: 400.0 };
        let trial = presence_trial(&log, 4000.0, visits).unwrap();
        let brier = |tallies: &BTreeMap<String, Tally>| tallies["cup"].score().brier;
        assert!(brier(&trial.birth_death) < brier(&trial.sigmoid), "{trial:?}");
        assert!(brier(&trial.birth_death) < brier(&trial.training_mean), "{trial:?}");
        assert_eq!(trial.changing, ["cup"]);
    }

    #[test]
    fn a_file_that_cannot_be_is_refused_with_its_line() {
        let with = |rows: &str| PresenceLog::from_csv(&format!("landmark,kind,time_s,present\n{rows}"));
        for (rows, words) in [
            ("a,detection,1,1\na,detection,0,1\n", "line 3: time runs backwards"),
            ("a,detection,-1,1\n", "line 2: time_s"),
            ("a,detection,NaN,1\n", "line 2: time_s"),
            ("a,guess,1,1\n", "kind is \"guess\""),
            ("a,truth,1,2\n", "present is \"2\""),
            ("a,truth\n", "line 2"),
        ] {
            let error = with(rows).unwrap_err().to_string();
            assert!(error.contains(words), "{error}");
        }
        assert!(matches!(PresenceLog::from_csv("a,b\n"), Err(PresenceError::Header { .. })));
    }

    #[test]
    fn a_split_needs_something_on_both_sides() {
        let log = PresenceLog::from_csv(&log()).unwrap();
        let visits = Visits { length_s: 20.0, every_s: 400.0 };
        let error = |split_s| presence_trial(&log, split_s, visits).unwrap_err().to_string();
        assert!(error(0.0).contains("learn from"), "{}", error(0.0));
        assert!(error(1e6).contains("predict"), "{}", error(1e6));
        let never = Visits { length_s: 20.0, every_s: 0.0 };
        assert!(presence_trial(&log, 4000.0, never).is_err());
    }
}
