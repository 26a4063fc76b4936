//! Floor plans: [`Plan`], of a house or of any state of a graph.
//!
//! ```
//! use scenefold::simulation::house;
//! use scenefold::view::plan::Plan;
//! let apartment = house::load("apartment").unwrap();
//! let svg = Plan::of_house(&apartment).svg();
//! assert!(svg.contains("LIVING ROOM"));
//! ```

mod draw;
mod labels;
mod of_graph;
#[cfg(test)]
mod tests;

use crate::simulation::blocks::Block;
use crate::simulation::house::{House, Thing};

/// What is drawn: everything in metres, seen from above, x to the right and y up the page.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plan {
    /// Written over it.
    pub title: String,
    /// The rooms.
    pub rooms: Vec<PlanRoom>,
    /// Walls, as polygons.
    pub walls: Vec<Vec<[f64; 2]>>,
    /// Ends of the openings in them.
    pub doors: Vec<[[f64; 2]; 2]>,
    /// The things.
    pub things: Vec<PlanThing>,
    /// The way of the robot; empty if it is not drawn.
    pub path: Vec<[f64; 2]>,
}

/// A room of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanRoom {
    /// What it is.
    pub label: String,
    /// Corners.
    pub outline: Vec<[f64; 2]>,
}

/// A thing of a plan.
#[derive(Clone, Debug, PartialEq)]
pub struct PlanThing {
    /// What it is.
    pub label: String,
    /// Corners of its footprint.
    pub corners: [[f64; 2]; 4],
    /// Lowest and highest point: what is higher is drawn over what is lower.
    pub z: [f64; 2],
    /// Whether people carry it about.
    pub movable: bool,
    /// Probability that it is still there, if that is to be shown.
    pub probability: Option<f64>,
    /// What became of it since another time.
    pub change: Option<PlanChange>,
}

/// What became of a thing.
#[derive(Clone, Debug, PartialEq)]
pub enum PlanChange {
    /// It is new.
    Added,
    /// It is gone: it is drawn where it was.
    Removed,
    /// It came from elsewhere.
    Moved {
        /// Corners of its footprint there.
        from: [[f64; 2]; 4],
    },
}

impl Plan {
    /// The plan of a house as it was built.
    pub fn of_house(house: &House) -> Self {
        let mut plan = Self { title: house.name.clone(), ..Self::default() };
        plan.build(house);
        plan.things = house.things.iter().map(thing).collect();
        plan
    }

    /// The rooms, walls and doors of a house.
    fn build(&mut self, house: &House) {
        let room = |room: &crate::simulation::house::Room| PlanRoom {
            label: room.label.to_string(),
            outline: room.outline.clone(),
        };
        self.rooms = house.rooms.iter().map(room).collect();
        // What hangs over a door is no wall on the floor.
        self.walls = house
            .walls()
            .iter()
            .map(|slab| crate::simulation::house::footprint(&slab.pose, slab.size))
            .filter(|block| block.z[0] < 0.5)
            .map(|block| block.corners().to_vec())
            .collect();
        self.doors = house.doors.iter().map(|door| door.ends).collect();
    }

    /// Draws the way of the robot: points on the floor, metres.
    pub fn with_path(mut self, path: Vec<[f64; 2]>) -> Self {
        self.path = path;
        self
    }

    /// The drawing as SVG.
    pub fn svg(&self) -> String {
        draw::draw(self)
    }
}

fn thing(thing: &Thing) -> PlanThing {
    let block = crate::simulation::house::footprint(&thing.pose, thing.size);
    of_block(thing.label.to_string(), &block, thing.movable)
}

fn of_block(label: String, block: &Block, movable: bool) -> PlanThing {
    let (corners, z) = (block.corners(), block.z);
    PlanThing { label, corners, z, movable, probability: None, change: None }
}
