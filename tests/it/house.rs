//! A small house, random inputs to it, and recordings of both. Shared by the tests.

use std::ops::ControlFlow;
use std::path::Path;

use proptest::option;
use proptest::prelude::*;
use proptest::sample::select;
use scenefold::change::{NodeRef, World};
use scenefold::event::{Event, Logged, SensorMessage, Status, Task, TaskStatus, Utterance};
use scenefold::geometry::{Pose, Size};
use scenefold::graph::{Label, NodeId, Object, PoseSource, Region, SceneGraph};
use scenefold::recording::{Recorder, RecorderOptions, Recording, Seal, SyncPolicy, Walk};
use scenefold::time::Stamp;
use scenefold::updater::Config;

/// An input and when its source says it happened.
pub type Input = (Stamp, Event);

/// The first moment of every test.
pub const START: Stamp = Stamp::from_nanos(1_767_571_200_000_000_000);

/// Options under which checkpoints are as frequent as can be.
pub const MANY_CHECKPOINTS: RecorderOptions =
    RecorderOptions { sync: SyncPolicy::Never, zstd_level: 3, checkpoint_ratio: 1 };

pub fn id(text: &str) -> NodeId {
    text.parse().unwrap()
}

pub fn label(text: &str) -> NodeRef {
    NodeRef::label(Label::new(text).unwrap())
}

/// The moment `seconds` after the first one.
pub fn at(seconds: u64) -> Stamp {
    START.plus_nanos(seconds * 1_000_000_000)
}

pub fn object(name: &str, room: &str, support: Option<&str>, at: [f64; 3]) -> Object {
    Object {
        label: Label::new(name).unwrap(),
        pose: Pose::at(at).unwrap(),
        size: Size::new(0.1, 0.2, 0.1).unwrap(),
        decay_rate: 0.001,
        last_observed: START,
        pose_source: PoseSource::Measured,
        room: id(room),
        support: support.map(id),
    }
}

pub fn room(name: &str, x: f64) -> Region {
    let extent = (Pose::at([x, 0.0, 1.0]).unwrap(), Size::new(4.0, 4.0, 2.0).unwrap());
    Region { label: Label::new(name).unwrap(), extent: Some(extent), parent: None }
}

/// Two closets, a kitchen with a mug and a bowl of cereal on a table, and a bedroom with another
/// mug.
pub fn house() -> SceneGraph {
    let mut graph = SceneGraph::new();
    let rooms = [("R1", "kitchen"), ("R2", "bedroom"), ("R3", "closet"), ("R4", "closet")];
    for (n, (node, name)) in rooms.into_iter().enumerate() {
        graph.insert_region(id(node), room(name, n as f64 * 5.0)).unwrap();
    }
    graph.connect(id("R1"), id("R2")).unwrap();
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

pub fn status(task: &str, status: Status) -> TaskStatus {
    TaskStatus::bare(task, status)
}

/// A message of ROS 2 that is passed through.
pub fn sensor(topic: &str, schema_name: &str, data: Vec<u8>) -> Event {
    let schema = scenefold::wire::ros2::schema_named(schema_name).unwrap();
    Event::Sensor(SensorMessage {
        topic: topic.into(),
        message_encoding: schema.message_encoding.into(),
        schema_name: schema.name.into(),
        schema_encoding: schema.encoding.into(),
        schema: schema.data.into(),
        data: data.into(),
    })
}

fn thing() -> BoxedStrategy<NodeRef> {
    let labels = ["table", "bowl", "cereal", "mug", "bed", "spoon", "unicorn"].map(label);
    let ids = ["O1", "O2", "O3", "O4", "O5", "O6", "O7", "O99"].map(|text| NodeRef::id(id(text)));
    prop_oneof![select(labels.to_vec()), select(ids.to_vec())].boxed()
}

fn place() -> BoxedStrategy<NodeRef> {
    let labels = ["kitchen", "bedroom", "closet", "attic"].map(label);
    let ids = ["R1", "R2", "R3", "R77"].map(|text| NodeRef::id(id(text)));
    prop_oneof![3 => select(labels.to_vec()), 2 => select(ids.to_vec())].boxed()
}

fn pose() -> impl Strategy<Value = Pose> {
    (-2.0..12.0_f64, -2.0..2.0_f64, 0.0..2.0_f64, -1.0..1.0_f64)
        .prop_map(|(x, y, z, turn)| Pose::new([x, y, z], [0.5, 0.0, 0.0, turn]).unwrap())
}

fn task_id() -> impl Strategy<Value = String> {
    select(vec!["a", "b", "c"]).prop_map(str::to_owned)
}

prop_compose! {
    fn task()(
        task_id in task_id(), object in option::weighted(0.8, thing()),
        source_room in option::of(place()), target_room in option::of(place()),
        support in option::of(thing()),
    ) -> Event {
        let instruction = "Tidy up, please.".to_owned();
        Event::Task(Task { task_id, instruction, object, source_room, target_room, support })
    }
}

prop_compose! {
    fn report()(
        task_id in task_id(),
        status in select(vec![
            Status::Started, Status::Picked, Status::Picked, Status::Picked, Status::Placed,
            Status::Placed, Status::Placed, Status::Failed, Status::Done,
        ]),
        pose in option::of(pose()), object in option::weighted(0.4, thing()),
        room in option::weighted(0.4, place()), support in option::weighted(0.4, thing()),
    ) -> Event {
        Event::TaskStatus(TaskStatus { task_id, status, pose, object, room, support })
    }
}

fn other() -> BoxedStrategy<Event> {
    let utterance = ("[a-z]{0,4}", "[a-z ]{1,30}")
        .prop_map(|(speaker, text)| Event::Utterance(Utterance { speaker, text }));
    let bytes = proptest::collection::vec(any::<u8>(), 0..80);
    let image = bytes.clone().prop_map(|data| {
        sensor("/camera/color/image/compressed", "sensor_msgs/msg/CompressedImage", data)
    });
    let tf = bytes.prop_map(|data| sensor("/tf", "tf2_msgs/msg/TFMessage", data));
    prop_oneof![Just(Event::Tick), utterance, image, tf].boxed()
}

/// One input, and how long after the last one it is stamped, in milliseconds.
fn step() -> BoxedStrategy<(i64, Event)> {
    let event = prop_oneof![3 => task(), 8 => report(), 2 => other()];
    let wait = prop_oneof![6 => 1..5_000_i64, 2 => Just(0_i64), 1 => -3_000..0_i64];
    (wait, event).boxed()
}

/// The house, and then inputs of every kind; their clock runs backwards at times.
pub fn inputs(count: std::ops::Range<usize>) -> BoxedStrategy<Vec<Input>> {
    proptest::collection::vec(step(), count)
        .prop_map(|steps| {
            let mut now = 1_000_000_000_i64;
            let mut inputs = vec![(START, Event::InitialGraph(house()))];
            for (wait, event) in steps {
                now = (now + wait * 1_000_000).max(0);
                inputs.push((START.plus_nanos(now as u64), event));
            }
            inputs
        })
        .boxed()
}

/// Records `inputs` into a new file; returns what was written, and the seal.
pub fn record(
    path: &Path,
    inputs: &[Input],
    options: &RecorderOptions,
    chunk_after: usize,
) -> (Vec<Logged>, Seal) {
    let mut recorder = Recorder::create(path, Config::default(), options).unwrap();
    let events = feed(&mut recorder, inputs, chunk_after);
    (events, recorder.finish().unwrap())
}

/// Records `inputs`, and closes the open chunks after every `chunk_after` of them.
pub fn feed(recorder: &mut Recorder, inputs: &[Input], chunk_after: usize) -> Vec<Logged> {
    let mut events = Vec::new();
    for (n, (at, input)) in inputs.iter().enumerate() {
        events.extend(recorder.record(*at, input.clone()).unwrap().events);
        if n % chunk_after == chunk_after - 1 {
            recorder.sync().unwrap();
        }
    }
    events
}

/// Every event of a recording, in order.
pub fn events(recording: &Recording, walk: Walk) -> Vec<Logged> {
    let mut events = Vec::new();
    recording
        .visit_events(walk, (1, u64::MAX), &mut |logged| {
            events.push(logged.clone());
            ControlFlow::Continue(())
        })
        .unwrap();
    events
}

/// The plainest fold there is: what every other way to a state is compared with.
pub fn apply(world: &mut World, event: &Event) {
    match event {
        Event::InitialGraph(graph) => *world = World::from_graph(graph.clone()),
        Event::Transaction(transaction) => transaction.apply(world).unwrap(),
        _ => {}
    }
}
