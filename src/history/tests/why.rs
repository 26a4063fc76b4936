//! The life of a node, told from its log.

use insta::assert_snapshot;
use proptest::prelude::*;

use super::arbitrary;
use super::fixture::{id, journey, label, log, start};
use crate::change::{
    Action, Cause, ChangeRecord, Claim, Departure, EvidenceRef, Modality, NodeRef, Occurred,
    Outcome, Primitive, Sighting, Step, Transaction, World,
};
use crate::event::{Event, Logged, Utterance};
use crate::graph::{Layer, NodeId};
use crate::history::why::Presence;
use crate::history::{Place, Selector, Slice, WhyDocument, WhyError, advance, why};

fn tell(log: &[Logged], who: &str) -> String {
    let who: Selector = who.parse().unwrap();
    match why(&Slice(log), u64::MAX, &who) {
        Ok(why) => why.to_string(),
        Err(error) => format!("error: {error}"),
    }
}

fn breakfast() -> Vec<Logged> {
    log("480 t1 picked O4
         485 t1 placed O4 on table in kitchen
         486 t1 done
         490 t2 picked bowl
         495 t2 placed bowl on bed
         500 t3 picked O4 in kitchen
         505 t4 picked O4
         506 t5 picked mugs
         510 t3 failed")
}

#[test]
fn the_life_of_a_mug_reads_like_a_story() {
    assert_snapshot!(tell(&breakfast(), "mug"), @r#"
    mug O4: in the gripper since 2026-01-05T08:20:00Z (event #17)
    It was last seen in the kitchen, on table O1.
    Since then 2 claims about it were rejected.
    Of the same name, but never changed: mug O5.

    2026-01-05 00:00:00  #1    in the initial graph: kitchen, in cupboard O7
    2026-01-05 08:00:00  c1    picked up from kitchen, in cupboard O7
                               action: the robot's task t1 reported "picked" (#2)
                               named by its id
    2026-01-05 08:05:00  c2    put down: kitchen, on table O1
                               action: the robot's task t1 reported "placed" (#5)
                               named by its id
    2026-01-05 08:20:00  c5    picked up from kitchen, on table O1
                               action: the robot's task t3 reported "picked" (#15)
                               named by its id
    2026-01-05 08:25:00  c6    a pick was claimed and rejected: mug O4 is already in the gripper
                               action: the robot's task t4 reported "picked" (#18)
    2026-01-05 08:30:00  c8    a move was claimed and rejected: task "t3" failed after the pick: mug O4 stays in the gripper
                               action: the robot's task t3 reported "failed" (#22)
    "#);
}

#[test]
fn what_lies_in_a_bowl_goes_along_with_it() {
    assert_snapshot!(tell(&breakfast(), "cereal"), @r#"
    cereal O3: bedroom, on bowl O2, since 2026-01-05T08:15:00Z (event #14)

    2026-01-05 00:00:00  #1    in the initial graph: kitchen, on bowl O2
    2026-01-05 08:10:00  c3    went along with bowl O2: picked up from kitchen, on bowl O2
                               action: the robot's task t2 reported "picked" (#9)
    2026-01-05 08:15:00  c4    went along with bowl O2: put down: bedroom, on bowl O2
                               action: the robot's task t2 reported "placed" (#12)
    "#);
}

#[test]
fn the_story_ends_where_it_is_told_to() {
    let log = breakfast();
    let why = why(&Slice(&log), 4, &Selector::Id(id("O4"))).unwrap();
    assert_eq!((why.upto.order, why.entries.len()), (4, 1));
    assert_eq!(
        why.to_string().lines().next(),
        Some("mug O4: in the gripper since 2026-01-05T08:00:00Z (event #4)")
    );
}

#[test]
fn what_never_changed_is_still_where_it_was() {
    assert_snapshot!(tell(&breakfast(), "TV-remote"), @r"
    tv remote O8: bedroom, on bed O6, since 2026-01-05T00:00:00Z (event #1)
    It is probably no longer there: 9 % (half-life 3.1 h, the initial graph; last observed 2026-01-05 00:00:00).

    2026-01-05 00:00:00  #1    in the initial graph: bedroom, on bed O6
    ");
}

#[test]
fn an_unknown_name_brings_up_similar_ones() {
    let unknown = |who| tell(&breakfast(), who);
    assert_snapshot!(unknown("cereals"), @r#"error: nothing in the log is called "cereals"; did you mean "cereal"?"#);
    assert_snapshot!(unknown("remote"), @r#"error: nothing in the log is called "remote"; did you mean "tv remote"?"#);
    assert_snapshot!(unknown("zebra"), @r#"error: nothing in the log is called "zebra""#);
    assert_snapshot!(unknown("O77"), @"error: nothing in the log is called O77");
}

#[test]
fn several_with_a_history_are_listed() {
    let log = log("480 t1 picked O4\n 485 t2 picked O5\n 490 t2 placed O5 on bed");
    assert_snapshot!(tell(&log, "mug"), @r#"
    error: "mug" may be any of these, so give an id:
      mug O4  in the gripper, picked in kitchen, in cupboard O7
      mug O5  bedroom, on bed O6
    "#);
}

#[test]
fn a_task_is_told_before_its_reports() {
    let log = log("470 t told tv remote on table
         480 t picked
         485 t placed
         490 u picked mug
         500 u picked O77");
    assert_snapshot!(tell(&log, "tv remote"), @r#"
    tv remote O8: kitchen, on table O1, since 2026-01-05T08:05:00Z (event #9)

    2026-01-05 00:00:00  #1    in the initial graph: bedroom, on bed O6
    2026-01-05 08:00:00  c1    picked up from bedroom, on bed O6
                               action: the robot was told "Fetch the tv remote on table." (#2); the robot's task t reported "picked" (#4)
                               found as the only tv remote known
    2026-01-05 08:05:00  c2    put down: kitchen, on table O1
                               action: the robot was told "Fetch the tv remote on table." (#2); the robot's task t reported "placed" (#7)
                               named by its id
    "#);
    assert_snapshot!(tell(&log, "O5"), @r#"
    mug O5: bedroom, since 2026-01-05T00:00:00Z (event #1)
    It is probably no longer there: 9 % (half-life 3.1 h, the initial graph; last observed 2026-01-05 00:00:00).

    2026-01-05 00:00:00  #1    in the initial graph: bedroom
    2026-01-05 08:10:00  c3    a pick was claimed and rejected: mug is ambiguous: O4, O5
                               action: the robot's task u reported "picked" (#10)
    "#);
    assert_snapshot!(tell(&log, "O77"), @r#"
    O77: never in the graph

    2026-01-05 08:20:00  c4    a pick was claimed and rejected: no such object known: O77
                               action: the robot's task u reported "picked" (#12)
    "#);
}

/// Appends events to a log, all at `minute` minutes past midnight.
fn append(log: &mut Vec<Logged>, minute: u64, events: Vec<Event>) {
    let at = start().plus_nanos(minute * 60_000_000_000);
    for event in events {
        let order = log.len() as u64 + 1;
        log.push(Logged { order, at, published: at, event });
    }
}

fn told(order: u64, seq: u64, action: Action, outcome: Outcome) -> ChangeRecord {
    let claim = Claim {
        modality: Modality::Human,
        detector: "builtin/1".into(),
        action,
        object: NodeRef { id: Some(id("O4")), label: Some(label("mug")) },
        source_room: None,
        target_room: None,
        support: None,
        pose: None,
        size: None,
        confidence: 0.9,
        occurred: Occurred::default(),
        held: false,
        evidence: vec![EvidenceRef { topic: "/human/utterance".into(), order }],
    };
    ChangeRecord { seq, at: start(), claim, outcome }
}

fn says(text: &str) -> Event {
    Event::Utterance(Utterance { speaker: "anna".into(), text: text.into() })
}

/// A mug that was seen twice, then said to be gone, then said to be gone again.
fn taken() -> Vec<Logged> {
    let mut log = log("1 tick\n 2 tick");
    let step = |cause, primitive| Step { cause, primitive };
    let frame = |order| Cause::Evidence(EvidenceRef { topic: "/clock".into(), order });
    let seen = |order| {
        let seen = vec![Sighting { id: id("O4"), pose: None, size: None }];
        let observe = Primitive::Observe { at: start(), seen };
        Event::Transaction(Transaction { at: start(), steps: vec![step(frame(order), observe)] })
    };
    append(&mut log, 3, vec![seen(2), seen(3)]);
    let gone = Primitive::Remove { id: id("O4"), to: Departure::Gone, at: start() };
    let steps = vec![step(Cause::Change(1), gone)];
    append(
        &mut log,
        600,
        vec![
            says("I took the mug.\u{1b}[31m"),
            Event::Change(told(6, 1, Action::Removed, Outcome::Applied)),
            Event::Transaction(Transaction { at: start(), steps }),
        ],
    );
    let rejected = Outcome::Rejected {
        code: "already_absent".into(),
        reason: "mug O4 is not in the graph: it was removed before".into(),
    };
    let again = told(9, 2, Action::Removed, rejected);
    append(&mut log, 610, vec![says("The mug is gone."), Event::Change(again)]);
    log
}

#[test]
fn an_absence_is_told_with_who_took_it_away_and_what_was_said_since() {
    assert_snapshot!(tell(&taken(), "O4"), @r#"
    mug O4: not there since 2026-01-05T10:00:00Z (event #8)
    It was last known in the kitchen, in cupboard O7.
    It was removed by c1, human, 90 % sure: anna said "I took the mug.\u{1b}[31m" (#6).
    Since then one claim about it was rejected.

    2026-01-05 00:00:00  #1    in the initial graph: kitchen, in cupboard O7
    2026-01-05 00:03:00  #4    seen 2 times until 2026-01-05 00:03:00
                               the clock (#2)
    2026-01-05 10:00:00  c1    removed from kitchen, in cupboard O7
                               human, 90 % sure: anna said "I took the mug.\u{1b}[31m" (#6)
    2026-01-05 10:10:00  c2    a removal was claimed and rejected: mug O4 is not in the graph: it was removed before
                               human, 90 % sure: anna said "The mug is gone." (#9)
    "#);
}

#[test]
fn a_life_has_a_document() {
    let log = log("480 t1 picked O4");
    let why = why(&Slice(&log), u64::MAX, &Selector::Id(id("O4"))).unwrap();
    assert_snapshot!(serde_json::to_string(&WhyDocument::of(&why)).unwrap(), @r#"{"object":{"id":"O4","label":"mug"},"events":[{"order":4,"primitive":{"primitive":"remove","id":"O4","to":"held","at":"2026-01-05T08:00:00Z"},"change":{"seq":1,"at":"2026-01-05T08:00:00Z","modality":"action","detector":"action/1","action":"removed","object":{"id":"O4","label":"mug"},"source_room":{"id":"R1","label":"kitchen"},"target_room":null,"support":{"id":"O7","label":"cupboard"},"pose":null,"size":null,"confidence":1.0,"occurred":{"not_before":"2026-01-05T08:00:00Z","not_after":"2026-01-05T08:00:00Z"},"outcome":"applied","reason":null,"evidence":[{"topic":"/robot/task_status","order":2}],"code":null,"held":true},"evidence":[{"order":2,"at":"2026-01-05T08:00:00Z","topic":"/robot/task_status","event":"task_status","task_id":"t1","status":"picked","object":{"id":"O4","label":null},"room":null,"support":null,"pose":null}],"inputs":[{"order":2,"at":"2026-01-05T08:00:00Z","topic":"/robot/task_status","event":"task_status","task_id":"t1","status":"picked","object":{"id":"O4","label":null},"room":null,"support":null,"pose":null}],"at":"2026-01-05T08:00:00Z","also":[],"find":{"primitive":"find","query":"O4","room":null,"support":null,"candidates":["O4"],"chosen":"O4","reason":"named by id"},"along_with":null,"sightings":null}],"state":{"presence":"held","since":4,"at":"2026-01-05T08:00:00Z","place":{"room":{"id":"R1","label":"kitchen"},"support":{"id":"O7","label":"cupboard"},"pose":{"position":[3.0,0.0,1.2],"orientation":{"w":1.0,"x":0.0,"y":0.0,"z":0.0}},"pose_source":"held"}},"initial":{"order":1,"at":"2026-01-05T00:00:00Z","place":{"room":{"id":"R1","label":"kitchen"},"support":{"id":"O7","label":"cupboard"},"pose":{"position":[3.0,0.0,1.2],"orientation":{"w":1.0,"x":0.0,"y":0.0,"z":0.0}},"pose_source":"measured"}},"upto":4,"namesakes":[]}"#);
}

#[test]
fn a_log_that_cannot_be_folded_says_where() {
    let mut log = log("");
    let primitive = Primitive::Remove { id: id("O99"), to: Departure::Gone, at: start() };
    let steps = vec![Step { cause: Cause::Change(1), primitive }];
    append(&mut log, 1, vec![Event::Transaction(Transaction { at: start(), steps })]);
    let error = why(&Slice(&log), u64::MAX, &Selector::Id(id("O4"))).unwrap_err();
    assert!(matches!(&error, WhyError::Fold(fold) if fold.order == 2), "{error}");
}

proptest! {
    #[test]
    fn the_life_of_every_node_ends_as_the_world_does(
        graphs in prop::collection::vec(arbitrary::graph(), 1..4),
        (a, b) in arbitrary::two_in_one_house(),
    ) {
        for log in [journey(&graphs), journey(&[a, b])] {
            let mut world = World::default();
            for logged in &log {
                advance(&mut world, logged).unwrap();
            }
            let ids: Vec<NodeId> = (0..9).filter_map(|n| NodeId::new(Layer::Object, n)).collect();
            for id in ids {
                let Ok(why) = why(&Slice(&log), u64::MAX, &Selector::Id(id)) else {
                    prop_assert!(world.known(id).is_none());
                    continue;
                };
                prop_assert_eq!(why.state.presence, Presence::of(&world, id));
                prop_assert!(why.state.since.is_some());
                let orders: Vec<u64> = why.entries.iter().map(|it| it.moment.order).collect();
                prop_assert!(orders.is_sorted());
                // What it rests on may have moved or changed its name since.
                let bare = |place: Place| {
                    let support = place.support.map(|support| support.id);
                    (place.room.id, support, place.pose, place.pose_source)
                };
                let there = why.state.presence != Presence::Absent;
                let place = why.state.place.filter(|_| there).map(bare);
                let last = why.entries.last().map(|entry| entry.after.clone().map(bare));
                prop_assert!(last.is_none_or(|last| last == place));
            }
        }
    }
}
