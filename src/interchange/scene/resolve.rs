//! From a [`SceneDocument`] to a graph: names become nodes, what is missing gets its default.

use std::collections::BTreeSet;

use super::ids::Ids;
use super::{ObjectEntry, SceneDocument, SceneError};
use crate::change::topological_pose;
use crate::geometry::{Pose, Size};
use crate::graph::{GraphError, Layer, NodeId, Object, PoseSource, Region, SceneGraph};
use crate::interchange::{JsonError, MOVABLE_DECAY_RATE};
use crate::time::Stamp;

/// Side of the cube that stands for an object whose size is not given.
pub(super) const DEFAULT_SIDE_UM: i64 = 200_000;

impl SceneDocument {
    /// The graph, and the moment of the document (1970 if it names none).
    pub fn to_graph(self) -> Result<(SceneGraph, Stamp), SceneError> {
        let at = self.at.unwrap_or(Stamp::EPOCH);
        let mut graph = SceneGraph::new();
        let rooms = self.insert_regions(&mut graph)?;
        let objects = self.object_ids()?;
        let all: Vec<&ObjectEntry> = self.objects.iter().chain(&self.held).collect();
        let resolver = Resolver { document: &self, all: &all, ids: &objects, rooms: &rooms, at };
        resolver.insert_objects(&mut graph)?;
        Ok((graph, at))
    }

    fn object_ids(&self) -> Result<Ids, SceneError> {
        let all = self.objects.iter().chain(&self.held);
        let given = all.map(|entry| (entry.id, entry.label.clone())).collect();
        Ids::new(Layer::Object, given, |n| self.object_path(n))
    }

    fn object_path(&self, n: usize) -> String {
        match n.checked_sub(self.objects.len()) {
            None => format!("objects[{n}]"),
            Some(n) => format!("held[{n}]"),
        }
    }

    fn insert_regions(&self, graph: &mut SceneGraph) -> Result<Ids, SceneError> {
        let given = self.buildings.iter().map(|entry| (entry.id, entry.label.clone())).collect();
        let buildings = Ids::new(Layer::Building, given, |n| format!("buildings[{n}]"))?;
        for ((id, label), entry) in buildings.nodes.iter().zip(&self.buildings) {
            let extent = entry.pose.zip(entry.size);
            graph
                .insert_region(*id, Region { label: label.clone(), extent, parent: None })
                .map_err(|error| refused(id.to_string(), &error))?;
        }
        let given = self.floors.iter().map(|entry| (entry.id, entry.label.clone())).collect();
        let floors = Ids::new(Layer::Floor, given, |n| format!("floors[{n}]"))?;
        for (n, ((id, label), entry)) in floors.nodes.iter().zip(&self.floors).enumerate() {
            let path = || format!("floors[{n}].building");
            let parent =
                entry.building.as_ref().map(|name| buildings.find(name, path)).transpose()?;
            let extent = entry.pose.zip(entry.size);
            graph
                .insert_region(*id, Region { label: label.clone(), extent, parent })
                .map_err(|error| refused(path(), &error))?;
        }
        self.insert_rooms(graph, &floors, &buildings)
    }

    fn insert_rooms(
        &self,
        graph: &mut SceneGraph,
        floors: &Ids,
        buildings: &Ids,
    ) -> Result<Ids, SceneError> {
        let given = self.rooms.iter().map(|entry| (entry.id, entry.label.clone())).collect();
        let rooms = Ids::new(Layer::Room, given, |n| format!("rooms[{n}]"))?;
        for (n, ((id, label), entry)) in rooms.nodes.iter().zip(&self.rooms).enumerate() {
            let path = |field: &str| format!("rooms[{n}].{field}");
            let floor = entry.floor.as_ref().map(|name| floors.find(name, || path("floor")));
            let building =
                entry.building.as_ref().map(|name| buildings.find(name, || path("building")));
            let parent = floor.or(building).transpose()?;
            let extent = entry.pose.zip(entry.size);
            graph
                .insert_region(*id, Region { label: label.clone(), extent, parent })
                .map_err(|error| refused(path("id"), &error))?;
        }
        for (n, ((id, _), entry)) in rooms.nodes.iter().zip(&self.rooms).enumerate() {
            for (m, name) in entry.access_to.iter().enumerate() {
                let path = || format!("rooms[{n}].access_to[{m}]");
                let other = rooms.find(name, path)?;
                graph.connect(*id, other).map_err(|error| refused(path(), &error))?;
            }
        }
        Ok(rooms)
    }
}

fn refused(path: String, error: &GraphError) -> SceneError {
    JsonError { path, problem: error.to_string() }.into()
}

struct Resolver<'a> {
    document: &'a SceneDocument,
    all: &'a [&'a ObjectEntry],
    ids: &'a Ids,
    rooms: &'a Ids,
    at: Stamp,
}

impl Resolver<'_> {
    /// Supports go in before what rests on them, for its room and pose may be theirs.
    fn insert_objects(&self, graph: &mut SceneGraph) -> Result<(), SceneError> {
        for n in 0..self.all.len() {
            let mut stack = Vec::new();
            let mut seen = BTreeSet::new();
            let mut next = Some(n);
            while let Some(n) = next {
                let id = self.ids.nodes[n].0;
                if graph.contains(id) {
                    break;
                }
                if !seen.insert(n) {
                    let problem = format!("{id} rests on itself through others");
                    return Err(JsonError { path: self.path(n, "support"), problem }.into());
                }
                let support = self.support(n)?;
                stack.push((n, support));
                next = support.and_then(|id| self.ids.position(id));
            }
            for (n, support) in stack.into_iter().rev() {
                self.insert_object(graph, n, support)?;
            }
        }
        Ok(())
    }

    fn path(&self, n: usize, field: &str) -> String {
        format!("{}.{field}", self.document.object_path(n))
    }

    fn support(&self, n: usize) -> Result<Option<NodeId>, SceneError> {
        let name = self.all[n].support.as_ref();
        name.map(|name| self.ids.find(name, || self.path(n, "support"))).transpose()
    }

    fn room(
        &self,
        graph: &SceneGraph,
        n: usize,
        support: Option<NodeId>,
    ) -> Result<NodeId, SceneError> {
        if let Some(name) = &self.all[n].room {
            return self.rooms.find(name, || self.path(n, "room"));
        }
        if let Some(below) = support.and_then(|id| graph.object(id)) {
            return Ok(below.room);
        }
        if let [(only, _)] = self.rooms.nodes.as_slice() {
            return Ok(*only);
        }
        let problem = "the room is missing; give \"room\" or \"support\"".to_owned();
        Err(JsonError { path: self.path(n, "room"), problem }.into())
    }

    fn insert_object(
        &self,
        graph: &mut SceneGraph,
        n: usize,
        support: Option<NodeId>,
    ) -> Result<(), SceneError> {
        let entry = self.all[n];
        let id = self.ids.nodes[n].0;
        let room = self.room(graph, n, support)?;
        let size = entry.size.unwrap_or_else(default_size);
        let (pose, source) = match entry.pose {
            Some(pose) => (pose, PoseSource::Measured),
            None => (default_pose(graph, room, support, size), PoseSource::Topological),
        };
        let object = Object {
            label: entry.label.clone(),
            pose,
            size,
            decay_rate: entry.decay_rate.unwrap_or(MOVABLE_DECAY_RATE),
            last_observed: entry.last_observed.unwrap_or(self.at),
            pose_source: entry.pose_source.unwrap_or(source),
            room,
            support,
        };
        graph
            .insert_object(id, object)
            .map_err(|error| refused(self.document.object_path(n), &error))
    }
}

fn default_size() -> Size {
    Size::from_micrometres([DEFAULT_SIDE_UM; 3]).expect("the side is positive")
}

fn default_pose(graph: &SceneGraph, room: NodeId, support: Option<NodeId>, size: Size) -> Pose {
    topological_pose(graph, room, support, size)
}
