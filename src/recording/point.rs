//! From what a person names ([`At`]) to a place in the order of a log.

use std::ops::ControlFlow;

use super::events::{Walk, WalkError};
use super::open::Recording;
use crate::event::{Event, Topic};
use crate::time::{At, Stamp};

/// A place in the order of a log: after every event that is within both bounds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Point {
    /// Number of the last event before it.
    pub last_order: u64,
    /// Log time of the last event before it.
    pub last_time: Stamp,
    /// The moment itself, where a time was named.
    pub moment: Option<Stamp>,
}

impl Point {
    const END: Self = Self { last_order: u64::MAX, last_time: Stamp::MAX, moment: None };

    /// Whether it is after everything.
    pub fn is_end(&self) -> bool {
        *self == Self::END
    }

    fn order(last_order: u64) -> Self {
        Self { last_order, ..Self::END }
    }

    fn time(moment: Stamp) -> Self {
        Self { last_time: moment, moment: Some(moment), ..Self::END }
    }
}

/// Why a place was not found.
#[derive(Debug, thiserror::Error)]
pub enum PointError {
    /// The recording holds no event.
    #[error("the recording holds no event")]
    Empty,
    /// Before the recording.
    #[error("{at} is before the recording, which starts at {start}")]
    BeforeStart {
        /// What was named.
        at: Stamp,
        /// Where it starts.
        start: Stamp,
    },
    /// No change of that number.
    #[error("there is no change c{seq}: the last one is c{last}")]
    NoSuchChange {
        /// What was named.
        seq: u64,
        /// The last one there is.
        last: u64,
    },
    /// No event of that number.
    #[error("there is no event #{order}: the last one is #{last}")]
    NoSuchEvent {
        /// What was named.
        order: u64,
        /// The last one there is.
        last: u64,
    },
    /// The recording could not be walked.
    #[error(transparent)]
    Walk(#[from] WalkError),
}

impl Recording {
    /// The place that `at` names.
    pub fn point(&self, at: At) -> Result<Point, PointError> {
        let start = self.start().ok_or(PointError::Empty)?;
        let point = match at {
            At::End => Point::END,
            At::Start => Point::order(1),
            At::SinceStart(nanos) => Point::time(start.plus_nanos(nanos)),
            At::Instant(at) if at < start => return Err(PointError::BeforeStart { at, start }),
            At::Instant(at) => Point::time(at),
            At::Event(order) => Point::order(order),
            At::Change(seq) => Point::order(self.end_of_change(seq)?),
        };
        Ok(point)
    }

    /// Number of the last event of the update that recorded change `seq`.
    fn end_of_change(&self, seq: u64) -> Result<u64, PointError> {
        let before = self.checkpoints().rfind(|c| c.changes < seq);
        let first = before.map_or(1, |checkpoint| checkpoint.order + 1);
        let (mut last_seq, mut end) = (before.map_or(0, |checkpoint| checkpoint.changes), None);
        let mut look = |logged: &crate::event::Logged| match &logged.event {
            Event::Change(record) => {
                last_seq = record.seq;
                if record.seq == seq {
                    end = Some(logged.order);
                }
                ControlFlow::Continue(())
            }
            // What one update derives stands together: another input ends it.
            event if end.is_some() && event.is_input() => ControlFlow::Break(()),
            event => {
                if end.is_some() && event.topic() == Topic::Primitive {
                    end = Some(logged.order);
                }
                ControlFlow::Continue(())
            }
        };
        self.visit_events(Walk::Events, (first, u64::MAX), &mut look)?;
        end.ok_or(PointError::NoSuchChange { seq, last: last_seq })
    }
}
