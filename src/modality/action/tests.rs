//! Given a graph and statuses, then these records and this graph.

use insta::assert_snapshot;

use crate::change::{ChangeRecord, NodeRef, Outcome};
use crate::event::{Event, Status, Task, TaskStatus};
use crate::geometry::{Pose, Size};
use crate::graph::{Label, NodeId, Object, PoseSource, Region, SceneGraph};
use crate::time::Stamp;
use crate::updater::{Config, Updater};

fn id(text: &str) -> NodeId {
    text.parse().unwrap()
}

fn label(text: &str) -> NodeRef {
    NodeRef::label(Label::new(text).unwrap())
}

fn object(name: &str, room: &str, support: Option<&str>, at: [f64; 3]) -> Object {
    Object {
        label: Label::new(name).unwrap(),
        pose: Pose::at(at).unwrap(),
        size: Size::new(0.1, 0.1, 0.1).unwrap(),
        decay_rate: 0.0,
        last_observed: Stamp::EPOCH,
        pose_source: PoseSource::Measured,
        room: id(room),
        support: support.map(id),
    }
}

/// A kitchen with a mug and a bowl of cereal on a table, and a bedroom with another mug.
fn house() -> SceneGraph {
    let mut graph = SceneGraph::new();
    for (room, name, x) in [("R1", "kitchen", 0.0), ("R2", "bedroom", 5.0)] {
        let extent = (Pose::at([x, 0.0, 1.0]).unwrap(), Size::new(4.0, 4.0, 2.0).unwrap());
        let label = Label::new(name).unwrap();
        graph.insert_region(id(room), Region { label, extent: Some(extent), parent: None }).unwrap();
    }
    for (node, name, room, support, at) in [
        ("O1", "table", "R1", None, [1.0, 0.0, 0.5]),
        ("O2", "bowl", "R1", Some("O1"), [1.0, 0.0, 0.6]),
        ("O3", "cereal", "R1", Some("O2"), [1.0, 0.0, 0.7]),
        ("O4", "mug", "R1", Some("O1"), [1.2, 0.0, 0.6]),
        ("O5", "mug", "R2", None, [5.0, 0.0, 0.05]),
        ("O6", "bed", "R2", None, [5.0, 1.0, 0.3]),
    ] {
        graph.insert_object(id(node), object(name, room, support, at)).unwrap();
    }
    graph
}

/// What the statuses give: a line per change record, then where everything is.
fn story(inputs: Vec<Event>) -> String {
    let mut updater = Updater::new(Config::default());
    updater.update(Stamp::EPOCH, Event::InitialGraph(house())).unwrap();
    let mut lines = Vec::new();
    for (second, input) in (1..).zip(inputs) {
        let at = Stamp::from_nanos(second * 1_000_000_000);
        for logged in updater.update(at, input).unwrap() {
            if let Event::Change(record) = logged.event {
                lines.push(line(&record));
            }
        }
    }
    lines.push("--".to_owned());
    let graph = updater.graph();
    for (node, object) in graph.all_objects() {
        let held = if object.is_held() { " held" } else { "" };
        let on = object.support.map_or(String::new(), |on| format!(" on {on}"));
        let [x, y, z] = object.pose.position();
        let source = object.pose_source.as_str();
        lines.push(format!(
            "{node} {} {}{on} ({x}, {y}, {z}) {source}{held}",
            object.label, object.room
        ));
    }
    lines.join("\n")
}

fn line(record: &ChangeRecord) -> String {
    let claim = &record.claim;
    let outcome = match &record.outcome {
        Outcome::Applied => "applied".to_owned(),
        Outcome::Rejected { code, reason } => format!("rejected [{code}] {reason}"),
    };
    let room = |room: &Option<NodeRef>| room.as_ref().map_or("-".to_owned(), NodeRef::to_string);
    format!(
        "c{} {} {}: {} -> {} on {}: {outcome}",
        record.seq,
        claim.action.as_str(),
        claim.object,
        room(&claim.source_room),
        room(&claim.target_room),
        room(&claim.support)
    )
}

fn task(object: &str, to: &str) -> Event {
    Event::Task(Task {
        task_id: "t".into(),
        instruction: format!("Take the {object} to the {to}."),
        object: Some(label(object)),
        source_room: Some(label("kitchen")),
        target_room: Some(label(to)),
        support: None,
    })
}

fn status(status: Status) -> Event {
    Event::TaskStatus(TaskStatus::bare("t", status))
}

fn naming(status: Status, object: NodeRef, support: Option<NodeRef>) -> Event {
    let report = TaskStatus::bare("t", status);
    Event::TaskStatus(TaskStatus { object: Some(object), support, ..report })
}

#[test]
fn what_is_picked_and_placed_keeps_its_id_and_changes_room() {
    assert_snapshot!(story(vec![
        task("mug", "bedroom"),
        status(Status::Started),
        status(Status::Picked),
        status(Status::Placed),
        status(Status::Done),
    ]), @"");
}

#[test]
fn what_is_in_a_bowl_goes_with_it() {
    assert_snapshot!(story(vec![
        naming(Status::Picked, NodeRef::id(id("O2")), None),
        naming(Status::Placed, NodeRef::id(id("O2")), Some(NodeRef::id(id("O6")))),
    ]), @"");
}

#[test]
fn picking_an_unknown_thing_is_rejected_and_placing_it_adds_it() {
    assert_snapshot!(story(vec![
        naming(Status::Picked, label("banana"), None),
        naming(Status::Placed, label("banana"), Some(label("bed"))),
    ]), @"");
}

#[test]
fn picking_one_of_several_is_rejected_and_so_is_placing_it() {
    assert_snapshot!(story(vec![
        naming(Status::Picked, label("mug"), None),
        naming(Status::Placed, label("mug"), Some(label("bed"))),
    ]), @"");
}

#[test]
fn placing_what_was_never_picked_is_one_move() {
    assert_snapshot!(story(vec![
        naming(Status::Placed, label("bowl"), Some(label("bed"))),
    ]), @"");
}

#[test]
fn failing_after_the_pick_leaves_it_in_the_gripper() {
    assert_snapshot!(story(vec![
        task("mug", "bedroom"),
        status(Status::Picked),
        status(Status::Failed),
    ]), @"");
}

#[test]
fn failing_with_a_pose_puts_it_where_it_fell() {
    let fell = TaskStatus {
        pose: Some(Pose::at([3.5, 0.0, 0.05]).unwrap()),
        ..TaskStatus::bare("t", Status::Failed)
    };
    assert_snapshot!(story(vec![
        task("mug", "bedroom"),
        status(Status::Picked),
        Event::TaskStatus(fell),
    ]), @"");
}

#[test]
fn failing_before_the_pick_changes_nothing() {
    assert_snapshot!(story(vec![
        task("mug", "bedroom"),
        status(Status::Started),
        status(Status::Failed),
    ]), @"");
}

#[test]
fn done_without_placing_leaves_it_in_the_gripper() {
    assert_snapshot!(story(vec![
        task("mug", "bedroom"),
        status(Status::Picked),
        status(Status::Done),
    ]), @"");
}

#[test]
fn a_status_of_no_known_task_that_names_nothing_is_rejected() {
    assert_snapshot!(story(vec![status(Status::Picked), status(Status::Placed)]), @"");
}

#[test]
fn picking_twice_is_rejected_and_placing_still_works() {
    assert_snapshot!(story(vec![
        naming(Status::Picked, NodeRef::id(id("O4")), None),
        naming(Status::Picked, NodeRef::id(id("O4")), None),
        naming(Status::Placed, NodeRef::id(id("O4")), Some(label("bed"))),
    ]), @"");
}

#[test]
fn the_reported_pose_tells_two_mugs_apart() {
    let picked = TaskStatus {
        object: Some(label("mug")),
        pose: Some(Pose::at([4.9, 0.0, 0.1]).unwrap()),
        ..TaskStatus::bare("t", Status::Picked)
    };
    assert_snapshot!(story(vec![Event::TaskStatus(picked)]), @"");
}

#[test]
fn an_unknown_support_costs_only_the_support() {
    let placed = TaskStatus {
        object: Some(NodeRef::id(id("O4"))),
        room: Some(label("bedroom")),
        support: Some(label("wardrobe")),
        ..TaskStatus::bare("t", Status::Placed)
    };
    assert_snapshot!(story(vec![Event::TaskStatus(placed)]), @"");
}

#[test]
fn placing_nowhere_is_rejected() {
    assert_snapshot!(story(vec![naming(Status::Placed, NodeRef::id(id("O4")), None)]), @"");
}

#[test]
fn a_thing_cannot_be_placed_on_itself_or_on_what_it_carries() {
    let bowl = || NodeRef::id(id("O2"));
    assert_snapshot!(story(vec![
        naming(Status::Placed, bowl(), Some(NodeRef::id(id("O3")))),
        naming(Status::Placed, bowl(), Some(bowl())),
    ]), @"");
}
