//! The life of a node as a story for people.

use std::fmt;

use super::story::{because, clean, found, happened, time};
use super::{Entry, Moment, Presence, Stale, Why};
use crate::change::Cause;

/// Where the words of an entry begin: after the time and the number.
const INDENT: usize = 27;

/// Below this probability it is said that an object is probably elsewhere.
const DOUBT: f64 = 0.5;

/// λ times the half-life.
const LN_3: f64 = 1.098_612_288_668_109_8;

/// How many namesakes are named.
const NAMESAKES: usize = 10;

/// How things stand, then what happened, in order.
impl fmt::Display for Why {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.headline(f)?;
        self.doubt(f)?;
        self.outcome(f)?;
        self.namesakes(f)?;
        writeln!(f)?;
        if let Some(initial) = &self.initial {
            let number = format!("#{}", initial.moment.order);
            let place = initial.place.as_ref().map_or(String::new(), |place| format!(": {place}"));
            let when = time(initial.moment.at);
            writeln!(f, "{when}  {number:<5} in the initial graph{place}")?;
        }
        let mut stale = self.stale.iter().peekable();
        for entry in &self.entries {
            while let Some(it) = stale.next_if(|it| it.moment.order < entry.moment.order) {
                became_stale(f, it)?;
            }
            self.entry(f, entry)?;
        }
        stale.try_for_each(|it| became_stale(f, it))
    }
}

impl Why {
    fn headline(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(Moment { order, at }) = self.state.since else {
            return writeln!(f, "{}: never in the graph", self.node);
        };
        let since = format!("since {at} (event #{order})");
        let place = self.state.place.as_ref();
        match (self.state.presence, place) {
            (Presence::Present, Some(place)) => {
                writeln!(f, "{}: {}, {since}", self.node, place.spot())
            }
            (Presence::Present, None) => writeln!(f, "{}: there {since}", self.node),
            (Presence::Held, _) => writeln!(f, "{}: in the gripper {since}", self.node),
            (Presence::Absent, _) => writeln!(f, "{}: not there {since}", self.node),
        }?;
        match (self.state.presence, place) {
            (Presence::Held, Some(place)) => {
                writeln!(f, "It was last seen in the {}.", place.spot())
            }
            (Presence::Absent, Some(place)) => {
                writeln!(f, "It was last known in the {}.", place.spot())
            }
            _ => Ok(()),
        }
    }

    /// For what is probably elsewhere by now.
    fn doubt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(belief) = self.state.belief.as_ref().filter(|it| it.probability < DOUBT) else {
            return Ok(());
        };
        let percent = 100.0 * belief.probability;
        let hours = (belief.decay_rate > 0.0).then(|| LN_3 / belief.decay_rate / 3600.0);
        let half_life = hours.map_or(String::new(), |it| format!("half-life {it:.1} h, "));
        writeln!(
            f,
            "It is probably no longer there: {percent:.0} % ({half_life}{}; last observed {}).",
            clean(&belief.origin),
            time(belief.last_observed)
        )
    }

    /// For what is not there: what took it away, and what has been said since.
    fn outcome(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some(since) = self.state.since else { return Ok(()) };
        if self.state.presence == Presence::Present {
            return Ok(());
        }
        let last = self.entries.iter().rfind(|entry| entry.moment == since);
        if let Some(entry) = last.filter(|_| self.state.presence == Presence::Absent) {
            let because = because(entry).map_or(String::new(), |words| format!(", {words}"));
            writeln!(f, "It was removed by {}{because}.", number(entry))?;
        }
        let later = |entry: &&Entry| entry.is_rejected() && entry.moment.order > since.order;
        match self.entries.iter().filter(later).count() {
            0 => Ok(()),
            1 => writeln!(f, "Since then one claim about it was rejected."),
            n => writeln!(f, "Since then {n} claims about it were rejected."),
        }
    }

    fn namesakes(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.namesakes.is_empty() {
            return Ok(());
        }
        let shown: Vec<String> =
            self.namesakes.iter().take(NAMESAKES).map(ToString::to_string).collect();
        let rest = self.namesakes.len() - shown.len();
        let more = if rest > 0 { format!(" and {rest} more") } else { String::new() };
        writeln!(f, "Of the same name, but never changed: {}{more}.", shown.join(", "))
    }

    fn entry(&self, f: &mut fmt::Formatter<'_>, entry: &Entry) -> fmt::Result {
        let (when, what) = (time(entry.moment.at), happened(self, entry));
        writeln!(f, "{when}  {:<5} {what}", number(entry))?;
        let details = [because(entry), found(self, entry)];
        details.iter().flatten().try_for_each(|words| writeln!(f, "{:INDENT$}{words}", ""))
    }
}

fn became_stale(f: &mut fmt::Formatter<'_>, stale: &Stale) -> fmt::Result {
    let number = format!("#{}", stale.moment.order);
    let [percent, below] = [stale.probability, stale.threshold].map(|it| 100.0 * it);
    let when = time(stale.moment.at);
    writeln!(f, "{when}  {number:<5} a target to look at: {percent:.0} %, below {below:.0} %")
}

/// `c36`, or the event where no change was the cause.
fn number(entry: &Entry) -> String {
    match (&entry.change, &entry.cause) {
        (Some(change), _) => format!("c{}", change.seq),
        (None, Some(Cause::Change(seq))) => format!("c{seq}"),
        (None, _) => format!("#{}", entry.moment.order),
    }
}
