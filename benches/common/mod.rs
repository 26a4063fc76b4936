//! What the benches share: logs to measure on, and how to measure.
//!
//! Every target is a ratio of two times taken in the same process, so that it means the same on
//! any machine.

// Each bench uses its own part of this.
#![allow(dead_code)]

pub mod chunks;
pub mod dense;
pub mod household;
pub mod logs;
pub mod measure;
pub mod room;

/// Whether only the smoke mode is wanted: everything a hundredth of its size.
pub fn small() -> bool {
    std::env::var_os("SCENEFOLD_BENCH_SMALL").is_some_and(|value| value != "0")
}

/// `full`, or less in the smoke mode.
pub fn scaled(full: u64) -> u64 {
    if small() { full / 50 } else { full }
}
