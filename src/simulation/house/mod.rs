//! What a house is: [`House`]; where houses come from: [`load()`].
//!
//! A house file is JSON (see [`HouseFile`]); so is the graph of a VirtualHome apartment, and any
//! scene that `replay --json` prints: those become houses by [`from_graph()`], which mends what
//! does not fit and says so.

mod build;
mod built_in;
mod check;
mod decay;
mod error;
mod export;
mod file;
mod from_graph;
mod load;
mod obj;
mod space;
mod structure;
#[cfg(test)]
mod tests;
mod thing;

use std::sync::Arc;

use super::mesh::{Material, Mesh};
use crate::geometry::{Pose, Size};
use crate::graph::Label;
pub use build::{build, read};
pub use built_in::{BUILT_IN, BuiltIn};
pub use decay::{DECAY_CLASSES, DecayClass, decay_class, decay_rate_of};
pub use error::{HouseError, LoadError};
pub use file::{
    AxisName, DoorFile, HouseFile, Look, ObjectFile, QuaternionFile, RoomFile, TextureFile,
};
pub use from_graph::{FromGraph, from_graph};
pub use load::{FileKind, Loaded, kind, load, load_reported};
pub use space::{Misfit, Space, SurfaceInWorld, TOUCH_M, around as footprint};
pub use structure::Slab;

/// One storey, known to be possible: no rooms overlap, nothing floats or stands in a wall.
///
/// World frame: x and y along the floor, z up, the floor at z = 0, metres.
#[derive(Clone, Debug, PartialEq)]
pub struct House {
    /// What it is called.
    pub name: String,
    /// Floor to ceiling, metres.
    pub wall_height_m: f64,
    /// Thickness of the walls; they stand half in each of the rooms that they part.
    pub wall_thickness_m: f64,
    /// How the walls look.
    pub wall: Material,
    /// Rooms; number n is `R{n+1}` of the graph.
    pub rooms: Vec<Room>,
    /// Doors between them.
    pub doors: Vec<Door>,
    /// Things in them; number n is `O{n+1}` of the graph.
    pub things: Vec<Thing>,
}

/// A room.
#[derive(Clone, Debug, PartialEq)]
pub struct Room {
    /// What it is.
    pub label: Label,
    /// Corners on the floor, counter-clockwise, metres.
    pub outline: Vec<[f64; 2]>,
    /// How its floor looks.
    pub floor: Material,
}

/// An opening in a wall, from the floor up.
#[derive(Clone, Debug, PartialEq)]
pub struct Door {
    /// Numbers of the rooms on either side.
    pub rooms: [usize; 2],
    /// Ends of the opening on the line of the wall, metres.
    pub ends: [[f64; 2]; 2],
    /// Height of the opening, metres.
    pub height_m: f64,
}

/// A thing in a house.
#[derive(Clone, Debug, PartialEq)]
pub struct Thing {
    /// Its name in the house file, unlike that of any other.
    pub name: String,
    /// Semantic class.
    pub label: Label,
    /// `world_from_object` of the centre of its box.
    pub pose: Pose,
    /// Its box.
    pub size: Size,
    /// How it looks; fills the box.
    pub mesh: Arc<Mesh>,
    /// Whether people carry it about.
    pub movable: bool,
    /// λ in 1/s; 0 for what never moves.
    pub decay_rate: f64,
    /// Number of its room.
    pub room: usize,
    /// Number of the thing it stands on or lies in; none if on the floor or a wall.
    pub support: Option<usize>,
    /// Upper faces on which other things can be put.
    pub surfaces: Vec<Surface>,
}

/// A level rectangle of a thing on which other things can be put, in the frame of the thing.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// What it is called: "top", "seat", "arm", "shelf".
    pub name: String,
    /// Lowest x and y, metres.
    pub min: [f64; 2],
    /// Highest x and y, metres.
    pub max: [f64; 2],
    /// Its height, metres.
    pub z: f64,
    /// Free height above it, metres; none if nothing is above.
    pub clearance_m: Option<f64>,
}
