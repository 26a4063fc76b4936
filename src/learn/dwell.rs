//! [`Dwell`]: how long a thing stayed, as far as that is known; [`DwellData`]: many of them.

use std::collections::BTreeMap;

/// How long something stayed where it was, in seconds since it was known to be there: more than
/// `from_s`, at most `until_s`. Equal where the moment is known; `until_s` is infinite where it
/// has not gone yet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dwell {
    /// It was still there then, ≥ 0.
    pub from_s: f64,
    /// It was gone by then, > 0.
    pub until_s: f64,
}

/// Why a dwell was refused.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum DwellError {
    /// Not a number, or before it was put there.
    #[error("a thing cannot stay from {from_s} s to {until_s} s: both must be numbers ≥ 0")]
    NotATime {
        /// What was given.
        from_s: f64,
        /// What was given.
        until_s: f64,
    },
    /// It ends before it begins.
    #[error(
        "time runs backwards: still there after {from_s} s, but gone after {until_s} s; sort the \
         looks by time"
    )]
    Backwards {
        /// What was given.
        from_s: f64,
        /// What was given.
        until_s: f64,
    },
}

impl Dwell {
    /// It left between two looks, `from_s` and `until_s` after it was put there.
    pub fn between(from_s: f64, until_s: f64) -> Result<Self, DwellError> {
        let number = |it: f64| !it.is_nan() && it >= 0.0;
        if !number(from_s) || !number(until_s) || from_s.is_infinite() {
            return Err(DwellError::NotATime { from_s, until_s });
        }
        if until_s < from_s {
            return Err(DwellError::Backwards { from_s, until_s });
        }
        Ok(Self { from_s, until_s })
    }

    /// It left exactly then.
    pub fn exactly(at_s: f64) -> Result<Self, DwellError> {
        Self::between(at_s, at_s)
    }

    /// It was still there when last seen: right-censored.
    pub fn at_least(from_s: f64) -> Result<Self, DwellError> {
        Self::between(from_s, f64::INFINITY)
    }

    /// Whether it is known to have left.
    pub fn has_ended(self) -> bool {
        self.until_s.is_finite()
    }
}

/// Many dwells, counted. Those whose ends agree to a thousandth are kept as one with its mean, so
/// that a fit costs the same for a million looks as for a thousand.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DwellData {
    bins: BTreeMap<(u32, u32, bool), Sum>,
    count: u64,
    ended: u64,
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Sum {
    count: f64,
    from_s: f64,
    until_s: f64,
}

/// The exponent and ten bits of the mantissa: steps of about a thousandth.
fn step(seconds: f64) -> u32 {
    (seconds.to_bits() >> 42) as u32
}

impl DwellData {
    /// Counts one more. A dwell of no length at all tells nothing and is left out.
    pub fn add(&mut self, dwell: Dwell) {
        let Dwell { from_s, until_s } = dwell;
        if until_s <= 0.0 || (from_s <= 0.0 && until_s.is_infinite()) {
            return;
        }
        self.count += 1;
        self.ended += u64::from(dwell.has_ended());
        let exact = from_s.to_bits() == until_s.to_bits();
        let sum = self.bins.entry((step(from_s), step(until_s), exact)).or_default();
        sum.count += 1.0;
        sum.from_s += from_s;
        sum.until_s += until_s;
    }

    /// Takes in the dwells of another.
    pub fn extend(&mut self, other: &Self) {
        self.count += other.count;
        self.ended += other.ended;
        for (key, sum) in &other.bins {
            let own = self.bins.entry(*key).or_default();
            own.count += sum.count;
            own.from_s += sum.from_s;
            own.until_s += sum.until_s;
        }
    }

    /// How many there are.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// How many of them are known to have ended.
    pub fn ended(&self) -> u64 {
        self.ended
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The different ones, with how often each was met.
    pub(super) fn weighted(&self) -> impl Iterator<Item = (Dwell, f64)> {
        self.bins.iter().map(|((_, _, exact), sum)| {
            let from_s = sum.from_s / sum.count;
            let until_s = if *exact { from_s } else { sum.until_s / sum.count };
            (Dwell { from_s, until_s }, sum.count)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_that_run_backwards_are_refused_with_the_mend() {
        let error = Dwell::between(20.0, 10.0).unwrap_err().to_string();
        assert!(error.contains("backwards") && error.contains("sort"), "{error}");
        for (from, until) in [(f64::NAN, 1.0), (-1.0, 1.0), (1.0, f64::NAN), (f64::INFINITY, 1.0)] {
            assert!(matches!(Dwell::between(from, until), Err(DwellError::NotATime { .. })));
        }
    }

    #[test]
    fn alike_dwells_are_counted_together_and_keep_their_mean() {
        let mut data = DwellData::default();
        for k in 0..1000 {
            data.add(Dwell::between(3600.0 + f64::from(k) * 1e-3, 7200.0).unwrap());
        }
        data.add(Dwell::at_least(50.0).unwrap());
        data.add(Dwell::at_least(0.0).unwrap());
        assert_eq!((data.count(), data.ended()), (1001, 1000));
        let weighted: Vec<_> = data.weighted().collect();
        assert_eq!(weighted.len(), 2, "{weighted:?}");
        assert!((weighted[1].0.from_s - 3600.4995).abs() < 1e-6, "{weighted:?}");
    }
}
