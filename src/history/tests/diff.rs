//! Differences, and the way from one graph to another.

use insta::assert_snapshot;
use proptest::prelude::*;

use super::arbitrary;
use super::fixture::{graph, house, id, start};
use crate::change::{Cause, Departure, Primitive, Sighting, Step, Transaction, World};
use crate::geometry::Tolerance;
use crate::graph::SceneGraph;
use crate::history::{Diff, DiffDocument, primitives_between};

fn text(from: &SceneGraph, to: &SceneGraph) -> String {
    Diff::between(from, to, &Tolerance::EXACT).to_string()
}

/// A later state of the house.
fn later() -> SceneGraph {
    graph(
        "R1 kitchen
         R2 guest_room
         R3 pantry
         O1 table R1 - 1 0 0.5
         O2 bowl R1 O1 1.3 0 1.05
         O3 cup R1 O2 1 0 1.1
         O4 mug R1 O1 1.2 0 1.05
         O6 bed R2 - 5 1 0.5
         O7 cupboard R1 - 3 0 1
         O8 tv_remote R2 O6 5 1 1.05 held
         O9 spoon R3 - 8 0 0",
    )
}

#[test]
fn a_diff_reads_in_order_of_id() {
    assert_snapshot!(text(&house(), &later()), @r"
    ~ bowl O2  kitchen, on table O1  (0.30 m)
    ~ cup O3  label: cereal  →  cup
    ~ mug O4  kitchen, in cupboard O7  →  kitchen, on table O1 (1.81 m)
    - mug O5  bedroom
    ~ tv remote O8  bedroom, on bed O6  →  in the gripper
    + spoon O9  pantry
    ~ guest room R2  label: bedroom  →  guest room
    + pantry R3  room
    ");
}

#[test]
fn a_diff_has_a_document() {
    let from = graph("R1 kitchen\n O1 table R1 - 1 0 0.5\n O4 mug R1 O1 1 0 1.05");
    let to = graph("R2 hall\n R1 kitchen\n O1 bed R1 - 1 0 0.5\n O4 mug R1 - 2 0 0");
    let diff = Diff::between(&from, &to, &Tolerance::EXACT);
    let json = serde_json::to_string_pretty(&DiffDocument::of(&diff)).unwrap();
    assert_snapshot!(json, @r#"
    {
      "added": [
        {
          "id": "R2",
          "label": "hall",
          "place": null
        }
      ],
      "removed": [],
      "moved": [
        {
          "id": "O4",
          "label": "mug",
          "fields": [
            "support",
            "pose"
          ],
          "distance": 1.45,
          "angle": 0.0,
          "from": {
            "room": {
              "id": "R1",
              "label": "kitchen"
            },
            "support": {
              "id": "O1",
              "label": "table"
            },
            "pose": {
              "position": [
                1.0,
                0.0,
                1.05
              ],
              "orientation": {
                "w": 1.0,
                "x": 0.0,
                "y": 0.0,
                "z": 0.0
              }
            },
            "pose_source": "measured"
          },
          "to": {
            "room": {
              "id": "R1",
              "label": "kitchen"
            },
            "support": null,
            "pose": {
              "position": [
                2.0,
                0.0,
                0.0
              ],
              "orientation": {
                "w": 1.0,
                "x": 0.0,
                "y": 0.0,
                "z": 0.0
              }
            },
            "pose_source": "measured"
          }
        }
      ],
      "changed": [
        {
          "id": "O1",
          "label": "bed",
          "field": "label",
          "from": "table",
          "to": "bed"
        }
      ]
    }
    "#);
}

#[test]
fn what_is_within_the_tolerance_is_no_difference() {
    let from = graph("R1 kitchen\n O4 mug R1 - 1 0 0");
    let to = graph("R1 kitchen\n O4 mug R1 - 1.01 0 0");
    let loose = Tolerance { distance_m: 0.02, angle_rad: 0.0 };
    assert!(Diff::between(&from, &to, &loose).is_empty());
    assert!(!Diff::between(&from, &to, &Tolerance::EXACT).is_empty());
}

#[test]
fn when_it_was_last_seen_is_told_only_if_asked_for() {
    let from = house();
    let mut world = World::from_graph(from.clone());
    let seen = vec![Sighting { id: id("O4"), pose: None, size: None }];
    Primitive::Observe { at: start().plus_nanos(1_000_000_000), seen }.apply(&mut world).unwrap();
    assert!(Diff::between(&from, world.graph(), &Tolerance::EXACT).is_empty());
    assert_snapshot!(Diff::complete(&from, world.graph(), &Tolerance::EXACT), @"~ mug O4  last_observed: 2026-01-05T00:00:00Z  →  2026-01-05T00:00:01Z");
}

#[track_caller]
fn check_way(from: &SceneGraph, to: &SceneGraph) -> String {
    let mut world = World::from_graph(from.clone());
    let primitives = primitives_between(&world, to, start());
    let mut words = Vec::new();
    for primitive in &primitives {
        primitive.apply(&mut world).unwrap();
        let nodes: Vec<String> = primitive.nodes().iter().map(ToString::to_string).collect();
        words.push(format!("{} {}", primitive.name(), nodes.join(" ")));
    }
    assert_eq!(world.graph().hash(), to.hash());
    words.join(", ")
}

#[test]
fn the_way_is_short_where_little_differs() {
    let from = house();
    let to = graph(
        "R1 kitchen
         R2 bedroom
         R3 pantry
         O1 table R1 - 1 0 0.5
         O2 bowl R1 O1 1.3 0 1.05
         O3 cereal R1 O2 1 0 1.1
         O4 mug R1 O1 1.2 0 1.05
         O5 mug R2 - 5 0 0.05 held
         O6 bed R2 - 5 1 0.5
         O7 cupboard R1 - 3 0 1
         O9 tv_remote R3 O6 5 1 1.05",
    );
    assert_snapshot!(check_way(&from, &to), @"add R3, remove O8, observe O2, move O4, add O9, remove O5");
}

#[test]
fn two_things_change_places() {
    let from = graph("R1 kitchen\n O2 box R1 - 0 0 0\n O1 lid R1 O2 0 0 0.1");
    let to = graph("R1 kitchen\n O1 lid R1 - 0 0 0\n O2 box R1 O1 0 0 0.1");
    assert_snapshot!(check_way(&from, &to), @"move O1, move O2");
}

#[test]
fn what_lies_in_a_held_thing_is_renamed() {
    let from = graph("R1 hall\n O1 bowl R1 - 0 0 0 held\n O2 cereal R1 O1 0 0 0.1 held");
    let to = graph("R1 hall\n O1 bowl R1 - 0 0 0 held\n O2 muesli R1 O1 0 0 0.1 held");
    assert_snapshot!(check_way(&from, &to), @"add O1, add O2, move O2, remove O2, remove O1");
}

#[test]
fn something_is_put_on_a_thing_that_gets_another_name() {
    let from = graph("R1 hall\n O1 lid R1 O2 0 0 0\n O2 box R1 - 0 0 0");
    let to = graph("R1 hall\n O0 mug R1 O2 0 0 0\n O1 lid R1 O2 0 0 0\n O2 crate R1 - 0 0 0");
    assert_snapshot!(check_way(&from, &to), @"add O0, move O0, move O1, remove O2, add O2, move O0, move O1");
}

#[test]
fn a_room_goes_with_its_access_and_comes_back_with_it() {
    let mut from = graph("R1 kitchen\n R2 hall\n O1 mug R1 - 0 0 0");
    from.connect(id("R1"), id("R2")).unwrap();
    let mut world = World::from_graph(from.clone());
    let remove = |node| {
        let primitive = Primitive::Remove { id: id(node), to: Departure::Gone, at: start() };
        Step { cause: Cause::Change(1), primitive }
    };
    // The mug is still in the kitchen, so all of it is refused.
    let both = Transaction { at: start(), steps: vec![remove("R2"), remove("R1")] };
    assert!(both.apply(&mut world).is_err());
    assert_eq!(world.graph(), &from);
    let hall = Transaction { at: start(), steps: vec![remove("R2")] };
    hall.apply(&mut world).unwrap();
    assert_eq!(world.graph().access().count(), 0);
}

proptest! {
    #[test]
    fn primitives_lead_to_the_target(from in arbitrary::graph(), to in arbitrary::graph()) {
        let mut world = World::from_graph(from);
        for primitive in primitives_between(&world, &to, start()) {
            prop_assert!(primitive.apply(&mut world).is_ok(), "{primitive:?}");
        }
        prop_assert_eq!(world.graph().hash(), to.hash());
    }

    #[test]
    fn within_one_house_only_what_differs_is_touched(
        (from, to) in arbitrary::two_in_one_house()
    ) {
        let mut world = World::from_graph(from.clone());
        let primitives = primitives_between(&world, &to, start());
        for primitive in &primitives {
            prop_assert!(primitive.apply(&mut world).is_ok(), "{primitive:?}");
            let regions = primitive.nodes().iter().any(|id| from.region(*id).is_some());
            prop_assert!(!regions, "{primitive:?}");
        }
        prop_assert_eq!(world.graph().hash(), to.hash());
    }

    #[test]
    fn a_complete_diff_is_empty_exactly_between_equals(
        (from, to) in arbitrary::two_in_one_house()
    ) {
        prop_assert!(Diff::complete(&from, &from, &Tolerance::EXACT).is_empty());
        prop_assert!(primitives_between(&World::from_graph(from.clone()), &from, start()).is_empty());
        let diff = Diff::complete(&from, &to, &Tolerance::EXACT);
        prop_assert_eq!(diff.is_empty(), from == to);
    }

    #[test]
    fn a_diff_turned_round_has_the_same_nodes(from in arbitrary::graph(), to in arbitrary::graph()) {
        let there = Diff::between(&from, &to, &Tolerance::EXACT);
        let back = Diff::between(&to, &from, &Tolerance::EXACT);
        prop_assert_eq!(there.added, back.removed);
        prop_assert_eq!(there.moved.len(), back.moved.len());
        prop_assert_eq!(there.changed.len(), back.changed.len());
    }
}
