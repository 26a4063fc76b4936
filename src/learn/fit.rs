//! [`fit_dwells`]: λ of every class, with its interval.

use std::collections::BTreeMap;

use super::dwell::DwellData;
use super::optimise::{DROP_95, interval, maximum};
use super::pool::{Family, family};
use super::sigmoid::{Curve, log_likelihood};

/// Bounds of ln λ: a half-life from a tenth of a second to some 35,000 years.
pub(super) const THETA: (f64, f64) = (-27.6, 2.4);

/// λ of a class.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DwellFit {
    /// λ in 1/s: the mode of its posterior.
    pub rate_per_s: f64,
    /// Lower end of the 95 % interval; 0 where the data sets none.
    pub low_per_s: f64,
    /// Upper end; infinite where the data sets none.
    pub high_per_s: f64,
    /// How many dwells it rests on.
    pub count: u64,
    /// How many of them are known to have ended.
    pub ended: u64,
    /// How much of it is the family's, 0 to 1: 1 for a class without data.
    pub pooled: f64,
}

/// λ of every class by maximum likelihood, shrunk to the family of all of them; and the family,
/// if there are two or more. A class without data has the family's λ, or if there is none, is
/// left out. Nothing at all gives nothing.
///
/// The interval is that of the profile likelihood (with the family's density), so that it is
/// right for few data too, where a normal one is not.
pub fn fit_dwells(
    classes: &BTreeMap<String, DwellData>,
) -> (BTreeMap<String, DwellFit>, Option<Family>) {
    let with_data: Vec<&DwellData> = classes.values().filter(|data| !data.is_empty()).collect();
    let family = (with_data.len() > 1).then(|| family_of(&with_data));
    let fit = |data: &DwellData| match family {
        None if data.is_empty() => None,
        family => Some(fit_one(data, family)),
    };
    let fits = classes.iter().filter_map(|(class, data)| Some((class.clone(), fit(data)?)));
    (fits.collect(), family)
}

fn family_of(classes: &[&DwellData]) -> Family {
    let mut all = DwellData::default();
    classes.iter().for_each(|data| all.extend(data));
    let start = maximum(|theta| log_likelihood(&all, theta), THETA.0, THETA.1);
    let alone: Vec<Option<(f64, f64)>> = classes.iter().map(|data| parabola(data)).collect();
    family(classes.len(), start, |n, family| {
        if let Some((top, precision)) = alone[n] {
            let sum = precision + family.precision();
            return ((top * precision + family.mean * family.precision()) / sum, sum);
        }
        let at = |theta| posterior(classes[n], Some(family), theta);
        let mode = maximum(at, THETA.0, THETA.1);
        // Where the likelihood is not curved downwards, what is known is the family's.
        (mode, (-at(mode).bend).max(family.precision()))
    })
}

/// With enough data a likelihood is a parabola about its maximum: its top and its precision.
fn parabola(data: &DwellData) -> Option<(f64, f64)> {
    const ENOUGH: u64 = 5;
    if data.ended() < ENOUGH {
        return None;
    }
    let at = |theta| log_likelihood(data, theta);
    let top = maximum(at, THETA.0, THETA.1);
    let precision = -at(top).bend;
    (precision > 0.5).then_some((top, precision))
}

fn posterior(data: &DwellData, family: Option<Family>, theta: f64) -> Curve {
    let likelihood = log_likelihood(data, theta);
    family.map_or(likelihood, |family| likelihood.plus(family.curve(theta), 1.0))
}

fn fit_one(data: &DwellData, family: Option<Family>) -> DwellFit {
    let at = |theta| posterior(data, family, theta);
    let mode = maximum(at, THETA.0, THETA.1);
    let (low, high) = interval(at, mode, THETA, DROP_95);
    let pooled = family.map_or(0.0, |it| it.precision() / (-at(mode).bend).max(it.precision()));
    DwellFit {
        rate_per_s: if mode > THETA.0 + 1e-6 { libm::exp(mode) } else { 0.0 },
        low_per_s: if low > THETA.0 { libm::exp(low) } else { 0.0 },
        high_per_s: if high < THETA.1 { libm::exp(high) } else { f64::INFINITY },
        count: data.count(),
        ended: data.ended(),
        pooled,
    }
}
