//! The likelihood of λ under p(static | Δt) = 2 / (1 + e^{λΔt}) (paper, "Time").
//!
//! With S(t) = 2/(1+e^{λt}), an object that left between a and b after it was put there has the
//! likelihood S(a) − S(b), one that is still there S(a), one that left at t the density −S′(t).
//! In θ = ln λ, x = λa, y = λb, d = y − x:
//!
//! - ln(S(a) − S(b)) = ln 2 − x + ln(1 − e^{−d}) − ln(1 + e^{−x}) − ln(1 + e^{−y}), whose first
//!   derivative is −x + g(d) + σ(x) + σ(y), with g(d) = d/(e^d − 1), σ(x) = x/(1 + e^x);
//! - written with e^{−x} only, so that nothing overflows and nothing cancels for small λ.

use super::dwell::{Dwell, DwellData};

const LN_2: f64 = std::f64::consts::LN_2;

/// A log-likelihood at one point: its value, first and second derivative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Curve {
    pub value: f64,
    pub slope: f64,
    pub bend: f64,
}

impl Curve {
    pub fn plus(self, other: Self, weight: f64) -> Self {
        Self {
            value: self.value + weight * other.value,
            slope: self.slope + weight * other.slope,
            bend: self.bend + weight * other.bend,
        }
    }
}

/// ln of the likelihood of all dwells at θ = ln λ, λ in 1/s.
pub(super) fn log_likelihood(data: &DwellData, theta: f64) -> Curve {
    let rate = libm::exp(theta);
    data.weighted().fold(Curve::default(), |sum, (dwell, n)| sum.plus(one(dwell, rate, theta), n))
}

fn one(dwell: Dwell, rate: f64, theta: f64) -> Curve {
    let x = rate * dwell.from_s;
    if !dwell.has_ended() {
        return still_there(x);
    }
    let d = rate * (dwell.until_s - dwell.from_s);
    if d <= 0.0 { left_at(x, theta) } else { left_between(x, d) }
}

/// σ(x) = x/(1 + e^x), and x·σ′(x).
fn sigma(x: f64) -> (f64, f64) {
    let e = libm::exp(-x);
    let sigma = x * e / (1.0 + e);
    (sigma, sigma * (1.0 - x + sigma))
}

fn still_there(x: f64) -> Curve {
    let (s, s1) = sigma(x);
    Curve { value: LN_2 - x - libm::log1p(libm::exp(-x)), slope: s - x, bend: s1 - x }
}

fn left_at(x: f64, theta: f64) -> Curve {
    let (s, s1) = sigma(x);
    let value = theta + LN_2 - x - 2.0 * libm::log1p(libm::exp(-x));
    Curve { value, slope: 1.0 - x + 2.0 * s, bend: 2.0 * s1 - x }
}

fn left_between(x: f64, d: f64) -> Curve {
    let y = x + d;
    let ((sx, sx1), (sy, sy1)) = (sigma(x), sigma(y));
    let gone = -libm::expm1(-d);
    // g(d) = d/(e^d − 1), and d·g′(d).
    let g = d * libm::exp(-d) / gone;
    let value = LN_2 - x + libm::log(gone)
        - libm::log1p(libm::exp(-x))
        - libm::log1p(libm::exp(-y));
    Curve { value, slope: g - x + sx + sy, bend: g * (1.0 - d - g) - x + sx1 + sy1 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn survival(rate: f64, t: f64) -> f64 {
        2.0 / (1.0 + libm::exp(rate * t))
    }

    fn data(dwell: Dwell) -> DwellData {
        let mut data = DwellData::default();
        data.add(dwell);
        data
    }

    proptest! {
        #[test]
        fn the_likelihood_is_the_difference_of_two_probabilities(
            a in 0.0..5e4_f64, d in 1.0..5e4_f64, rate in 1e-6..1e-4_f64,
        ) {
            let dwell = data(Dwell::between(a, a + d).unwrap());
            let value = log_likelihood(&dwell, libm::log(rate)).value;
            prop_assert!((libm::exp(value) - (survival(rate, a) - survival(rate, a + d))).abs() < 1e-9);
            let censored = data(Dwell::at_least(a + d).unwrap());
            let value = log_likelihood(&censored, libm::log(rate)).value;
            prop_assert!((libm::exp(value) - survival(rate, a + d)).abs() < 1e-9);
        }

        #[test]
        fn the_derivatives_are_those_of_the_value(
            a in 0.0..5e4_f64, d in 0.0..5e4_f64, kind in 0..3, rate in 1e-6..1e-3_f64,
        ) {
            let dwell = data(match kind {
                0 => Dwell::between(a, a + d + 1.0).unwrap(),
                1 => Dwell::exactly(a + 1.0).unwrap(),
                _ => Dwell::at_least(a + 1.0).unwrap(),
            });
            let (theta, h) = (libm::log(rate), 1e-4);
            let at = |theta| log_likelihood(&dwell, theta);
            let slope = (at(theta + h).value - at(theta - h).value) / (2.0 * h);
            let bend = (at(theta + h).slope - at(theta - h).slope) / (2.0 * h);
            let found = at(theta);
            prop_assert!((found.slope - slope).abs() < 1e-5 * (1.0 + slope.abs()), "{found:?} {slope}");
            prop_assert!((found.bend - bend).abs() < 1e-5 * (1.0 + bend.abs()), "{found:?} {bend}");
        }
    }

    #[test]
    fn tiny_and_huge_rates_stay_finite() {
        let dwell = data(Dwell::between(1.0, 2.0).unwrap());
        for theta in [-40.0, -20.0, 0.0, 3.0, 5.0] {
            let curve = log_likelihood(&dwell, theta);
            assert!(curve.value.is_finite() && curve.slope.is_finite(), "{theta} {curve:?}");
        }
    }
}
