//! A house as a scene graph.

use super::{House, Room, Thing};
use crate::geometry::{Pose, Size};
use crate::graph::{Label, Layer, NodeId, Object, PoseSource, Region, SceneGraph};
use crate::time::Stamp;

impl House {
    /// The graph of what is where: rooms `R1`…, things `O1`… in their order, the floor `F1`, the
    /// building `B1`; doors give access. Everything was seen at `at`.
    pub fn graph(&self, at: Stamp) -> SceneGraph {
        let mut graph = SceneGraph::new();
        let (building, floor) = (id(Layer::Building, 0), id(Layer::Floor, 0));
        let all: Vec<[f64; 2]> =
            self.rooms.iter().flat_map(|room| room.outline.iter().copied()).collect();
        let extent = extent(&all, self.wall_height_m);
        for (node, name, parent) in [(building, "building", None), (floor, "floor", Some(building))]
        {
            let label = Label::new(name).expect("it is a label");
            insert(&mut graph, node, Region { label, extent, parent });
        }
        for (n, room) in self.rooms.iter().enumerate() {
            insert(&mut graph, id(Layer::Room, n), region(room, self.wall_height_m, floor));
        }
        for door in &self.doors {
            let [a, b] = door.rooms.map(|n| id(Layer::Room, n));
            graph.connect(a, b).expect("doors are between two rooms of the house");
        }
        self.insert_things(&mut graph, at);
        graph
    }

    fn insert_things(&self, graph: &mut SceneGraph, at: Stamp) {
        let mut left: Vec<usize> = (0..self.things.len()).collect();
        while !left.is_empty() {
            let (ready, later): (Vec<usize>, Vec<usize>) = left.iter().partition(|n| {
                self.things[**n]
                    .support
                    .is_none_or(|below| graph.contains(id(Layer::Object, below)))
            });
            assert!(!ready.is_empty(), "nothing stands on itself");
            for n in ready {
                let node = id(Layer::Object, n);
                let added = graph.insert_object(node, object(&self.things[n], at));
                added.expect("each thing has an id of its own and a room");
            }
            left = later;
        }
    }
}

fn id(layer: Layer, n: usize) -> NodeId {
    NodeId::new(layer, n as u32 + 1).expect("a house has fewer things than there are ids")
}

fn insert(graph: &mut SceneGraph, node: NodeId, region: Region) {
    graph.insert_region(node, region).expect("each region has an id of its own");
}

fn extent(corners: &[[f64; 2]], height_m: f64) -> Option<(Pose, Size)> {
    let least = |k: usize| corners.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min);
    let most = |k: usize| corners.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max);
    let (low, high) = ([least(0), least(1)], [most(0), most(1)]);
    let centre = [0, 1].map(|k| f64::midpoint(low[k], high[k]));
    let pose = Pose::at([centre[0], centre[1], height_m / 2.0]).ok()?;
    Some((pose, Size::new(high[0] - low[0], high[1] - low[1], height_m).ok()?))
}

fn region(room: &Room, height_m: f64, floor: NodeId) -> Region {
    let extent = extent(&room.outline, height_m);
    Region { label: room.label.clone(), extent, parent: Some(floor) }
}

fn object(thing: &Thing, at: Stamp) -> Object {
    Object {
        label: thing.label.clone(),
        pose: thing.pose,
        size: thing.size,
        decay_rate: thing.decay_rate,
        last_observed: at,
        pose_source: PoseSource::Measured,
        room: id(Layer::Room, thing.room),
        support: thing.support.map(|below| id(Layer::Object, below)),
    }
}
