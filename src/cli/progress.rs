//! Progress of long work on stderr, only if that is a terminal.

use std::ops::ControlFlow;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::event::Logged;
use crate::history::{EventLog, FoldError};

/// A bar over a known number of steps.
pub fn bar(what: &'static str, steps: u64) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(Some(steps), ProgressDrawTarget::stderr());
    let template = "{msg} [{wide_bar}] {human_pos}/{human_len} {eta}";
    let style = ProgressStyle::with_template(template).expect("the template is fixed and valid");
    bar.with_style(style.progress_chars("=> ")).with_message(what)
}

/// A counter, where the number of steps is not known.
pub fn counter(what: &'static str) -> ProgressBar {
    let bar = ProgressBar::with_draw_target(None, ProgressDrawTarget::stderr());
    let style = ProgressStyle::with_template("{spinner} {msg} {human_pos}")
        .expect("the template is fixed and valid");
    bar.enable_steady_tick(Duration::from_millis(200));
    bar.with_style(style).with_message(what)
}

/// A log that counts the events that are visited.
pub struct Counted<'l, L> {
    log: &'l L,
    bar: ProgressBar,
}

impl<'l, L> Counted<'l, L> {
    /// Counts the visits of `log`.
    pub fn new(log: &'l L) -> Self {
        Self { log, bar: counter("events read") }
    }
}

impl<L: EventLog> EventLog for Counted<'_, L> {
    type Error = L::Error;

    fn visit(
        &self,
        first: u64,
        last: u64,
        visitor: &mut dyn FnMut(&Logged) -> ControlFlow<()>,
    ) -> Result<(), L::Error> {
        self.log.visit(first, last, &mut |logged| {
            self.bar.inc(1);
            visitor(logged)
        })
    }

    fn visit_all(
        &self,
        first: u64,
        last: u64,
        visitor: &mut dyn FnMut(&Logged) -> ControlFlow<()>,
    ) -> Result<(), L::Error> {
        self.log.visit_all(first, last, visitor)
    }

    fn refused(&self, error: &FoldError) -> bool {
        self.log.refused(error)
    }
}

impl<L> Drop for Counted<'_, L> {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
