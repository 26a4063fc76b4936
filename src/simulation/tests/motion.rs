//! The robot keeps to the free floor and to its speed, and does what it was asked.

use proptest::prelude::*;

use super::small_house;
use crate::event::Status;
use crate::simulation::blocks::Block;
use crate::simulation::house::Space;
use crate::simulation::robot::grid::Grid;
use crate::simulation::robot::motion::{Body, BodyConfig, wrapped};
use crate::simulation::robot::path::{length, plan};
use crate::simulation::scenario::Scenario;
use crate::simulation::shapes::polygon::contains;
use crate::simulation::story::{Moment, Story, StoryError};

const RADIUS_M: f64 = 0.22;

/// Walls and things in the way of a robot.
fn obstacles(house: &crate::simulation::house::House) -> Vec<Block> {
    let space = Space::new(house);
    let things = (0..house.things.len()).flat_map(|n| space.parts_of(n));
    space.walls().iter().chain(things).filter(|block| block.z[0] < 1.4).copied().collect()
}

fn grid() -> (std::sync::Arc<crate::simulation::house::House>, Grid) {
    let house = small_house();
    let obstacles = obstacles(&house);
    let grid = Grid::new(&house, &obstacles, RADIUS_M);
    (house, grid)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn a_way_keeps_its_distance_from_walls_and_is_no_longer_than_twice_the_straight_line_and_more(
        from in (0.3..3.7_f64, 0.3..1.5_f64),
        to in (4.3..5.9_f64, 0.3..2.7_f64),
    ) {
        let (house, grid) = grid();
        let way = plan(&grid, [from.0, from.1], [to.0, to.1]).unwrap();
        prop_assert!(length(&way) < 2.0 * libm::hypot(to.0 - from.0, to.1 - from.1) + 3.0);
        for pair in way.windows(2) {
            for n in 0..=50 {
                let t = f64::from(n) / 50.0;
                let at = [0, 1].map(|axis| pair[0][axis] + (pair[1][axis] - pair[0][axis]) * t);
                let wall = obstacles(&house).iter().map(|block| block.distance(at)).fold(9.0, f64::min);
                // To within a cell of the grid.
                prop_assert!(wall > RADIUS_M - 0.06, "{at:?} is {wall} m from a wall");
                prop_assert!(house.rooms.iter().any(|room| contains(&room.outline, at)) || (at[0] - 4.0).abs() < 0.06);
            }
        }
    }
}

#[test]
fn there_is_no_way_through_a_wall() {
    let mut house = (*small_house()).clone();
    house.doors.clear();
    let grid = Grid::new(&house, &obstacles(&house), RADIUS_M);
    assert_eq!(plan(&grid, [1.0, 1.0], [6.0, 1.0]), None);
}

fn scenario(json: &str) -> Scenario {
    Scenario::from_json(json).unwrap()
}

fn told(scenario: &Scenario) -> (Story, Vec<(u64, Moment)>) {
    let mut story = Story::new(scenario.clone(), &small_house()).unwrap();
    let mut moments = Vec::new();
    let start = scenario.start.nanos();
    while story
        .tick::<StoryError>(&mut |_, at, moment| {
            moments.push((at.nanos() - start, moment.clone()));
            Ok(())
        })
        .unwrap()
    {}
    (story, moments)
}

const ERRAND: &str = r#"{"name": "errand", "house": "small", "tasks": [
    {"time": "1s", "instruction": "Take the mug to the bed.", "pick": "mug", "place": {"on": "bed"}}]}"#;

#[test]
fn an_errand_is_run_from_pick_to_place() {
    let (story, moments) = told(&scenario(ERRAND));
    let reports: Vec<Status> = moments
        .iter()
        .filter_map(|(_, moment)| match moment {
            Moment::Reported(report) => Some(report.status),
            _ => None,
        })
        .collect();
    assert_eq!(reports, [Status::Started, Status::Picked, Status::Placed, Status::Done]);
    let mug = story.world().thing(2);
    assert_eq!((mug.room, mug.support), (1, Some(1)));
    assert!((mug.pose.position()[2] - 0.55).abs() < 1e-6);
}

#[test]
fn what_is_not_there_any_more_cannot_be_picked() {
    let gone = r#"{"name": "gone", "house": "small",
        "actions": [{"time": "2s", "action": "removed", "object": "mug"}],
        "tasks": [{"time": "1s", "instruction": "Take the mug to the bed.", "pick": "mug",
                   "place": {"on": "bed"}}]}"#;
    let (_, moments) = told(&scenario(gone));
    let failed =
        |moment: &Moment| matches!(moment, Moment::Reported(r) if r.status == Status::Failed);
    assert!(moments.iter().any(|(_, moment)| failed(moment)));
}

#[test]
fn the_same_scenario_is_the_same_story() {
    let scenario = scenario(ERRAND);
    assert_eq!(told(&scenario).1, told(&scenario).1);
}

#[test]
fn while_the_robot_sleeps_the_clock_ticks() {
    let json = r#"{"name": "asleep", "house": "small", "gaps": [{"time": "2s", "length": "2d"}]}"#;
    let (_, moments) = told(&scenario(json));
    let ticks: Vec<u64> = moments
        .iter()
        .filter(|(_, moment)| *moment == Moment::Clock)
        .map(|(at, _)| at / 1_000_000_000)
        .collect();
    let hours = 48;
    assert_eq!(ticks.len(), hours + 1);
    assert_eq!((ticks[0], ticks[hours]), (2, 2 + 172_800));
    assert!(moments.windows(2).all(|pair| pair[0].0 <= pair[1].0), "time never runs back");
}

#[test]
fn the_body_is_never_faster_than_it_may_be() {
    let config = BodyConfig::default();
    let mut body = Body::new(config, [0.0, 0.0], 0.0);
    body.follow(&[[0.0, 0.0], [1.0, 0.3], [0.2, 1.0]]);
    let step = 0.05;
    while !body.is_idle() {
        let before = body.clone();
        body.step(step);
        let moved = libm::hypot(body.at[0] - before.at[0], body.at[1] - before.at[1]);
        assert!(moved <= config.speed_m_s * step + 1e-9);
        assert!(wrapped(body.yaw - before.yaw).abs() <= config.turn_rad_s * step + 1e-9);
        assert!((body.pan - before.pan).abs() <= config.head_rad_s * step + 1e-9);
    }
    assert!(libm::hypot(body.at[0] - 0.2, body.at[1] - 1.0) < 1e-9);
}

#[test]
fn the_camera_looks_ahead_and_down() {
    let mut body = Body::new(BodyConfig::default(), [0.0, 0.0], 0.0);
    body.pan = std::f64::consts::FRAC_PI_2;
    body.tilt = 0.0;
    let ahead = body.world_from_camera() * nalgebra::Point3::new(0.0, 0.0, 1.0);
    let right = body.world_from_camera() * nalgebra::Point3::new(1.0, 0.0, 0.0);
    let eye = body.world_from_camera() * nalgebra::Point3::origin();
    assert!(((ahead - eye) - nalgebra::Vector3::y()).norm() < 1e-9, "panned to the left");
    assert!(((right - eye) - nalgebra::Vector3::x()).norm() < 1e-9);
}
