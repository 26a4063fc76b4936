//! Laws of the pipeline: inputs to recording to states and back, over random inputs.

mod edits;
mod interchange;
mod recorder;
mod states;

use proptest::test_runner::Config;

/// Cases are few because each is a whole recording.
pub fn cases(count: u32) -> Config {
    Config { cases: count, max_shrink_iters: 200, failure_persistence: None, ..Config::default() }
}
