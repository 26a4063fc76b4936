//! What breaks a promise of the contracts is refused, and the refusal names the field.

use prost::Message;

use crate::event::{Event, Topic};
use crate::graph::{Layer, NodeId};
use crate::time::Stamp;
use crate::wire::{WireError, decode, decode_checkpoint, decode_transaction, proto};

#[track_caller]
fn refused(topic: &Topic, message: &impl Message, expected: &str) {
    refused_bytes(topic, &message.encode_to_vec(), expected);
}

#[track_caller]
fn refused_bytes(topic: &Topic, payload: &[u8], expected: &str) {
    let text = match topic {
        Topic::Checkpoint => decode_checkpoint(payload).map(drop),
        _ => decode(topic, Stamp::EPOCH, payload).map(drop),
    }
    .expect_err(expected)
    .to_string();
    assert!(text.starts_with(expected), "{text:?} does not start with {expected:?}");
}

fn pose() -> proto::Pose {
    proto::Pose { x_um: 1, ..Default::default() }
}

fn object() -> proto::Object {
    proto::Object {
        label: "mug".into(),
        pose: Some(pose()),
        size: Some(proto::Size { w_um: 1, h_um: 1, d_um: 1 }),
        pose_source: 1,
        ..Default::default()
    }
}

fn node(index: u32, object: proto::Object) -> proto::ObjectNode {
    proto::ObjectNode { index, object: Some(object) }
}

fn room(n: u32) -> proto::RegionNode {
    let region = proto::Region { label: "kitchen".into(), ..Default::default() };
    proto::RegionNode { node: (1 << 24) + n, region: Some(region) }
}

fn graph(objects: Vec<proto::ObjectNode>) -> proto::GraphState {
    proto::GraphState { regions: vec![room(0)], access: vec![], objects }
}

#[track_caller]
fn object_refused(object: proto::Object, expected: &str) {
    refused(&Topic::InitialGraph, &graph(vec![node(0, object)]), expected);
}

#[test]
fn an_object_that_cannot_be_is_refused() {
    assert!(
        decode(&Topic::InitialGraph, Stamp::EPOCH, &graph(vec![node(0, object())]).encode_to_vec())
            .is_ok()
    );
    object_refused(proto::Object { label: String::new(), ..object() }, "Object.label is missing");
    object_refused(
        proto::Object { label: "a\u{7}".into(), ..object() },
        "Object.label: \"a\\u{7}\"",
    );
    object_refused(proto::Object { pose: None, ..object() }, "Object.pose is missing");
    object_refused(proto::Object { size: None, ..object() }, "Object.size is missing");
    object_refused(proto::Object { pose_source: 0, ..object() }, "Object.pose_source is missing");
    object_refused(
        proto::Object { pose_source: 4, ..object() },
        "Object.pose_source is 4: it must",
    );
    for rate in [f64::NAN, f64::INFINITY, -1.0] {
        let rated = proto::Object { decay_rate_per_s: rate, ..object() };
        object_refused(rated, "Object.decay_rate_per_s is");
    }
    let late = Some(i64::MAX as u64 + 1);
    object_refused(
        proto::Object { last_observed_nanos: late, ..object() },
        "Object.last_observed_nanos is 9223372036854775808",
    );
    object_refused(proto::Object { room: 1 << 24, ..object() }, "Object.room is 16777216");
    object_refused(proto::Object { room: 1, ..object() }, "GraphState: node R1 does not exist");
    object_refused(proto::Object { support: Some(0), ..object() }, "GraphState: O0 cannot rest");
    object_refused(proto::Object { support: Some(5), ..object() }, "GraphState: node O5");
}

#[test]
fn geometry_that_cannot_be_is_refused() {
    let posed = |pose| proto::Object { pose: Some(pose), ..object() };
    object_refused(posed(proto::Pose { x_um: i64::MAX, ..pose() }), "Pose: x is");
    object_refused(posed(proto::Pose { qx_e7: 5, ..pose() }), "Pose: the orientation");
    let sized =
        |w_um| proto::Object { size: Some(proto::Size { w_um, h_um: 1, d_um: 1 }), ..object() };
    object_refused(sized(0), "Size: width is 0");
    object_refused(sized(u64::MAX), "Size: width is");
}

#[test]
fn a_graph_that_cannot_be_is_refused() {
    let twice = graph(vec![node(3, object()), node(3, object())]);
    refused(&Topic::InitialGraph, &twice, "GraphState: node O3 already exists");
    let resting = |on| proto::Object { support: Some(on), ..object() };
    let cycle = graph(vec![node(0, resting(1)), node(1, resting(2)), node(2, resting(0))]);
    refused(&Topic::InitialGraph, &cycle, "GraphState: O0 cannot rest on O1");
    let self_access =
        proto::GraphState { access: vec![proto::Access { room_a: 0, room_b: 0 }], ..graph(vec![]) };
    refused(&Topic::InitialGraph, &self_access, "GraphState: R0 cannot give access to itself");
    let no_region = |node| proto::GraphState {
        regions: vec![proto::RegionNode { node, ..room(0) }],
        ..graph(vec![])
    };
    refused(&Topic::InitialGraph, &no_region(4 << 24), "RegionNode.node is 67108864");
    refused(&Topic::InitialGraph, &no_region(7), "GraphState: O7 is a object");
    let half = proto::Region { label: "hall".into(), pose: Some(pose()), ..Default::default() };
    let half = proto::RegionNode { region: Some(half), ..room(0) };
    let half = proto::GraphState { regions: vec![half], ..graph(vec![]) };
    refused(&Topic::InitialGraph, &half, "Region.size is missing");
}

#[test]
fn a_high_pile_is_read_quickly_whichever_way_it_is_numbered() {
    let n: u32 = 20_000;
    for up in [true, false] {
        let on = |k: u32| if up { k.checked_sub(1) } else { (k + 1 < n).then_some(k + 1) };
        let pile = (0..n).map(|k| node(k, proto::Object { support: on(k), ..object() }));
        let payload = graph(pile.collect()).encode_to_vec();
        let Ok(Event::InitialGraph(graph)) = decode(&Topic::InitialGraph, Stamp::EPOCH, &payload)
        else {
            panic!("a pile is a graph");
        };
        let resting = graph.all_objects().filter(|(_, object)| object.support.is_some());
        assert_eq!(resting.count() as u32, n - 1);
    }
}

#[test]
fn a_reason_may_quote_the_longest_input() {
    let reason = "\\u{7f}".repeat(1 << 20);
    let find = proto::step::Primitive::Find(proto::Find { reason, ..Default::default() });
    let payload = proto::Transaction { steps: vec![step(find)] }.encode_to_vec();
    assert!(decode_transaction(Stamp::EPOCH, &payload).is_ok());
}

fn step(primitive: proto::step::Primitive) -> proto::Step {
    proto::Step { cause: Some(proto::step::Cause::Change(1)), primitive: Some(primitive) }
}

#[track_caller]
fn step_refused(step: proto::Step, expected: &str) {
    refused(&Topic::Primitive, &proto::Transaction { steps: vec![step] }, expected);
}

#[test]
fn a_step_that_cannot_be_is_refused() {
    use proto::step::Primitive as P;
    let moved = proto::Move { pose: Some(pose()), pose_source: 1, ..Default::default() };
    let ok = proto::Transaction { steps: vec![step(P::Move(moved))] }.encode_to_vec();
    assert!(decode_transaction(Stamp::EPOCH, &ok).is_ok());
    step_refused(proto::Step { cause: None, ..step(P::Move(moved)) }, "Step.cause is missing");
    step_refused(
        proto::Step { cause: Some(proto::step::Cause::Change(1)), primitive: None },
        "Step.primitive is missing",
    );
    step_refused(step(P::Move(proto::Move { pose: None, ..moved })), "Move.pose is missing");
    step_refused(
        step(P::Move(proto::Move { pose_source: 0, ..moved })),
        "Move.pose_source is missing",
    );
    step_refused(
        step(P::Move(proto::Move { at_nanos: Some(u64::MAX), ..moved })),
        "Move.at_nanos is",
    );
    // A room where the field implies an object.
    step_refused(
        step(P::Move(proto::Move { object: (1 << 24) + 2, ..moved })),
        "Move.object is 16777218: it must be an index up to 16777215",
    );
    step_refused(step(P::Remove(proto::Remove::default())), "Remove.to is missing");
    step_refused(
        step(P::Remove(proto::Remove { to: 3, ..Default::default() })),
        "Remove.to is 3: it must be 1 (gone) or 2 (held)",
    );
    let decay = proto::SetDecay { decay_rate_per_s: f64::NAN, ..Default::default() };
    step_refused(step(P::SetDecay(decay)), "SetDecay.decay_rate_per_s is NaN");
    let decay = proto::SetDecay { origin: "x".repeat(70_000), ..Default::default() };
    step_refused(step(P::SetDecay(decay)), "SetDecay.origin holds more than 65536");
    let what = |node, what| step(P::Add(proto::Add { node, what, access_rooms: vec![] }));
    let (an_object, a_region) = (
        proto::add::What::Object(object()),
        proto::add::What::Region(proto::Region { label: "hall".into(), ..Default::default() }),
    );
    step_refused(what(1 << 24, Some(an_object)), "Add.node is R0: it must be an object");
    step_refused(what(1, Some(a_region)), "Add.node is O1: it must be a region");
    step_refused(what(1, None), "Add.what is missing");
}

#[test]
fn a_transaction_of_too_many_entries_is_refused() {
    let find = proto::Find { candidate_nodes: vec![0; 1 << 17], ..Default::default() };
    step_refused(
        step(proto::step::Primitive::Find(find)),
        "Transaction.candidate_nodes holds more",
    );
}

fn record() -> proto::ChangeRecord {
    proto::ChangeRecord {
        seq: 1,
        modality: 1,
        action: 1,
        object: Some(proto::NodeRef::default()),
        outcome: 1,
        ..Default::default()
    }
}

#[track_caller]
#[allow(clippy::needless_pass_by_value)] // so that the cases fit on a line
fn record_refused(record: proto::ChangeRecord, expected: &str) {
    refused(&Topic::Change, &record, expected);
}

#[test]
fn a_change_record_that_cannot_be_is_refused() {
    assert!(decode(&Topic::Change, Stamp::EPOCH, &record().encode_to_vec()).is_ok());
    record_refused(proto::ChangeRecord { seq: 0, ..record() }, "ChangeRecord.seq is missing");
    record_refused(proto::ChangeRecord { modality: 0, ..record() }, "ChangeRecord.modality is");
    record_refused(proto::ChangeRecord { modality: 5, ..record() }, "ChangeRecord.modality is 5");
    record_refused(proto::ChangeRecord { action: 4, ..record() }, "ChangeRecord.action is 4");
    record_refused(proto::ChangeRecord { object: None, ..record() }, "ChangeRecord.object is");
    record_refused(proto::ChangeRecord { outcome: 0, ..record() }, "ChangeRecord.outcome is");
    record_refused(proto::ChangeRecord { outcome: 3, ..record() }, "ChangeRecord.outcome is 3");
    record_refused(proto::ChangeRecord { outcome: 2, ..record() }, "ChangeRecord.reason_code is");
    record_refused(
        proto::ChangeRecord { reason: "because".into(), ..record() },
        "ChangeRecord.reason_code is",
    );
    for confidence in [f64::NAN, -0.1, 1.1] {
        record_refused(
            proto::ChangeRecord { confidence, ..record() },
            "ChangeRecord.confidence is",
        );
    }
    let late = u64::MAX;
    record_refused(proto::ChangeRecord { at_nanos: late, ..record() }, "ChangeRecord.at_nanos is");
    record_refused(
        proto::ChangeRecord { not_before_nanos: Some(late), ..record() },
        "ChangeRecord.not_before_nanos is",
    );
    let unplaced = proto::EvidenceRef { topic: "/clock".into(), order: 0 };
    record_refused(
        proto::ChangeRecord { evidence: vec![unplaced], ..record() },
        "EvidenceRef.order is missing",
    );
    let object = proto::NodeRef { id: 17, label: String::new() };
    record_refused(
        proto::ChangeRecord { object: Some(object), ..record() },
        "NodeRef.id is 17: it must be a layer letter",
    );
}

#[test]
fn an_input_that_cannot_be_is_refused() {
    refused(&Topic::TaskStatus, &proto::TaskStatus::default(), "TaskStatus.status is missing");
    let unknown = proto::TaskStatus { status: 6, ..Default::default() };
    refused(&Topic::TaskStatus, &unknown, "TaskStatus.status is 6: it must be 1 (started)");
    refused(&Topic::Interpretation, &proto::Interpretation::default(), "Interpretation.of is");
    let stale = |threshold, target| proto::Staleness { threshold, targets: vec![target] };
    let target = proto::StaleTarget::default();
    refused(&Topic::Staleness, &stale(1.5, target.clone()), "Staleness.threshold is 1.5");
    refused(&Topic::Staleness, &stale(0.5, target.clone()), "StaleTarget.object is missing");
    let never = proto::StaleTarget { decay_rate_per_s: -1.0, ..target };
    refused(&Topic::Staleness, &stale(0.5, never), "StaleTarget.decay_rate_per_s is -1");
    let text = "x".repeat((1 << 20) + 1);
    let long = proto::Utterance { speaker: String::new(), text };
    refused(&Topic::Utterance, &long, "Utterance.text holds more than 1048576");
    refused_bytes(&Topic::Utterance, b"\x0a\x01\xff", "Utterance.speaker is \"\u{fffd}\"");
}

#[test]
fn bytes_that_are_no_message_are_refused() {
    refused_bytes(&Topic::Clock, b"\x08", "Tick is damaged");
    refused_bytes(&Topic::Clock, b"\x00\x00", "Tick is damaged: a field number");
    refused_bytes(&Topic::Clock, b"\x0b", "Tick is damaged: a field is of an unknown kind");
    refused_bytes(&Topic::Clock, b"\x0a\x05ab", "Tick is damaged: it ends within a field");
    refused_bytes(&Topic::Clock, &[0xff; 11], "Tick is damaged: a number does not end");
    refused_bytes(&Topic::Utterance, b"\x08\x01", "Utterance is damaged: a field is of another");
    // A pose given twice, which protobuf would merge.
    let twice = b"\x10\x01\x1a\x02\x08\x02\x1a\x02\x10\x02";
    refused_bytes(&Topic::TaskStatus, twice, "TaskStatus is damaged: a field that may be given");
}

#[test]
fn fields_of_later_versions_are_skipped() {
    let payload = b"\x12\x02hi\xa0\x06\x01\xaa\x06\x01x\xb1\x06\0\0\0\0\0\0\0\0\xbd\x06\0\0\0\0";
    let read = decode(&Topic::Utterance, Stamp::EPOCH, payload);
    assert!(matches!(read, Ok(Event::Utterance(utterance)) if utterance.text == "hi"));
}

#[test]
fn topics_of_others_are_passed_through() {
    let topic = Topic::named("/camera/depth");
    let error = decode(&topic, Stamp::EPOCH, b"").unwrap_err();
    assert_eq!(error, WireError::NoEvent { topic: "/camera/depth".into() });
}

#[test]
fn a_checkpoint_that_cannot_be_is_refused() {
    let hash = vec![0; 32];
    let checkpoint = proto::Checkpoint {
        chain: hash.clone(),
        state_hash: hash.clone(),
        memory_hash: hash,
        state_size: 3,
        state_zstd: zstd::bulk::compress(b"abc", 3).unwrap(),
        ..Default::default()
    };
    assert!(decode_checkpoint(&checkpoint.encode_to_vec()).is_ok());
    let refuse = |change: &dyn Fn(&mut proto::Checkpoint), expected: &str| {
        let mut changed = checkpoint.clone();
        change(&mut changed);
        refused(&Topic::Checkpoint, &changed, expected);
    };
    refuse(&|it| it.chain.clear(), "Checkpoint.chain is missing");
    refuse(&|it| it.chain.push(0), "Checkpoint.chain is 33 bytes long: it must be 32");
    refuse(&|it| it.at_nanos = u64::MAX, "Checkpoint.at_nanos is");
    refuse(&|it| it.state_size = 2, "Checkpoint.state_zstd is damaged");
    refuse(&|it| it.state_size = 4, "Checkpoint.state_zstd is damaged");
    refuse(&|it| it.state_size = u64::MAX, "Checkpoint.state_size holds more");
    refuse(&|it| it.state_zstd.truncate(5), "Checkpoint.state_zstd is damaged");
}

#[test]
fn every_layer_has_its_own_numbers() {
    use crate::wire::common::{index, node};
    let room = NodeId::new(Layer::Room, 2).unwrap();
    assert_eq!((node(room), index(room, Layer::Room)), ((1 << 24) + 2, 2));
    assert_eq!(index(room, Layer::Object), (1 << 24) + 2);
}
