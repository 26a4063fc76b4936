//! [`LookPlan`]: looks at every object at set hours, and what was where some time later.

use super::history::{Histories, ObjectHistory, Spot};
use crate::time::Stamp;

pub(super) const HOUR_NANOS: u64 = 3_600_000_000_000;
pub(super) const DAY_NANOS: u64 = 24 * HOUR_NANOS;

/// When things are looked at, and how long after that it is asked where they are. Days are those
/// of UTC.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LookPlan {
    /// Nanoseconds from one look to the next.
    pub every: u64,
    /// The first look of a day, nanoseconds from midnight.
    pub first: u64,
    /// The last look of a day may be then.
    pub last: u64,
    /// Nanoseconds from a look to what is asked.
    pub gaps: Vec<u64>,
    /// Whether only what is asked on the day of the look counts: for logs in which every day
    /// begins anew.
    pub same_day: bool,
}

impl Default for LookPlan {
    /// Every two hours from 6:00 to 22:00; 1, 2, 4 and 8 hours later.
    fn default() -> Self {
        let gaps = [1, 2, 4, 8].map(|hours| hours * HOUR_NANOS).to_vec();
        let (every, first, last) = (2 * HOUR_NANOS, 6 * HOUR_NANOS, 22 * HOUR_NANOS);
        Self { every, first, last, gaps, same_day: false }
    }
}

/// A thing that was looked at, and where it was some time later.
#[derive(Clone, Debug, PartialEq)]
pub struct Look<'h> {
    /// Its class.
    pub class: &'h str,
    /// When it was looked at.
    pub at: Stamp,
    /// How long after that it is asked where it is: which of the plan's gaps.
    pub gap: usize,
    /// That gap in seconds.
    pub gap_s: f64,
    /// Where it was.
    pub spot: Spot,
    /// Where it was then; `None`: in the gripper, or gone.
    pub then: Option<Spot>,
    /// λ of the node, 1/s.
    pub decay_rate: f64,
}

impl Look<'_> {
    /// Whether it was where it had been.
    pub fn stayed(&self) -> bool {
        self.then == Some(self.spot)
    }

    /// The hour of the day of the look, 0 to 23.
    pub fn hour(&self) -> usize {
        hour_of(self.at.nanos())
    }

    /// The hour of the day of what is asked.
    pub fn hour_then(&self) -> usize {
        hour_of(self.at.nanos() + (self.gap_s * 1e9) as u64)
    }
}

pub(super) fn hour_of(nanos: u64) -> usize {
    (nanos % DAY_NANOS / HOUR_NANOS) as usize
}

impl LookPlan {
    /// Shows the visitor every look at every object that changed before `known_by`, whose look
    /// and answer both lie in `from..until`. An object in the gripper is not looked at; what is
    /// not known is left out.
    ///
    /// A complete log is taken to hold to the end of its last day.
    pub fn visit<'h>(
        &self,
        histories: &'h Histories,
        (from, until): (Stamp, Stamp),
        known_by: Stamp,
        visitor: &mut dyn FnMut(&Look<'h>),
    ) {
        let Some((start, end)) = histories.span else { return };
        let end = Stamp::from_nanos(end.nanos() / DAY_NANOS * DAY_NANOS + DAY_NANOS - 1);
        let window = Window { from: from.max(start), until: until.min(end) };
        let changed = |it: &&ObjectHistory| it.first_change.is_some_and(|at| at <= known_by);
        for history in histories.objects.values().filter(changed) {
            for at in self.times(window) {
                self.at(histories, history, at, window, visitor);
            }
        }
    }

    fn times(&self, window: Window) -> impl Iterator<Item = Stamp> {
        let (first, last, every) = (self.first, self.last, self.every.max(1));
        let days = window.from.nanos() / DAY_NANOS..=window.until.nanos() / DAY_NANOS;
        let looks = move |day: u64| (first..=last).step_by(every as usize).map(move |at| day * DAY_NANOS + at);
        let inside = move |at: &Stamp| *at >= window.from && *at <= window.until;
        days.flat_map(looks).map(Stamp::from_nanos).filter(inside)
    }

    fn at<'h>(
        &self,
        histories: &'h Histories,
        history: &'h ObjectHistory,
        at: Stamp,
        window: Window,
        visitor: &mut dyn FnMut(&Look<'h>),
    ) {
        let complete = histories.complete;
        let Some(Some(spot)) = history.spot_at(at, complete) else { return };
        for (gap, nanos) in self.gaps.iter().enumerate() {
            let then = at.plus_nanos(*nanos);
            let another_day = then.nanos() / DAY_NANOS != at.nanos() / DAY_NANOS;
            if then > window.until || (self.same_day && another_day) {
                continue;
            }
            let Some(found) = history.spot_at(then, complete) else { continue };
            visitor(&Look {
                class: history.label.as_str(),
                at,
                gap,
                gap_s: *nanos as f64 / 1e9,
                spot,
                then: found,
                decay_rate: history.decay_rate,
            });
        }
    }
}

#[derive(Clone, Copy, Debug)]
struct Window {
    from: Stamp,
    until: Stamp,
}
