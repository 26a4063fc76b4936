//! Going on where a recording ends, also where its writer was killed.

use std::convert::Infallible;
use std::ops::ControlFlow;

use super::chain::{Chain, GENESIS, Link};
use super::events::{RawEvent, Walk, decode};
use super::open::{Recording, Segment};
use super::reprocess::Again;
use crate::event::Logged;
use crate::updater::{Config, Updater};

/// Where a recording ends.
#[derive(Debug)]
pub(super) struct End {
    /// The updater as it was after the last event.
    pub updater: Updater,
    /// Link of the chain after the last event.
    pub chain: Link,
    /// What the last input derives, if its writer was killed before that was written.
    pub missing: Vec<Logged>,
}

/// Why it is not known how a recording ends.
#[derive(Debug, thiserror::Error)]
pub enum ResumeError {
    /// Something before the end is lost.
    #[error("the recording is damaged: {0}")]
    Damaged(String),
    /// Recorded by a program whose detectors differ from those of this one.
    #[error(
        "{count} input(s) since the last checkpoint give something else now than was recorded: \
         `scenefold reprocess` shows what"
    )]
    Different {
        /// How many.
        count: u64,
    },
}

impl Recording {
    /// Runs the detectors again from the last checkpoint to the end.
    pub(super) fn resume(&self) -> Result<End, ResumeError> {
        let damaged = |what: String| ResumeError::Damaged(what);
        let config = self.meta().map_or_else(Config::default, |meta| meta.config.clone());
        if self.meta().is_none() && self.is_empty() {
            // Its writer was killed before it said anything.
            return Ok(End { updater: Updater::new(config), chain: GENESIS, missing: Vec::new() });
        }
        let usable =
            self.checkpoints().rev().find_map(|at| Some((at.segment, self.checkpoint(at).ok()?)));
        if let Some((segment, checkpoint)) = usable {
            let chain = Chain::after(checkpoint.chain);
            let updater = checkpoint.updater(config).map_err(|error| damaged(error.to_string()))?;
            return self.run_on(updater, chain, segment);
        }
        let Some(first) = self.segments.first().filter(|segment| segment.meta.is_some()) else {
            return Err(damaged("it is not one of ours".to_owned()));
        };
        self.run_on(Updater::new(config), Chain::after(first.first_link()), 0)
    }

    /// Feeds the events after `updater` to it; `chain` stands in segment number `segment`.
    fn run_on(&self, updater: Updater, chain: Chain, segment: usize) -> Result<End, ResumeError> {
        let first = updater.order() + 1;
        let mut run = Run {
            again: Again::new(updater),
            chain,
            segment: &self.segments[segment],
            expected: first,
            problem: None,
        };
        let walked = self
            .walk(Walk::Everything, (first, u64::MAX), &mut |segment, raw| run.take(segment, raw));
        walked.map_err(|error| ResumeError::Damaged(error.to_string()))?;
        if let Some(what) = run.problem {
            return Err(ResumeError::Damaged(what));
        }
        let chain = self.end_link(&run);
        let mut again = run.again;
        let mut nowhere = |_: &_, _: &[_]| Ok::<_, Infallible>(());
        again.settle(&mut nowhere).map_err(|error| ResumeError::Damaged(error.to_string()))?;
        let missing = again.missing_tail();
        if !missing.is_empty() {
            again.forget_last();
        }
        let result = again.finish();
        if result.different > 0 {
            return Err(ResumeError::Different { count: result.different });
        }
        Ok(End { updater: result.updater, chain, missing })
    }

    /// Where the next segment goes on: at the seal of the last one, or at its last link.
    fn end_link(&self, run: &Run<'_>) -> Link {
        let Some(last) = self.segments.last() else { return run.chain.link() };
        match &last.seal {
            Some(seal) => seal.chain,
            None if std::ptr::eq(last, run.segment) => run.chain.link(),
            // The last segment ended before its first event.
            None => Chain::after(last.first_link()).link(),
        }
    }
}

/// The end of a recording being run through the detectors again.
struct Run<'r> {
    again: Again,
    chain: Chain,
    segment: &'r Segment,
    expected: u64,
    problem: Option<String>,
}

impl<'r> Run<'r> {
    fn take(&mut self, segment: &'r Segment, raw: RawEvent<'_>) -> ControlFlow<()> {
        if raw.order != self.expected {
            self.problem = Some(format!("events from #{} are missing", self.expected));
            return ControlFlow::Break(());
        }
        self.expected += 1;
        if !std::ptr::eq(segment, self.segment) {
            self.segment = segment;
            self.chain = Chain::after(segment.first_link());
        }
        let (at, published) = (raw.log_time, raw.publish_time);
        self.chain.add(&raw.topic.name(), raw.order, at, published, raw.data);
        let mut nowhere = |_: &_, _: &[_]| Ok::<_, Infallible>(());
        let taken = decode(segment, raw)
            .map_err(|error| error.to_string())
            .and_then(|logged| self.again.take(&logged, &mut nowhere).map_err(|e| e.to_string()));
        match taken {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                self.problem = Some(error);
                ControlFlow::Break(())
            }
        }
    }
}
