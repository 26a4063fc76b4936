//! Tests of our own JSON.

// Lengths lie on a grid: equality is exact.
#![allow(clippy::float_cmp)]

use proptest::prelude::*;

use super::*;
use crate::graph::PoseSource;
use crate::interchange::testing::{id, scene_graph};
use crate::time::Stamp;

proptest! {
    #[test]
    fn a_scene_reads_back_what_was_printed(graph in scene_graph(), at in 0..i64::MAX as u64) {
        let at = Stamp::from_nanos(at);
        let document = SceneDocument::of(&graph, at);
        let text = serde_json::to_string(&document).unwrap();
        let parsed = SceneDocument::parse(&text).unwrap();
        prop_assert_eq!(&parsed, &document);
        let (read, read_at) = parsed.to_graph().unwrap();
        prop_assert_eq!(read.hash(), graph.hash());
        prop_assert_eq!((read, read_at), (graph, at));
        prop_assert!(import(&text).unwrap().report.notes.is_empty());
    }

    #[test]
    fn any_text_is_read_or_refused(text in "[\\[\\]{}\":,a-z0-9 ]{0,40}") {
        let _ = import(&text);
    }
}

const KITCHEN: &str = r#"{"rooms": [{"label": "kitchen", "pose": {"position": [1, 2, 1]},
                                     "size": [4, 4, 2]}],
    "objects": [{"label": "mug", "support": "Dining_Table"},
                {"id": "O0", "label": "dining table", "pose": {"position": [1, 1, 0.5]},
                 "size": [1, 1, 1]},
                {"label": "rug"}]}"#;

#[test]
fn what_is_left_out_by_hand_gets_its_default() {
    let import = import(KITCHEN).unwrap();
    let graph = import.graph;
    let (mug, rug) = (graph.object(id("O1")).unwrap(), graph.object(id("O2")).unwrap());
    assert_eq!(mug.support, Some(id("O0")));
    assert_eq!(mug.pose.position(), [1.0, 1.0, 1.1]);
    assert_eq!(mug.pose_source, PoseSource::Topological);
    assert_eq!(mug.size.metres(), [0.2; 3]);
    assert_eq!(rug.pose.position(), [1.0, 2.0, 1.0]);
    assert_eq!(rug.room, id("R0"));
    assert_eq!(graph.object(id("O0")).unwrap().pose_source, PoseSource::Measured);
    assert_eq!(import.start, Stamp::EPOCH);
}

#[test]
fn a_hash_that_does_not_match_is_noted() {
    let text = KITCHEN.replacen('{', r#"{"hash": "00ff", "#, 1);
    let notes = import(&text).unwrap().report.notes;
    assert!(notes[0].contains("not 00ff"), "{notes:?}");
}

#[track_caller]
fn check_refused(text: &str, place: &str, words: &str) {
    let error = import(text).unwrap_err().to_string();
    assert!(error.starts_with(place) && error.contains(words), "{error}");
}

#[test]
fn what_cannot_be_is_refused_with_its_place() {
    let objects = |objects: &str| format!(r#"{{"rooms":[{{"label":"a"}}],"objects":[{objects}]}}"#);
    check_refused("{", "line 1 column 1", "complete");
    check_refused("[]", "the document", "an object");
    check_refused(r#"{"room": []}"#, "room:", "unknown field; known are at, hash, rooms");
    check_refused(r#"{"at": "soon"}"#, "at:", "RFC 3339");
    check_refused(r#"{"objects": [{"label": "mug"}]}"#, "objects[0].room", "give \"room\"");
    check_refused(&objects("{}"), "objects[0]:", "\"label\" is missing");
    check_refused(&objects(r#"{"label":""}"#), "objects[0].label", "empty");
    check_refused(&objects(r#"{"label":"a","size":[1,0,1]}"#), "objects[0].size[1]", "positive");
    check_refused(&objects(r#"{"label":"a","size":[1,"x",1]}"#), "objects[0].size[1]", "a number");
    check_refused(&objects(r#"{"label":"a","size":[1,1]}"#), "objects[0].size", "three numbers");
    check_refused(&objects(r#"{"label":"a","room":"b"}"#), "objects[0].room", "no room has");
    check_refused(&objects(r#"{"label":"a","id":"R1"}"#), "objects[0].id", "begin with O");
    check_refused(
        &objects(r#"{"label":"a","decay_rate":-1}"#),
        "objects[0].decay_rate",
        "0 or more",
    );
    check_refused(
        &objects(r#"{"label":"a","pose_source":"held"}"#),
        "objects[0].pose_source",
        "held",
    );
    check_refused(&objects(r#"{"label":"a","support":"a"}"#), "objects[0].support", "itself");
    check_refused(
        &objects(r#"{"label":"a","id":"O1"},{"label":"a","id":"O1"}"#),
        "objects[1].id",
        "objects[0]",
    );
    check_refused(
        &objects(r#"{"label":"m"},{"label":"m"},{"label":"x","support":"m"}"#),
        "objects[2].support",
        "O0, O1",
    );
    check_refused(
        r#"{"rooms":[{"label":"a","access_to":["a"]}]}"#,
        "rooms[0].access_to[0]",
        "itself",
    );
    check_refused(r#"{"rooms":[{"label":"a","size":[1,1,1]}]}"#, "rooms[0]", "no pose");
}

#[test]
fn deep_nesting_is_refused() {
    let text = "[".repeat(100_000);
    assert!(import(&text).is_err());
}
