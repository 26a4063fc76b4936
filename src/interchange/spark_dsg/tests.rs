//! Tests of Spark-DSG.

// Lengths lie on a grid: equality is exact.
#![allow(clippy::float_cmp)]

use proptest::prelude::*;

use super::*;
use crate::graph::{Label, Layer, NodeId, Object, PoseSource, SceneGraph};
use crate::interchange::testing::{id, scene_graph, shared};
use crate::interchange::{Import, MOVABLE_DECAY_RATE};
use crate::time::Stamp;

/// Written by the `PyPI` package; see `tests/python/make_spark_dsg.py`.
const NEWEST: &str = include_str!("../../../tests/data/spark_dsg_1.1.3.json");

#[test]
fn a_file_of_the_newest_version_is_read() {
    let Import { graph, start, report, .. } = import(NEWEST).unwrap();
    let (table, mug, rug) = (
        graph.object(id("O1")).unwrap(),
        graph.object(id("O2")).unwrap(),
        graph.object(id("O5")).unwrap(),
    );
    assert_eq!(
        [&table.label, &mug.label, &rug.label].map(Label::as_str),
        ["table", "mug", "red rug"]
    );
    assert_eq!([table.room, mug.room, rug.room], [id("R0"), id("R0"), id("R1")]);
    assert_eq!(table.size.metres(), [2.0, 1.0, 0.8]);
    let quarter = std::f64::consts::FRAC_1_SQRT_2;
    assert!((table.pose.orientation()[3] - quarter).abs() < 1e-6);
    assert_eq!(mug.pose.position(), [1.0, 1.0, 0.86]);
    assert_eq!(start, Stamp::from_nanos(1_767_571_200_000_000_001));
    assert_eq!((rug.last_observed, rug.size.metres()), (Stamp::EPOCH, [0.2; 3]));
    let (kitchen, other) = (graph.region(id("R0")).unwrap(), graph.region(id("R1")).unwrap());
    assert_eq!([&kitchen.label, &other.label].map(Label::as_str), ["kitchen", "room 1"]);
    assert_eq!(kitchen.extent.unwrap().1.metres(), [4.0, 4.0, 2.5]);
    // Only one place belongs to it: the box is that point, a millimetre thick.
    assert_eq!(other.extent.unwrap().0.position(), [6.0, 1.0, 1.0]);
    assert_eq!((kitchen.parent, other.parent), (Some(id("B0")), Some(id("B0"))));
    assert_eq!(graph.access().collect::<Vec<_>>(), [(id("R0"), id("R1"))]);
    assert_eq!((report.counts["places skipped"], report.counts["agent poses skipped"]), (3, 1));
}

#[test]
fn hydras_apartment_of_version_1_0_0_is_read() {
    let Some(text) = shared("spark_dsg/apartment_dsg.json") else { return };
    let Import { graph, report, .. } = import(&text).unwrap();
    println!("{report}");
    let ids: Vec<String> = graph.objects().map(|(id, _)| id.to_string()).collect();
    assert_eq!(ids, ["O0", "O11", "O24", "O33", "O56", "O61", "O84"]);
    assert!(graph.objects().all(|(_, object)| object.room == id("R0")));
    assert_eq!(graph.label(id("O0")).unwrap().as_str(), "class_5");
    assert_eq!(graph.region(id("R0")).unwrap().parent, Some(id("B0")));
    assert!(graph.region(id("R0")).unwrap().extent.is_some());
    assert!(graph.region(id("B0")).unwrap().extent.is_some());
    assert_eq!((report.counts["places skipped"], report.counts["agent poses skipped"]), (185, 102));
    let notes = report.notes.join("\n");
    assert!(notes.contains("6 objects have an impossible time"), "{notes}");
    assert_eq!(graph.object(id("O0")).unwrap().last_observed, Stamp::from_nanos(112));
}

/// What remains of a graph when the gripper is left out.
fn without_held(graph: &SceneGraph) -> SceneGraph {
    let mut left = graph.clone();
    let held: Vec<NodeId> = graph.held().map(|(id, _)| id).collect();
    for id in &held {
        let object = left.object(*id).unwrap().clone();
        left.update_object(*id, Object { support: None, ..object }).unwrap();
    }
    for id in held {
        left.remove_object(id).unwrap();
    }
    left
}

proptest! {
    #[test]
    fn our_own_export_reads_back(graph in scene_graph()) {
        let text = export(&graph).to_string();
        let Import { graph: read, .. } = import(&text).unwrap();
        let expected = without_held(&graph);
        let objects = |graph: &SceneGraph| -> Vec<_> {
            graph.objects().map(|(id, object)| (id, object.clone())).collect()
        };
        prop_assert_eq!(objects(&read), objects(&expected));
        for layer in [Layer::Room, Layer::Floor, Layer::Building] {
            for ((id, a), (other, b)) in read.regions(layer).zip(expected.regions(layer)) {
                prop_assert_eq!((id, &a.label, a.parent), (other, &b.label, b.parent));
                // One without a box gets that of its contents.
                prop_assert!(b.extent.is_none() || a.extent == b.extent);
            }
            prop_assert_eq!(read.regions(layer).count(), expected.regions(layer).count());
        }
        prop_assert_eq!(read.access().collect::<Vec<_>>(), expected.access().collect::<Vec<_>>());
    }

    #[test]
    fn a_damaged_file_is_read_or_refused(at in 0..NEWEST.len(), byte in "[ -~]") {
        let mut text = NEWEST.to_owned();
        text.replace_range(at..=at, &byte);
        let _ = import(&text);
    }
}

fn small(nodes: &str, edges: &str) -> String {
    format!(r#"{{"nodes": [{nodes}], "edges": [{edges}]}}"#)
}

const OBJECT: &str = r#"{"id": 5692549928996306945, "layer": 2,
    "attributes": {"type": "ObjectNodeAttributes", "position": [1, 1, 0], "name": "mug",
                   "last_update_time_ns": 18446744073709551615}}"#;

#[test]
fn an_object_in_no_room_is_put_into_one_called_unknown() {
    let Import { graph, report, .. } = import(&small(OBJECT, "")).unwrap();
    let mug = graph.object(id("O1")).unwrap();
    assert_eq!(graph.label(mug.room).unwrap().as_str(), "unknown");
    assert_eq!((mug.last_observed, mug.decay_rate), (Stamp::EPOCH, MOVABLE_DECAY_RATE));
    assert_eq!(mug.pose_source, PoseSource::Measured);
    assert_eq!(report.notes.len(), 3);
}

#[test]
fn an_object_without_a_parent_is_put_into_the_room_whose_box_holds_it() {
    let room = r#"{"id": 5908722711110090752, "layer": 4, "attributes": {"name": "R(0)",
        "position": [0, 0, 0], "bounding_box": {"type": "AABB", "min": [0, 0, -1],
                                                "max": [2, 2, 1]}}}"#;
    let Import { graph, .. } = import(&small(&format!("{OBJECT}, {room}"), "")).unwrap();
    assert_eq!(graph.object(id("O1")).unwrap().room, id("R0"));
    assert_eq!(graph.region(id("R0")).unwrap().extent.unwrap().1.metres(), [2.0; 3]);
}

#[test]
fn ids_that_do_not_fit_are_numbered_anew() {
    let odd = OBJECT.replace("5692549928996306945", "8070450532247928832");
    let Import { graph, report, .. } = import(&small(&odd, "")).unwrap();
    assert!(graph.object(id("O0")).is_some());
    assert!(report.notes.iter().any(|note| note.contains("anew: O0")), "{report}");
}

#[test]
fn what_cannot_be_is_refused_with_its_place() {
    let check = |text: &str, words: &str| {
        let error = import(text).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    };
    check("{}", "\"nodes\" is missing");
    check(&small(r#"{"id": 1.5}"#, ""), "nodes[0].id: 1.5 must be a whole number");
    check(&small(&format!("{OBJECT}, {OBJECT}"), ""), "nodes[1].id");
    check(&small(OBJECT, r#"{"source": -1, "target": 2}"#), "edges[0].source: -1");
    check(&small(&OBJECT.replace("[1, 1, 0]", "[1, 1]"), ""), "nodes[0].attributes.position");
    check(&small(&OBJECT.replace("mug", "\\u0007"), ""), "control characters");
}

#[test]
fn what_is_newer_or_leads_nowhere_is_told() {
    let newer = small(OBJECT, r#"{"source": 1, "target": 2}"#).replacen(
        '{',
        r#"{"SPARK_DSG_header": {"version": {"major": 1, "minor": 2}}, "#,
        1,
    );
    let report = import(&newer).unwrap().report;
    assert_eq!(report.counts["edges of unknown nodes skipped"], 1);
    assert!(report.notes[0].contains("1.2.0 is newer"), "{report}");
}
