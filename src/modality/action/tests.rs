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
        graph
            .insert_region(id(room), Region { label, extent: Some(extent), parent: None })
            .unwrap();
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
    ]), @"
    c1 removed mug O4: kitchen R1 -> - on table O1: applied
    c2 moved mug O4: kitchen R1 -> bedroom R2 on -: applied
    --
    O1 table R1 (1, 0, 0.5) measured
    O2 bowl R1 on O1 (1, 0, 0.6) measured
    O3 cereal R1 on O2 (1, 0, 0.7) measured
    O4 mug R2 (5, 0, 1) topological
    O5 mug R2 (5, 0, 0.05) measured
    O6 bed R2 (5, 1, 0.3) measured
    ");
}

#[test]
fn what_is_in_a_bowl_goes_with_it() {
    assert_snapshot!(story(vec![
        naming(Status::Picked, NodeRef::id(id("O2")), None),
        naming(Status::Placed, NodeRef::id(id("O2")), Some(NodeRef::id(id("O6")))),
    ]), @"
    c1 removed bowl O2: kitchen R1 -> - on table O1: applied
    c2 moved bowl O2: kitchen R1 -> bedroom R2 on bed O6: applied
    --
    O1 table R1 (1, 0, 0.5) measured
    O2 bowl R2 on O6 (5, 1, 0.4) topological
    O3 cereal R2 on O2 (5, 1, 0.5) topological
    O4 mug R1 on O1 (1.2, 0, 0.6) measured
    O5 mug R2 (5, 0, 0.05) measured
    O6 bed R2 (5, 1, 0.3) measured
    ");
}

#[test]
fn picking_an_unknown_thing_is_rejected_and_placing_it_adds_it() {
    assert_snapshot!(story(vec![
        naming(Status::Picked, label("banana"), None),
        naming(Status::Placed, label("banana"), Some(label("bed"))),
    ]), @"
    c1 removed banana: - -> - on -: rejected [unknown_object] no such object known: banana
    c2 added banana O7: - -> bedroom R2 on bed O6: applied
    --
    O1 table R1 (1, 0, 0.5) measured
    O2 bowl R1 on O1 (1, 0, 0.6) measured
    O3 cereal R1 on O2 (1, 0, 0.7) measured
    O4 mug R1 on O1 (1.2, 0, 0.6) measured
    O5 mug R2 (5, 0, 0.05) measured
    O6 bed R2 (5, 1, 0.3) measured
    O7 banana R2 on O6 (5, 1, 0.45) topological
    ");
}

#[test]
fn picking_one_of_several_is_rejected_and_so_is_placing_it() {
    assert_snapshot!(story(vec![
        naming(Status::Picked, label("mug"), None),
        naming(Status::Placed, label("mug"), Some(label("bed"))),
    ]), @r#"
    c1 removed mug: - -> - on -: rejected [ambiguous] mug is ambiguous: O4, O5
    c2 moved mug: - -> - on bed: rejected [placed_ambiguous] task "t" placed what it picked, but which object that was is ambiguous: O4, O5
    --
    O1 table R1 (1, 0, 0.5) measured
    O2 bowl R1 on O1 (1, 0, 0.6) measured
    O3 cereal R1 on O2 (1, 0, 0.7) measured
    O4 mug R1 on O1 (1.2, 0, 0.6) measured
    O5 mug R2 (5, 0, 0.05) measured
    O6 bed R2 (5, 1, 0.3) measured
    "#);
}

#[test]
fn placing_what_was_never_picked_is_one_move() {
    assert_snapshot!(story(vec![
        naming(Status::Placed, label("bowl"), Some(label("bed"))),
    ]), @"
    c1 moved bowl O2: kitchen R1 -> bedroom R2 on bed O6: applied
    --
    O1 table R1 (1, 0, 0.5) measured
    O2 bowl R2 on O6 (5, 1, 0.4) topological
    O3 cereal R2 on O2 (5, 1, 0.5) topological
    O4 mug R1 on O1 (1.2, 0, 0.6) measured
    O5 mug R2 (5, 0, 0.05) measured
    O6 bed R2 (5, 1, 0.3) measured
    ");
}

#[test]
fn failing_after_the_pick_leaves_it_in_the_gripper() {
    assert_snapshot!(story(vec![
        task("mug", "bedroom"),
        status(Status::Picked),
        status(Status::Failed),
    ]), @r#"
    c1 removed mug O4: kitchen R1 -> - on table O1: applied
    c2 moved mug O4: - -> bedroom on -: rejected [failed_holding] task "t" failed after the pick: mug O4 stays in the gripper
    --
    O1 table R1 (1, 0, 0.5) measured
    O2 bowl R1 on O1 (1, 0, 0.6) measured
    O3 cereal R1 on O2 (1, 0, 0.7) measured
    O4 mug R1 on O1 (1.2, 0, 0.6) held held
    O5 mug R2 (5, 0, 0.05) measured
    O6 bed R2 (5, 1, 0.3) measured
    "#);
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
    ]), @"
    c1 removed mug O4: kitchen R1 -> - on table O1: applied
    c2 moved mug O4: kitchen R1 -> bedroom R2 on -: applied
    --
    O1 table R1 (1, 0, 0.5) measured
    O2 bowl R1 on O1 (1, 0, 0.6) measured
    O3 cereal R1 on O2 (1, 0, 0.7) measured
    O4 mug R2 (3.5, 0, 0.05) measured
    O5 mug R2 (5, 0, 0.05) measured
    O6 bed R2 (5, 1, 0.3) measured
    ");
}

#[test]
fn failing_before_the_pick_changes_nothing() {
    assert_snapshot!(story(vec![
        task("mug", "bedroom"),
        status(Status::Started),
        status(Status::Failed),
    ]), @"
    --
    O1 table R1 (1, 0, 0.5) measured
    O2 bowl R1 on O1 (1, 0, 0.6) measured
    O3 cereal R1 on O2 (1, 0, 0.7) measured
    O4 mug R1 on O1 (1.2, 0, 0.6) measured
    O5 mug R2 (5, 0, 0.05) measured
    O6 bed R2 (5, 1, 0.3) measured
    ");
}

#[test]
fn done_without_placing_leaves_it_in_the_gripper() {
    assert_snapshot!(story(vec![
        task("mug", "bedroom"),
        status(Status::Picked),
        status(Status::Done),
    ]), @r#"
    c1 removed mug O4: kitchen R1 -> - on table O1: applied
    c2 moved mug O4: - -> bedroom on -: rejected [done_holding] task "t" is done but never placed mug O4: it stays in the gripper
    --
    O1 table R1 (1, 0, 0.5) measured
    O2 bowl R1 on O1 (1, 0, 0.6) measured
    O3 cereal R1 on O2 (1, 0, 0.7) measured
    O4 mug R1 on O1 (1.2, 0, 0.6) held held
    O5 mug R2 (5, 0, 0.05) measured
    O6 bed R2 (5, 1, 0.3) measured
    "#);
}

#[test]
fn a_status_of_no_known_task_that_names_nothing_is_rejected() {
    assert_snapshot!(story(vec![status(Status::Picked), status(Status::Placed)]), @r#"
    c1 removed something: - -> - on -: rejected [unknown_task] no task "t" was announced, and the status names no object
    c2 moved something: - -> - on -: rejected [unknown_task] no task "t" was announced, and the status names no object
    --
    O1 table R1 (1, 0, 0.5) measured
    O2 bowl R1 on O1 (1, 0, 0.6) measured
    O3 cereal R1 on O2 (1, 0, 0.7) measured
    O4 mug R1 on O1 (1.2, 0, 0.6) measured
    O5 mug R2 (5, 0, 0.05) measured
    O6 bed R2 (5, 1, 0.3) measured
    "#);
}

#[test]
fn picking_twice_is_rejected_and_placing_still_works() {
    assert_snapshot!(story(vec![
        naming(Status::Picked, NodeRef::id(id("O4")), None),
        naming(Status::Picked, NodeRef::id(id("O4")), None),
        naming(Status::Placed, NodeRef::id(id("O4")), Some(label("bed"))),
    ]), @"
    c1 removed mug O4: kitchen R1 -> - on table O1: applied
    c2 removed mug O4: - -> - on -: rejected [already_held] mug O4 is already in the gripper
    c3 moved mug O4: kitchen R1 -> bedroom R2 on bed O6: applied
    --
    O1 table R1 (1, 0, 0.5) measured
    O2 bowl R1 on O1 (1, 0, 0.6) measured
    O3 cereal R1 on O2 (1, 0, 0.7) measured
    O4 mug R2 on O6 (5, 1, 0.4) topological
    O5 mug R2 (5, 0, 0.05) measured
    O6 bed R2 (5, 1, 0.3) measured
    ");
}

#[test]
fn the_reported_pose_tells_two_mugs_apart() {
    let picked = TaskStatus {
        object: Some(label("mug")),
        pose: Some(Pose::at([4.9, 0.0, 0.1]).unwrap()),
        ..TaskStatus::bare("t", Status::Picked)
    };
    assert_snapshot!(story(vec![Event::TaskStatus(picked)]), @"
    c1 removed mug O5: bedroom R2 -> - on -: applied
    --
    O1 table R1 (1, 0, 0.5) measured
    O2 bowl R1 on O1 (1, 0, 0.6) measured
    O3 cereal R1 on O2 (1, 0, 0.7) measured
    O4 mug R1 on O1 (1.2, 0, 0.6) measured
    O5 mug R2 (5, 0, 0.05) held held
    O6 bed R2 (5, 1, 0.3) measured
    ");
}

#[test]
fn an_unknown_support_costs_only_the_support() {
    let placed = TaskStatus {
        object: Some(NodeRef::id(id("O4"))),
        room: Some(label("bedroom")),
        support: Some(label("wardrobe")),
        ..TaskStatus::bare("t", Status::Placed)
    };
    assert_snapshot!(story(vec![Event::TaskStatus(placed)]), @"
    c1 moved mug O4: kitchen R1 -> bedroom R2 on -: applied
    --
    O1 table R1 (1, 0, 0.5) measured
    O2 bowl R1 on O1 (1, 0, 0.6) measured
    O3 cereal R1 on O2 (1, 0, 0.7) measured
    O4 mug R2 (5, 0, 1) topological
    O5 mug R2 (5, 0, 0.05) measured
    O6 bed R2 (5, 1, 0.3) measured
    ");
}

#[test]
fn placing_nowhere_is_rejected() {
    assert_snapshot!(story(vec![naming(Status::Placed, NodeRef::id(id("O4")), None)]), @"
    c1 moved mug O4: - -> - on -: rejected [no_target] neither a room, a support nor a pose says where O4 is now
    --
    O1 table R1 (1, 0, 0.5) measured
    O2 bowl R1 on O1 (1, 0, 0.6) measured
    O3 cereal R1 on O2 (1, 0, 0.7) measured
    O4 mug R1 on O1 (1.2, 0, 0.6) measured
    O5 mug R2 (5, 0, 0.05) measured
    O6 bed R2 (5, 1, 0.3) measured
    ");
}

#[test]
fn a_thing_cannot_be_placed_on_itself_or_on_what_it_carries() {
    let bowl = || NodeRef::id(id("O2"));
    assert_snapshot!(story(vec![
        naming(Status::Placed, bowl(), Some(NodeRef::id(id("O3")))),
        naming(Status::Placed, bowl(), Some(bowl())),
    ]), @"
    c1 moved bowl O2: - -> - on O3: rejected [refused] the graph refuses: O2 cannot rest on O3: that rests on O2
    c2 moved bowl O2: - -> - on O2: rejected [refused] the graph refuses: O2 cannot rest on O2: that rests on O2
    --
    O1 table R1 (1, 0, 0.5) measured
    O2 bowl R1 on O1 (1, 0, 0.6) measured
    O3 cereal R1 on O2 (1, 0, 0.7) measured
    O4 mug R1 on O1 (1.2, 0, 0.6) measured
    O5 mug R2 (5, 0, 0.05) measured
    O6 bed R2 (5, 1, 0.3) measured
    ");
}

#[test]
fn what_is_placed_by_another_name_is_not_what_is_in_the_hand() {
    assert_snapshot!(story(vec![
        naming(Status::Picked, NodeRef::id(id("O4")), None),
        naming(Status::Placed, label("bowl"), Some(label("bed"))),
        status(Status::Done),
    ]), @r#"
    c1 removed mug O4: kitchen R1 -> - on table O1: applied
    c2 moved bowl O2: kitchen R1 -> bedroom R2 on bed O6: applied
    c3 moved mug O4: - -> - on -: rejected [done_holding] task "t" is done but never placed mug O4: it stays in the gripper
    --
    O1 table R1 (1, 0, 0.5) measured
    O2 bowl R2 on O6 (5, 1, 0.4) topological
    O3 cereal R2 on O2 (5, 1, 0.5) topological
    O4 mug R1 on O1 (1.2, 0, 0.6) held held
    O5 mug R2 (5, 0, 0.05) measured
    O6 bed R2 (5, 1, 0.3) measured
    "#);
}

#[test]
fn an_id_and_a_label_of_different_things_are_a_contradiction() {
    let both = NodeRef { label: label("bed").label, ..NodeRef::id(id("O4")) };
    assert_snapshot!(story(vec![
        naming(Status::Picked, both.clone(), None),
        naming(Status::Placed, both, Some(label("bed"))),
    ]), @"
    c1 removed bed O4: - -> - on -: rejected [contradiction] O4 is a mug, not a bed
    c2 moved bed O4: - -> - on bed: rejected [contradiction] O4 is a mug, not a bed
    --
    O1 table R1 (1, 0, 0.5) measured
    O2 bowl R1 on O1 (1, 0, 0.6) measured
    O3 cereal R1 on O2 (1, 0, 0.7) measured
    O4 mug R1 on O1 (1.2, 0, 0.6) measured
    O5 mug R2 (5, 0, 0.05) measured
    O6 bed R2 (5, 1, 0.3) measured
    ");
}

#[test]
fn what_another_task_placed_is_not_in_this_hand_any_more() {
    let other = |status, object: &str, support: &str| {
        Event::TaskStatus(TaskStatus {
            object: Some(NodeRef::id(id(object))),
            support: Some(NodeRef::id(id(support))),
            ..TaskStatus::bare("other", status)
        })
    };
    assert_snapshot!(story(vec![
        naming(Status::Picked, NodeRef::id(id("O4")), None),
        other(Status::Placed, "O4", "O6"),
        status(Status::Done),
    ]), @"
    c1 removed mug O4: kitchen R1 -> - on table O1: applied
    c2 moved mug O4: kitchen R1 -> bedroom R2 on bed O6: applied
    --
    O1 table R1 (1, 0, 0.5) measured
    O2 bowl R1 on O1 (1, 0, 0.6) measured
    O3 cereal R1 on O2 (1, 0, 0.7) measured
    O4 mug R2 on O6 (5, 1, 0.4) topological
    O5 mug R2 (5, 0, 0.05) measured
    O6 bed R2 (5, 1, 0.3) measured
    ");
}

#[test]
fn a_pick_that_is_rejected_does_not_hide_what_is_held() {
    assert_snapshot!(story(vec![
        naming(Status::Picked, NodeRef::id(id("O4")), None),
        naming(Status::Picked, label("ghost"), None),
        status(Status::Done),
    ]), @r#"
    c1 removed mug O4: kitchen R1 -> - on table O1: applied
    c2 removed ghost: - -> - on -: rejected [unknown_object] no such object known: ghost
    c3 moved mug O4: - -> - on -: rejected [done_holding] task "t" is done but never placed mug O4: it stays in the gripper
    --
    O1 table R1 (1, 0, 0.5) measured
    O2 bowl R1 on O1 (1, 0, 0.6) measured
    O3 cereal R1 on O2 (1, 0, 0.7) measured
    O4 mug R1 on O1 (1.2, 0, 0.6) held held
    O5 mug R2 (5, 0, 0.05) measured
    O6 bed R2 (5, 1, 0.3) measured
    "#);
}

#[test]
fn two_things_in_one_hand_are_placed_by_name() {
    assert_snapshot!(story(vec![
        naming(Status::Picked, NodeRef::id(id("O4")), None),
        naming(Status::Picked, NodeRef::id(id("O2")), None),
        naming(Status::Placed, label("mug"), Some(label("bed"))),
        naming(Status::Placed, label("bowl"), Some(label("bed"))),
        status(Status::Done),
    ]), @"
    c1 removed mug O4: kitchen R1 -> - on table O1: applied
    c2 removed bowl O2: kitchen R1 -> - on table O1: applied
    c3 moved mug O4: kitchen R1 -> bedroom R2 on bed O6: applied
    c4 moved bowl O2: kitchen R1 -> bedroom R2 on bed O6: applied
    --
    O1 table R1 (1, 0, 0.5) measured
    O2 bowl R2 on O6 (5, 1, 0.4) topological
    O3 cereal R2 on O2 (5, 1, 0.5) topological
    O4 mug R2 on O6 (5, 1, 0.4) topological
    O5 mug R2 (5, 0, 0.05) measured
    O6 bed R2 (5, 1, 0.3) measured
    ");
}

#[test]
fn an_id_that_nobody_knows_is_not_given_to_a_new_thing() {
    let unknown = NodeRef { label: label("vase").label, ..NodeRef::id(id("O16777215")) };
    assert_snapshot!(story(vec![
        naming(Status::Placed, unknown, Some(label("bed"))),
        naming(Status::Placed, label("clock"), Some(label("bed"))),
    ]), @"
    c1 added vase O7: - -> bedroom R2 on bed O6: applied
    c2 added clock O8: - -> bedroom R2 on bed O6: applied
    --
    O1 table R1 (1, 0, 0.5) measured
    O2 bowl R1 on O1 (1, 0, 0.6) measured
    O3 cereal R1 on O2 (1, 0, 0.7) measured
    O4 mug R1 on O1 (1.2, 0, 0.6) measured
    O5 mug R2 (5, 0, 0.05) measured
    O6 bed R2 (5, 1, 0.3) measured
    O7 vase R2 on O6 (5, 1, 0.45) topological
    O8 clock R2 on O6 (5, 1, 0.45) topological
    ");
}

#[test]
fn nothing_is_placed_on_what_is_in_the_gripper() {
    assert_snapshot!(story(vec![
        naming(Status::Picked, NodeRef::id(id("O1")), None),
        naming(Status::Placed, NodeRef::id(id("O5")), Some(NodeRef::id(id("O1")))),
    ]), @"
    c1 removed table O1: kitchen R1 -> - on -: applied
    c2 moved mug O5: - -> - on O1: rejected [support_held] O1 is in the gripper: nothing can be put on it
    --
    O1 table R1 (1, 0, 0.5) held held
    O2 bowl R1 on O1 (1, 0, 0.6) held held
    O3 cereal R1 on O2 (1, 0, 0.7) held held
    O4 mug R1 on O1 (1.2, 0, 0.6) held held
    O5 mug R2 (5, 0, 0.05) measured
    O6 bed R2 (5, 1, 0.3) measured
    ");
}
