//! Any graph: few nodes of few kinds, so that two of them have much in common.

use proptest::prelude::*;

use crate::geometry::{Pose, Size};
use crate::graph::{Label, Layer, NodeId, Object, PoseSource, Region, SceneGraph};
use crate::time::Stamp;

const LABELS: [&str; 3] = ["mug", "table", "tv remote"];

fn label() -> impl Strategy<Value = Label> {
    prop::sample::select(&LABELS).prop_map(|text| Label::new(text).unwrap())
}

fn pose() -> impl Strategy<Value = Pose> {
    let turn = prop::sample::select(vec![[1.0, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 1.0]]);
    (0..3_i32, turn).prop_map(|(x, turn)| Pose::new([f64::from(x), 0.5, 0.0], turn).unwrap())
}

fn size() -> impl Strategy<Value = Size> {
    (1..3_i32).prop_map(|side| Size::new(f64::from(side) / 10.0, 0.1, 0.1).unwrap())
}

/// An object in one of `rooms` rooms that may rest on one of those made before it.
#[derive(Clone, Debug)]
struct Draft {
    index: u32,
    room: prop::sample::Index,
    support: Option<prop::sample::Index>,
    object: Object,
}

prop_compose! {
    fn draft()(
        index in 0..9_u32,
        room: prop::sample::Index,
        support: Option<prop::sample::Index>,
        label in label(),
        pose in pose(),
        size in size(),
        decay_rate in prop::sample::select(vec![0.0, 0.5]),
        seconds in 0..3_u64,
        source in prop::sample::select(vec![
            PoseSource::Measured, PoseSource::Topological, PoseSource::Held,
        ]),
    ) -> Draft {
        let object = Object {
            label,
            pose,
            size,
            decay_rate,
            last_observed: Stamp::from_nanos(seconds * 1_000_000_000),
            pose_source: source,
            room: NodeId::new(Layer::Room, 0).unwrap(),
            support: None,
        };
        Draft { index, room, support, object }
    }
}

/// Rooms, floors, buildings and access, without objects.
pub fn regions() -> impl Strategy<Value = SceneGraph> {
    let extent = prop::option::of((pose(), size()));
    let room = (label(), extent, 0..3_u32);
    let links = prop::collection::vec((0..4_u32, 0..4_u32), 0..4);
    (prop::collection::btree_map(0..4_u32, room, 1..4), links, 0..3_u32).prop_map(
        |(rooms, links, floors)| {
            let mut graph = SceneGraph::new();
            let region = |name: &str, parent| Region {
                label: Label::new(name).unwrap(),
                extent: None,
                parent,
            };
            let building = NodeId::new(Layer::Building, 0).unwrap();
            graph.insert_region(building, region("house", None)).unwrap();
            for floor in 0..floors {
                let id = NodeId::new(Layer::Floor, floor).unwrap();
                graph.insert_region(id, region("floor", Some(building))).unwrap();
            }
            for (index, (label, extent, parent)) in rooms {
                let parent = match parent {
                    0 => Some(building),
                    n if n <= floors => NodeId::new(Layer::Floor, n - 1),
                    _ => None,
                };
                let id = NodeId::new(Layer::Room, index).unwrap();
                graph.insert_region(id, Region { label, extent, parent }).unwrap();
            }
            for (a, b) in links {
                let id = |index| NodeId::new(Layer::Room, index).unwrap();
                // Links to rooms that are not there are refused, and that is all right.
                let _ = graph.connect(id(a), id(b));
            }
            graph
        },
    )
}

fn furnish(mut graph: SceneGraph, drafts: Vec<Draft>) -> SceneGraph {
    let rooms: Vec<NodeId> = graph.rooms().map(|(id, _)| id).collect();
    let mut placed: Vec<NodeId> = Vec::new();
    for draft in drafts {
        let id = NodeId::new(Layer::Object, draft.index).unwrap();
        let below = draft.support.filter(|_| !placed.is_empty());
        let support = below.map(|index| *index.get(&placed));
        let on_held = support.and_then(|on| graph.object(on)).is_some_and(Object::is_held);
        let pose_source = if on_held { PoseSource::Held } else { draft.object.pose_source };
        let room = *draft.room.get(&rooms);
        let object = Object { pose_source, room, support, ..draft.object };
        if graph.insert_object(id, object).is_ok() {
            placed.push(id);
        }
    }
    graph
}

/// Any graph.
pub fn graph() -> impl Strategy<Value = SceneGraph> {
    (regions(), prop::collection::vec(draft(), 0..10))
        .prop_map(|(regions, drafts)| furnish(regions, drafts))
}

/// Any two graphs with the same rooms.
pub fn two_in_one_house() -> impl Strategy<Value = (SceneGraph, SceneGraph)> {
    let drafts = || prop::collection::vec(draft(), 0..10);
    (regions(), drafts(), drafts())
        .prop_map(|(regions, a, b)| (furnish(regions.clone(), a), furnish(regions, b)))
}
