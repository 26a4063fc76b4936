//! Partial pooling: classes of which little is known lean on all the others.
//!
//! ln of a class's rate is taken to come from a normal family N(μ, τ²) of all classes of the
//! household; μ and τ are learned from the data too (empirical Bayes; Efron and Morris, "Data
//! analysis using Stein's estimator and its generalizations", 1975), by expectation-maximisation
//! with each class's posterior taken as normal around its mode.

use super::sigmoid::Curve;

/// The family that the rates of classes come from: ln(rate in 1/s) ~ N(mean, spread²).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Family {
    /// μ: mean of ln(rate in 1/s).
    pub mean: f64,
    /// τ: standard deviation of it, > 0.
    pub spread: f64,
}

/// As much weight as two more classes with a spread of 1 (a factor of e): with few classes their
/// spread is not known well, and must not shrink to nothing.
const PRIOR_CLASSES: f64 = 2.0;
const PRIOR_SPREAD: f64 = 1.0;

impl Family {
    /// ln of the density at θ, but for a constant.
    pub(super) fn curve(self, theta: f64) -> Curve {
        let (off, precision) = (theta - self.mean, self.precision());
        Curve { value: -0.5 * off * off * precision, slope: -off * precision, bend: -precision }
    }

    /// 1/τ².
    pub(super) fn precision(self) -> f64 {
        1.0 / (self.spread * self.spread)
    }
}

/// The family of several classes: `mode` gives for class `n` under a family the mode of its
/// posterior and the precision there. `start` is the mean to begin with.
pub(super) fn family(
    classes: usize,
    start: f64,
    mode: impl Fn(usize, Family) -> (f64, f64),
) -> Family {
    let mut family = Family { mean: start, spread: PRIOR_SPREAD };
    for _ in 0..100 {
        let modes: Vec<(f64, f64)> = (0..classes).map(|n| mode(n, family)).collect();
        let mean = modes.iter().map(|(theta, _)| theta).sum::<f64>() / classes as f64;
        let scatter = modes.iter().map(|(theta, precision)| {
            (theta - mean) * (theta - mean) + 1.0 / precision
        });
        let square = (scatter.sum::<f64>() + PRIOR_CLASSES * PRIOR_SPREAD * PRIOR_SPREAD)
            / (classes as f64 + PRIOR_CLASSES);
        let next = Family { mean, spread: libm::sqrt(square) };
        let settled = (next.mean - family.mean).abs() + (next.spread - family.spread).abs() < 1e-6;
        family = next;
        if settled {
            break;
        }
    }
    family
}
