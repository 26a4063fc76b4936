//! The edits of regions and of the access between rooms. Each succeeds whole or is refused and
//! changes nothing.

use super::edit::check_room_for;
use super::slots::{RegionSlot, Slots};
use super::{GraphError, Layer, NodeId, Region, SceneGraph};

impl SceneGraph {
    /// Adds a room, floor or building under a new id.
    pub fn insert_region(&mut self, id: NodeId, region: Region) -> Result<(), GraphError> {
        if id.layer() == Layer::Object {
            return Err(GraphError::WrongLayer { id, found: Layer::Object, expected: Layer::Room });
        }
        if self.region(id).is_some() {
            return Err(GraphError::DuplicateNode { id });
        }
        check_room_for(id.layer(), self.regions_mut(id.layer()).len())?;
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
        self.access.extend([(a, b), (b, a)]);
        Ok(())
    }

    /// Takes the access between two rooms away, if there is any.
    pub fn disconnect(&mut self, a: NodeId, b: NodeId) {
        self.access.remove(&(a, b));
        self.access.remove(&(b, a));
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
