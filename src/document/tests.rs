//! The documents, character by character: they are a contract.

use std::borrow::Cow;

use insta::assert_snapshot;

use super::*;
use crate::change::{
    Action, Cause, ChangeRecord, Claim, Departure, EvidenceRef, Modality, NodeRef, Occurred,
    Outcome, Primitive, Sighting, Step, Transaction,
};
use crate::event::{
    Event, Interpretation, Logged, SensorMessage, StaleTarget, Staleness, Status, Task, TaskStatus, Utterance,
};
use crate::geometry::{Pose, Size};
use crate::graph::{Label, Node, NodeId, Object, Placement, PoseSource, Region, SceneGraph};
use crate::time::Stamp;

fn id(text: &str) -> NodeId {
    text.parse().unwrap()
}

fn node(label: &str, of: &str) -> NodeRef {
    NodeRef { id: Some(id(of)), label: Some(Label::new(label).unwrap()) }
}

fn at() -> Stamp {
    "2026-01-05T08:00:12.5Z".parse().unwrap()
}

fn evidence() -> EvidenceRef {
    EvidenceRef { topic: Cow::Borrowed("/human/utterance"), order: 41 }
}

fn claim() -> Claim {
    Claim {
        modality: Modality::Human,
        detector: "builtin/1".into(),
        action: Action::Moved,
        object: node("mug", "O17"),
        source_room: Some(node("kitchen", "R1")),
        target_room: Some(NodeRef::id(id("R2"))),
        support: Some(node("table", "O3")),
        pose: Some(Pose::at([1.0, 0.25, 0.8]).unwrap()),
        size: Some(Size::new(0.1, 0.1, 0.12).unwrap()),
        confidence: 0.9,
        occurred: Occurred { not_before: None, not_after: Some(at()) },
        held: false,
        evidence: vec![evidence()],
    }
}

fn json(document: &impl serde::Serialize) -> String {
    serde_json::to_string(document).unwrap()
}

#[test]
fn an_applied_change_has_the_fields_of_the_contract_in_order() {
    let record = ChangeRecord { seq: 7, at: at(), claim: claim(), outcome: Outcome::Applied };
    assert_snapshot!(json(&ChangeDocument::of(&record)), @r#"{"seq":7,"at":"2026-01-05T08:00:12.5Z","modality":"human","detector":"builtin/1","action":"moved","object":{"id":"O17","label":"mug"},"source_room":{"id":"R1","label":"kitchen"},"target_room":{"id":"R2","label":null},"support":{"id":"O3","label":"table"},"pose":{"position":[1.0,0.25,0.8],"orientation":{"w":1.0,"x":0.0,"y":0.0,"z":0.0}},"size":[0.1,0.1,0.12],"confidence":0.9,"occurred":{"not_before":null,"not_after":"2026-01-05T08:00:12.5Z"},"outcome":"applied","reason":null,"evidence":[{"topic":"/human/utterance","order":41}],"code":null,"held":false}"#);
}

#[test]
fn a_rejected_change_has_its_reason_and_the_stable_word_for_it() {
    let claim = Claim {
        action: Action::Removed,
        object: NodeRef::label(Label::new("mug").unwrap()),
        source_room: None,
        target_room: None,
        support: None,
        pose: None,
        size: None,
        occurred: Occurred::default(),
        held: true,
        evidence: vec![],
        ..claim()
    };
    let outcome = Outcome::Rejected { code: "ambiguous".into(), reason: "mug is …".into() };
    let record = ChangeRecord { seq: 8, at: at(), claim, outcome };
    assert_snapshot!(json(&ChangeDocument::of(&record)), @r#"{"seq":8,"at":"2026-01-05T08:00:12.5Z","modality":"human","detector":"builtin/1","action":"removed","object":{"id":null,"label":"mug"},"source_room":null,"target_room":null,"support":null,"pose":null,"size":null,"confidence":0.9,"occurred":{"not_before":null,"not_after":null},"outcome":"rejected","reason":"mug is …","evidence":[],"code":"ambiguous","held":true}"#);
}

#[test]
fn every_primitive_has_a_document() {
    let to = Placement {
        room: id("R1"),
        support: None,
        pose: Pose::IDENTITY,
        pose_source: PoseSource::Topological,
        at: at(),
    };
    let object = Object {
        label: Label::new("mug").unwrap(),
        pose: Pose::IDENTITY,
        size: Size::new(0.1, 0.2, 0.3).unwrap(),
        decay_rate: 2.5e-5,
        last_observed: at(),
        pose_source: PoseSource::Measured,
        room: id("R1"),
        support: Some(id("O3")),
    };
    let room = Region { label: Label::new("hall").unwrap(), extent: None, parent: Some(id("F0")) };
    let primitives = [
        Primitive::Find {
            query: "mug".into(),
            room: Some(id("R1")),
            support: None,
            candidates: vec![id("O17"), id("O18")],
            chosen: Some(id("O17")),
            reason: "the only mug in the kitchen".into(),
        },
        Primitive::Add { id: id("O17"), node: Node::Object(object) },
        Primitive::Add { id: id("R4"), node: Node::Region(room, vec![id("R1")]) },
        Primitive::Remove { id: id("O17"), to: Departure::Held, at: at() },
        Primitive::Move { id: id("O17"), to },
        Primitive::Observe {
            at: at(),
            seen: vec![Sighting { id: id("O17"), pose: None, size: None }],
        },
        Primitive::SetDecay { id: id("O17"), decay_rate: 0.5, origin: "table".into() },
    ];
    let lines: Vec<String> = primitives.iter().map(|p| json(&PrimitiveDocument::of(p))).collect();
    assert_snapshot!(lines.join("\n"), @r#"
    {"primitive":"find","query":"mug","room":"R1","support":null,"candidates":["O17","O18"],"chosen":"O17","reason":"the only mug in the kitchen"}
    {"primitive":"add","id":"O17","node":{"label":"mug","size":[0.1,0.2,0.3],"decay_rate":0.000025,"room":"R1","support":"O3","pose":{"position":[0.0,0.0,0.0],"orientation":{"w":1.0,"x":0.0,"y":0.0,"z":0.0}},"pose_source":"measured","last_observed":"2026-01-05T08:00:12.5Z"}}
    {"primitive":"add","id":"R4","node":{"label":"hall","pose":null,"size":null,"parent":"F0","access_to":["R1"]}}
    {"primitive":"remove","id":"O17","to":"held","at":"2026-01-05T08:00:12.5Z"}
    {"primitive":"move","id":"O17","to":{"room":"R1","support":null,"pose":{"position":[0.0,0.0,0.0],"orientation":{"w":1.0,"x":0.0,"y":0.0,"z":0.0}},"pose_source":"topological","last_observed":"2026-01-05T08:00:12.5Z"}}
    {"primitive":"observe","at":"2026-01-05T08:00:12.5Z","seen":[{"id":"O17","pose":null,"size":null}]}
    {"primitive":"set_decay","id":"O17","decay_rate":0.5,"origin":"table"}
    "#);
}

fn inputs() -> Vec<Event> {
    vec![
        Event::InitialGraph(SceneGraph::new()),
        Event::Utterance(Utterance { speaker: "anna".into(), text: "I took the mug.".into() }),
        Event::Task(Task {
            task_id: "t".into(),
            instruction: "Bring the mug.".into(),
            object: Some(node("mug", "O17")),
            ..Task::default()
        }),
        Event::TaskStatus(TaskStatus {
            pose: Some(Pose::IDENTITY),
            ..TaskStatus::bare("t", Status::Placed)
        }),
        Event::Tick,
        Event::Sensor(SensorMessage {
            topic: "/camera/color/image/compressed".into(),
            message_encoding: "cdr".into(),
            schema_name: "sensor_msgs/msg/CompressedImage".into(),
            schema_encoding: "ros2msg".into(),
            schema: (*b"uint8[] data").into(),
            data: [1, 2, 3].into(),
        }),
    ]
}

fn derived() -> Vec<Event> {
    let primitive = Primitive::Remove { id: id("O17"), to: Departure::Gone, at: at() };
    let step = |cause| Step { cause, primitive: primitive.clone() };
    vec![
        Event::Interpretation(Interpretation {
            of: evidence(),
            object: Some(node("mug", "O17")),
            source_room: None,
            target_room: None,
            support: None,
            note: "one mug".into(),
            spans: vec![],
        }),
        Event::Staleness(Staleness {
            threshold: 0.5,
            targets: vec![StaleTarget {
                object: node("mug", "O17"),
                room: Some(node("kitchen", "R1")),
                probability: 0.25,
                decay_rate: 0.001,
                last_observed: at(),
            }],
        }),
        Event::Change(ChangeRecord { seq: 7, at: at(), claim: claim(), outcome: Outcome::Applied }),
        Event::Transaction(Transaction {
            at: at(),
            steps: vec![step(Cause::Change(7)), step(Cause::Evidence(evidence()))],
        }),
    ]
}

fn documents(events: Vec<Event>) -> String {
    let logged = |(order, event)| Logged { order, at: at(), published: at(), event };
    let lines: Vec<String> =
        (1..).zip(events).map(|numbered| json(&EventDocument::of(&logged(numbered)))).collect();
    lines.join("\n")
}

#[test]
fn every_input_has_a_document_without_its_payload() {
    assert_snapshot!(documents(inputs()), @r#"
    {"order":1,"at":"2026-01-05T08:00:12.5Z","topic":"/graph/initial","event":"initial_graph","rooms":0,"objects":0,"hash":"b0af806f149b4d73f41d3bdd9e821d0187a513c1556177790b3eb88395e5c4b9"}
    {"order":2,"at":"2026-01-05T08:00:12.5Z","topic":"/human/utterance","event":"utterance","speaker":"anna","text":"I took the mug."}
    {"order":3,"at":"2026-01-05T08:00:12.5Z","topic":"/robot/task","event":"task","task_id":"t","instruction":"Bring the mug.","object":{"id":"O17","label":"mug"},"source_room":null,"target_room":null,"support":null}
    {"order":4,"at":"2026-01-05T08:00:12.5Z","topic":"/robot/task_status","event":"task_status","task_id":"t","status":"placed","object":null,"room":null,"support":null,"pose":{"position":[0.0,0.0,0.0],"orientation":{"w":1.0,"x":0.0,"y":0.0,"z":0.0}}}
    {"order":5,"at":"2026-01-05T08:00:12.5Z","topic":"/clock","event":"tick"}
    {"order":6,"at":"2026-01-05T08:00:12.5Z","topic":"/camera/color/image/compressed","event":"sensor","schema":"sensor_msgs/msg/CompressedImage","encoding":"cdr","bytes":3}
    "#);
}

#[test]
fn every_derived_record_has_a_document() {
    assert_snapshot!(documents(derived()), @r#"
    {"order":1,"at":"2026-01-05T08:00:12.5Z","topic":"/evidence/interpretation","event":"interpretation","of":{"topic":"/human/utterance","order":41},"object":{"id":"O17","label":"mug"},"source_room":null,"target_room":null,"support":null,"note":"one mug"}
    {"order":2,"at":"2026-01-05T08:00:12.5Z","topic":"/evidence/staleness","event":"staleness","threshold":0.5,"targets":[{"object":{"id":"O17","label":"mug"},"room":{"id":"R1","label":"kitchen"},"probability":0.25,"decay_rate":0.001,"last_observed":"2026-01-05T08:00:12.5Z"}]}
    {"order":3,"at":"2026-01-05T08:00:12.5Z","topic":"/change","event":"change","change":{"seq":7,"at":"2026-01-05T08:00:12.5Z","modality":"human","detector":"builtin/1","action":"moved","object":{"id":"O17","label":"mug"},"source_room":{"id":"R1","label":"kitchen"},"target_room":{"id":"R2","label":null},"support":{"id":"O3","label":"table"},"pose":{"position":[1.0,0.25,0.8],"orientation":{"w":1.0,"x":0.0,"y":0.0,"z":0.0}},"size":[0.1,0.1,0.12],"confidence":0.9,"occurred":{"not_before":null,"not_after":"2026-01-05T08:00:12.5Z"},"outcome":"applied","reason":null,"evidence":[{"topic":"/human/utterance","order":41}],"code":null,"held":false}}
    {"order":4,"at":"2026-01-05T08:00:12.5Z","topic":"/primitive","event":"transaction","steps":[{"cause":{"change":7},"primitive":"remove","id":"O17","to":"gone","at":"2026-01-05T08:00:12.5Z"},{"cause":{"evidence":{"topic":"/human/utterance","order":41}},"primitive":"remove","id":"O17","to":"gone","at":"2026-01-05T08:00:12.5Z"}]}
    "#);
}
