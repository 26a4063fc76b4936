//! Tests of the VirtualHome import.

// Lengths lie on a grid: equality is exact.
#![allow(clippy::float_cmp)]

use super::*;
use crate::interchange::testing::{id, shared};

const HOME: &str = r#"{"nodes": [
  {"id": 1, "category": "Rooms", "class_name": "livingroom",
   "bounding_box": {"center": [0, 1, 0], "size": [4, 2, 6]}},
  {"id": 2, "category": "Rooms", "class_name": "kitchen",
   "bounding_box": {"center": [0, 1, 6], "size": [4, 2, 6]}},
  {"id": 3, "category": "Rooms", "class_name": "bedroom",
   "bounding_box": {"center": [-5, 1, 3], "size": [6, 2, 4]}},
  {"id": 4, "category": "Floor", "class_name": "floor",
   "bounding_box": {"center": [0, 0, 0], "size": [4, 0.1, 6]}},
  {"id": 5, "category": "Furniture", "class_name": "desk",
   "bounding_box": {"center": [1, 0.4, 2], "size": [1, 0.8, 2]}},
  {"id": 6, "category": "Props", "class_name": "mousemat", "properties": ["GRABBABLE"],
   "bounding_box": {"center": [1, 0.81, 2], "size": [0.2, 0, 0.3]}},
  {"id": 7, "category": "Props", "class_name": "mouse", "properties": ["MOVABLE"],
   "bounding_box": {"center": [1, 0.83, 2], "size": [0.1, 0.05, 0.05]}},
  {"id": 8, "category": "Characters", "class_name": "character", "bounding_box": null},
  {"id": 9, "category": "Doors", "class_name": "door",
   "bounding_box": {"center": [0, 1, 3], "size": [1, 2, 0.1]}},
  {"id": 10, "category": "Doors", "class_name": "door",
   "bounding_box": {"center": [0, 1, 3], "size": [1, 2, 0.1]}},
  {"id": 11, "category": "Doors", "class_name": "door",
   "bounding_box": {"center": [0, 1, 9], "size": [1, 2, 0.1]}}],
 "edges": [
  {"from_id": 5, "to_id": 1, "relation_type": "INSIDE"},
  {"from_id": 5, "to_id": 4, "relation_type": "ON"},
  {"from_id": 6, "to_id": 5, "relation_type": "ON"},
  {"from_id": 6, "to_id": 7, "relation_type": "ON"},
  {"from_id": 7, "to_id": 5, "relation_type": "ON"},
  {"from_id": 7, "to_id": 6, "relation_type": "ON"},
  {"from_id": 7, "to_id": 1, "relation_type": "CLOSE"},
  {"from_id": 9, "to_id": 1, "relation_type": "BETWEEN"},
  {"from_id": 9, "to_id": 3, "relation_type": "BETWEEN"},
  {"from_id": 99, "to_id": 3, "relation_type": "ON"}]}"#;

#[test]
fn rooms_things_supports_and_access_are_taken() {
    let Import { graph, report, .. } = import(HOME, &Options::default()).unwrap();
    assert_eq!(graph.region(id("R1")).unwrap().label.as_str(), "living room");
    let (desk, mouse) = (graph.object(id("O5")).unwrap(), graph.object(id("O7")).unwrap());
    assert_eq!(desk.room, id("R1"));
    assert_eq!(desk.support, None);
    assert_eq!(desk.pose.position(), [1.0, 2.0, 0.4]);
    assert_eq!(desk.size.metres(), [1.0, 2.0, 0.8]);
    assert_eq!((desk.decay_rate, mouse.decay_rate), (IMMOVABLE_DECAY_RATE, MOVABLE_DECAY_RATE));
    // The mat claims to lie on the mouse too, but the mouse is higher; and it is smaller than
    // the desk.
    assert_eq!(graph.object(id("O6")).unwrap().support, Some(id("O5")));
    assert_eq!(mouse.support, Some(id("O6")));
    let access: Vec<_> = graph.access().collect();
    assert_eq!(access, [(id("R1"), id("R2")), (id("R1"), id("R3"))]);
    assert_eq!(report.counts["floors skipped"], 1);
    assert_eq!(report.counts["characters skipped"], 1);
    assert_eq!(report.counts["CLOSE relations skipped"], 1);
    assert_eq!(report.counts["relations of unknown nodes skipped"], 1);
    let notes = report.notes.join("\n");
    assert!(notes.contains("no access: 11") && notes.contains("thick: O6"), "{notes}");
}

#[test]
fn structure_is_taken_where_it_is_asked_for() {
    let options = Options { structure: true, ..Options::default() };
    let graph = import(HOME, &options).unwrap().graph;
    assert_eq!(graph.object(id("O5")).unwrap().support, Some(id("O4")));
}

/// On which side of somebody at `from` who looks at `to` is `third`, seen in Unity? Its own
/// documents say that right = up × forward, by the formula of the cross product.
fn is_left_in_unity(from: [f64; 3], to: [f64; 3], third: [f64; 3]) -> bool {
    let minus = |a: [f64; 3], b: [f64; 3]| nalgebra::Vector3::from(a) - nalgebra::Vector3::from(b);
    let right = nalgebra::Vector3::y().cross(&minus(to, from));
    right.dot(&minus(third, from)) < 0.0
}

/// The same in our frame, where left = up × forward.
fn is_left_here(from: [f64; 3], to: [f64; 3], third: [f64; 3]) -> bool {
    let minus = |a: [f64; 3], b: [f64; 3]| nalgebra::Vector3::from(a) - nalgebra::Vector3::from(b);
    let left = nalgebra::Vector3::z().cross(&minus(to, from));
    left.dot(&minus(third, from)) > 0.0
}

#[track_caller]
fn check_not_mirrored(text: &str, rooms: [u64; 3]) {
    let value: serde_json::Value = serde_json::from_str(text).unwrap();
    let in_unity = rooms.map(|id| {
        let nodes = value["nodes"].as_array().unwrap();
        let node = nodes.iter().find(|node| node["id"] == id).unwrap();
        [0, 1, 2].map(|n| node["bounding_box"]["center"][n].as_f64().unwrap())
    });
    let graph = import(text, &Options::default()).unwrap().graph;
    let here = rooms.map(|n| {
        let room = graph.region(node_id(Layer::Room, n).unwrap()).unwrap();
        room.extent.unwrap().0.position()
    });
    for [a, b, c] in [[0, 1, 2], [1, 0, 2], [0, 2, 1], [2, 1, 0]] {
        let left = is_left_in_unity(in_unity[a], in_unity[b], in_unity[c]);
        assert_eq!(is_left_here(here[a], here[b], here[c]), left);
    }
}

#[test]
fn what_is_on_the_left_in_unity_is_on_the_left_here() {
    // In the living room, looking ahead (z) at the kitchen, the bedroom (x < 0) is on the left.
    assert!(is_left_in_unity([0.0, 1.0, 0.0], [0.0, 1.0, 6.0], [-5.0, 1.0, 3.0]));
    check_not_mirrored(HOME, [1, 2, 3]);
    if let Some(text) = shared("virtualhome/scene2.json") {
        check_not_mirrored(&text, [41, 1, 162]);
        check_not_mirrored(&text, [241, 41, 1]);
    }
}

#[test]
fn the_shared_apartment_is_read() {
    let Some(text) = shared("virtualhome/scene2.json") else { return };
    let Import { graph, report, .. } = import(&text, &Options::default()).unwrap();
    println!("{report}");
    assert_eq!(graph.rooms().count(), 4);
    assert_eq!(graph.object_count(), 310 - 4 - 1 - 35 - 31 - 28);
    // Bathroom - kitchen - bedroom, kitchen - living room.
    let access: Vec<_> = graph.access().collect();
    assert_eq!(
        access,
        [("R1", "R41"), ("R41", "R162"), ("R41", "R241")].map(|(a, b)| (id(a), id(b)))
    );
    assert_eq!(graph.object(id("O114")).unwrap().room, id("R41"));
}

#[test]
fn what_cannot_be_is_refused_with_its_place() {
    let check = |text: &str, words: &str| {
        let error = import(text, &Options::default()).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    };
    check("{}", "\"nodes\" is missing");
    check(r#"{"nodes": [{"id": -1}]}"#, "nodes[0].id");
    check(r#"{"nodes": [{"id": 99999999, "class_name": "a"}]}"#, "at most 16777215");
    check(r#"{"nodes": [{"id": 1, "class_name": "a"}, {"id": 1, "class_name": "a"}]}"#, "unique");
    check(r#"{"nodes": [{"id": 1, "class_name": ""}]}"#, "nodes[0].class_name");
    check(
        r#"{"nodes": [{"id": 1, "class_name": "a",
                       "bounding_box": {"center": [0,0,0], "size": [1,1,1]}}]}"#,
        "add an INSIDE edge",
    );
    let box_ = r#"{"nodes": [{"id": 1, "class_name": "a",
                              "bounding_box": {"center": [0,0,0], "size": [1,-1,1]}}]}"#;
    check(box_, "nodes[0].bounding_box");
}
