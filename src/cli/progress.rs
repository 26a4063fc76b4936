//! Progress of long work on stderr, only if that is a terminal.

use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

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
