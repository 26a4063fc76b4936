//! Plans of houses and graphs.

use super::*;
use crate::graph::{NodeId, SceneGraph};
use crate::simulation::house::BUILT_IN;
use crate::time::Stamp;
use crate::view::raster;

fn apartment() -> House {
    BUILT_IN[0].house().unwrap()
}

fn graph() -> SceneGraph {
    apartment().graph(Stamp::from_nanos(0))
}

fn object(graph: &SceneGraph, label: &str) -> NodeId {
    graph.objects().find(|(_, object)| object.label.as_str() == label).unwrap().0
}

#[test]
fn every_built_in_house_is_drawn_with_all_its_rooms() {
    for it in BUILT_IN {
        let house = it.house().unwrap();
        let plan = Plan::of_house(&house);
        let svg = plan.svg();
        assert_eq!(svg, Plan::of_house(&house).svg());
        for room in &house.rooms {
            assert!(svg.contains(&room.label.as_str().to_uppercase()), "{}", room.label);
        }
        let label = |thing: &&Thing| !svg.contains(&format!(">{}", thing.label));
        let unlabelled: Vec<&str> =
            house.things.iter().filter(label).map(|thing| thing.label.as_str()).collect();
        assert!(unlabelled.len() <= 2, "{}: {unlabelled:?}", it.name);
    }
}

#[test]
fn a_graph_is_drawn_as_the_house_it_came_from() {
    let (house, graph) = (Plan::of_house(&apartment()), Plan::of_graph(&graph(), "apartment"));
    assert_eq!(graph.rooms.len(), house.rooms.len());
    assert_eq!(graph.doors.len(), house.doors.len());
    assert_eq!(graph.things.len(), house.things.len());
}

#[test]
fn what_changed_is_drawn_in_its_colour() {
    let before = graph();
    let mut after = before.clone();
    after.remove_object(object(&before, "towel")).unwrap();
    let mug = object(&before, "mug");
    let moved = before.object(mug).unwrap();
    let there = before.object(object(&before, "nightstand")).unwrap();
    let mut placement = crate::graph::Placement::of(moved);
    (placement.pose, placement.room, placement.support) = (there.pose, there.room, None);
    after.place_object(mug, &placement).unwrap();
    let added: NodeId = "O900".parse().unwrap();
    after.insert_object(added, crate::graph::Object { support: None, ..moved.clone() }).unwrap();
    let plan = Plan::of_graph(&after, "now").with_changes(&before, &after);
    let changes: Vec<&str> = plan
        .things
        .iter()
        .filter_map(|thing| thing.change.as_ref())
        .map(|change| match change {
            PlanChange::Added => "added",
            PlanChange::Removed => "removed",
            PlanChange::Moved { .. } => "moved",
        })
        .collect();
    assert_eq!(changes, ["moved", "added", "removed"]);
    let svg = plan.svg();
    for word in [">added<", ">removed<", ">moved<", ">towel<", ">mug<"] {
        assert!(svg.contains(word), "{word}");
    }
    let same = Plan::of_graph(&before, "now").with_changes(&before, &before);
    assert!(same.things.iter().all(|thing| thing.change.is_none()));
}

#[test]
fn probabilities_and_the_way_of_the_robot_are_shown() {
    let graph = graph();
    let day = Stamp::from_nanos(86_400_000_000_000);
    let plan = Plan::of_graph(&graph, "a day later").with_probabilities(&graph, day);
    let mug = plan.things.iter().find(|thing| thing.label == "mug").unwrap();
    assert!(mug.probability.is_some_and(|p| p < 0.2));
    let sofa = plan.things.iter().find(|thing| thing.label == "sofa").unwrap();
    assert_eq!(sofa.probability, None);
    let svg = plan.with_path(vec![[1.0, 1.0], [2.0, 1.0]]).svg();
    assert!(svg.contains("still there") && svg.contains("way of the robot"));
}

#[test]
fn nothing_at_all_is_drawn_too() {
    for plan in [Plan::default(), Plan::of_graph(&SceneGraph::new(), "nothing")] {
        assert!(raster::png(&plan.svg(), 200).is_ok());
    }
}

#[test]
fn a_small_plan_is_as_it_was() {
    let text = r#"{"name": "small", "rooms": [{"label": "den", "box": [0, 0, 3, 2]},
        {"label": "hall", "box": [3, 0, 5, 2]}], "doors": [{"between": ["den", "hall"], "at": [3, 1]}],
        "objects": [{"label": "table", "position": [1, 1]},
                    {"label": "mug", "position": [1, 1], "support": "table"}]}"#;
    let file = crate::simulation::house::read(text).unwrap();
    let house = crate::simulation::house::build(&file, None).unwrap();
    insta::assert_snapshot!(Plan::of_house(&house).svg());
}
