//! The edits of objects. Each succeeds whole or is refused and changes nothing.

use super::{
    GraphError, Layer, NodeId, Object, PoseSource, SceneGraph,
    slots::ObjectSlot,
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

    /// `object`, but here.
    pub fn over(&self, object: Object) -> Object {
        Object {
            room: self.room,
            support: self.support,
            pose: self.pose,
            pose_source: self.pose_source,
            last_observed: self.at,
            ..object
        }
    }
}

/// Most nodes in one layer; far more than any building holds, few enough to bound what a hostile
/// log can claim.
pub const MAX_NODES: usize = 1 << 20;
/// Most objects below one that is put on something.
pub const MAX_PILE: usize = 100;

/// At what an object is counted.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Hold {
    room: NodeId,
    support: Option<NodeId>,
    held: bool,
}

impl Hold {
    fn of(object: &Object) -> Self {
        Self { room: object.room, support: object.support, held: object.is_held() }
    }
}

impl ObjectSlot {
    /// The count of what rests on it, held or not.
    pub(super) fn count(&mut self, held: bool) -> &mut u32 {
        if held { &mut self.resting_held } else { &mut self.resting }
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
        if self.objects.get(id.index()).is_some() {
            return Err(GraphError::DuplicateNode { id });
        }
        check_room_for(Layer::Object, self.objects.len())?;
        check_decay_rate(id, object.decay_rate)?;
        self.check_room(object.room)?;
        self.check_support(id, None, object.support, object.is_held())?;
        self.put_in(id, Object { decay_rate: object.decay_rate + 0.0, ..object });
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
        self.count_on(Hold::of(&slot.object), -1);
        Ok(slot.object)
    }

    /// Marks an object as held; nothing that is not held itself may rest on it.
    pub fn hold_object(&mut self, id: NodeId, at: Stamp) -> Result<(), GraphError> {
        let slot = self.object_slot(id)?;
        if slot.object.is_held() {
            return Err(GraphError::Held { id });
        }
        let held = PoseSource::Held;
        let to = Placement { pose_source: held, at, ..Placement::of(&slot.object) };
        self.place_object(id, &to)
    }

    /// Puts an object elsewhere; also one that is held, which it then no longer is.
    pub fn place_object(&mut self, id: NodeId, placement: &Placement) -> Result<(), GraphError> {
        self.check_placement(id, placement)?;
        self.put_at(id, placement);
        Ok(())
    }

    /// Replaces all that is known of an object.
    pub fn update_object(&mut self, id: NodeId, object: Object) -> Result<(), GraphError> {
        self.swap_object(id, object).map(drop)
    }

    /// As [`Self::update_object`]; returns what it was.
    pub(crate) fn swap_object(
        &mut self,
        id: NodeId,
        object: Object,
    ) -> Result<Object, GraphError> {
        check_decay_rate(id, object.decay_rate)?;
        self.check_placement(id, &Placement::of(&object))?;
        let object = Object { decay_rate: object.decay_rate + 0.0, ..object };
        Ok(self.put_over(id, object))
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

    pub(super) fn put_in(&mut self, id: NodeId, object: Object) {
        self.count_on(Hold::of(&object), 1);
        let slot = ObjectSlot { object, resting: 0, resting_held: 0 };
        self.objects.insert(id.index(), slot).expect("the slot was seen to be free");
    }

    pub(super) fn put_at(&mut self, id: NodeId, to: &Placement) {
        let slot = self.objects.get_mut(id.index()).expect("it was seen to be there");
        let object = &mut slot.object;
        let before = Hold::of(object);
        object.room = to.room;
        object.support = to.support;
        object.pose = to.pose;
        object.pose_source = to.pose_source;
        object.last_observed = to.at;
        let after = Hold::of(object);
        if before != after {
            self.count_on(before, -1);
            self.count_on(after, 1);
        }
    }

    pub(super) fn put_over(&mut self, id: NodeId, object: Object) -> Object {
        let slot = self.objects.get_mut(id.index()).expect("it was seen to be there");
        let after = Hold::of(&object);
        let before = std::mem::replace(&mut slot.object, object);
        self.count_on(Hold::of(&before), -1);
        self.count_on(after, 1);
        before
    }

    /// Counts an object in (+1) or out (−1) at its room and support.
    fn count_on(&mut self, at: Hold, by: i32) {
        let step = |count: &mut u32| *count = count.wrapping_add_signed(by);
        if let Some(room) = self.rooms.get_mut(at.room.index()) {
            step(&mut room.children);
        }
        if let Some(support) = at.support.and_then(|id| self.objects.get_mut(id.index())) {
            step(support.count(at.held));
        }
    }

    fn check_placement(&self, id: NodeId, to: &Placement) -> Result<(), GraphError> {
        let slot = self.object_slot(id)?;
        let held = to.pose_source == PoseSource::Held;
        self.check_room(to.room)?;
        self.check_support(id, slot.object.support, to.support, held)?;
        if held && !slot.object.is_held() && slot.resting > 0 {
            return Err(GraphError::StillSupports { id, count: slot.resting });
        }
        Ok(())
    }

    pub(super) fn check_room(&self, room: NodeId) -> Result<(), GraphError> {
        expect_layer(room, Layer::Room)?;
        let known = self.rooms.get(room.index()).is_some();
        if known { Ok(()) } else { Err(GraphError::UnknownNode { id: room }) }
    }

    /// `id`, which rests on `before`, may rest on `support`: it can hold it, and rests not on
    /// `id`. Few things stand on each other in a house, so a high pile is refused rather than
    /// walked down at every edit.
    fn check_support(
        &self,
        id: NodeId,
        before: Option<NodeId>,
        support: Option<NodeId>,
        held: bool,
    ) -> Result<(), GraphError> {
        let Some(support) = support else { return Ok(()) };
        self.check_holds(support, held)?;
        if before == Some(support) {
            return Ok(());
        }
        let mut below = Some(support);
        for _ in 0..MAX_PILE {
            let Some(next) = below else { return Ok(()) };
            if next == id {
                return Err(GraphError::SupportCycle { id, support });
            }
            below = self.object_slot(next)?.object.support;
        }
        match below {
            None => Ok(()),
            Some(_) => Err(GraphError::PileTooHigh { id, support, limit: MAX_PILE }),
        }
    }

    /// `support` is an object, and held only if what rests on it is.
    pub(super) fn check_holds(&self, support: NodeId, held: bool) -> Result<(), GraphError> {
        if self.object_slot(support)?.object.is_held() && !held {
            return Err(GraphError::Held { id: support });
        }
        Ok(())
    }

    pub(super) fn object_slot(&self, id: NodeId) -> Result<&ObjectSlot, GraphError> {
        expect_layer(id, Layer::Object)?;
        self.objects.get(id.index()).ok_or(GraphError::UnknownNode { id })
    }

    fn present_mut(&mut self, id: NodeId) -> Result<&mut Object, GraphError> {
        if self.object_slot(id)?.object.is_held() {
            return Err(GraphError::Held { id });
        }
        Ok(&mut self.objects.get_mut(id.index()).expect("just read").object)
    }
}

fn expect_layer(id: NodeId, expected: Layer) -> Result<(), GraphError> {
    let found = id.layer();
    if found == expected { Ok(()) } else { Err(GraphError::WrongLayer { id, found, expected }) }
}

/// Whether a layer that holds `count` nodes takes another.
pub(super) fn check_room_for(layer: Layer, count: usize) -> Result<(), GraphError> {
    if count < MAX_NODES { Ok(()) } else { Err(GraphError::Full { layer, limit: MAX_NODES }) }
}

fn check_decay_rate(id: NodeId, value: f64) -> Result<(), GraphError> {
    if value.is_finite() && value >= 0.0 {
        Ok(())
    } else {
        Err(GraphError::DecayRate { id, value })
    }
}
