//! The edits of a graph. Each succeeds whole or is refused and changes nothing.

use super::{
    GraphError, Layer, NodeId, Object, PoseSource, Region, SceneGraph,
    slots::{ObjectSlot, RegionSlot, Slots},
};
use crate::geometry::{Pose, Size};
use crate::time::Stamp;

/// What a move sets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// The room it belongs to from now on.
    pub room: NodeId,
    /// What it rests on or lies in from now on.
    pub support: Option<NodeId>,
    /// Its pose, `world_from_object`.
    pub pose: Pose,
    /// How the pose is known.
    pub pose_source: PoseSource,
    /// When it was put there, or seen there.
    pub at: Stamp,
}

impl Placement {
    /// Where `object` is.
    pub fn of(object: &Object) -> Self {
        Self {
            room: object.room,
            support: object.support,
            pose: object.pose,
            pose_source: object.pose_source,
            at: object.last_observed,
        }
    }
}

impl SceneGraph {
    /// An empty graph.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds an object under a new id.
    pub fn insert_object(&mut self, id: NodeId, object: Object) -> Result<(), GraphError> {
        expect_layer(id, Layer::Object)?;
        if self.object(id).is_some() {
            return Err(GraphError::DuplicateNode { id });
        }
        check_decay_rate(id, object.decay_rate)?;
        self.check_room(object.room)?;
        self.check_support(id, object.support, object.is_held())?;
        self.count_on(&object, 1);
        let object = Object { decay_rate: object.decay_rate + 0.0, ..object };
        let slot = ObjectSlot { object, resting: 0, resting_held: 0 };
        self.objects.insert(id.index(), slot).expect("the slot was seen to be free");
        Ok(())
    }

    /// Takes an object out; nothing may rest on it. Returns what it was.
    pub fn remove_object(&mut self, id: NodeId) -> Result<Object, GraphError> {
        let slot = self.object_slot(id)?;
        let count = slot.resting + slot.resting_held;
        if count > 0 {
            return Err(GraphError::StillSupports { id, count });
        }
        let slot = self.objects.remove(id.index()).expect("the slot was seen to be full");
        self.count_on(&slot.object, -1);
        Ok(slot.object)
    }

    /// Marks an object as held; nothing that is not held itself may rest on it.
    pub fn hold_object(&mut self, id: NodeId, at: Stamp) -> Result<(), GraphError> {
        let slot = self.object_slot(id)?;
        if slot.object.is_held() {
            return Err(GraphError::Held { id });
        }
        if slot.resting > 0 {
            return Err(GraphError::StillSupports { id, count: slot.resting });
        }
        let before = slot.object.clone();
        let held = Object { pose_source: PoseSource::Held, last_observed: at, ..before.clone() };
        self.replace_object(id, &before, held);
        Ok(())
    }

    /// Puts an object elsewhere; also one that is held, which it then no longer is.
    pub fn place_object(&mut self, id: NodeId, placement: &Placement) -> Result<(), GraphError> {
        let before = self.object_slot(id)?.object.clone();
        self.check_room(placement.room)?;
        let held = placement.pose_source == PoseSource::Held;
        self.check_support(id, placement.support, held)?;
        let after = Object {
            room: placement.room,
            support: placement.support,
            pose: placement.pose,
            pose_source: placement.pose_source,
            last_observed: placement.at,
            ..before.clone()
        };
        if held && !before.is_held() && self.object_slot(id)?.resting > 0 {
            let count = self.object_slot(id)?.resting;
            return Err(GraphError::StillSupports { id, count });
        }
        self.replace_object(id, &before, after);
        Ok(())
    }

    /// Replaces all that is known of an object.
    pub fn update_object(&mut self, id: NodeId, object: Object) -> Result<(), GraphError> {
        check_decay_rate(id, object.decay_rate)?;
        self.place_object(id, &Placement::of(&object))?;
        let slot = self.objects.get_mut(id.index()).expect("it was just placed");
        slot.object = Object { decay_rate: object.decay_rate + 0.0, ..object };
        Ok(())
    }

    /// Notes that an object was seen at `at`, with better geometry where given.
    pub fn observe_object(
        &mut self,
        id: NodeId,
        at: Stamp,
        pose: Option<Pose>,
        size: Option<Size>,
    ) -> Result<(), GraphError> {
        let object = self.present_mut(id)?;
        object.last_observed = at;
        if let Some(pose) = pose {
            object.pose = pose;
            object.pose_source = PoseSource::Measured;
        }
        if let Some(size) = size {
            object.size = size;
        }
        Ok(())
    }

    /// Sets λ of an object, in 1/s.
    pub fn set_decay_rate(&mut self, id: NodeId, decay_rate: f64) -> Result<(), GraphError> {
        check_decay_rate(id, decay_rate)?;
        self.object_slot(id)?;
        let slot = self.objects.get_mut(id.index()).expect("the slot was seen to be full");
        slot.object.decay_rate = decay_rate + 0.0;
        Ok(())
    }

    /// Adds a room, floor or building under a new id.
    pub fn insert_region(&mut self, id: NodeId, region: Region) -> Result<(), GraphError> {
        if id.layer() == Layer::Object {
            return Err(GraphError::WrongLayer { id, found: Layer::Object, expected: Layer::Room });
        }
        if self.region(id).is_some() {
            return Err(GraphError::DuplicateNode { id });
        }
        if let Some(parent) = region.parent {
            if parent.layer() <= id.layer() {
                return Err(GraphError::LayerOrder { parent, child: id });
            }
            self.region_slot(parent)?.children += 1;
        }
        let slot = RegionSlot { region, children: 0 };
        self.regions_mut(id.layer()).insert(id.index(), slot).expect("seen to be free");
        Ok(())
    }

    /// Takes a region out; nothing may belong to it and it may give access to nothing.
    pub fn remove_region(&mut self, id: NodeId) -> Result<Region, GraphError> {
        if self.region(id).is_none() {
            return Err(GraphError::UnknownNode { id });
        }
        let count = self.region_slot(id)?.children as usize + self.access_from(id).count();
        if count > 0 {
            return Err(GraphError::StillContains { id, count });
        }
        let removed = self.regions_mut(id.layer()).remove(id.index()).expect("seen to be full");
        if let Some(parent) = removed.region.parent {
            self.region_slot(parent).expect("a parent outlives its children").children -= 1;
        }
        Ok(removed.region)
    }

    /// Connects two rooms by access, in both directions; connecting twice is connecting once.
    pub fn connect(&mut self, a: NodeId, b: NodeId) -> Result<(), GraphError> {
        if a == b {
            return Err(GraphError::SelfAccess { id: a });
        }
        self.check_room(a)?;
        self.check_room(b)?;
        self.access.insert((a.min(b), a.max(b)));
        Ok(())
    }

    /// Takes the access between two rooms away, if there is any.
    pub fn disconnect(&mut self, a: NodeId, b: NodeId) {
        self.access.remove(&(a.min(b), a.max(b)));
    }

    fn replace_object(&mut self, id: NodeId, before: &Object, after: Object) {
        self.count_on(before, -1);
        self.count_on(&after, 1);
        self.objects.get_mut(id.index()).expect("the caller has just read it").object = after;
    }

    /// Counts `object` in (+1) or out (−1) at its room and support.
    fn count_on(&mut self, object: &Object, by: i32) {
        let step = |count: &mut u32| *count = count.wrapping_add_signed(by);
        if let Some(room) = self.rooms.get_mut(object.room.index()) {
            step(&mut room.children);
        }
        if let Some(support) = object.support.and_then(|id| self.objects.get_mut(id.index())) {
            step(if object.is_held() { &mut support.resting_held } else { &mut support.resting });
        }
    }

    fn check_room(&self, room: NodeId) -> Result<(), GraphError> {
        expect_layer(room, Layer::Room)?;
        self.region(room).map(drop).ok_or(GraphError::UnknownNode { id: room })
    }

    /// `id` may rest on `support`: it exists, is held only if `id` is, and rests not on `id`.
    fn check_support(
        &self,
        id: NodeId,
        support: Option<NodeId>,
        held: bool,
    ) -> Result<(), GraphError> {
        let Some(support) = support else { return Ok(()) };
        expect_layer(support, Layer::Object)?;
        let mut below = Some(support);
        while let Some(next) = below {
            if next == id {
                return Err(GraphError::SupportCycle { id, support });
            }
            let object = self.object(next).ok_or(GraphError::UnknownNode { id: next })?;
            if next == support && object.is_held() && !held {
                return Err(GraphError::Held { id: support });
            }
            below = object.support;
        }
        Ok(())
    }

    fn object_slot(&self, id: NodeId) -> Result<&ObjectSlot, GraphError> {
        expect_layer(id, Layer::Object)?;
        self.objects.get(id.index()).ok_or(GraphError::UnknownNode { id })
    }

    fn present_mut(&mut self, id: NodeId) -> Result<&mut Object, GraphError> {
        if self.object_slot(id)?.object.is_held() {
            return Err(GraphError::Held { id });
        }
        Ok(&mut self.objects.get_mut(id.index()).expect("just read").object)
    }

    fn region_slot(&mut self, id: NodeId) -> Result<&mut RegionSlot, GraphError> {
        let unknown = GraphError::UnknownNode { id };
        if id.layer() == Layer::Object {
            return Err(unknown);
        }
        self.regions_mut(id.layer()).get_mut(id.index()).ok_or(unknown)
    }

    fn regions_mut(&mut self, layer: Layer) -> &mut Slots<RegionSlot> {
        match layer {
            Layer::Object => unreachable!("callers have refused objects"),
            Layer::Room => &mut self.rooms,
            Layer::Floor => &mut self.floors,
            Layer::Building => &mut self.buildings,
        }
    }
}

fn expect_layer(id: NodeId, expected: Layer) -> Result<(), GraphError> {
    let found = id.layer();
    if found == expected { Ok(()) } else { Err(GraphError::WrongLayer { id, found, expected }) }
}

fn check_decay_rate(id: NodeId, value: f64) -> Result<(), GraphError> {
    if value.is_finite() && value >= 0.0 {
        Ok(())
    } else {
        Err(GraphError::DecayRate { id, value })
    }
}
