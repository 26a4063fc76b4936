//! [`PresenceFilter`]: whether a thing is there, from a sensor that misses and imagines.
//!
//! A birth-death chain that is seen through noise: between detections the belief follows the
//! chain, at each one it is weighed by how probable that detection is if the thing is there and
//! if it is not (a hidden Markov model in continuous time; Baum et al., "A maximization technique
//! occurring in the statistical analysis of probabilistic functions of Markov chains", 1970).

use super::birth_death::BirthDeath;
use super::optimise::simplex;
use super::pool::Family;

/// How a sensor errs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sense {
    /// Probability that it misses what is there.
    pub missed: f64,
    /// Probability that it sees what is not there.
    pub imagined: f64,
}

/// How a thing comes and goes, and how it is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PresenceModel {
    /// How it comes and goes.
    pub rates: BirthDeath,
    /// How it is seen.
    pub sense: Sense,
}

/// What is believed of one thing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PresenceFilter {
    model: PresenceModel,
    here: f64,
    at_s: f64,
}

/// A detection that is earlier than the one before it.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("time runs backwards: a detection at {at_s} s after one at {before_s} s; sort them")]
pub struct Backwards {
    /// The detection.
    pub at_s: f64,
    /// The one before.
    pub before_s: f64,
}

impl Sense {
    /// Probability of a detection (or none) if the thing is there, and if it is not.
    fn likelihood(self, seen: bool) -> [f64; 2] {
        match seen {
            true => [1.0 - self.missed, self.imagined],
            false => [self.missed, 1.0 - self.imagined],
        }
    }
}

impl PresenceFilter {
    /// Before any detection: its share of time.
    pub fn new(model: PresenceModel) -> Self {
        Self { model, here: model.rates.share(), at_s: f64::NEG_INFINITY }
    }

    /// Probability that it is there at `at_s`, in seconds; at or after the last detection.
    pub fn here_at(&self, at_s: f64) -> f64 {
        match self.at_s.is_finite() {
            true => self.model.rates.here(self.here, (at_s - self.at_s).max(0.0)),
            false => self.here,
        }
    }

    /// Takes a detection (or a look that detected nothing).
    pub fn observe(&mut self, at_s: f64, seen: bool) -> Result<(), Backwards> {
        if at_s.is_nan() || at_s < self.at_s {
            return Err(Backwards { at_s, before_s: self.at_s });
        }
        let before = self.here_at(at_s);
        let [there, not] = self.model.sense.likelihood(seen);
        let (there, not) = (before * there, (1.0 - before) * not);
        // Only impossible where both are: the sensor is then no evidence.
        self.here = if there + not > 0.0 { there / (there + not) } else { before };
        self.at_s = at_s;
        Ok(())
    }
}

/// Detections of one thing: seconds, and whether it was seen. In order of time.
pub(super) type Detections = Vec<(f64, bool)>;

/// How things come and go is sought around an hour, give or take a factor of e³.
const WIDE: Family = Family { mean: -8.2, spread: 3.0 };
/// Where ln of a rate in 1/s may lie.
const BOUND: (f64, f64) = (-18.0, 1.0);
/// Errors are never taken to be rarer than this or commoner than chance.
const SENSE: (f64, f64) = (1e-4, 0.45);

/// The model of each thing, from its detections: rates of its own, errors of one sensor. Things
/// never detected have the rates where nothing is known.
pub fn fit_presence(things: &[Detections]) -> Vec<PresenceModel> {
    let mut sense = Sense { missed: 0.1, imagined: 0.1 };
    let mut at = vec![[WIDE.mean + 1.5; 2]; things.len()];
    for (size, steps) in [(1.5, 60), (0.5, 40), (0.2, 40)] {
        for (at, detections) in at.iter_mut().zip(things) {
            *at = simplex(|it| posterior(detections, sense, it), *at, size, steps);
        }
        sense = errors(things, &at, sense);
    }
    at.iter().map(|at| PresenceModel { rates: rates(at), sense }).collect()
}

fn rates([leave, back]: &[f64; 2]) -> BirthDeath {
    BirthDeath { leave_per_s: libm::exp(*leave), return_per_s: libm::exp(*back) }
}

fn posterior(detections: &Detections, sense: Sense, at: &[f64; 2]) -> f64 {
    if at.iter().any(|theta| *theta < BOUND.0 || *theta > BOUND.1) {
        return f64::NEG_INFINITY;
    }
    let prior: f64 = at.iter().map(|theta| WIDE.curve(*theta).value).sum();
    prior + log_likelihood(detections, PresenceModel { rates: rates(at), sense })
}

/// Steps of the chain; detectors mostly look at equal times, so the last one is kept.
struct Steps {
    rates: BirthDeath,
    after_s: f64,
    decay: f64,
}

impl Steps {
    fn new(rates: BirthDeath) -> Self {
        Self { rates, after_s: 0.0, decay: 1.0 }
    }

    fn decay(&mut self, after_s: f64) -> f64 {
        if after_s.to_bits() != self.after_s.to_bits() {
            self.after_s = after_s;
            let rate = self.rates.leave_per_s + self.rates.return_per_s;
            self.decay = libm::exp(-rate * after_s);
        }
        self.decay
    }
}

fn log_likelihood(detections: &Detections, model: PresenceModel) -> f64 {
    let mut steps = Steps::new(model.rates);
    let share = model.rates.share();
    let (mut here, mut last) = (share, None);
    let (mut total, mut product) = (0.0, 1.0_f64);
    for (at_s, seen) in detections {
        if let Some(last) = last {
            here = share + (here - share) * steps.decay(at_s - last);
        }
        let [there, not] = model.sense.likelihood(*seen);
        let (there, not) = (here * there, (1.0 - here) * not);
        here = there / (there + not);
        last = Some(*at_s);
        product *= there + not;
        // One logarithm for many factors.
        if product < 1e-200 {
            total += libm::log(product);
            product = 1.0;
        }
    }
    total + libm::log(product)
}

/// The errors of the sensor, given how probable it is, in hindsight, that each thing was there.
fn errors(things: &[Detections], at: &[[f64; 2]], sense: Sense) -> Sense {
    let (mut missed, mut there, mut imagined, mut not) = (0.1, 1.0, 0.1, 1.0);
    for (detections, at) in things.iter().zip(at) {
        let model = PresenceModel { rates: rates(at), sense };
        for ((_, seen), here) in detections.iter().zip(smoothed(detections, model)) {
            there += here;
            not += 1.0 - here;
            if *seen { imagined += 1.0 - here } else { missed += here }
        }
    }
    let [missed, imagined] = [missed / there, imagined / not].map(|it| it.clamp(SENSE.0, SENSE.1));
    Sense { missed, imagined }
}

/// Probability at each detection that the thing was there, given all of them, before and after.
pub(super) fn smoothed(detections: &Detections, model: PresenceModel) -> Vec<f64> {
    let mut filter = PresenceFilter::new(model);
    let mut beliefs = Vec::with_capacity(detections.len());
    for (at_s, seen) in detections {
        if filter.observe(*at_s, *seen).is_ok() {
            beliefs.push(filter.here);
        } else {
            beliefs.push(filter.here_at(*at_s));
        }
    }
    let (mut steps, share) = (Steps::new(model.rates), model.rates.share());
    // Likelihood of everything later, if it is there, and if it is not.
    let mut later = [1.0_f64, 1.0];
    for n in (0..detections.len()).rev() {
        let here = beliefs[n];
        let [there, not] = [here * later[0], (1.0 - here) * later[1]];
        beliefs[n] = there / (there + not);
        let Some((before_s, _)) = n.checked_sub(1).map(|n| detections[n]) else { break };
        let (at_s, seen) = detections[n];
        let seen = model.sense.likelihood(seen);
        let decay = steps.decay(at_s - before_s);
        let from = |start: f64| {
            let here = share + (start - share) * decay;
            here * seen[0] * later[0] + (1.0 - here) * seen[1] * later[1]
        };
        let next = [from(1.0), from(0.0)];
        later = next.map(|it| it / (next[0] + next[1]));
    }
    beliefs
}

#[cfg(test)]
mod tests {
    use super::*;

    const MODEL: PresenceModel = PresenceModel {
        rates: BirthDeath { leave_per_s: 1.0 / 300.0, return_per_s: 1.0 / 600.0 },
        sense: Sense { missed: 0.1, imagined: 0.1 },
    };

    #[test]
    fn one_miss_is_no_absence_but_ten_are() {
        let mut filter = PresenceFilter::new(MODEL);
        (0..5).for_each(|n| filter.observe(f64::from(n), true).unwrap());
        filter.observe(5.0, false).unwrap();
        assert!(filter.here_at(5.0) > 0.9, "{filter:?}");
        (6..16).for_each(|n| filter.observe(f64::from(n), false).unwrap());
        assert!(filter.here_at(15.0) < 0.01, "{filter:?}");
        assert!((filter.here_at(1e9) - 1.0 / 3.0).abs() < 1e-9, "its share, in the long run");
    }

    #[test]
    fn a_detection_in_the_past_is_refused() {
        let mut filter = PresenceFilter::new(MODEL);
        filter.observe(10.0, true).unwrap();
        let before = filter;
        let error = filter.observe(9.0, true).unwrap_err().to_string();
        assert!(error.contains("backwards"), "{error}");
        assert!(filter.observe(f64::NAN, true).is_err());
        assert_eq!(filter, before);
    }

    #[test]
    fn rates_and_errors_are_found_in_detections() {
        // There for 300 s, away for 600 s, every tenth look errs.
        let look = |n: u32| {
            let here = n % 900 < 300;
            (f64::from(n), here != (n % 10 == 3))
        };
        let things = vec![(0..18_000).map(look).collect(), (0..2_000).map(|n| (f64::from(n), n % 10 != 3)).collect()];
        let models = fit_presence(&things);
        let PresenceModel { rates, sense } = models[0];
        assert!((sense.missed - 0.1).abs() < 0.02 && (sense.imagined - 0.1).abs() < 0.02, "{sense:?}");
        assert!((1.0 / rates.leave_per_s / 300.0 - 1.0).abs() < 0.3, "{rates:?}");
        assert!((1.0 / rates.return_per_s / 600.0 - 1.0).abs() < 0.3, "{rates:?}");
        assert!(models[1].rates.leave_per_s < 1e-3, "{models:?}");
    }

    #[test]
    fn nothing_detected_leaves_what_was_thought_before() {
        let models = fit_presence(&[Vec::new()]);
        assert!((models[0].rates.share() - 0.5).abs() < 0.01, "{models:?}");
        assert!(fit_presence(&[]).is_empty());
    }
}
