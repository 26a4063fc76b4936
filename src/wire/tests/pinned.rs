//! What was written once reads for ever: pinned contracts and payloads.

use crate::change::{
    Action, Cause, ChangeRecord, Claim, EvidenceRef, Modality, NodeRef, Occurred, Outcome,
    Primitive, Step, Transaction,
};
use crate::event::{Event, Topic, Utterance};
use crate::geometry::{Pose, Size};
use crate::graph::{Label, Object, Placement, PoseSource, Region, SceneGraph, StateHash};
use crate::time::Stamp;
use crate::wire::{decode, encode, ros2, schema_of};

#[test]
fn the_embedded_contracts_change_only_on_purpose() {
    let own = Topic::OWN.iter().map(|topic| schema_of(topic).expect("our own"));
    let ros2 = [ros2::TF_MESSAGE, ros2::IMAGE, ros2::COMPRESSED_IMAGE, ros2::CAMERA_INFO];
    let lines: Vec<String> = own
        .chain(ros2)
        .map(|it| {
            format!("{} {} {}", it.name, it.data.len(), &StateHash::of(it.data).to_string()[..16])
        })
        .collect();
    insta::assert_snapshot!(lines.join("\n"), @"
    scenefold.v1.GraphState 1482 63ec19f97de315f6
    scenefold.v1.Utterance 113 8bab71bb3200e75b
    scenefold.v1.Task 1368 5ff4490167c50655
    scenefold.v1.TaskStatus 1505 6d358798e64cc9df
    scenefold.v1.Tick 57 3cdfcb13170a4b0f
    scenefold.v1.ChangeRecord 2215 50773ac630fb7f97
    scenefold.v1.LanguageReply 1388 79435683af9938d8
    scenefold.v1.Interpretation 1623 b96928d09f4d58ce
    scenefold.v1.Staleness 1422 c262adb5fc19d140
    scenefold.v1.ChangeRecord 2215 50773ac630fb7f97
    scenefold.v1.Transaction 2694 360e281e76a343ce
    scenefold.v1.Checkpoint 320 98470128ec0b2744
    tf2_msgs/msg/TFMessage 1144 ec54603815d24001
    sensor_msgs/msg/Image 576 588f029a3fb807b9
    sensor_msgs/msg/CompressedImage 441 b84e9c4eb05cb4f4
    sensor_msgs/msg/CameraInfo 927 16616adfb51d5cc1
    ");
}

/// Moves O17 onto O300 in R2, turned by a right angle about z.
fn moved(at: Stamp) -> Event {
    let id = "O17".parse().expect("an id");
    let to = Placement {
        room: "R2".parse().expect("an id"),
        support: Some("O300".parse().expect("an id")),
        pose: Pose::new([1.25, -2.5, 0.842], [0.5, 0.0, 0.0, 0.5]).expect("a pose"),
        pose_source: PoseSource::Measured,
        at,
    };
    let step = Step { cause: Cause::Change(7), primitive: Primitive::Move { id, to } };
    Event::Transaction(Transaction { at, steps: vec![step] })
}

/// Rejects the claim that a mug was removed from the kitchen.
fn rejected(at: Stamp) -> Event {
    let claim = Claim {
        modality: Modality::Human,
        detector: "builtin/1".into(),
        action: Action::Removed,
        object: NodeRef::label(Label::new("mug").expect("a label")),
        source_room: Some(NodeRef::id("R1".parse().expect("an id"))),
        target_room: None,
        support: None,
        pose: None,
        size: None,
        confidence: 0.5,
        occurred: Occurred { not_before: None, not_after: Some(at) },
        held: false,
        evidence: vec![EvidenceRef { topic: "/human/utterance".into(), order: 41 }],
    };
    let outcome = Outcome::Rejected { code: "ambiguous".into(), reason: "two mugs".into() };
    Event::Change(ChangeRecord { seq: 7, at, claim, outcome })
}

/// A mug in a kitchen.
fn kitchen(at: Stamp) -> Event {
    let mut graph = SceneGraph::new();
    let room = "R1".parse().expect("an id");
    let label = |text| Label::new(text).expect("a label");
    let region = Region { label: label("kitchen"), extent: None, parent: None };
    graph.insert_region(room, region).expect("the graph is empty");
    let object = Object {
        label: label("mug"),
        pose: Pose::at([1.25, -2.5, 0.842]).expect("a pose"),
        size: Size::new(0.08, 0.08, 0.1).expect("a size"),
        decay_rate: 0.25,
        last_observed: at,
        pose_source: PoseSource::Topological,
        room,
        support: None,
    };
    graph.insert_object("O17".parse().expect("an id"), object).expect("the room is there");
    Event::InitialGraph(graph)
}

/// The bytes were written by the first version. They are never changed: if a test fails, it is
/// the reader that must be mended.
#[track_caller]
fn check(expected: &Event, at: Stamp, payload: &str) {
    let bytes: Vec<u8> = payload
        .as_bytes()
        .chunks(2)
        .map(|pair| std::str::from_utf8(pair).ok().and_then(|hex| u8::from_str_radix(hex, 16).ok()))
        .collect::<Option<_>>()
        .expect("hexadecimal digits");
    let now = encode(expected);
    assert_eq!(decode(&expected.topic(), at, &bytes).as_ref(), Ok(expected), "now: {now:02x?}");
}

#[test]
fn payloads_of_the_first_version_still_read() {
    let at = Stamp::from_nanos(1_767_571_200_000_000_000);
    let said = Utterance { speaker: "Ann".into(), text: "the mug is gone".into() };
    check(&Event::Utterance(said), at, "0a03416e6e120f746865206d756720697320676f6e65");
    check(
        &moved(at),
        at,
        "0a27080732230811100218ac02221808a0cb980110bf96b10218a0e46620b895df0638b895df062801",
    );
    check(
        &rejected(at),
        at,
        "08071100003633a4ac8718180122096275696c74696e2f312803320512036d75673a0909010000000000005261000000000000e03f7100003633a4ac87188201140a102f68756d616e2f7574746572616e63651029880102920109616d626967756f75739a010874776f206d756773",
    );
    check(
        &kitchen(at),
        at,
        "0a10088180800812090a076b69746368656e1a3d081112390a036d7567120e08a0cb980110bf96b10218a0e4661a0c0880f1041080f10418a08d0621000000000000d03f2900003633a4ac871830023801",
    );
}
