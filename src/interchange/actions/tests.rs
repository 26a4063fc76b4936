//! Tests of the import of actions.

// Lengths lie on a grid: equality is exact.
#![allow(clippy::float_cmp)]

use std::collections::BTreeMap;

use super::*;
use crate::change::{
    Action, Cause, Claim, Modality, Occurred, PlanConfig, Step, Transaction, World, plan,
};
use crate::event::{Event, Status, TaskStatus};
use crate::geometry::Size;
use crate::graph::{NodeId, PoseSource};
use crate::interchange::testing::{id, shared};
use crate::interchange::virtualhome;
use crate::time::Stamp;

const HEADER: &str = "split,day,minute,action,object,object_id,destination,destination_id\n";

fn start() -> Stamp {
    "2026-01-05T00:00:00Z".parse().unwrap()
}

fn log(rows: &str) -> String {
    HEADER.to_owned() + &rows.replace(' ', "")
}

fn options() -> Options<'static> {
    Options { start: start(), name: "h", ..Options::default() }
}

fn statuses(import: &Import) -> Vec<(String, TaskStatus)> {
    let status = |(at, event): &(Stamp, Event)| match event {
        Event::TaskStatus(status) => (at.to_string(), status.clone()),
        other => panic!("{other:?}"),
    };
    import.inputs.iter().map(status).collect()
}

/// What the updater does with a status, by the planner alone.
fn apply(world: &mut World, status: &TaskStatus, at: Stamp) {
    let picked = status.status == Status::Picked;
    let claim = Claim {
        modality: Modality::Action,
        detector: "test".into(),
        action: if picked { Action::Removed } else { Action::Moved },
        object: status.object.clone().unwrap(),
        source_room: None,
        target_room: status.room.clone(),
        support: status.support.clone(),
        pose: None,
        size: None,
        confidence: 1.0,
        occurred: Occurred::at(at),
        held: picked,
        evidence: vec![],
    };
    let config = PlanConfig { decay_rate: 0.0, size: Size::new(0.1, 0.1, 0.1).unwrap() };
    if let Ok(plan) = plan(world, &claim, at, &config) {
        let step = |primitive| Step { cause: Cause::Change(0), primitive };
        let steps = plan.primitives.into_iter().map(step).collect();
        let _ = Transaction { at, steps }.apply(world);
    }
}

type Arrangement = BTreeMap<NodeId, (NodeId, Option<NodeId>, bool)>;

fn arrangement(world: &World) -> Arrangement {
    let place = |(id, o): (NodeId, &crate::graph::Object)| (id, (o.room, o.support, o.is_held()));
    world.graph().all_objects().map(place).collect()
}

/// Plays the events; every day must begin with the initial arrangement. Returns the days.
#[track_caller]
fn check_every_day_begins_as_the_first(import: &Import) -> usize {
    let mut world = World::from_graph(import.graph.clone());
    let initial = arrangement(&world);
    let (mut day, mut days) = (String::new(), 0);
    let mut last = import.start;
    for (at, event) in &import.inputs {
        assert!(*at >= last);
        last = *at;
        let Event::TaskStatus(status) = event else { panic!("{event:?}") };
        let part = status.task_id.split('/').nth(1).unwrap();
        if !part.starts_with("reset") && part != day {
            assert_eq!(arrangement(&world), initial, "{part}");
            day = part.to_owned();
            days += 1;
        }
        apply(&mut world, status, *at);
    }
    days
}

#[test]
fn rows_become_statuses_in_the_order_of_the_file() {
    let rows = "train,0,371.0,grab,mug,7,,\n\
                train,0,371.5,putback,mug,7,table,3\n\
                train,0,424.85714285714306,grab,mug,7,,\n\
                test,0,10,putobjback,mug,7,,\n";
    let import = import(&log(rows), &options()).unwrap();
    let all = statuses(&import);
    let times: Vec<&str> = all.iter().map(|(at, _)| at.as_str()).collect();
    assert_eq!(
        times,
        [
            "2026-01-05T06:11:00Z",
            "2026-01-05T06:11:30Z",
            "2026-01-05T07:04:51.429Z",
            "2026-01-06T00:00:00Z",
            "2026-01-06T00:10:00Z"
        ]
    );
    let tasks: Vec<&str> = all.iter().map(|(_, status)| status.task_id.as_str()).collect();
    assert_eq!(tasks, ["h/train0/7", "h/train0/7", "h/train0/7", "h/reset1/7", "h/test0/7"]);
    let placed = &all[1].1;
    assert_eq!((placed.status, placed.pose), (Status::Placed, None));
    assert_eq!(placed.object.as_ref().unwrap().to_string(), "mug O7");
    assert_eq!(placed.support.as_ref().unwrap().to_string(), "table O3");
    assert_eq!(placed.room.as_ref().unwrap().label.as_ref().unwrap().as_str(), "unknown");
    // Nobody grabbed it that day: it goes where it is.
    assert_eq!(all[4].1.support, Some(all[1].1.support.clone().unwrap()));
    assert_eq!(check_every_day_begins_as_the_first(&import), 2);
}

#[test]
fn what_lies_in_a_bowl_is_back_at_midnight() {
    let rows = "train,0,1,grab,cereal,12,,\n\
                train,0,2,putin,cereal,12,bowl,11\n\
                train,0,3,grab,bowl,11,,\n\
                train,0,4,putback,bowl,11,table,2\n\
                train,0,5,grab,spoon,10,,\n\
                train,0,6,putin,spoon,10,bowl,11\n\
                train,0,7,grab,bowl,11,,\n\
                train,0,8,grab,spoon,10,,\n\
                train,1,1500,grab,bowl,11,,\n\
                train,1,1501,putback,bowl,11,table,2\n\
                train,2,1,grab,spoon,10,,\n\
                train,2,90,grab,cup,13,,\n\
                train,3,1,grab,spoon,10,,\n";
    let initial = "object,object_id,place\nspoon,10,drawer\nbowl,11,shelf\ncereal,12,shelf\n";
    let options = Options { initial_csv: Some(initial), ..options() };
    let import = import(&log(rows), &options).unwrap();
    assert_eq!(check_every_day_begins_as_the_first(&import), 4);
    let counts = &import.report.counts;
    assert_eq!(counts["grabs of what is in the gripper already"], 1);
    assert_eq!(counts["midnights delayed by the day before"], 1);
    assert_eq!(counts["rows set to the end of the day before"], 1);
}

#[test]
fn places_come_from_graph_list_and_name_in_this_order() {
    let base = r#"{"rooms": [{"id": "R41", "label": "kitchen"}],
        "objects": [{"id": "O1", "label": "kitchentable", "size": [1, 1, 1],
                     "pose": {"position": [1, 1, 0.5]}},
                    {"id": "O2", "label": "knife_block"}]}"#;
    let graph = crate::interchange::scene::import(base).unwrap().graph;
    let rows = "train,0,1,grab,cup,10,,\ntrain,0,2,putback,cup,10,table,1\n\
                train,0,3,grab,cup,10,,\ntrain,0,4,putback,cup,10,dining_room,41\n\
                train,0,5,grab,cup,10,,\ntrain,0,6,putin,cup,10,fridge,6\n\
                train,0,7,grab,cup,10,,\ntrain,0,8,putin,cup,10,cd_player,31\n\
                train,0,9,grab,knife,11,,\ntrain,0,10,putin,knife,11,,\n";
    let places = "id,class,room\n6,fridge,Kitchen\n999,outside,\n";
    let initial = "object,object_id,place\ncup,10,outside\nknife,11,knifeblock\nfork,12,mat\n";
    let options = Options {
        graph: Some(graph),
        places_csv: Some(places),
        initial_csv: Some(initial),
        ..options()
    };
    let import = import(&log(rows), &options).unwrap();
    let graph = &import.graph;
    let on = |o: &str| graph.object(id(o)).unwrap().support;
    let room = |o: &str| graph.label(graph.object(id(o)).unwrap().room).unwrap().as_str();
    assert_eq!((on("O10"), room("O10")), (None, "outside"));
    assert_eq!((on("O11"), room("O11")), (Some(id("O2")), "kitchen"));
    assert_eq!((room("O6"), room("O31"), room("O12")), ("kitchen", "unknown", "unknown"));
    assert_eq!(graph.label(on("O12").unwrap()).unwrap().as_str(), "mat");
    let events = statuses(&import);
    assert_eq!(events[1].1.support.as_ref().unwrap().id, Some(id("O1")));
    assert_eq!(
        (&events[3].1.support, events[3].1.room.as_ref().unwrap().id),
        (&None, Some(id("R41")))
    );
    // The knife was put back without a word where: where it was grabbed.
    assert_eq!(events[9].1.support.as_ref().unwrap().id, Some(id("O2")));
    let notes = import.report.notes.join("\n");
    assert!(notes.contains("table 1 is kitchentable O1"), "{notes}");
}

#[test]
fn a_class_of_several_places_means_the_one_the_thing_is_put_to() {
    let rows = "train,0,1,grab,cup,10,,\ntrain,0,2,putback,cup,10,shelf,2\n\
                train,0,3,grab,pen,11,,\ntrain,0,4,putback,pen,11,shelf,1\n\
                train,0,5,grab,pen,11,,\ntrain,0,6,putback,pen,11,shelf,1\n";
    let initial = "object,object_id,place\ncup,10,shelf\npen,11,shelf\nrag,12,shelf\n";
    let import = import(&log(rows), &Options { initial_csv: Some(initial), ..options() }).unwrap();
    let on = |o: &str| import.graph.object(id(o)).unwrap().support;
    assert_eq!([on("O10"), on("O11"), on("O12")], [Some(id("O2")), Some(id("O1")), Some(id("O1"))]);
    assert!(import.graph.all_objects().all(|(_, o)| o.pose_source == PoseSource::Topological));
}

#[test]
fn what_cannot_be_is_refused_with_its_line() {
    let check = |text: &str, words: &str| {
        let error = import(text, &options()).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    };
    check("", "the header is \"\"");
    check("day,split\n", "it must be \"split,day,minute");
    check(&log("train,0,1,grab,mug\n"), "actions line 2: it has 5 columns, the header 8");
    check(&log("train,0,1,grab,mug,x,,\n"), "actions line 2: object_id is \"x\"");
    check(&log("\ntrain,0,1,grab,mug,7,,\ndev,0,1,grab,mug,7,,\n"), "line 4: split is \"dev\"");
    check(&log("train,0,1,throw,mug,7,,\n"), "one of grab, putback");
    check(&log("train,0,NaN,grab,mug,7,,\n"), "minute is \"NaN\"");
    check(&log("train,-1,1,grab,mug,7,,\n"), "day is \"-1\"");
    check(&log("train,0,1,putin,mug,7,table,\n"), "destination_id is \"\"");
    check(&log("train,0,1,putin,mug,7,,3\n"), "destination: ");
    check(&log("train,0,2,grab,mug,7,,\ntrain,0,1,grab,mug,7,,\n"), "line 3: the minute");
    check(&log("train,1,2,grab,mug,7,,\ntrain,0,3,grab,mug,7,,\n"), "line 3: the day");
    check(&log("test,0,2,grab,mug,7,,\ntrain,0,3,grab,mug,7,,\n"), "line 3: the day");
    let bad_places = Options { places_csv: Some("id,class,room\nx,a,b\n"), ..options() };
    let error = import(HEADER, &bad_places).unwrap_err().to_string();
    assert!(error.contains("places line 2: id"), "{error}");
}

#[test]
fn cycles_among_first_places_end() {
    let rows = "train,0,1,grab,a,1,,\ntrain,0,2,putin,a,1,b,2\n\
                train,0,3,grab,b,2,,\ntrain,0,4,putin,b,2,a,1\n\
                train,0,5,grab,c,3,,\ntrain,0,6,putin,c,3,c,3\n";
    let import = import(&log(rows), &options()).unwrap();
    assert_eq!(import.graph.object_count(), 3);
    assert_eq!(import.graph.object(id("O2")).unwrap().support, None);
    assert_eq!(import.graph.object(id("O1")).unwrap().support, Some(id("O2")));
}

proptest::proptest! {
    #[test]
    fn any_log_is_played_and_every_day_begins_as_the_first(
        acts in proptest::collection::vec((0..3_u32, 0..5_u32, 0..8_u32), 0..40),
    ) {
        let mut rows = String::new();
        for (n, (act, object, place)) in acts.iter().enumerate() {
            let (day, minute) = (n / 8, n % 8);
            let row = match act {
                0 => format!("train,{day},{minute},grab,o{object},{object},,\n"),
                1 => format!("train,{day},{minute},putin,o{object},{object},o{place},{place}\n"),
                _ => format!("train,{day},{minute},putobjback,o{object},{object},,\n"),
            };
            rows += &row;
        }
        let initial = "object,object_id,place\no0,0,shelf\no1,1,shelf\no2,2,shelf\no3,3,table\no4,4,table\n";
        let options = Options { initial_csv: Some(initial), ..options() };
        check_every_day_begins_as_the_first(&import(&log(&rows), &options).unwrap());
    }

    #[test]
    fn any_text_is_read_or_refused(text in "(train,0,|grab|,|\n|mug|7|\"){0,20}") {
        let _ = import(&(HEADER.to_owned() + &text), &options());
    }
}

#[track_caller]
fn check_household(letter: &str, rows: u64) {
    let Some(scene) = shared("virtualhome/scene2.json") else { return };
    let csv = shared(&format!("homer_plus/household_{letter}.csv")).unwrap();
    let initial = shared(&format!("homer_plus/initial_{letter}.csv")).unwrap();
    let places = shared("homer_plus/extra_places.csv").unwrap();
    let base = virtualhome::Options { start: start(), ..virtualhome::Options::default() };
    let graph = virtualhome::import(&scene, &base).unwrap().graph;
    for graph in [Some(graph), None] {
        let options = Options {
            graph,
            places_csv: Some(&places),
            initial_csv: Some(&initial),
            start: start(),
            name: "household",
        };
        let import = import(&csv, &options).unwrap();
        println!("{}\n", import.report);
        assert_eq!(import.report.counts["rows"], rows);
        assert_eq!(check_every_day_begins_as_the_first(&import), 75);
    }
}

#[test]
fn every_day_of_household_a_begins_as_the_first() {
    check_household("a", 14_002);
}

#[test]
fn every_day_of_household_b_begins_as_the_first() {
    check_household("b", 11_775);
}
