//! Wrong houses: every complaint names the field and the mend.

use serde_json::{Value, json};

use super::super::*;

/// Two rooms, a door, a table with a mug, a cabinet on the wall.
fn right() -> Value {
    json!({
        "name": "small",
        "rooms": [
            {"label": "kitchen", "box": [0, 0, 4, 3]},
            {"label": "bedroom", "box": [4, 0, 7, 3]}
        ],
        "doors": [{"between": ["kitchen", "bedroom"], "at": [4, 1]}],
        "objects": [
            {"label": "table", "position": [1.5, 1.5]},
            {"label": "mug", "position": [1.5, 1.5], "support": "table"},
            {"label": "wall cabinet", "position": [2, 2.75, 1.8]},
            {"label": "chair", "position": [6, 2], "yaw": 90, "mesh": "chair", "colour": "#aa3311"}
        ]
    })
}

fn complaints(file: &Value) -> Vec<String> {
    let made = read(&file.to_string()).map_err(|error| vec![error]).and_then(|it| build(&it, None));
    made.err().unwrap_or_default().iter().map(ToString::to_string).collect()
}

/// With the value at `pointer` replaced, the first complaint says all of `words`.
#[track_caller]
fn check_wrong(pointer: &str, value: Value, words: &[&str]) {
    let mut file = right();
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    match file.pointer_mut(parent).unwrap() {
        Value::Array(items) if key == "-" => items.push(value),
        Value::Array(items) => items[key.parse::<usize>().unwrap()] = value,
        Value::Object(fields) => drop(fields.insert(key.to_owned(), value)),
        other => panic!("{other}"),
    }
    let found = complaints(&file);
    let first = found.first().unwrap_or_else(|| panic!("{pointer}: nothing is wrong"));
    for word in words {
        assert!(first.contains(word), "{pointer}: {word:?} is not in: {first}");
    }
}

#[test]
fn the_right_house_is_right() {
    assert_eq!(complaints(&right()), Vec::<String>::new());
}

#[test]
fn fields_that_cannot_be_are_named() {
    for (pointer, value, words) in [
        ("/rooms", json!([]), &["rooms: ", "at least one"][..]),
        ("/wall_height", json!(0.5), &["wall_height: 0.5", "1.8"]),
        ("/wall_thickness", json!(-0.1), &["wall_thickness: -0.1"]),
        ("/colour", json!("#ffffff"), &["colour", "unknown field"]),
        ("/rooms/0/box/2", json!("wide"), &["rooms[0].box[2]", "invalid type"]),
        ("/objects/1/size", json!([0.1, -0.1, 0.1]), &["objects[1].size[1]: ", "-0.1", "0.001"]),
        ("/objects/1/size", json!([0.1, 0.1]), &["objects[1].size"]),
        ("/objects/1/sise", json!([0.1, 0.1, 0.1]), &["objects[1].sise", "unknown field", "size"]),
        ("/objects/1/position", json!([1.0]), &["objects[1].position: ", "two"]),
        ("/objects/3/yaw", json!(1e9), &["objects[3].yaw: 1000000000"]),
        ("/objects/3/colour", json!("red"), &["objects[3].colour: \"red\"", "#cc3322"]),
        ("/objects/3/mesh", json!("flux"), &["objects[3].mesh: \"flux\"", ".obj", "tv remote"]),
        ("/objects/3/mesh", json!("no/such.obj"), &["objects[3].mesh: ", "such.obj"]),
        ("/objects/3/decay", json!("slow"), &["objects[3].decay: \"slow\"", "tableware"]),
        ("/objects/3/half_life_h", json!(0.0), &["objects[3].half_life_h: 0"]),
        ("/objects/3/label", json!(" "), &["objects[3].label: "]),
        (
            "/objects/3/room",
            json!("attic"),
            &["objects[3].room: ", "\"attic\"", "kitchen, bedroom"],
        ),
        ("/objects/3/room", json!("kitchen"), &["objects[3].position: ", "in the bedroom, not"]),
        ("/objects/3/name", json!("mug"), &["name: \"mug\"", "objects[1]", "another"]),
        ("/objects/3/texture", json!({"dots": 1}), &["objects[3].texture", "stripes"]),
        (
            "/objects/3/texture",
            json!({"grain": {"scale": 0.1, "strength": 2}}),
            &["objects[3].texture.grain.strength: 2"],
        ),
        (
            "/objects/-",
            json!({"label": "gizmo", "position": [1, 1]}),
            &["objects[4]: ", "size [w, h, d]"],
        ),
        (
            "/objects/3/orientation",
            json!({"w": 1, "x": 0, "y": 0, "z": 0}),
            &["objects[3]: ", "yaw or orientation"],
        ),
    ] {
        check_wrong(pointer, value, words);
    }
}

#[test]
fn rooms_that_cannot_be_are_named() {
    for (pointer, value, words) in [
        (
            "/rooms/1/box",
            json!([3.5, 0, 7, 3]),
            &["rooms[1]: ", "bedroom overlaps the kitchen", "0.50 m"][..],
        ),
        ("/rooms/1/box", json!([4, 0, 3, 3]), &["rooms[1].box[2]: 3", "beyond 4"]),
        ("/rooms/1/outline", json!([[4, 0], [7, 0], [7, 3]]), &["rooms[1]: ", "not both"]),
        (
            "/rooms/-",
            json!({"label": "x", "outline": [[9, 0], [10, 1], [10, 0], [9, 1]]}),
            &["rooms[2].outline: ", "crosses itself"],
        ),
        ("/rooms/-", json!({"label": "x", "outline": [[9, 0], [10, 1]]}), &["three corners"]),
        ("/rooms/-", json!({"label": "x"}), &["rooms[2]: ", "box", "outline"]),
        (
            "/rooms/-",
            json!({"label": "kitchen", "box": [9, 0, 12, 3]}),
            &["rooms[2].name: \"kitchen\"", "rooms[0]"],
        ),
        ("/doors/0/between/1", json!("attic"), &["doors[0].between[1]: ", "\"attic\"", "bedroom"]),
        ("/doors/0/between/1", json!("kitchen"), &["doors[0].at: ", "two different rooms"]),
        ("/doors/0/at", json!([3, 1]), &["doors[0].at: ", "(3, 1)", "not on a wall shared"]),
        ("/doors/0/at", json!([4, 0.2]), &["doors[0].at: ", "reaches beyond the wall"]),
        ("/doors/0/width", json!(0.1), &["doors[0].width: 0.1", "0.4"]),
        ("/doors/0/height", json!(3.0), &["doors[0].height: 3", "2.5"]),
    ] {
        check_wrong(pointer, value, words);
    }
}

#[test]
fn things_that_cannot_stand_there_are_named() {
    for (pointer, value, words) in [
        (
            "/objects/3/position",
            json!([9, 2]),
            &["objects[3].position: ", "(9, 2) is in no room"][..],
        ),
        (
            "/objects/3/position",
            json!([6.95, 2]),
            &["objects[3].position: \"chair\"", "into a wall"],
        ),
        (
            "/objects/3/position",
            json!([6, 2, 1.0]),
            &["objects[3].position: ", "floats 0.55 m", "support"],
        ),
        ("/objects/3/position", json!([6, 2, 0.2]), &["objects[3].position: ", "into the floor"]),
        ("/objects/2/position", json!([2, 2.75, 2.4]), &["objects[2].position: ", "ceiling"]),
        (
            "/objects/1/position",
            json!([1.5, 1.5, 1.0]),
            &["objects[1].position: ", "0.21 m above the top"],
        ),
        ("/objects/1/position", json!([2.1, 1.5]), &["objects[1]: \"mug\"", "juts", "edge"]),
        (
            "/objects/1/support",
            json!("desk"),
            &["objects[1].support: ", "no object named \"desk\""],
        ),
        ("/objects/1/support", json!("mug"), &["objects[1].support: ", "stands on itself"]),
        ("/objects/1/surface", json!("shelf"), &["objects[1]: ", "no surface \"shelf\"", "top"]),
        ("/objects/3/surface", json!("top"), &["objects[3].surface: ", "support"]),
        (
            "/objects/-",
            json!({"label": "glass", "position": [1.52, 1.5], "support": "table"}),
            &["objects[4].position: \"glass\"", "into \"mug\" (objects[1])", "move one"],
        ),
        (
            "/objects/-",
            json!({"label": "stool", "position": [2.0, 1.8]}),
            &["objects[4].position: \"stool\"", "into \"table\""],
        ),
        (
            "/objects/-",
            json!({"label": "apple", "position": [1.5, 1.5], "support": "mug"}),
            &["objects[4]: ", "nothing can be put on \"mug\""],
        ),
    ] {
        check_wrong(pointer, value, words);
    }
}

#[test]
fn all_complaints_are_told_at_once() {
    let mut file = right();
    file["objects"][1]["size"] = json!([0.0, 0.1, 0.1]);
    file["objects"][3]["colour"] = json!("red");
    assert_eq!(complaints(&file).len(), 2);
}

#[test]
fn a_chair_may_stand_under_a_table() {
    let mut file = right();
    file["objects"][3] = json!({"label": "chair", "position": [1.5, 2.0]});
    assert_eq!(complaints(&file), Vec::<String>::new());
}

#[test]
fn a_thing_may_lie_on_its_side() {
    let mut file = right();
    let lying = json!({"w": 1, "x": 1, "y": 0, "z": 0});
    file["objects"][1] = json!({"label": "bottle", "position": [1.5, 1.5], "support": "table", "orientation": lying});
    let house = build(&read(&file.to_string()).unwrap(), None).unwrap();
    assert!((house.things[1].pose.position()[2] - 0.78).abs() < 1e-5);
}
