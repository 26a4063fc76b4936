//! The paper's mission simulated, against the time that it takes in the house.
//!
//! `cargo bench --bench simulate`; `SCENEFOLD_BENCH_SMALL=1` for a smoke run.

mod common;

use std::sync::Arc;
use std::time::Instant;

use common::measure::{tell_at_least, tell_time};
use common::small;
use scenefold::simulation::house;
use scenefold::simulation::record::record;
use scenefold::simulation::scenario::paper_mission;

fn main() {
    let folder = tempfile::tempdir().expect("there is room for a recording");
    let mut scenario = paper_mission(1);
    if small() {
        (scenario.robot.camera.width, scenario.robot.camera.height) = (64, 48);
    }
    let house = Arc::new(house::load(&scenario.house).expect("it is built in"));
    let path = folder.path().join("mission.mcap");
    let start = Instant::now();
    let done = record(&scenario, &house, &path, &mut |_| {}).expect("the mission can happen");
    let took = start.elapsed();
    tell_time("simulate, render and record", took, done.pictures, "picture");
    let bytes = std::fs::metadata(&path).expect("it was written").len();
    println!("{} pictures, {:.0} s in the house, {bytes} bytes", done.pictures, done.seconds);
    let ratio = done.seconds / took.as_secs_f64();
    tell_at_least("times faster than real time", ratio, 5.0);
}
