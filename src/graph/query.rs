//! Reading a graph.

use super::{Layer, NodeId, Object, Region, SceneGraph};
use crate::graph::slots::{RegionSlot, Slots};

impl SceneGraph {
    /// The object with this id, held or not.
    pub fn object(&self, id: NodeId) -> Option<&Object> {
        if id.layer() != Layer::Object {
            return None;
        }
        self.objects.get(id.index()).map(|slot| &slot.object)
    }

    /// The room, floor or building with this id.
    pub fn region(&self, id: NodeId) -> Option<&Region> {
        self.region_slots(id.layer())?.get(id.index()).map(|slot| &slot.region)
    }

    /// Whether there is a node with this id.
    pub fn contains(&self, id: NodeId) -> bool {
        self.object(id).is_some() || self.region(id).is_some()
    }

    /// The label of any node.
    pub fn label(&self, id: NodeId) -> Option<&super::Label> {
        self.object(id).map(|o| &o.label).or_else(|| self.region(id).map(|r| &r.label))
    }

    /// Objects that are where the graph says, in order of id; not those in the gripper.
    pub fn objects(&self) -> impl Iterator<Item = (NodeId, &Object)> {
        self.all_objects().filter(|(_, object)| !object.is_held())
    }

    /// Objects in the gripper, in order of id.
    pub fn held(&self) -> impl Iterator<Item = (NodeId, &Object)> {
        self.all_objects().filter(|(_, object)| object.is_held())
    }

    /// All objects, held or not, in order of id.
    pub fn all_objects(&self) -> impl Iterator<Item = (NodeId, &Object)> {
        self.objects.iter().map(|(index, slot)| (known(Layer::Object, index), &slot.object))
    }

    /// Regions of one layer, in order of id; none for [`Layer::Object`].
    pub fn regions(&self, layer: Layer) -> impl Iterator<Item = (NodeId, &Region)> {
        self.region_slots(layer).into_iter().flat_map(move |slots| {
            slots.iter().map(move |(i, slot)| (known(layer, i), &slot.region))
        })
    }

    /// Rooms, in order of id.
    pub fn rooms(&self) -> impl Iterator<Item = (NodeId, &Region)> {
        self.regions(Layer::Room)
    }

    /// How many objects there are, held or not.
    pub fn object_count(&self) -> usize {
        self.objects.len()
    }

    /// Pairs of rooms with access to each other, each once, in order.
    pub fn access(&self) -> impl Iterator<Item = (NodeId, NodeId)> {
        self.access.iter().copied()
    }

    /// Rooms that `room` gives access to, in order of id.
    pub fn access_from(&self, room: NodeId) -> impl Iterator<Item = NodeId> {
        let mut others: Vec<NodeId> = self
            .access
            .iter()
            .filter_map(|(a, b)| match room {
                _ if *a == room => Some(*b),
                _ if *b == room => Some(*a),
                _ => None,
            })
            .collect();
        others.sort_unstable();
        others.into_iter()
    }

    /// What rests on or lies in `id`, directly or on something that does; lower things first.
    pub fn resting_on(&self, id: NodeId) -> Vec<NodeId> {
        let direct = |below: NodeId| {
            let some =
                self.objects.get(below.index()).is_some_and(|s| s.resting + s.resting_held > 0);
            self.all_objects()
                .take_while(move |_| some)
                .filter(move |(_, object)| object.support == Some(below))
                .map(|(above, _)| above)
        };
        let mut found: Vec<NodeId> = direct(id).collect();
        let mut next = 0;
        while let Some(below) = found.get(next).copied() {
            found.extend(direct(below));
            next += 1;
        }
        found
    }

    /// The region of `layer` that `id` belongs to, directly or through others.
    pub fn ancestor(&self, id: NodeId, layer: Layer) -> Option<NodeId> {
        let mut current = self.object(id).map_or(id, |object| object.room);
        while current.layer() < layer {
            current = self.region(current)?.parent?;
        }
        (current.layer() == layer && current != id).then_some(current)
    }

    /// The largest index in use in a layer.
    pub fn last_index(&self, layer: Layer) -> Option<u32> {
        match layer {
            Layer::Object => self.objects.iter().last().map(|(index, _)| index),
            _ => self.region_slots(layer)?.iter().last().map(|(index, _)| index),
        }
    }

    fn region_slots(&self, layer: Layer) -> Option<&Slots<RegionSlot>> {
        match layer {
            Layer::Object => None,
            Layer::Room => Some(&self.rooms),
            Layer::Floor => Some(&self.floors),
            Layer::Building => Some(&self.buildings),
        }
    }
}

fn known(layer: Layer, index: u32) -> NodeId {
    NodeId::new(layer, index).expect("only indices of ids are stored")
}
