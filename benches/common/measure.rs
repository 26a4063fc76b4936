//! Times, ratios and peak memory. Knows nothing of recordings.

use std::process::Command;
use std::time::{Duration, Instant};

/// The best of `rounds` times of each of some jobs, run in turns, so that whatever else the
/// machine does meets all of them alike.
pub fn best_of<const N: usize>(rounds: usize, jobs: [&mut dyn FnMut(); N]) -> [Duration; N] {
    let start = Instant::now();
    best_by(rounds, jobs, || start.elapsed())
}

/// As [`best_of`], for jobs that keep to this thread: the time it had a processor, where the
/// system tells, so that a busy machine spoils little.
pub fn best_cpu_of<const N: usize>(rounds: usize, jobs: [&mut dyn FnMut(); N]) -> [Duration; N] {
    let start = Instant::now();
    best_by(rounds, jobs, || processor_time().unwrap_or(start.elapsed()))
}

fn best_by<const N: usize>(
    rounds: usize,
    mut jobs: [&mut dyn FnMut(); N],
    now: impl Fn() -> Duration,
) -> [Duration; N] {
    let mut best = [Duration::MAX; N];
    for _ in 0..rounds {
        for (job, best) in jobs.iter_mut().zip(&mut best) {
            let start = now();
            job();
            *best = (*best).min(now().saturating_sub(start));
        }
    }
    best
}

fn processor_time() -> Option<Duration> {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    told.split_whitespace().next()?.parse().ok().map(Duration::from_nanos)
}

/// Prints `time` and what it is per unit.
pub fn tell_time(name: &str, time: Duration, units: u64, unit: &str) {
    let nanos = time.as_nanos() as f64 / units.max(1) as f64;
    println!("time  {name}: {:.1} ms, {nanos:.0} ns per {unit}", time.as_secs_f64() * 1e3);
}

/// Prints a ratio that is to be at most `limit`.
pub fn tell_at_most(name: &str, value: f64, limit: f64) {
    println!("ratio {name} = {value:.3} (≤ {limit}){}", missed(value <= limit));
}

/// Prints a ratio that is to be at least `limit`.
pub fn tell_at_least(name: &str, value: f64, limit: f64) {
    println!("ratio {name} = {value:.3} (≥ {limit}){}", missed(value >= limit));
}

fn missed(met: bool) -> &'static str {
    match (met, super::small()) {
        (true, _) => "",
        (false, false) => "  MISSED",
        // The targets are for logs of full size; a small one says only that the bench runs.
        (false, true) => "  not at this size",
    }
}

/// `a` over `b`.
pub fn over(a: Duration, b: Duration) -> f64 {
    a.as_secs_f64() / b.as_secs_f64()
}

const CHILD: &str = "SCENEFOLD_BENCH_CHILD";

/// The job this process was started for by [`peak_mib`], if it was.
pub fn child_job() -> Option<String> {
    std::env::var(CHILD).ok()
}

/// Peak memory in MiB of this program run anew with `job`; `None` where the system does not
/// tell. The child calls [`tell_peak`] at its end.
pub fn peak_mib(job: &str) -> Option<f64> {
    let program = std::env::current_exe().ok()?;
    let output = Command::new(program).env(CHILD, job).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("peak_kib "))?;
    Some(line.trim().parse::<f64>().ok()? / 1024.0)
}

/// Prints the peak memory of this process for [`peak_mib`].
pub fn tell_peak() {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kib = peak.map_or("", |peak| peak.trim().trim_end_matches(" kB"));
    println!("peak_kib {kib}");
}
