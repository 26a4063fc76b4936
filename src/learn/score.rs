//! [`Score`]: how good probabilities are, given what came of them.
//!
//! Both scores are proper: nobody does better than by saying what they believe (Gneiting and
//! Raftery, "Strictly proper scoring rules, prediction, and estimation", 2007).

use serde::Serialize;

/// Probabilities are kept this far from 0 and 1 in the log loss, which is infinite there: who
/// says "never" and is wrong pays 13.8.
pub const CLIP: f64 = 1e-6;

/// How many bins a reliability diagram has.
pub const BINS: usize = 10;

/// How good predictions are.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Score {
    /// Mean of −ln of the probability given to what came, in nats.
    pub log_loss: f64,
    /// Mean of the squared difference of probability and outcome (Brier, 1950).
    pub brier: f64,
    /// How many predictions.
    pub n: u64,
}

/// One bin of a reliability diagram.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Bin {
    /// Predictions from here on.
    pub from: f64,
    /// To here.
    pub to: f64,
    /// How many there are.
    pub n: u64,
    /// Their mean; `None` if there are none.
    pub predicted: Option<f64>,
    /// The share that came true; `None` if there are none.
    pub observed: Option<f64>,
}

/// Adds up scores.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    n: u64,
    log_loss: f64,
    brier: f64,
    bins: [(u64, f64, u64); BINS],
}

impl Tally {
    /// Counts a prediction and whether it came true.
    pub fn add(&mut self, probability: f64, came: bool) {
        let outcome = f64::from(u8::from(came));
        let clipped = probability.clamp(CLIP, 1.0 - CLIP);
        self.n += 1;
        self.log_loss -= libm::log(if came { clipped } else { 1.0 - clipped });
        self.brier += (probability - outcome) * (probability - outcome);
        let bin = ((probability * BINS as f64) as usize).min(BINS - 1);
        let (count, sum, true_ones) = &mut self.bins[bin];
        *count += 1;
        *sum += probability;
        *true_ones += u64::from(came);
    }

    /// Takes in another tally.
    pub fn extend(&mut self, other: &Self) {
        self.n += other.n;
        self.log_loss += other.log_loss;
        self.brier += other.brier;
        for (own, (count, sum, came)) in self.bins.iter_mut().zip(other.bins) {
            own.0 += count;
            own.1 += sum;
            own.2 += came;
        }
    }

    /// The score; of nothing, zeros.
    pub fn score(&self) -> Score {
        let mean = |sum: f64| if self.n == 0 { 0.0 } else { sum / self.n as f64 };
        Score { log_loss: mean(self.log_loss), brier: mean(self.brier), n: self.n }
    }

    /// The reliability diagram: what was said against what came.
    pub fn reliability(&self) -> Vec<Bin> {
        let width = 1.0 / BINS as f64;
        let bin = |(n, (count, sum, came)): (usize, &(u64, f64, u64))| {
            let share = |total: f64| (*count > 0).then(|| total / *count as f64);
            let (from, to) = (n as f64 * width, (n + 1) as f64 * width);
            Bin { from, to, n: *count, predicted: share(*sum), observed: share(*came as f64) }
        };
        self.bins.iter().enumerate().map(bin).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_coin_scores_ln_2_and_a_quarter() {
        let mut tally = Tally::default();
        (0..10).for_each(|n| tally.add(0.5, n % 2 == 0));
        let Score { log_loss, brier, n } = tally.score();
        assert!((log_loss - std::f64::consts::LN_2).abs() < 1e-12 && n == 10);
        assert!((brier - 0.25).abs() < 1e-12);
    }

    #[test]
    fn certainty_that_is_wrong_costs_much_but_not_everything() {
        let mut tally = Tally::default();
        tally.add(1.0, false);
        assert!((tally.score().log_loss - 13.8155).abs() < 1e-3);
        assert_eq!(Tally::default().score().n, 0);
    }

    #[test]
    fn a_reliability_bin_compares_what_was_said_with_what_came() {
        let mut tally = Tally::default();
        (0..4).for_each(|n| tally.add(0.75, n < 3));
        tally.add(1.0, true);
        let bins = tally.reliability();
        assert_eq!((bins[7].n, bins[7].predicted, bins[7].observed), (4, Some(0.75), Some(0.75)));
        assert_eq!((bins[9].n, bins[0].predicted), (1, None));
    }
}
