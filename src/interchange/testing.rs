//! Arbitrary graphs and the shared data, for the tests of this folder.

use proptest::prelude::*;

use crate::geometry::{Pose, Size};
use crate::graph::{Label, Layer, NodeId, Object, PoseSource, Region, SceneGraph};
use crate::time::Stamp;

/// The text of a file of the shared data; `None` where there is none.
#[allow(clippy::disallowed_methods)]
pub fn shared(path: &str) -> Option<String> {
    let folder = std::env::var("SCENEFOLD_SHARED_DATA").ok()?;
    Some(std::fs::read_to_string(format!("{folder}/{path}")).unwrap())
}

pub fn id(text: &str) -> NodeId {
    text.parse().unwrap()
}

fn pose() -> impl Strategy<Value = Pose> {
    (prop::array::uniform3(-50.0..50.0_f64), prop::array::uniform4(-1.0..1.0_f64))
        .prop_map(|(position, wxyz)| Pose::new(position, wxyz).unwrap_or(Pose::IDENTITY))
}

fn size() -> impl Strategy<Value = Size> {
    prop::array::uniform3(1_i64..9_000_000).prop_map(|um| Size::from_micrometres(um).unwrap())
}

fn label() -> impl Strategy<Value = Label> {
    "[a-zà-ž\"\\\\<>]{1,6}( [a-z_]{1,6})?".prop_map(|text| Label::new(&text).unwrap())
}

fn extent() -> impl Strategy<Value = Option<(Pose, Size)>> {
    prop::option::of((pose(), size()))
}

prop_compose! {
    fn object()(label in label(), pose in pose(), size in size(), rate in 0.0..1.0_f64,
                seen in 0..i64::MAX as u64, source in 0..3_u8) -> Object {
        let pose_source = [PoseSource::Measured, PoseSource::Topological, PoseSource::Held]
            [usize::from(source)];
        let last_observed = Stamp::from_nanos(seen);
        let room = NodeId::new(Layer::Room, 0).unwrap();
        Object { label, pose, size, decay_rate: rate, last_observed, pose_source, room,
                 support: None }
    }
}

prop_compose! {
    /// A graph with a few nodes of every layer, whatever fits together of what was drawn.
    pub fn scene_graph()(
        buildings in prop::collection::vec((label(), extent()), 0..3),
        floors in prop::collection::vec((label(), extent(), prop::option::of(0..3_u32)), 0..3),
        rooms in prop::collection::vec((label(), extent(), prop::option::of(0..6_u32)), 1..5),
        access in prop::collection::vec((0..5_u32, 0..5_u32), 0..6),
        objects in prop::collection::vec(
            (object(), 0..400_u32, 0..5_u32, prop::option::of(0..12_u32)), 0..12),
    ) -> SceneGraph {
        let mut graph = SceneGraph::new();
        let id = |layer, index| NodeId::new(layer, index).unwrap();
        for (n, (label, extent)) in (0..).zip(buildings) {
            graph.insert_region(id(Layer::Building, n), Region { label, extent, parent: None })
                .unwrap();
        }
        for (n, (label, extent, parent)) in (0..).zip(floors) {
            let parent = parent.map(|n| id(Layer::Building, n)).filter(|id| graph.contains(*id));
            graph.insert_region(id(Layer::Floor, n * 2), Region { label, extent, parent }).unwrap();
        }
        let mut known = Vec::new();
        for (n, (label, extent, parent)) in (0..).zip(rooms) {
            let parent = parent.map(|n| match n % 2 {
                0 => id(Layer::Building, n / 2),
                _ => id(Layer::Floor, n / 2 * 2),
            });
            let parent = parent.filter(|id| graph.contains(*id));
            known.push(id(Layer::Room, n * 7));
            graph.insert_region(known[n as usize], Region { label, extent, parent }).unwrap();
        }
        let room = |n: u32| known[n as usize % known.len()];
        for (a, b) in access {
            let _ = graph.connect(room(a), room(b));
        }
        let mut inserted: Vec<NodeId> = Vec::new();
        for (object, index, in_room, support) in objects {
            let object_id = id(Layer::Object, index);
            let support = support.and_then(|n| inserted.get(n as usize).copied());
            let object = Object { room: room(in_room), support, ..object };
            if graph.insert_object(object_id, object.clone()).is_ok()
                || graph.insert_object(object_id, Object { support: None, ..object }).is_ok()
            {
                inserted.push(object_id);
            }
        }
        graph
    }
}
