//! The state at any point of a long log, against the same in a short one; and what the
//! checkpoints that make it quick take.
//!
//! `cargo bench --bench seek`; `SCENEFOLD_BENCH_SMALL=1` for a smoke run.

mod common;

use std::time::{Duration, Instant};

use common::household::Dice;
use common::logs::Log;
use common::measure::{over, tell_at_most, tell_time};
use common::{chunks, scaled, small};
use scenefold::recording::Recording;
use scenefold::time::At;

fn main() {
    let log = |primitives| Log { primitives, checkpoints: true, sensor_bytes: 0 };
    let (short, long) = (log(scaled(1_000_000)), log(scaled(10_000_000)));
    let (short_path, long_path) = (short.path(), long.path());
    for path in [&short_path, &long_path] {
        checkpoints(path);
    }
    let open = |path| Recording::open(path).expect("the log is intact");
    let start = Instant::now();
    let recordings = [open(&short_path), open(&long_path)];
    tell_time("open both", start.elapsed(), 2, "file");
    for threads in [1, 2] {
        let [short, long] = mean_seeks(&recordings, threads);
        tell_time(&format!("seek, short log, {threads} thread(s)"), short, 1, "seek");
        tell_time(&format!("seek, long log, {threads} thread(s)"), long, 1, "seek");
        let name = format!("seek on {threads} thread(s)");
        tell_at_most(&format!("{name}, mean ms in the long log"), long.as_secs_f64() * 1e3, 20.0);
        tell_at_most(&format!("{name}, long/short"), over(long, short), 1.3);
    }
}

/// The mean time of a seek to an event and to a moment, both at random, in each of two
/// recordings.
fn mean_seeks(recordings: &[Recording; 2], threads: usize) -> [Duration; 2] {
    let mut dice = Dice::new();
    let rounds = if small() { 20 } else { 150 };
    let mut total = [Duration::ZERO; 2];
    for (recording, n) in (0..rounds).flat_map(|_| recordings.iter().zip([0, 1])) {
        let start = recording.start().expect("there are events").nanos();
        let end = recording.end().expect("there are events").nanos();
        let events = recording.seal().expect("it was ended").events;
        let part = u128::from(dice.below(1 << 31));
        let of = |whole: u64| ((u128::from(whole) * part) >> 31) as u64;
        for at in [At::Event(1 + of(events - 1)), At::SinceStart(of(end - start))] {
            let began = Instant::now();
            let state = recording.state_at(at, threads).expect("the point is in the log");
            total[n] += began.elapsed();
            drop(state);
        }
    }
    total.map(|total| total / (2 * rounds))
}

fn checkpoints(path: &std::path::Path) {
    let sizes = chunks::sizes(&chunks::open(path));
    let share = |of: u64, all: u64| 100.0 * of as f64 / all as f64;
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    println!("{name}: {} bytes of events, {} in the file", sizes.events, sizes.events_in_file);
    for (of, all) in [("event bytes", sizes.events), ("events in the file", sizes.events_in_file)] {
        let value = share(sizes.checkpoints, all);
        tell_at_most(&format!("{name}: checkpoints, % of {of}"), value, 10.0);
    }
}
