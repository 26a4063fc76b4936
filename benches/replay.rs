//! Replay of a whole log: read, checksum, decode and fold, against raw decompression of the same
//! chunks; on one thread and on two; alone and among two gigabytes of pictures; in how much
//! memory.
//!
//! `cargo bench --bench replay`; `SCENEFOLD_BENCH_SMALL=1` for a smoke run,
//! `SCENEFOLD_BENCH_SENSOR_MB` for another amount of pictures.

mod common;

use std::path::Path;

use common::household::{house, node};
use common::logs::Log;
use common::measure::{
    best_cpu_of, best_of, child_job, over, peak_mib, tell_at_least, tell_at_most, tell_peak,
    tell_time,
};
use common::{chunks, dense, scaled};
use scenefold::graph::{Layer, SceneGraph};
use scenefold::recording::Recording;
use scenefold::time::At;

const ROUNDS: usize = 7;
const SPARSE: &str = "sparse";

fn main() {
    if let Some(job) = child_job() {
        match job.as_str() {
            SPARSE => drop(sparse()),
            path => replay(Path::new(path), 2),
        }
        return tell_peak();
    }
    let primitives = scaled(1_000_000);
    let log = Log { primitives, checkpoints: false, sensor_bytes: 0 };
    against_zstd("household", &log.path(), primitives, 2.5);
    // Nothing but small edits, which compress to a third of what those of a household do: no
    // target, but not to be lost sight of.
    against_zstd("dense", &dense::path(primitives), primitives, 5.0);
    among_pictures(log);
    in_memory(log);
}

fn replay(path: &Path, threads: usize) {
    let recording = Recording::open(path).expect("the log is intact");
    let state = recording.state_at(At::End, threads).expect("the log has an end");
    assert_eq!(state.uncertain, None);
    assert_eq!(state.graph().object_count(), common::household::OBJECTS as usize);
}

fn against_zstd(name: &str, path: &Path, primitives: u64, limit: f64) {
    let compressed = chunks::compressed(&chunks::open(path));
    let mut decompress = || {
        chunks::decompress(&compressed);
    };
    let [zstd, alone] = best_cpu_of(ROUNDS, [&mut decompress, &mut || replay(path, 1)]);
    let [one, two] = best_of(ROUNDS, [&mut || replay(path, 1), &mut || replay(path, 2)]);
    tell_time(&format!("{name}: raw zstd"), zstd, primitives, "primitive");
    tell_time(&format!("{name}: replay"), alone, primitives, "primitive");
    tell_time(&format!("{name}: replay, 1 thread, by the clock"), one, primitives, "primitive");
    tell_time(&format!("{name}: replay, 2 threads, by the clock"), two, primitives, "primitive");
    tell_at_most(&format!("{name}: replay/zstd"), over(alone, zstd), limit);
    tell_at_least(&format!("{name}: 1 thread/2 threads"), over(one, two), 1.6);
}

fn among_pictures(log: Log) {
    let megabytes = std::env::var("SCENEFOLD_BENCH_SENSOR_MB").ok();
    let megabytes = megabytes.and_then(|mb| mb.parse().ok()).unwrap_or(scaled(2_000));
    let (alone, among) = (log.path(), Log { sensor_bytes: megabytes << 20, ..log }.path());
    let [alone, among] =
        best_cpu_of(ROUNDS, [&mut || replay(&alone, 1), &mut || replay(&among, 1)]);
    tell_at_most(
        &format!("replay among {megabytes} MB of pictures/alone"),
        over(among, alone),
        1.2,
    );
}

/// As many objects as a graph takes, their numbers far apart.
fn sparse() -> SceneGraph {
    let mut graph = house();
    let object = graph.object(node(Layer::Object, 0)).expect("the house is furnished").clone();
    for n in 1_000..1_000_000 {
        let id = node(Layer::Object, n * 16);
        graph.insert_object(id, object.clone()).expect("a new object");
    }
    graph
}

fn in_memory(log: Log) {
    if let Some(mib) = peak_mib(SPARSE) {
        tell_at_most("peak MiB of a million sparse objects", mib, 400.0);
    }
    for factor in [1, 10] {
        let primitives = log.primitives * factor;
        let path = Log { primitives, ..log }.path();
        match peak_mib(&path.to_string_lossy()) {
            Some(mib) => tell_at_most(&format!("peak MiB of replaying {primitives}"), mib, 200.0),
            None => println!("peak memory is not told by this system"),
        }
    }
}
