//! A thousand random scenarios in the built-in houses: nothing floats, nothing is in another.

use std::sync::Arc;

use crate::simulation::blocks::Block;
use crate::simulation::house::{self, House, footprint};
use crate::simulation::scenario::{Draw, Scenario, generate, paper_mission};
use crate::simulation::world::TrueWorld;

fn built_in(name: &str) -> Arc<House> {
    Arc::new(house::load(name).unwrap())
}

fn block(world: &TrueWorld, n: usize) -> Block {
    let thing = world.thing(n);
    footprint(&thing.pose, thing.size)
}

/// What was put somewhere lies level on a surface of its support, and within it.
fn check_lies_on_its_support(world: &TrueWorld, n: usize, what: &str) {
    let (thing, lying) = (world.thing(n), block(world, n));
    let Some(support) = thing.support else {
        assert!(lying.z[0].abs() < 1e-4, "{what}: {} floats over the floor", thing.name);
        return;
    };
    let support = world.thing(support);
    let below = support.pose.isometry().inverse();
    let carries = support.surfaces.iter().any(|surface| {
        let inside = lying.corners().iter().all(|corner| {
            let at = below * nalgebra::Point3::new(corner[0], corner[1], 0.0);
            (surface.min[0]..=surface.max[0]).contains(&at.x)
                && (surface.min[1]..=surface.max[1]).contains(&at.y)
        });
        let level = support.pose.position()[2] + surface.z;
        inside && (lying.z[0] - level).abs() < 1e-4
    });
    assert!(carries, "{what}: {} does not lie on {}", thing.name, support.name);
}

/// Part by part: a book may lie between the boards of a shelf.
fn check_meets_nothing(world: &TrueWorld, n: usize, what: &str) {
    if let Err(misfit) = world.space().is_free(n, &world.thing(n).pose) {
        panic!("{what}: {}: {misfit}", world.thing(n).name);
    }
}

/// Lets everything happen, and checks each thing that was put somewhere.
fn check_scenario(scenario: &Scenario, house: &Arc<House>) {
    scenario.check(house).unwrap_or_else(|error| panic!("{}: {error}", scenario.name));
    let what = format!("{} in {}", scenario.name, scenario.house);
    let mut check = |world: &TrueWorld| {
        for n in world.present() {
            let touched = n >= house.things.len() || world.thing(n).pose != house.things[n].pose;
            if touched {
                check_lies_on_its_support(world, n, &what);
                check_meets_nothing(world, n, &what);
            }
        }
    };
    scenario.rehearse(house, &mut check).unwrap();
}

#[test]
fn in_a_thousand_random_scenarios_nothing_floats_or_is_in_another() {
    let names = ["apartment", "cottage", "loft"];
    let houses = names.map(|name| (name, built_in(name)));
    let mut happened = 0;
    for seed in 0..1000 {
        let (name, house) = &houses[seed as usize % houses.len()];
        let scenario = generate(name, house, seed, Draw { told: 0.5, ..Draw::default() });
        happened += scenario.actions.len();
        check_scenario(&scenario, house);
    }
    assert!(happened > 5000, "only {happened} things happened");
}

#[test]
fn the_papers_mission_can_happen_with_any_seed() {
    let house = built_in("apartment");
    for seed in 0..50 {
        check_scenario(&paper_mission(seed), &house);
    }
}

#[test]
fn the_schema_of_scenarios_is_the_committed_one() {
    let path =
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("schemas/scenario.schema.json");
    if std::env::var_os("SCENEFOLD_WRITE_SCHEMAS").is_some() {
        std::fs::write(&path, Scenario::schema()).unwrap();
    }
    let committed = std::fs::read_to_string(path).unwrap();
    let mend = "run the test with SCENEFOLD_WRITE_SCHEMAS=1 and commit the file";
    assert!(committed == Scenario::schema(), "{mend}");
}

#[test]
fn a_random_scenario_reads_back_from_its_file() {
    let house = built_in("apartment");
    let scenario = generate("apartment", &house, 3, Draw::default());
    assert_eq!(Scenario::from_json(&scenario.to_json()).unwrap(), scenario);
    assert_eq!(generate("apartment", &house, 3, Draw::default()), scenario);
}
