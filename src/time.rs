//! Instants on the recording clock and the ways a person names one.
//!
//! Knows nothing of files or graphs. There is no `now()`: time comes from messages only.
//! Main items: [`Stamp`], [`At`].

use std::fmt;
use std::str::FromStr;

use jiff::Timestamp;

const NANOS_PER_SECOND: u64 = 1_000_000_000;

/// Instant on the recording clock: nanoseconds since the Unix epoch (MCAP `log_time`).
///
/// The largest one is that of `i64`, the year 2262, so that differences always fit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Stamp(u64);

impl Stamp {
    /// The Unix epoch.
    pub const EPOCH: Self = Self(0);
    /// The last instant that can be named.
    pub const MAX: Self = Self(i64::MAX as u64);

    /// Wraps nanoseconds since the epoch; later instants than [`Stamp::MAX`] become it.
    pub const fn from_nanos(nanos: u64) -> Self {
        if nanos > Self::MAX.0 { Self::MAX } else { Self(nanos) }
    }

    /// Nanoseconds since the epoch.
    pub const fn nanos(self) -> u64 {
        self.0
    }

    /// Seconds from `earlier` to `self`; zero if `earlier` is in fact the later one.
    pub fn seconds_since(self, earlier: Self) -> f64 {
        self.0.saturating_sub(earlier.0) as f64 / NANOS_PER_SECOND as f64
    }

    /// The instant `nanos` after this one.
    pub const fn plus_nanos(self, nanos: u64) -> Self {
        Self::from_nanos(self.0.saturating_add(nanos))
    }
}

/// RFC 3339 in UTC, with as many decimals as needed.
impl fmt::Display for Stamp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let nanos = i128::from(self.0);
        match Timestamp::from_nanosecond(nanos) {
            Ok(timestamp) => write!(f, "{timestamp}"),
            Err(_) => write!(f, "{nanos}ns"),
        }
    }
}

impl FromStr for Stamp {
    type Err = TimeError;

    fn from_str(text: &str) -> Result<Self, TimeError> {
        let instant: Timestamp =
            text.parse().map_err(|_| TimeError::Instant { text: text.to_owned() })?;
        let nanos = u64::try_from(instant.as_nanosecond());
        match nanos {
            Ok(nanos) if nanos <= Self::MAX.0 => Ok(Self(nanos)),
            _ if instant < Timestamp::UNIX_EPOCH => {
                Err(TimeError::BeforeEpoch { text: text.to_owned() })
            }
            _ => Err(TimeError::TooLate { text: text.to_owned() }),
        }
    }
}

/// Why a time was not understood.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TimeError {
    /// Not an RFC 3339 instant.
    #[error("{text:?} is not an RFC 3339 instant such as 2026-01-05T08:00:00Z")]
    Instant {
        /// What was given.
        text: String,
    },
    /// Before 1970.
    #[error("{text:?} is before 1970, where recordings begin")]
    BeforeEpoch {
        /// What was given.
        text: String,
    },
    /// After 2262.
    #[error("{text:?} is after 2262-04-11, where nanoseconds in 64 bits end")]
    TooLate {
        /// What was given.
        text: String,
    },
    /// Not a duration.
    #[error("{text:?} is not a duration such as 90s, 1h30m or 2d")]
    Span {
        /// What was given.
        text: String,
    },
    /// None of the forms of [`At`].
    #[error(
        "{text:?} is not a point in a recording: use start, end, a time from the start (12.5s, \
         36h, 65d), an RFC 3339 instant, an event (#42), a change (c7) or nanoseconds"
    )]
    At {
        /// What was given.
        text: String,
    },
}

/// A point in a recording, as a person names it.
///
/// ```
/// use scenefold::time::{At, Stamp};
/// assert_eq!("#42".parse(), Ok(At::Event(42)));
/// assert_eq!("c7".parse(), Ok(At::Change(7)));
/// assert_eq!("36h".parse(), Ok(At::SinceStart(36 * 3600 * 1_000_000_000)));
/// assert_eq!("1970-01-01T00:00:01Z".parse(), Ok(At::Instant(Stamp::from_nanos(1_000_000_000))));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum At {
    /// Right after the initial graph was recorded.
    Start,
    /// After the last event.
    End,
    /// This many nanoseconds after the first event.
    SinceStart(u64),
    /// After every event up to and including this instant.
    Instant(Stamp),
    /// After the event with this number; 0 is before the first.
    Event(u64),
    /// After the event that recorded the change with this number, and what it did to the graph.
    Change(u64),
}

impl fmt::Display for At {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Start => f.write_str("start"),
            Self::End => f.write_str("end"),
            Self::SinceStart(nanos) => write!(f, "{}", Span(*nanos)),
            Self::Instant(stamp) => write!(f, "{stamp}"),
            Self::Event(order) => write!(f, "#{order}"),
            Self::Change(seq) => write!(f, "c{seq}"),
        }
    }
}

impl FromStr for At {
    type Err = TimeError;

    fn from_str(text: &str) -> Result<Self, TimeError> {
        let unknown = || TimeError::At { text: text.to_owned() };
        match text {
            "start" => return Ok(Self::Start),
            "end" => return Ok(Self::End),
            _ => {}
        }
        if let Some(number) = text.strip_prefix('#') {
            return digits(number).map(Self::Event).ok_or_else(unknown);
        }
        if let Some(number) = text.strip_prefix('c') {
            return digits(number).map(Self::Change).ok_or_else(unknown);
        }
        if let Some(nanos) = digits(text) {
            return Ok(Self::Instant(Stamp::from_nanos(nanos)));
        }
        if let Ok(span) = text.parse::<Span>() {
            return Ok(Self::SinceStart(span.0));
        }
        match text.parse() {
            Ok(stamp) => Ok(Self::Instant(stamp)),
            Err(beyond @ (TimeError::BeforeEpoch { .. } | TimeError::TooLate { .. })) => Err(beyond),
            Err(_) => Err(unknown()),
        }
    }
}

fn digits(text: &str) -> Option<u64> {
    text.bytes().all(|byte| byte.is_ascii_digit()).then(|| text.parse().ok()).flatten()
}

/// A length of time in nanoseconds, written `12.5s`, `1h30m`, `2d`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Span(pub u64);

/// Units from the largest; a day is 24 hours.
const UNITS: [(&str, u64); 8] = [
    ("w", 7 * 86_400 * NANOS_PER_SECOND),
    ("d", 86_400 * NANOS_PER_SECOND),
    ("h", 3_600 * NANOS_PER_SECOND),
    ("m", 60 * NANOS_PER_SECOND),
    ("s", NANOS_PER_SECOND),
    ("ms", 1_000_000),
    ("us", 1_000),
    ("ns", 1),
];

impl fmt::Display for Span {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut rest = self.0;
        for (unit, nanos) in &UNITS[1..4] {
            if rest >= *nanos {
                write!(f, "{}{unit}", rest / nanos)?;
                rest %= nanos;
            }
        }
        if rest > 0 || self.0 == 0 {
            write!(f, "{}s", rest as f64 / NANOS_PER_SECOND as f64)?;
        }
        Ok(())
    }
}

impl FromStr for Span {
    type Err = TimeError;

    fn from_str(text: &str) -> Result<Self, TimeError> {
        let bad = || TimeError::Span { text: text.to_owned() };
        let mut rest = text;
        let mut total: u64 = 0;
        while !rest.is_empty() {
            let digits_end = rest
                .find(|c: char| !c.is_ascii_digit() && c != '.')
                .filter(|end| *end > 0)
                .ok_or_else(bad)?;
            let (number, after) = rest.split_at(digits_end);
            let unit_end =
                after.find(|c: char| c.is_ascii_digit() || c == '.').unwrap_or(after.len());
            let (unit, after) = after.split_at(unit_end);
            let nanos = nanos_of(number, unit).ok_or_else(bad)?;
            total = total.checked_add(nanos).ok_or_else(bad)?;
            rest = after;
        }
        if text.is_empty() { Err(bad()) } else { Ok(Self(total)) }
    }
}

/// `12.5`, `s` in nanoseconds, exactly: the fraction is not taken through a float.
fn nanos_of(number: &str, unit: &str) -> Option<u64> {
    let (_, scale) = UNITS.iter().find(|(name, _)| *name == unit)?;
    let (whole, fraction) = number.split_once('.').unwrap_or((number, ""));
    if whole.is_empty() || fraction.len() > 18 {
        return None;
    }
    let whole = digits(whole)?.checked_mul(*scale)?;
    let numerator = if fraction.is_empty() { 0 } else { u128::from(digits(fraction)?) };
    let denominator = 10_u128.pow(fraction.len() as u32);
    let part = u64::try_from(numerator * u128::from(*scale) / denominator).ok()?;
    whole.checked_add(part)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(text: &str, expected: At) {
        assert_eq!(text.parse::<At>(), Ok(expected), "{text}");
    }

    #[test]
    fn every_form_of_at_is_read() {
        check("start", At::Start);
        check("end", At::End);
        check("12.5s", At::SinceStart(12_500_000_000));
        check("36h", At::SinceStart(36 * 3_600_000_000_000));
        check("65d", At::SinceStart(65 * 86_400_000_000_000));
        check("1h30m", At::SinceStart(5_400_000_000_000));
        check("#42", At::Event(42));
        check("c7", At::Change(7));
        check("1767571200000000000", At::Instant(Stamp::from_nanos(1_767_571_200_000_000_000)));
        check("2026-01-05T00:00:00Z", At::Instant(Stamp::from_nanos(1_767_571_200_000_000_000)));
        check(
            "2026-01-05T02:00:00.5+02:00",
            At::Instant(Stamp::from_nanos(1_767_571_200_500_000_000)),
        );
    }

    #[test]
    fn what_is_no_point_in_time_is_refused_with_the_forms() {
        for text in
            ["", "soon", "#", "c", "#-1", "12", "3y", "1.2.3s", ".s", "s", "1969-01-01T00:00:00Z"]
        {
            let parsed = text.parse::<At>();
            assert!(text == "12" || parsed.is_err(), "{text}: {parsed:?}");
        }
        for text in ["2262-04-12T00:00:00Z", "2500-01-01T00:00:00Z", "2600-01-01T00:00:00Z"] {
            assert_eq!(text.parse::<Stamp>(), Err(TimeError::TooLate { text: text.to_owned() }));
        }
        let message = "soon".parse::<At>().unwrap_err().to_string();
        assert!(message.contains("36h") && message.contains("c7"), "{message}");
    }

    #[test]
    fn a_stamp_prints_as_rfc_3339_and_reads_back() {
        for nanos in [0, 1, 1_767_571_200_000_000_000, 1_767_571_212_500_000_000, i64::MAX as u64] {
            let stamp = Stamp::from_nanos(nanos);
            assert_eq!(stamp.to_string().parse(), Ok(stamp));
        }
        assert_eq!(
            Stamp::from_nanos(1_767_571_212_500_000_000).to_string(),
            "2026-01-05T00:00:12.5Z"
        );
    }

    #[test]
    fn a_span_prints_what_it_reads() {
        for text in ["0s", "12.5s", "1d12h", "1h30m", "65d"] {
            assert_eq!(text.parse::<Span>().unwrap().to_string(), text);
        }
    }
}
