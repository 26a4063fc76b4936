//! [`BirthDeath`]: a thing leaves its place and may come back, which the sigmoid cannot express.
//!
//! A Markov chain in continuous time with two states, here and away: it leaves at rate μ and
//! returns at rate ν. From here, P(here after Δt) = π + (1 − π) e^{−(μ+ν)Δt}, from away
//! π (1 − e^{−(μ+ν)Δt}), with π = ν/(μ + ν) (Cox and Miller, "The theory of stochastic
//! processes", 1965, §4.2).

use std::collections::BTreeMap;

use super::optimise::simplex;
use super::pool::Family;

/// Rates in 1/s, each > 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BirthDeath {
    /// μ: how fast a thing leaves.
    pub leave_per_s: f64,
    /// ν: how fast it returns.
    pub return_per_s: f64,
}

/// The rates of a class and what they rest on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BirthDeathFit {
    /// The rates.
    pub model: BirthDeath,
    /// 95 % interval of μ, 1/s.
    pub leave_95: (f64, f64),
    /// 95 % interval of ν, 1/s.
    pub return_95: (f64, f64),
    /// How many pairs of looks, and stretches watched, it rests on.
    pub count: u64,
}

/// What is known of a thing and its place, counted.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PairCounts {
    /// Pairs of looks: whether it was here at the first and at the second, by the time between
    /// them (to a thousandth): how many, and the sum of the times in seconds.
    pairs: BTreeMap<(bool, bool, u32), (f64, f64)>,
    /// Seconds watched while here and while away, and how often it was seen to leave and return.
    watched: [(f64, f64); 2],
    count: u64,
}

impl BirthDeath {
    /// The share of time it is here in the long run.
    pub fn share(self) -> f64 {
        self.return_per_s / (self.leave_per_s + self.return_per_s)
    }

    /// Probability that it is here `after_s` seconds after it was here with probability `before`.
    pub fn here(self, before: f64, after_s: f64) -> f64 {
        let share = self.share();
        let rate = self.leave_per_s + self.return_per_s;
        share + (before - share) * libm::exp(-rate * after_s)
    }
}

impl PairCounts {
    /// Counts one pair of looks `after_s` seconds apart; times that are none are left out.
    pub fn pair(&mut self, here_before: bool, here_after: bool, after_s: f64) {
        if !(after_s.is_finite() && after_s > 0.0) {
            return;
        }
        let key = (here_before, here_after, (after_s.to_bits() >> 42) as u32);
        let (count, sum) = self.pairs.entry(key).or_default();
        *count += 1.0;
        *sum += after_s;
        self.count += 1;
    }

    /// Counts a stretch during which it was watched, and whether it changed at its end.
    pub fn stretch(&mut self, here: bool, seconds: f64, changed: bool) {
        if !(seconds.is_finite() && seconds >= 0.0) {
            return;
        }
        let (time, changes) = &mut self.watched[usize::from(!here)];
        *time += seconds;
        *changes += f64::from(u8::from(changed));
        self.count += 1;
    }

    /// Takes in the counts of another.
    pub fn extend(&mut self, other: &Self) {
        for (key, (count, sum)) in &other.pairs {
            let own = self.pairs.entry(*key).or_default();
            own.0 += count;
            own.1 += sum;
        }
        for (own, (time, changes)) in self.watched.iter_mut().zip(other.watched) {
            own.0 += time;
            own.1 += changes;
        }
        self.count += other.count;
    }

    /// How many pairs and stretches there are.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// ln of the likelihood at (ln μ, ln ν).
    fn log_likelihood(&self, [leave, back]: &[f64; 2]) -> f64 {
        let model = BirthDeath { leave_per_s: libm::exp(*leave), return_per_s: libm::exp(*back) };
        let [(here_s, left), (away_s, returned)] = self.watched;
        let watched = left * leave - model.leave_per_s * here_s + returned * back
            - model.return_per_s * away_s;
        let pairs = self.pairs.iter().map(|((before, after, _), (count, sum))| {
            let here = model.here(f64::from(u8::from(*before)), sum / count);
            count * libm::log(if *after { here } else { 1.0 - here }.max(1e-300))
        });
        watched + pairs.sum::<f64>()
    }
}

/// Where ln of a rate in 1/s is looked for.
const BOUND: (f64, f64) = (-23.0, 2.4);
/// The family of rates where nothing is known: an hour, give or take a factor of e².
const WIDE: Family = Family { mean: -8.2, spread: 3.0 };

/// The rates of every class, shrunk to what all classes have in common, and those of all together
/// under the empty name. Without any data, nothing.
pub fn fit_pairs(classes: &BTreeMap<String, PairCounts>) -> BTreeMap<String, BirthDeathFit> {
    let mut all = PairCounts::default();
    classes.values().for_each(|counts| all.extend(counts));
    if all.count() == 0 {
        return BTreeMap::new();
    }
    let together = mode(&all, [WIDE, WIDE]);
    let common = families(classes, together);
    let fits = classes.iter().map(|(class, counts)| (class.clone(), fit_one(counts, common)));
    fits.chain([(String::new(), fit_one(&all, [WIDE, WIDE]))]).collect()
}

/// The families of ln μ and ln ν, by a few rounds of expectation-maximisation.
fn families(classes: &BTreeMap<String, PairCounts>, start: [f64; 2]) -> [Family; 2] {
    let mut families = start.map(|mean| Family { mean, spread: 1.5 });
    let known: Vec<&PairCounts> = classes.values().filter(|it| it.count() > 0).collect();
    if known.len() < 2 {
        return families;
    }
    for _ in 0..8 {
        let modes: Vec<[f64; 2]> = known.iter().map(|counts| mode(counts, families)).collect();
        for (n, family) in families.iter_mut().enumerate() {
            let count = modes.len() as f64;
            let mean = modes.iter().map(|mode| mode[n]).sum::<f64>() / count;
            let scatter = modes.iter().map(|mode| (mode[n] - mean) * (mode[n] - mean));
            let square = (scatter.sum::<f64>() + 2.0 * 1.5 * 1.5) / (count + 2.0);
            *family = Family { mean, spread: libm::sqrt(square) };
        }
    }
    families
}

fn posterior(counts: &PairCounts, families: [Family; 2], at: &[f64; 2]) -> f64 {
    if at.iter().any(|theta| *theta < BOUND.0 || *theta > BOUND.1) {
        return f64::NEG_INFINITY;
    }
    let prior = at.iter().zip(families).map(|(theta, family)| family.curve(*theta).value);
    counts.log_likelihood(at) + prior.sum::<f64>()
}

fn mode(counts: &PairCounts, families: [Family; 2]) -> [f64; 2] {
    let value = |at: &[f64; 2]| posterior(counts, families, at);
    let start = families.map(|family| family.mean);
    let near = simplex(value, start, 1.0, 200);
    simplex(value, near, 0.1, 100)
}

fn fit_one(counts: &PairCounts, families: [Family; 2]) -> BirthDeathFit {
    let at = mode(counts, families);
    let spread = spread(|it| posterior(counts, families, it), at);
    let around = |n: usize| {
        let by = 1.959_963_985 * spread[n];
        (libm::exp(at[n] - by), libm::exp(at[n] + by))
    };
    let model = BirthDeath { leave_per_s: libm::exp(at[0]), return_per_s: libm::exp(at[1]) };
    let (leave_95, return_95) = (around(0), around(1));
    BirthDeathFit { model, leave_95, return_95, count: counts.count() }
}

/// Standard deviations of both logarithms, from the curvature at the maximum.
fn spread(value: impl Fn(&[f64; 2]) -> f64, [x, y]: [f64; 2]) -> [f64; 2] {
    let h = 1e-3;
    let at = |i: f64, j: f64| value(&[x + i * h, y + j * h]);
    let second = |up: f64, down: f64| (up - 2.0 * at(0.0, 0.0) + down) / (h * h);
    let a = -second(at(1.0, 0.0), at(-1.0, 0.0));
    let d = -second(at(0.0, 1.0), at(0.0, -1.0));
    let b = -(at(1.0, 1.0) - at(1.0, -1.0) - at(-1.0, 1.0) + at(-1.0, -1.0)) / (4.0 * h * h);
    let determinant = a * d - b * b;
    if !(determinant.is_finite() && determinant > 0.0 && a > 0.0) {
        return [f64::INFINITY; 2];
    }
    [libm::sqrt(d / determinant), libm::sqrt(a / determinant)]
}

#[cfg(test)]
mod tests {
    use super::*;

    const MODEL: BirthDeath = BirthDeath { leave_per_s: 1e-4, return_per_s: 3e-4 };

    #[test]
    fn what_was_here_tends_to_its_share() {
        assert!((MODEL.here(1.0, 0.0) - 1.0).abs() < 1e-12);
        assert!((MODEL.here(1.0, 1e9) - 0.75).abs() < 1e-12);
        assert!((MODEL.here(0.0, 1e9) - 0.75).abs() < 1e-12);
        // Chapman and Kolmogorov: two steps are one.
        let twice = MODEL.here(MODEL.here(1.0, 1000.0), 2000.0);
        assert!((twice - MODEL.here(1.0, 3000.0)).abs() < 1e-12);
    }

    #[test]
    fn rates_are_found_from_pairs_and_from_what_was_watched() {
        let (mut pairs, mut watched) = (PairCounts::default(), PairCounts::default());
        for after_s in [600.0, 1800.0, 7200.0] {
            for before in [true, false] {
                let here = MODEL.here(f64::from(u8::from(before)), after_s);
                for n in 0..1000 {
                    pairs.pair(before, f64::from(n) < 1000.0 * here, after_s);
                }
            }
        }
        for _ in 0..400 {
            watched.stretch(true, 1e4, true);
            watched.stretch(false, 1e4 / 3.0, true);
        }
        for counts in [pairs, watched] {
            let fits = fit_pairs(&BTreeMap::from([("mug".to_owned(), counts)]));
            let BirthDeathFit { model, leave_95, return_95, .. } = fits["mug"];
            assert!((model.leave_per_s / 1e-4 - 1.0).abs() < 0.05, "{model:?}");
            assert!((model.return_per_s / 3e-4 - 1.0).abs() < 0.05, "{model:?}");
            assert!(leave_95.0 < 1e-4 && 1e-4 < leave_95.1, "{leave_95:?}");
            assert!(return_95.0 < 3e-4 && 3e-4 < return_95.1, "{return_95:?}");
        }
    }

    #[test]
    fn nothing_gives_nothing_and_a_class_without_data_the_family() {
        assert!(fit_pairs(&BTreeMap::new()).is_empty());
        let mut mug = PairCounts::default();
        (0..100).for_each(|n| mug.pair(true, n % 4 != 0, 3600.0));
        mug.pair(true, true, f64::NAN);
        let classes = [("mug".to_owned(), mug), ("cup".to_owned(), PairCounts::default())];
        let fits = fit_pairs(&classes.into_iter().collect());
        assert_eq!(fits["cup"].count, 0);
        assert!(fits["cup"].leave_95.1 / fits["cup"].leave_95.0 > 10.0, "{:?}", fits["cup"]);
    }
}
