//! A large house with a busy robot: the graph at the start and the inputs, equal in every run.

use scenefold::change::NodeRef;
use scenefold::event::{Event, SensorMessage, Status, TaskStatus};
use scenefold::geometry::{Pose, Size};
use scenefold::graph::{Label, Layer, NodeId, Object, PoseSource, Region, SceneGraph};
use scenefold::time::Stamp;

/// Objects in the house.
pub const OBJECTS: u32 = 10_000;
/// The first of them are furniture, on which the others rest.
const FURNITURE: u32 = 1_000;
const ROOMS: u32 = 20;
const START: u64 = 1_767_571_200_000_000_000;
/// Primitives that one pick or place comes to: `Find`, and `Remove` or `Add`.
pub const PRIMITIVES_PER_UPDATE: u64 = 2;

/// Numbers that look random and are equal in every run (xorshift).
pub struct Dice(u64);

impl Dice {
    /// Dice that always fall the same way.
    pub fn new() -> Self {
        Self(0x9e37_79b9_7f4a_7c15)
    }

    /// A number below `bound`.
    pub fn below(&mut self, bound: u32) -> u32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (((self.0 >> 32) * u64::from(bound)) >> 32) as u32
    }

    fn metres(&mut self, range_m: f64) -> f64 {
        f64::from(self.below(1 << 24)) / f64::from(1 << 24) * range_m
    }

    /// Somewhere in the house, turned about the vertical.
    pub fn pose(&mut self) -> Pose {
        let place = [self.metres(40.0), self.metres(40.0), self.metres(2.5)];
        Pose::new(place, [1.0, 0.0, 0.0, self.metres(1.0)]).expect("it is within the house")
    }
}

/// A node of the house.
pub fn node(layer: Layer, index: u32) -> NodeId {
    NodeId::new(layer, index).expect("a small index")
}

/// The house before the robot begins.
pub fn house() -> SceneGraph {
    let mut graph = SceneGraph::new();
    let mut dice = Dice::new();
    for n in 0..ROOMS {
        let extent = Some((dice.pose(), Size::new(8.0, 8.0, 3.0).expect("a valid size")));
        let label = Label::new(&format!("room {n}")).expect("a valid label");
        let region = Region { label, extent, parent: None };
        graph.insert_region(node(Layer::Room, n), region).expect("a new room");
    }
    let labels: Vec<Label> =
        (0..200).map(|n| Label::new(&format!("thing {n}")).expect("a valid label")).collect();
    for n in 0..OBJECTS {
        let object = Object {
            label: labels[dice.below(200) as usize].clone(),
            pose: dice.pose(),
            size: Size::new(0.1 + dice.metres(0.3), 0.2, 0.3).expect("a valid size"),
            decay_rate: 1.0e-5,
            last_observed: Stamp::from_nanos(START),
            pose_source: PoseSource::Measured,
            room: node(Layer::Room, dice.below(ROOMS)),
            support: (n >= FURNITURE).then(|| node(Layer::Object, dice.below(FURNITURE))),
        };
        graph.insert_object(node(Layer::Object, n), object).expect("a new object");
    }
    graph
}

/// The initial graph, then `updates` picks and places in turn, about one a second.
pub fn inputs(updates: u64) -> impl Iterator<Item = (Stamp, Event)> {
    let mut dice = Dice::new();
    let mut thing = FURNITURE;
    let mut at = START;
    let initial = (Stamp::from_nanos(START), Event::InitialGraph(house()));
    let statuses = (0..updates).map(move |n| {
        at += 500_000_000 + u64::from(dice.below(1_000_000_000));
        let mut status = TaskStatus::bare(format!("task-{}", n / 2), Status::Picked);
        if n % 2 == 0 {
            thing = FURNITURE + dice.below(OBJECTS - FURNITURE);
        } else {
            status.status = Status::Placed;
            status.pose = Some(dice.pose());
            status.support = Some(by_id(dice.below(FURNITURE)));
        }
        status.object = Some(by_id(thing));
        (Stamp::from_nanos(at), Event::TaskStatus(status))
    });
    std::iter::once(initial).chain(statuses)
}

fn by_id(index: u32) -> NodeRef {
    NodeRef { id: Some(node(Layer::Object, index)), label: None }
}

/// A picture that does not compress, as large as that of a camera.
pub fn picture(dice: &mut Dice) -> Event {
    let schema = scenefold::wire::ros2::COMPRESSED_IMAGE;
    let data: Vec<u8> =
        (0..PICTURE_BYTES / 4).flat_map(|_| dice.below(u32::MAX).to_le_bytes()).collect();
    Event::Sensor(SensorMessage {
        topic: "/camera/color/image/compressed".into(),
        message_encoding: schema.message_encoding.into(),
        schema_name: schema.name.into(),
        schema_encoding: schema.encoding.into(),
        schema: schema.data.into(),
        data: data.into(),
    })
}

/// Size of a picture.
pub const PICTURE_BYTES: u64 = 256 << 10;
