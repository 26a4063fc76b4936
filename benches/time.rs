//! What time costs: probabilities of a hundred thousand nodes, learning from a million looks, a
//! tick of the clock at which nothing crosses.
//!
//! `cargo bench --bench time`.

mod common;

use std::collections::BTreeMap;
use std::hint::black_box;

use common::household::{Dice, node};
use common::measure::{best_cpu_of, over, tell_at_most, tell_time};
use common::scaled;
use scenefold::event::Event;
use scenefold::geometry::Size;
use scenefold::graph::{Label, Layer, Object, PoseSource, Region, SceneGraph};
use scenefold::learn::{Dwell, DwellData, fit_dwells};
use scenefold::time::Stamp;
use scenefold::updater::{Config, Updater};

const START: Stamp = Stamp::from_nanos(1_767_571_200_000_000_000);
const HOUR: u64 = 3_600_000_000_000;

/// A hall full of things with rates of their own, none of which crosses within the hour.
fn hall(objects: u32) -> SceneGraph {
    let (mut graph, mut dice) = (SceneGraph::new(), Dice::new());
    let room = node(Layer::Room, 1);
    let label = |text: &str| Label::new(text).expect("a label");
    let region = Region { label: label("hall"), extent: None, parent: None };
    graph.insert_region(room, region).expect("a new room");
    for n in 0..objects {
        let object = Object {
            label: label("mug"),
            pose: dice.pose(),
            size: Size::new(0.1, 0.1, 0.1).expect("a size"),
            decay_rate: 1e-6 + 1e-5 * f64::from(dice.below(1000)) / 1000.0,
            last_observed: START.plus_nanos(u64::from(dice.below(1000)) * 1_000_000_000),
            pose_source: PoseSource::Measured,
            room,
            support: None,
        };
        graph.insert_object(node(Layer::Object, n), object).expect("a new object");
    }
    graph
}

fn probabilities() {
    // Many times over: what the system tells of processor time is coarse.
    const TIMES: u64 = 50;
    let objects = scaled(100_000);
    let graph = hall(objects as u32);
    let now = START.plus_nanos(6 * HOUR);
    let exponents: Vec<f64> = graph
        .objects()
        .map(|(_, it)| it.decay_rate * now.seconds_since(it.last_observed))
        .collect();
    let [bare, nodes] = best_cpu_of(
        10,
        [
            &mut || {
                for _ in 0..TIMES {
                    black_box(black_box(&exponents).iter().map(|it| libm::exp(*it)).sum::<f64>());
                }
            },
            &mut || {
                for _ in 0..TIMES {
                    let probabilities = black_box(&graph).objects();
                    black_box(probabilities.map(|(_, it)| it.probability_static(now)).sum::<f64>());
                }
            },
        ],
    );
    tell_time("probabilities of nodes, 50 times", nodes, TIMES * objects, "node");
    tell_at_most("probabilities over bare exp", over(nodes, bare), 3.0);
}

/// Looks that found things gone or there, all of different length.
fn looks(count: u64) -> Vec<(u32, Dwell)> {
    let mut dice = Dice::new();
    let mut seconds = |below: u32| f64::from(dice.below(below)) + 0.5;
    (0..count)
        .map(|n| {
            let from = seconds(100_000);
            let dwell = match n % 3 {
                0 => Dwell::at_least(from),
                1 => Dwell::exactly(from),
                _ => Dwell::between(from, from + seconds(10_000)),
            };
            ((n % 50) as u32, dwell.expect("in order"))
        })
        .collect()
}

fn learn(looks: &[(u32, Dwell)]) -> f64 {
    let mut classes: BTreeMap<String, DwellData> = BTreeMap::new();
    let names: Vec<String> = (0..50).map(|n| format!("class {n}")).collect();
    for name in &names {
        classes.insert(name.clone(), DwellData::default());
    }
    let mut data: Vec<DwellData> = classes.values().cloned().collect();
    looks.iter().for_each(|(class, dwell)| data[*class as usize].add(*dwell));
    let fits = fit_dwells(&names.into_iter().zip(data).collect()).0;
    fits.values().map(|fit| fit.rate_per_s).sum()
}

fn learning() {
    let count = scaled(1_000_000);
    let many = looks(count);
    let few = &many[..many.len() / 10];
    let [all, tenth] = best_cpu_of(
        2,
        [
            &mut || {
                black_box(learn(black_box(&many)));
            },
            &mut || {
                black_box(learn(black_box(few)));
            },
        ],
    );
    tell_time("learning from looks", all, count, "look");
    tell_at_most("a look of a million over one of a tenth of that", over(all, tenth) / 10.0, 1.5);
}

fn ticks() {
    let config = Config::from_json(r#"{"stale_below": 0.5}"#).expect("a threshold");
    let updater = |objects: u64| {
        let mut updater = Updater::new(config.clone());
        updater.update(START, Event::InitialGraph(hall(objects as u32))).expect("an input");
        updater
    };
    let (mut large, mut small) = (updater(scaled(100_000)), updater(scaled(1_000)));
    let ticks = scaled(100_000);
    let run = |updater: &mut Updater| {
        for n in 0..ticks {
            let at = START.plus_nanos(n * 1_000_000);
            black_box(updater.update(at, Event::Tick)).expect("an input");
        }
    };
    let [many, few] = best_cpu_of(10, [&mut || run(&mut large), &mut || run(&mut small)]);
    tell_time("ticks over 100 000 objects", many, ticks, "tick");
    tell_at_most("a tick over 100 000 objects over one over 1 000", over(many, few), 1.5);
}

fn main() {
    probabilities();
    learning();
    ticks();
}
