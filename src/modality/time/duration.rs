//! [`HumanDuration`]: lengths of time as people write them, `2 hours`, `1h30m`, `never`.

use std::fmt;
use std::str::FromStr;

/// A length of time in seconds, above 0, or for ever.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct HumanDuration(Option<f64>);

/// Why a text is no length of time.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{text:?} is not a length of time: use a number above 0 and a unit, such as \"90 seconds\", \
     \"2 hours\", \"1h30m\", \"3 days\", or \"never\""
)]
pub struct DurationError {
    text: String,
}

/// Units from the largest: name, short name, seconds.
const UNITS: [(&str, &str, f64); 5] = [
    ("week", "w", 604_800.0),
    ("day", "d", 86_400.0),
    ("hour", "h", 3_600.0),
    ("minute", "m", 60.0),
    ("second", "s", 1.0),
];

impl HumanDuration {
    /// For ever.
    pub const NEVER: Self = Self(None);

    /// A length of time; for ever if it is not finite.
    pub fn seconds(seconds: f64) -> Self {
        Self(Some(seconds).filter(|it| it.is_finite() && *it > 0.0))
    }

    /// In seconds; `None` if it is for ever.
    pub fn as_seconds(self) -> Option<f64> {
        self.0
    }
}

/// In the largest unit that gives at least 1, to three digits: `2 hours`, `1.53 days`.
impl fmt::Display for HumanDuration {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(seconds) = self.0 else { return f.write_str("never") };
        let fits = UNITS[1..].iter().find(|(_, _, unit)| seconds >= *unit * 0.9995);
        let (name, _, unit) = fits.unwrap_or(&UNITS[4]);
        let number = three_digits(seconds / unit);
        let plural = if number == "1" { "" } else { "s" };
        write!(f, "{number} {name}{plural}")
    }
}

fn three_digits(value: f64) -> String {
    let decimals = match value {
        v if v < 1e-3 => return format!("{value:.2e}"),
        v if v < 0.9995 => 4,
        v if v < 9.995 => 2,
        v if v < 99.95 => 1,
        _ => 0,
    };
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
}

impl FromStr for HumanDuration {
    type Err = DurationError;

    fn from_str(text: &str) -> Result<Self, DurationError> {
        let bad = || DurationError { text: text.chars().take(40).collect() };
        if text.trim() == "never" {
            return Ok(Self::NEVER);
        }
        let (mut rest, mut seconds) = (text.trim(), 0.0);
        while !rest.is_empty() {
            let (amount, after) = number(rest).ok_or_else(bad)?;
            let after = after.trim_start();
            let end = after.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(after.len());
            seconds += amount * unit(&after[..end]).ok_or_else(bad)?;
            rest = after[end..].trim_start();
        }
        if seconds > 0.0 && seconds.is_finite() { Ok(Self(Some(seconds))) } else { Err(bad()) }
    }
}

/// The number that `text` begins with, and what follows it.
fn number(text: &str) -> Option<(f64, &str)> {
    let mantissa = text.find(|c: char| !c.is_ascii_digit() && c != '.').unwrap_or(text.len());
    let exponent = text[mantissa..].strip_prefix("e-").map_or(0, |rest| {
        2 + rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len())
    });
    let (number, rest) = text.split_at(mantissa + exponent);
    Some((number.parse().ok()?, rest))
}

fn unit(word: &str) -> Option<f64> {
    let short = |word: &str| match word {
        "min" | "mins" => Some(60.0),
        "sec" | "secs" => Some(1.0),
        "hr" | "hrs" => Some(3_600.0),
        _ => None,
    };
    let singular = word.strip_suffix('s').filter(|it| it.len() > 1).unwrap_or(word);
    let named = UNITS.iter().find(|(name, letter, _)| *name == singular || *letter == word);
    named.map(|(_, _, seconds)| *seconds).or_else(|| short(word))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[track_caller]
    fn check(text: &str, seconds: f64, printed: &str) {
        let read: HumanDuration = text.parse().unwrap();
        assert_eq!(read.as_seconds(), Some(seconds), "{text}");
        assert_eq!(read.to_string(), printed);
    }

    #[test]
    fn people_write_lengths_of_time_in_many_ways() {
        check("2 hours", 7_200.0, "2 hours");
        check("1 hour", 3_600.0, "1 hour");
        check("90 minutes", 5_400.0, "1.5 hours");
        check("1h30m", 5_400.0, "1.5 hours");
        check("1 day 12 hours", 129_600.0, "1.5 days");
        check("3d", 259_200.0, "3 days");
        check("2 weeks", 1_209_600.0, "14 days");
        check("45 min", 2_700.0, "45 minutes");
        check("0.25 seconds", 0.25, "0.25 seconds");
        check("1000 days", 86_400_000.0, "1000 days");
        assert_eq!("never".parse(), Ok(HumanDuration::NEVER));
        assert_eq!(HumanDuration::NEVER.to_string(), "never");
    }

    #[test]
    fn what_is_no_length_of_time_is_refused_with_examples() {
        for text in ["", "soon", "0 hours", "-2 hours", "2", "2 fortnights", "NaN s", "1..2 h"] {
            let error = text.parse::<HumanDuration>().unwrap_err().to_string();
            assert!(error.contains("2 hours"), "{error}");
        }
    }

    proptest! {
        #[test]
        fn what_is_printed_reads_back_to_three_digits(seconds in 1e-6..1e12_f64) {
            let read: HumanDuration = HumanDuration::seconds(seconds).to_string().parse().unwrap();
            let ratio = read.as_seconds().unwrap() / seconds;
            prop_assert!((ratio - 1.0).abs() < 0.006, "{seconds} {ratio}");
        }
    }
}
