//! [`Pace`]: whether a question is sent again, and after what pause.

use std::time::Duration;

use super::{ChatOptions, Failure};

/// How often and when one question is sent.
pub(super) struct Pace {
    left: u32,
    pause: Duration,
    longest: Duration,
    random: u64,
}

impl Pace {
    /// For one question. The jitter is taken from what is asked: the same in every run, and
    /// different for different robots, which is what jitter is for.
    pub fn new(options: &ChatOptions, question: &str) -> Self {
        let hash = blake3::hash(question.as_bytes());
        let random = hash.as_bytes().first_chunk().map_or(0, |bytes| u64::from_le_bytes(*bytes));
        let ChatOptions { attempts, pause, longest_pause: longest, .. } = *options;
        Self { left: attempts.saturating_sub(1), pause, longest, random }
    }

    /// The pause before the next attempt.
    ///
    /// # Errors
    /// Why there is none, to be added to what went wrong; empty if it could not help.
    pub fn next(&mut self, failure: &Failure) -> Result<Duration, String> {
        if !failure.again {
            return Err(String::new());
        }
        if self.left == 0 {
            return Err("; no more attempts".to_owned());
        }
        self.left -= 1;
        let own = self.jittered(self.pause.min(self.longest));
        self.pause = self.pause.saturating_mul(2);
        match failure.retry_after {
            Some(asked) if asked > self.longest => {
                Err(format!("; it asks to wait for {} s", asked.as_secs()))
            }
            Some(asked) => Ok(asked.max(own)),
            None => Ok(own),
        }
    }

    /// Between half of `pause` and all of it. `SplitMix64`: Steele, Lea, Flood, "Fast splittable
    /// pseudorandom number generators", OOPSLA 2014.
    fn jittered(&mut self, pause: Duration) -> Duration {
        self.random = self.random.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.random;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let unit = ((z ^ (z >> 31)) >> 40) as f64 / (1_u64 << 24) as f64;
        pause.mul_f64(0.5 + 0.5 * unit)
    }
}

/// Reads `Retry-After`: seconds, or a date, which is taken from the `Date` of the same response
/// rather than from a clock that may differ from the server's (RFC 9110, section 10.2.3).
pub(super) fn retry_after(value: &str, date: Option<&str>) -> Option<Duration> {
    if let Ok(seconds) = value.trim().parse() {
        return Some(Duration::from_secs(seconds));
    }
    let instant = |text: &str| jiff::fmt::rfc2822::parse(text).ok().map(|z| z.timestamp());
    let wait = instant(value)?.duration_since(instant(date?)?);
    Some(wait.try_into().unwrap_or(Duration::ZERO))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn failed(retry_after: Option<u64>) -> Failure {
        let retry_after = retry_after.map(Duration::from_secs);
        Failure { retry_after, ..Failure::new("it failed", true) }
    }

    #[test]
    fn pauses_double_within_their_jitter_and_end() {
        let options = ChatOptions { attempts: 5, ..ChatOptions::default() };
        let mut pace = Pace::new(&options, "the mug is gone");
        for expected in [0.5, 1.0, 2.0, 4.0] {
            let pause = pace.next(&failed(None)).unwrap().as_secs_f64();
            assert!((expected / 2.0..=expected).contains(&pause), "{pause} of {expected}");
        }
        assert_eq!(pace.next(&failed(None)), Err("; no more attempts".to_owned()));
    }

    #[test]
    fn the_same_question_has_the_same_pauses_and_another_has_others() {
        let pauses = |question: &str| {
            let mut pace = Pace::new(&ChatOptions::default(), question);
            [pace.next(&failed(None)), pace.next(&failed(None))]
        };
        assert_eq!(pauses("a"), pauses("a"));
        assert_ne!(pauses("a"), pauses("b"));
    }

    #[test]
    fn the_server_says_how_long_to_wait_within_reason() {
        let mut pace = Pace::new(&ChatOptions::default(), "a");
        assert_eq!(pace.next(&failed(Some(7))), Ok(Duration::from_secs(7)));
        assert!(pace.next(&failed(Some(0))).unwrap() > Duration::ZERO);
        let mut pace = Pace::new(&ChatOptions::default(), "a");
        assert_eq!(pace.next(&failed(Some(3600))), Err("; it asks to wait for 3600 s".to_owned()));
        assert_eq!(pace.next(&Failure::new("no", false)), Err(String::new()));
    }

    #[test]
    fn retry_after_is_seconds_or_a_date() {
        let date = Some("Wed, 21 Oct 2015 07:28:00 GMT");
        let check = |value: &str, date, seconds: Option<u64>| {
            assert_eq!(retry_after(value, date), seconds.map(Duration::from_secs), "{value}");
        };
        check(" 12 ", None, Some(12));
        check("Wed, 21 Oct 2015 07:28:09 GMT", date, Some(9));
        check("Wed, 21 Oct 2015 07:27:00 GMT", date, Some(0));
        check("Wed, 21 Oct 2015 07:28:09 GMT", None, None);
        check("soon", date, None);
        check("-1", date, None);
    }
}
