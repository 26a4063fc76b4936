//! Expressions of time: "this morning", "two hours ago", "on Monday".

use super::lemma::singular;
use super::lexicon::{Lexicon, Times};
use super::reading::When;
use super::token::Token;
use crate::time::Stamp;

/// An expression of time in a sentence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TimeSpan {
    /// Tokens `from..to`.
    pub from: usize,
    pub to: usize,
    /// What it means; none if it lies ahead ("tonight" said in the morning).
    pub when: Option<When>,
}

const DAY_S: f64 = 86_400.0;
const HOUR_S: f64 = 3_600.0;

/// Seconds since midnight, and the day of the week from Monday, when something was said (UTC).
#[derive(Clone, Copy, Debug)]
struct Said {
    second: f64,
    weekday: usize,
}

impl Said {
    fn at(at: Stamp) -> Self {
        let seconds = at.nanos() / 1_000_000_000;
        // The first of January 1970 was a Thursday.
        let weekday = ((seconds / 86_400 + 3) % 7) as usize;
        Self { second: (seconds % 86_400) as f64, weekday }
    }

    /// From hour `from` to hour `to` of the day `days` ago.
    fn hours(self, days: usize, from: u32, to: u32) -> Option<When> {
        let before = |hour: u32| self.second + days as f64 * DAY_S - f64::from(hour) * HOUR_S;
        let (earliest_s, latest_s) = (before(from), before(to).max(0.0));
        (earliest_s >= latest_s).then_some(When { earliest_s, latest_s })
    }
}

/// All expressions of time in `tokens`, from left to right.
pub(super) fn find(lexicon: &Lexicon, tokens: &[Token], said_at: Stamp) -> Vec<TimeSpan> {
    let reader = Reader { times: &lexicon.times, numbers: lexicon, tokens, said: Said::at(said_at) };
    let mut found = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        match reader.read(at) {
            Some((to, when)) => {
                found.push(TimeSpan { from: at, to, when });
                at = to;
            }
            None => at += 1,
        }
    }
    found
}

struct Reader<'a> {
    times: &'a Times,
    numbers: &'a Lexicon,
    tokens: &'a [Token],
    said: Said,
}

type Found = Option<(usize, Option<When>)>;

impl Reader<'_> {
    fn word(&self, at: usize) -> &str {
        self.tokens.get(at).map_or("", |token| token.text.as_str())
    }

    fn read(&self, at: usize) -> Found {
        self.phrase(at)
            .or_else(|| self.ago(at))
            .or_else(|| self.day(at))
            .or_else(|| self.last(at))
            .or_else(|| self.this(at))
            .or_else(|| self.at_clock(at))
            .or_else(|| self.in_part(at))
    }

    fn phrase(&self, at: usize) -> Found {
        let matches = |phrase: &str| {
            let words = phrase.split(' ').count();
            let same = phrase.split(' ').enumerate().all(|(n, word)| self.word(at + n) == word);
            same.then_some(words)
        };
        let first = self.word(at);
        let all = self.times.spans.iter().filter(|(phrase, _)| phrase.starts_with(first) && !first.is_empty());
        let best = all.filter_map(|(phrase, span)| Some((matches(phrase)?, span))).max_by_key(|it| it.0);
        let (words, [earliest_s, latest_s]) = best?;
        Some((at + words, Some(When { earliest_s: *earliest_s, latest_s: *latest_s })))
    }

    /// "two hours ago", "half an hour ago", "a few days ago".
    fn ago(&self, at: usize) -> Found {
        let half = usize::from(self.word(at) == "half");
        let (mut next, least, most) = self.amount(at + half)?;
        let unit = singular(self.word(next));
        let seconds = *self.times.units.get(&unit)?;
        next += 1;
        if self.word(next) != "ago" && self.word(next) != "earlier" {
            return None;
        }
        let (least, most) = if half == 1 { (least / 2.0, most / 2.0) } else { (least, most) };
        let one = if half == 1 { 0.25 } else { 0.5 };
        let when = if unit == "day" && least.to_bits() == most.to_bits() {
            self.said.hours(least as usize, 0, 24)
        } else {
            let latest_s = ((least - one) * seconds).max(0.0);
            Some(When { earliest_s: (most + one) * seconds, latest_s })
        };
        Some((next + 1, when))
    }

    fn amount(&self, at: usize) -> Option<(usize, f64, f64)> {
        let word = self.word(at);
        if let Ok(n) = word.parse::<u32>() {
            return Some((at + 1, f64::from(n), f64::from(n)));
        }
        if let Some(n) = self.numbers.words.numbers.get(word) {
            return Some((at + 1, f64::from(*n), f64::from(*n)));
        }
        match (word, self.word(at + 1)) {
            ("a", "few") => Some((at + 2, 2.0, 6.0)),
            ("a", "couple") => Some((at + 2 + usize::from(self.word(at + 2) == "of"), 2.0, 3.0)),
            ("several" | "some" | "few", _) => Some((at + 1, 2.0, 10.0)),
            ("a" | "an" | "about", "one" | "an") => Some((at + 2, 1.0, 1.0)),
            ("a" | "an", _) => Some((at + 1, 1.0, 1.0)),
            _ => None,
        }
    }

    /// "yesterday", "today", "tonight", "on Monday", "the day before yesterday".
    fn day(&self, at: usize) -> Found {
        match self.word(at) {
            "the" if (1..4).map(|n| self.word(at + n)).eq(["day", "before", "yesterday"]) => {
                Some((at + 4, self.said.hours(2, 0, 24)))
            }
            "yesterday" => Some(self.with_part(at + 1, 1)),
            "today" => Some((at + 1, self.said.hours(0, 0, 24))),
            "tonight" => Some((at + 1, self.said.hours(0, 17, 24))),
            "tomorrow" | "soon" => Some((at + 1, None)),
            "earlier" => {
                let inner = self.this(at + 1).or_else(|| self.day(at + 1));
                Some(inner.unwrap_or((at + 1, self.said.hours(0, 0, 24))))
            }
            "on" | "last" => {
                let skip = usize::from(self.word(at) == "on") + usize::from(self.word(at + 1) == "last");
                let day = self.word(at + skip.max(1));
                let weekday = self.times.weekdays.iter().position(|name| name == day)?;
                let days = (self.said.weekday + 7 - weekday) % 7;
                let days = if days == 0 { 7 } else { days };
                Some(self.with_part(at + skip.max(1) + 1, days))
            }
            _ => None,
        }
    }

    /// The day `days` ago, or the part of it that is named next.
    fn with_part(&self, at: usize, days: usize) -> (usize, Option<When>) {
        let skip = if self.word(at) == "in" && self.word(at + 1) == "the" { 2 } else { 0 };
        match self.times.parts.get(self.word(at + skip)) {
            Some([from, to]) => (at + skip + 1, self.said.hours(days, *from, *to)),
            None => (at, self.said.hours(days, 0, 24)),
        }
    }

    /// "last night", "last week", "last month", "over the weekend".
    fn last(&self, at: usize) -> Found {
        let weekend = |to: usize| {
            let saturday = (self.said.weekday + 2) % 7;
            let days = if saturday == 0 { 7 } else { saturday };
            let earliest_s = self.said.hours(days, 0, 24)?.earliest_s;
            Some((to, Some(When { earliest_s, latest_s: (earliest_s - 2.0 * DAY_S).max(0.0) })))
        };
        match (self.word(at), self.word(at + 1), self.word(at + 2)) {
            ("last", "night", _) => Some((at + 2, self.said.hours(1, 18, 30))),
            ("last", "evening", _) => Some((at + 2, self.said.hours(1, 17, 24))),
            ("last", "weekend", _) => weekend(at + 2),
            ("over" | "on" | "at" | "during", "the", "weekend") => weekend(at + 3),
            ("last", "week", _) => {
                let monday = self.said.second + (self.said.weekday + 7) as f64 * DAY_S;
                Some((at + 2, Some(When { earliest_s: monday, latest_s: monday - 7.0 * DAY_S })))
            }
            ("last", "month", _) => Some((at + 2, Some(When { earliest_s: 62.0 * DAY_S, latest_s: 0.0 }))),
            ("last", "year", _) => Some((at + 2, Some(When { earliest_s: 730.0 * DAY_S, latest_s: 0.0 }))),
            _ => None,
        }
    }

    /// "this morning", "this week".
    fn this(&self, at: usize) -> Found {
        if self.word(at) != "this" {
            return None;
        }
        if self.word(at + 1) == "week" {
            let earliest_s = self.said.second + self.said.weekday as f64 * DAY_S;
            return Some((at + 2, Some(When { earliest_s, latest_s: 0.0 })));
        }
        let [from, to] = *self.times.parts.get(self.word(at + 1))?;
        Some((at + 2, self.said.hours(0, from, to)))
    }

    /// "at noon", "at 3 pm", "at five o'clock".
    fn at_clock(&self, at: usize) -> Found {
        if self.word(at) != "at" && self.word(at) != "around" {
            return None;
        }
        if let Some([from, to]) = self.times.parts.get(self.word(at + 1)) {
            let days = usize::from(self.said.hours(0, *from, *to).is_none());
            return Some((at + 2, self.said.hours(days, *from, *to)));
        }
        let word = self.word(at + 1);
        let digits = word.trim_end_matches(|c: char| c.is_alphabetic());
        let hour = digits.parse().ok().or_else(|| self.numbers.words.numbers.get(word).copied());
        let hour = hour.filter(|hour| *hour < 24)?;
        let suffix = [&word[digits.len()..], self.word(at + 2)];
        let pm = suffix.iter().any(|it| matches!(*it, "pm" | "p.m"));
        let am = suffix.iter().any(|it| matches!(*it, "am" | "a.m" | "o'clock"));
        let separate = matches!(self.word(at + 2), "pm" | "am" | "p.m" | "a.m" | "o'clock");
        if !pm && !am {
            return None;
        }
        let hour = if pm && hour < 12 { hour + 12 } else { hour };
        let days = usize::from(self.said.hours(0, hour, hour + 1).is_none());
        let before = self.said.second + days as f64 * DAY_S - f64::from(hour) * HOUR_S;
        let around = When { earliest_s: before + HOUR_S / 2.0, latest_s: (before - HOUR_S / 2.0).max(0.0) };
        Some((at + 2 + usize::from(separate), Some(around)))
    }

    /// "in the morning", "for breakfast", "after dinner".
    fn in_part(&self, at: usize) -> Found {
        let preposition = matches!(self.word(at), "in" | "during" | "for" | "after" | "before" | "over");
        let the = usize::from(self.word(at + 1) == "the");
        let [from, to] = *self.times.parts.get(self.word(at + 1 + the)).filter(|_| preposition)?;
        let days = usize::from(self.said.hours(0, from, to).is_none());
        Some((at + 2 + the, self.said.hours(days, from, to)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modality::human::lexicon::lexicon;
    use crate::modality::human::token::sentences;

    /// Wednesday, 2026-01-07T15:00:00Z.
    const SAID: Stamp = Stamp::from_nanos(1_767_798_000_000_000_000);

    #[track_caller]
    fn check(text: &str, hours: Option<(f64, f64)>) {
        let sentence = sentences(text).next().unwrap();
        let found = find(lexicon(), &sentence.tokens, SAID);
        assert_eq!(found.len(), 1, "{found:?}");
        let when = found[0].when.map(|it| (it.earliest_s / HOUR_S, it.latest_s / HOUR_S));
        assert_eq!(when, hours, "{text}");
    }

    #[test]
    fn people_name_times_in_many_ways() {
        check("I ate it this morning", Some((10.0, 3.0)));
        check("I ate it yesterday", Some((39.0, 15.0)));
        check("yesterday evening I ate it", Some((22.0, 15.0)));
        check("I ate it last night", Some((21.0, 9.0)));
        check("two hours ago", Some((2.5, 1.5)));
        check("half an hour ago", Some((0.75, 0.25)));
        check("on Monday", Some((63.0, 39.0)));
        check("last week", Some((15.0 + 9.0 * 24.0, 15.0 + 2.0 * 24.0)));
        check("at 2 pm", Some((1.5, 0.5)));
        check("tonight", None);
        check("I ate it just now", Some((600.0 / 3600.0, 0.0)));
    }
}
