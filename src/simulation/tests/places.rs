//! Things are put where they fit, and scenarios that cannot happen say why.

use proptest::prelude::*;

use super::{small_house, thing};
use crate::simulation::house::{TOUCH_M, footprint};
use crate::simulation::random::Random;
use crate::simulation::scenario::{Place, Scenario};
use crate::simulation::world::TrueWorld;

proptest! {
    #[test]
    fn what_is_put_on_a_table_lies_on_it_and_meets_nothing(seed: u64) {
        let world = TrueWorld::new(small_house());
        let plate = thing("plate", 0, None, [0.0; 3], [0.25, 0.25, 0.02]);
        let place = Place { on: Some("table".to_owned()), ..Place::default() };
        let spot = world.place(&plate, &place, &mut Random::new(seed, 0)).unwrap();
        let (plate, table) = (footprint(&spot.pose, plate.size), footprint(&world.thing(0).pose, world.thing(0).size));
        prop_assert!((plate.z[0] - table.z[1]).abs() < 1e-5);
        for corner in plate.corners() {
            prop_assert!((corner[0] - 1.0).abs() <= 0.6 && (corner[1] - 2.2).abs() <= 0.4);
        }
        let mug = world.space().parts_of(2);
        let deepest = mug.iter().map(|part| plate.depth(part)).fold(-1.0, f64::max);
        prop_assert!(deepest < TOUCH_M, "{deepest} m into the mug");
        prop_assert_eq!((spot.room, spot.support), (0, Some(0)));
    }
}

/// The scenario with this in it is refused with all of these words.
fn refused(rest: &str, words: &[&str]) {
    let json = format!(r#"{{"name": "x", "house": "small", {rest}}}"#);
    let error = match Scenario::from_json(&json) {
        Ok(scenario) => scenario.check(&small_house()).unwrap_err().to_string(),
        Err(error) => error.to_string(),
    };
    for word in words {
        assert!(error.contains(word), "{rest}\n{error:?} lacks {word:?}");
    }
}

#[test]
fn a_scenario_that_cannot_happen_is_refused_with_the_field_and_the_mend() {
    refused(
        r#""actions": [{"time": "1s", "action": "removed", "object": "mugg"}]"#,
        &["actions[0]", "mugg", "is \"mug\" meant"],
    );
    refused(
        r#""actions": [{"time": "1s", "action": "removed", "object": "table"}]"#,
        &["actions[0]", "mug stands on \"table\""],
    );
    refused(
        r#""actions": [{"time": "1s", "action": "removed", "object": "mug"},
                       {"time": "2s", "action": "removed", "object": "mug"}]"#,
        &["actions[1]", "no \"mug\" in the house by then"],
    );
    refused(
        r#""actions": [{"time": "1s", "action": "moved", "object": "mug", "to": {"on": "bed", "surface": "arm"}}]"#,
        &["actions[0]", "bed", "'s arm", "it has top"],
    );
    refused(
        r#""actions": [{"time": "1s", "action": "moved", "object": "mug", "to": {"on": "book"}}]"#,
        &["nothing can be put on", "no level surface"],
    );
    refused(
        r#""actions": [{"time": "1s", "action": "moved", "object": "mug", "to": {}}]"#,
        &["actions[0]", "say where"],
    );
    refused(
        r#""actions": [{"time": "1s", "action": "added", "object": {"label": "mug"}, "to": {"on": "bed"}}]"#,
        &["object.name", "choose another name"],
    );
    refused(
        r#""actions": [{"time": "1s", "action": "added", "object": {"label": "piano", "size": [1.5, 1.5, 1]}, "to": {"on": "table"}}]"#,
        &["piano", "does not fit on table"],
    );
    refused(
        r#""actions": [{"time": "1s", "action": "added", "object": {"label": "vase", "size": [1, -1, 1]}, "to": {"on": "bed"}}]"#,
        &["actions[0]", "object.size", "-1"],
    );
    refused(
        r#""tasks": [{"time": "1s", "instruction": "?", "pick": "lamp", "place": {"on": "bed"}}]"#,
        &["tasks[0].pick", "lamp"],
    );
    refused(
        r#""tasks": [{"time": "1s", "instruction": "?", "pick": "mug", "place": {"room": "attic"}}]"#,
        &["tasks[0].place", "attic", "kitchen, bedroom"],
    );
    refused(r#""robot": {"room": "attic"}"#, &["robot.room", "attic"]);
    refused(r#""robot": {"round": ["kitchen", "x"]}"#, &["robot.round[1]"]);
    refused(r#""robot": {"camera": {"rate_hz": 0}}"#, &["robot.camera.rate_hz", "0.01 to 20"]);
    refused(r#""robot": {"camera": {"width": 3}}"#, &["robot.camera.width", "16 to 4096"]);
    refused(r#""robot": {"body": {"speed_m_s": -1}}"#, &["robot.body.speed_m_s", "-1"]);
    refused(r#""actions": [{"time": "soon", "action": "removed", "object": "mug"}]"#, &["soon"]);
    refused(r#""actions": [{"time": "1s", "action": "eaten", "object": "mug"}]"#, &["eaten"]);
    refused(r#""colour": 3"#, &["colour"]);
}
