//! Two recordings made by hand: `every_rejection`, all that the robot's own hands can run into,
//! and `every_primitive`, which goes on with what no detector of this version derives.
//!
//! With `SCENEFOLD_MAKE_RECORDINGS=FOLDER` they are written there; see `recordings/make.sh`.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use scenefold::change::{
    Action, Cause, Claim, Departure, EvidenceRef, Modality, NodeRef, Occurred, Outcome, PlanConfig,
    Primitive, Sighting, Step, Transaction, World,
};
use scenefold::container::{ChannelSpec, ChunkClass, LogOptions, LogWriter, SchemaSpec};
use scenefold::event::{Event, Logged, Status, Task, TaskStatus, Topic, Utterance};
use scenefold::geometry::{Pose, Size};
use scenefold::graph::{Label, Node, Region, StateHash};
use scenefold::modality::Desk;
use scenefold::recording::{
    Chain, Checkpoint, Ending, Meta, Recording, Status as Verdict, Walk, verify,
};
use scenefold::time::Stamp;
use scenefold::updater::{Config, Updater};
use scenefold::wire::{self, CheckpointHead, ros2};

use crate::house::{
    Input, MANY_CHECKPOINTS, START, apply, at, events, house, id, label, record, room, sensor,
    status,
};

fn task(task_id: &str, object: Option<NodeRef>) -> Event {
    let instruction = "Take it away.".to_owned();
    Event::Task(Task { task_id: task_id.to_owned(), instruction, object, ..Task::default() })
}

fn report(report: TaskStatus) -> Event {
    Event::TaskStatus(report)
}

/// A report that names the object.
fn of(task: &str, what: Status, object: &str) -> TaskStatus {
    TaskStatus { object: Some(NodeRef::id(id(object))), ..status(task, what) }
}

fn transform() -> Event {
    let stamp = ros2::Time { sec: 1_767_571_202, nanosec: 0 };
    let transform = ros2::TransformStamped {
        header: ros2::Header { stamp, frame_id: "map" },
        child_frame_id: "base_link",
        translation: [1.0, 2.0, 0.0],
        rotation_xyzw: [0.0, 0.0, 0.0, 1.0],
    };
    sensor("/tf", "tf2_msgs/msg/TFMessage", ros2::encode_tf(&[transform]))
}

fn image() -> Event {
    let stamp = ros2::Time { sec: 1_767_571_203, nanosec: 0 };
    let image = ros2::CompressedImage {
        header: ros2::Header { stamp, frame_id: "camera_color_optical_frame" },
        format: "png",
        data: &[0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n'],
    };
    sensor(
        "/camera/color/image/compressed",
        "sensor_msgs/msg/CompressedImage",
        ros2::encode_compressed_image(&image),
    )
}

/// Every rejection that statuses can cause, and what is right in between.
fn story() -> Vec<Input> {
    use Status::{Done, Failed, Picked, Placed, Started};
    let pose = |x, y, z| Some(Pose::at([x, y, z]).unwrap());
    let speaker = "Ada".to_owned();
    let inputs = vec![
        Event::InitialGraph(house()),
        Event::Utterance(Utterance { speaker, text: "Where is my mug?".to_owned() }),
        transform(),
        image(),
        Event::Tick,
        // nothing_named
        task("t1", None),
        report(status("t1", Started)),
        report(status("t1", Picked)),
        // unknown_object, and then the addition of what was picked
        report(TaskStatus { object: Some(label("vase")), ..status("t2", Picked) }),
        report(TaskStatus { room: Some(label("bedroom")), ..status("t2", Placed) }),
        report(status("t2", Done)),
        // ambiguous, placed_ambiguous
        task("t3", Some(label("mug"))),
        report(status("t3", Picked)),
        report(TaskStatus { room: Some(label("bedroom")), ..status("t3", Placed) }),
        // unknown_room, unknown_support, no_target
        report(TaskStatus { room: Some(label("attic")), ..of("t4", Placed, "O2") }),
        report(TaskStatus { support: Some(label("shelf")), ..of("t4", Placed, "O2") }),
        report(of("t4", Placed, "O2")),
        // ambiguous room
        report(TaskStatus { room: Some(label("closet")), ..of("t4", Placed, "O2") }),
        // already_held, failed_holding, done_holding
        report(of("t5", Picked, "O2")),
        report(of("t6", Picked, "O2")),
        report(status("t5", Failed)),
        report(status("t6", Done)),
        // unknown_task
        report(status("t7", Picked)),
        report(TaskStatus { support: Some(label("table")), ..of("t8", Placed, "O2") }),
        // refused: the table cannot be put on the bowl that stands on it
        report(TaskStatus { support: Some(label("bowl")), ..of("t8", Placed, "O1") }),
        // a move at a measured pose, and a drop
        report(of("t9", Picked, "O4")),
        report(TaskStatus { pose: pose(1.1, 0.2, 0.6), ..status("t9", Placed) }),
        report(of("t10", Picked, "O5")),
        report(TaskStatus { pose: pose(5.0, -1.0, 0.05), ..status("t10", Failed) }),
        // nothing picked: one move; something in the hand at the end
        report(TaskStatus { room: Some(label("kitchen")), ..of("t11", Placed, "O6") }),
        report(of("t12", Picked, "O3")),
    ];
    inputs.into_iter().zip(1..).map(|(input, second)| (at(second), input)).collect()
}

/// A recording as it is written without a recorder, so that it may hold anything.
struct ByHand {
    writer: LogWriter<Vec<u8>>,
    meta: Meta,
    chain: Chain,
    world: World,
    order: u64,
    changes: u64,
    primitives: u64,
    at: Stamp,
}

impl ByHand {
    fn new() -> Self {
        let mut writer = LogWriter::new(Vec::new(), LogOptions::default()).unwrap();
        let meta = Meta::new(Config::default(), 1, StateHash([0; 32]));
        let (name, map) = meta.record();
        writer.write_metadata(name, map).unwrap();
        let (world, chain) = (World::default(), Chain::after(meta.first_link()));
        Self { writer, meta, chain, world, order: 0, changes: 0, primitives: 0, at: START }
    }

    fn write(&mut self, logged: &Logged) {
        let topic = logged.event.topic();
        let (spec, data) = match &logged.event {
            Event::Sensor(message) => {
                let image = message.schema_name.contains("Image");
                let class = if image { ChunkClass::PackedSensor } else { ChunkClass::Event };
                let schema = SchemaSpec {
                    name: message.schema_name.to_string(),
                    encoding: message.schema_encoding.to_string(),
                    data: message.schema.to_vec(),
                };
                (spec(&topic, &message.message_encoding, schema, class), message.data.to_vec())
            }
            event => (own(&topic), wire::encode(event)),
        };
        let channel = self.writer.register(spec).unwrap();
        let (time, published) = (logged.at.nanos(), logged.published.nanos());
        self.writer.write(channel, logged.order as u32, time, published, &data).unwrap();
        self.chain.add(&topic.name(), logged.order, time, published, &data);
        self.note(logged);
    }

    fn note(&mut self, logged: &Logged) {
        (self.order, self.at) = (logged.order, logged.at);
        match &logged.event {
            Event::Change(record) => self.changes = record.seq,
            Event::Transaction(transaction) => self.primitives += transaction.steps.len() as u64,
            _ => {}
        }
        apply(&mut self.world, &logged.event);
    }

    /// Writes what no detector derived, as the next event.
    fn next(&mut self, event: Event) {
        let (order, at) = (self.order + 1, self.at);
        self.write(&Logged { order, at, published: at, event });
    }

    fn checkpoint(&mut self, updater: &Updater) {
        let Checkpoint { order, changes, at, state_hash, memory_hash, state, .. } =
            Checkpoint::of(updater);
        self.writer.flush().unwrap();
        let head = CheckpointHead {
            version: 1,
            order,
            changes,
            at,
            chain: self.chain.close().0,
            state_hash: state_hash.0,
            memory_hash: memory_hash.0,
            state_size: state.len() as u64,
        };
        let channel = self.writer.register(own(&Topic::Checkpoint)).unwrap();
        let data = wire::encode_checkpoint(&head, &state);
        self.writer.write(channel, order as u32, at.nanos(), at.nanos(), &data).unwrap();
    }

    fn finish(mut self) -> Vec<u8> {
        self.writer.flush().unwrap();
        let ending = Ending {
            events: self.order,
            changes: self.changes,
            primitives: self.primitives,
            link: self.chain.link(),
            state_hash: self.world.graph().hash(),
            meta: &self.meta,
        };
        let (name, map) = ending.seal().record();
        self.writer.write_metadata(name, map).unwrap();
        self.writer.finish().unwrap()
    }
}

fn own(topic: &Topic) -> ChannelSpec {
    let schema = wire::schema_of(topic).unwrap();
    let class =
        if *topic == Topic::Checkpoint { ChunkClass::Checkpoint } else { ChunkClass::Event };
    let text = SchemaSpec {
        name: schema.name.to_owned(),
        encoding: schema.encoding.to_owned(),
        data: schema.data.to_vec(),
    };
    spec(topic, schema.message_encoding, text, class)
}

fn spec(topic: &Topic, encoding: &str, schema: SchemaSpec, class: ChunkClass) -> ChannelSpec {
    let word = match class {
        ChunkClass::Event => "event",
        ChunkClass::Checkpoint => "checkpoint",
        ChunkClass::Sensor | ChunkClass::PackedSensor => "sensor",
    };
    ChannelSpec {
        topic: topic.name().into_owned(),
        message_encoding: encoding.to_owned(),
        metadata: BTreeMap::from([("scenefold.class".to_owned(), word.to_owned())]),
        schema: Some(schema),
        class,
    }
}

fn claim(action: Action, object: NodeRef, order: u64, at: Stamp) -> Claim {
    Claim {
        modality: Modality::Perception,
        detector: "by hand/1".into(),
        action,
        object,
        source_room: None,
        target_room: None,
        support: None,
        pose: None,
        size: None,
        confidence: 0.75,
        occurred: Occurred { not_before: None, not_after: Some(at) },
        held: false,
        evidence: vec![EvidenceRef { topic: "/clock".into(), order }],
    }
}

/// What a camera might have told: gone, gone again, there already, new, grown.
fn claims(order: u64, at: Stamp) -> Vec<Claim> {
    let named = |text| NodeRef::id(id(text));
    let claim = |action, object| claim(action, object, order, at);
    vec![
        claim(Action::Removed, named("O5")),
        claim(Action::Removed, named("O5")),
        Claim { target_room: Some(label("bedroom")), ..claim(Action::Added, named("O6")) },
        Claim {
            target_room: Some(label("bedroom")),
            size: Size::new(0.3, 0.3, 1.2).ok(),
            pose: Pose::at([6.0, 1.0, 0.6]).ok(),
            ..claim(Action::Added, label("plant"))
        },
        Claim {
            support: Some(label("bed")),
            size: Size::new(0.1, 0.1, 0.12).ok(),
            ..claim(Action::Moved, named("O4"))
        },
    ]
}

/// What no claim comes to.
fn edits(order: u64, at: Stamp) -> Transaction {
    let evidence = EvidenceRef { topic: "/clock".into(), order };
    let region =
        |name: &str| Region { label: Label::new(name).unwrap(), extent: None, parent: None };
    let floor = Node::Region(region("ground floor"), vec![]);
    let hall = Node::Region(
        Region { parent: Some(id("F1")), ..room("hall", 20.0) },
        vec![id("R1"), id("R2")],
    );
    let seen = vec![
        Sighting { id: id("O1"), pose: None, size: None },
        Sighting { id: id("O2"), pose: Pose::at([1.0, 0.1, 0.6]).ok(), size: None },
        Sighting { id: id("O6"), pose: None, size: Size::new(0.9, 2.0, 0.6).ok() },
    ];
    let primitives = vec![
        Primitive::Observe { at, seen },
        Primitive::SetDecay { id: id("O4"), decay_rate: 0.5, origin: "learned".to_owned() },
        Primitive::Add { id: id("F1"), node: floor },
        Primitive::Add { id: id("R5"), node: hall },
        Primitive::Remove { id: id("R4"), to: Departure::Gone, at },
    ];
    let step = |primitive| Step { cause: Cause::Evidence(evidence.clone()), primitive };
    Transaction { at, steps: primitives.into_iter().map(step).collect() }
}

/// The bytes of `every_primitive`.
pub fn every_primitive() -> Vec<u8> {
    let mut by_hand = ByHand::new();
    let mut updater = Updater::new(Config::default());
    for (at, input) in story() {
        updater.update(at, input).unwrap().iter().for_each(|logged| by_hand.write(logged));
        if updater.order() == 40 || updater.order() == 41 {
            by_hand.checkpoint(&updater);
        }
    }
    let (order, now) = (by_hand.order + 1, at(3600));
    by_hand.write(&Logged { order, at: now, published: now, event: Event::Tick });
    let plan = PlanConfig { decay_rate: 0.0, size: Size::new(0.2, 0.2, 0.2).unwrap() };
    let mut world = by_hand.world.clone();
    let mut desk = Desk::new(&mut world, &plan, now, by_hand.changes);
    for claim in claims(order, now) {
        let _ = desk.claim(claim);
    }
    desk.into_events().into_iter().for_each(|event| by_hand.next(event));
    by_hand.next(Event::Transaction(edits(order, now)));
    by_hand.finish()
}

fn every_rejection(path: &Path) {
    record(path, &story(), &MANY_CHECKPOINTS, 10);
}

/// Writes both to the folder asked for, else to one that is forgotten.
fn make() -> (PathBuf, Option<tempfile::TempDir>) {
    let asked = std::env::var_os("SCENEFOLD_MAKE_RECORDINGS").map(PathBuf::from);
    let forgotten = asked.is_none().then(|| tempfile::tempdir().unwrap());
    let folder = asked.or(forgotten.as_ref().map(|f| f.path().to_owned())).unwrap();
    for (name, bytes) in [("every_primitive", Some(every_primitive())), ("every_rejection", None)] {
        let path = folder.join(name).with_extension("mcap");
        assert!(!path.exists(), "{} is never overwritten", path.display());
        match bytes {
            Some(bytes) => fs::write(path, bytes).unwrap(),
            None => every_rejection(&path),
        }
    }
    (folder, forgotten)
}

/// The names of all primitives, with where a removal went, and the codes of all rejections.
fn words(recording: &Recording) -> BTreeSet<String> {
    let mut words = BTreeSet::new();
    for logged in events(recording, Walk::Events) {
        match logged.event {
            Event::Transaction(transaction) => {
                for Step { primitive, .. } in transaction.steps {
                    let to = match primitive {
                        Primitive::Remove { to, .. } => format!(" {to:?}").to_lowercase(),
                        _ => String::new(),
                    };
                    words.insert(format!("{}{to}", primitive.name()));
                }
            }
            Event::Change(record) => {
                if let Outcome::Rejected { code, .. } = record.outcome {
                    words.insert(code.into_owned());
                }
            }
            _ => {}
        }
    }
    words
}

const BY_STATUSES: [&str; 16] = [
    "add",
    "already_held",
    "ambiguous",
    "done_holding",
    "failed_holding",
    "find",
    "move",
    "no_target",
    "nothing_named",
    "placed_ambiguous",
    "refused",
    "remove held",
    "unknown_object",
    "unknown_room",
    "unknown_support",
    "unknown_task",
];

#[test]
fn the_recordings_made_by_hand_hold_all_there_is() {
    let (folder, _forgotten) = make();
    let open = |name: &str| Recording::open(&folder.join(name)).unwrap();
    let by_statuses: BTreeSet<String> = BY_STATUSES.map(str::to_owned).into();
    assert_eq!(words(&open("every_rejection.mcap")), by_statuses);
    let by_hand = ["already_absent", "already_present", "observe", "remove gone", "set_decay"];
    let all: BTreeSet<String> = by_statuses.into_iter().chain(by_hand.map(str::to_owned)).collect();
    assert_eq!(words(&open("every_primitive.mcap")), all);

    let intact = verify(&folder.join("every_rejection.mcap"), &mut |_| ()).unwrap();
    assert_eq!(intact.status, Verdict::Intact, "{:?}", intact.findings);
    assert!(intact.checkpoints > 0);
    // Nothing is lost or edited, but no detector of today derives what was written by hand.
    let by_hand = verify(&folder.join("every_primitive.mcap"), &mut |_| ()).unwrap();
    assert_eq!(by_hand.status, Verdict::Nondeterministic, "{:?}", by_hand.findings);
    assert_eq!(by_hand.findings.len(), 1, "{:?}", by_hand.findings);
    assert_eq!(by_hand.checkpoints, 1);
}

#[test]
fn why_saves_the_picture_that_caused_a_removal() {
    let jpeg = vec![0xff, 0xd8, 1, 2, 3];
    let header = ros2::Header { stamp: ros2::Time::default(), frame_id: "camera" };
    let image = ros2::CompressedImage { header, format: "jpeg", data: &jpeg };
    let mut by_hand = ByHand::new();
    by_hand.next(Event::InitialGraph(house()));
    by_hand.next(sensor(
        "/camera/color/image/compressed",
        "sensor_msgs/msg/CompressedImage",
        ros2::encode_compressed_image(&image),
    ));
    let plan = PlanConfig { decay_rate: 0.0, size: Size::new(0.2, 0.2, 0.2).unwrap() };
    let mut world = by_hand.world.clone();
    let mut desk = Desk::new(&mut world, &plan, by_hand.at, 0);
    let evidence = EvidenceRef { topic: "/camera/color/image/compressed".into(), order: 2 };
    let gone = claim(Action::Removed, NodeRef::id(id("O4")), 2, START);
    desk.claim(Claim { evidence: vec![evidence], ..gone }).unwrap();
    desk.into_events().into_iter().for_each(|event| by_hand.next(event));
    let folder = tempfile::tempdir().unwrap();
    let (path, out) = (folder.path().join("a.mcap"), folder.path().join("pictures"));
    fs::write(&path, by_hand.finish()).unwrap();
    let mut why = std::process::Command::new(env!("CARGO_BIN_EXE_scenefold"));
    assert!(why.arg("why").arg(&path).arg("O4").arg("--out").arg(&out).status().unwrap().success());
    assert_eq!(fs::read(out.join("2.jpg")).unwrap(), jpeg);
}
