//! Going on where a recording ends, also where its writer was killed.

use std::convert::Infallible;
use std::ops::ControlFlow;

use super::chain::{Chain, Link};
use super::events::{Walk, decode};
use super::open::Recording;
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
        let usable = self.checkpoints().rev().find_map(|at| self.checkpoint(at).ok());
        if let Some(checkpoint) = usable {
            let chain = Chain::after(checkpoint.chain);
            let updater = checkpoint.updater(config).map_err(|error| damaged(error.to_string()))?;
            return self.run_on(updater, chain);
        }
        let first = self.meta().ok_or_else(|| damaged("it is not ours".to_owned()))?.chain;
        self.run_on(Updater::new(config), Chain::after(first))
    }

    fn run_on(&self, updater: Updater, mut chain: Chain) -> Result<End, ResumeError> {
        let first = updater.order() + 1;
        let mut expected = first;
        let mut again = Again::new(updater);
        let mut problem = None;
        let mut nowhere = |_: &_, _: &[_]| Ok::<_, Infallible>(());
        let mut each = |segment: &super::open::Segment, raw: super::events::RawEvent<'_>| {
            if raw.order != expected {
                problem = Some(format!("events from #{expected} are missing"));
                return ControlFlow::Break(());
            }
            expected += 1;
            if segment.events.contains(&raw.channel) {
                let (at, published) = (raw.log_time, raw.publish_time);
                chain.add(&raw.topic.name(), raw.order, at, published, raw.data);
            }
            let taken =
                decode(segment, raw).map_err(|error| error.to_string()).and_then(|logged| {
                    again.take(&logged, &mut nowhere).map_err(|error| error.to_string())
                });
            match taken {
                Ok(()) => ControlFlow::Continue(()),
                Err(error) => {
                    problem = Some(error);
                    ControlFlow::Break(())
                }
            }
        };
        let walked = self.walk(Walk::Everything, (first, u64::MAX), &mut each);
        walked.map_err(|error| ResumeError::Damaged(error.to_string()))?;
        if let Some(what) = problem {
            return Err(ResumeError::Damaged(what));
        }
        let missing = again.missing_tail();
        if !missing.is_empty() {
            again.forget_last();
        }
        let result = again.finish();
        if result.different > 0 {
            return Err(ResumeError::Different { count: result.different });
        }
        Ok(End { updater: result.updater, chain: chain.link(), missing })
    }
}
