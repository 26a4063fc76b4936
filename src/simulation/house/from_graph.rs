//! A house from a scene graph that nobody drew as a house: [`from_graph`].
//!
//! Rooms become rectangles that meet in walls; doors are put where the graph has doors, or where
//! rooms give access; things are filled with the mesh of their class and pushed into their rooms.
//! What is left out or changed is told.

mod doors;
mod rooms;
mod things;

use super::{House, HouseError, Thing};
use crate::graph::{Object, SceneGraph};
use crate::simulation::shapes::paint;

/// A house, and what had to be mended.
#[derive(Clone, Debug, PartialEq)]
pub struct FromGraph {
    /// The house.
    pub house: House,
    /// What was left out or changed, for people.
    pub notes: Vec<String>,
}

/// Thickness of the walls, metres.
const WALL_M: f64 = 0.1;

/// The house of a graph. Its room number n is the n-th room of the graph, its thing number n the
/// n-th object that is no floor, wall, ceiling or door. Things may overlap, as the boxes of the
/// graph do, and hang in the air; they never reach into walls, the floor or the ceiling.
pub fn from_graph(graph: &SceneGraph, name: &str) -> Result<FromGraph, HouseError> {
    let mut notes = Vec::new();
    let storey = rooms::storey(graph, &mut notes)?;
    let mut house = House {
        name: name.to_owned(),
        wall_height_m: storey.height_m,
        wall_thickness_m: WALL_M,
        wall: paint::plain(0x00f2_efe9),
        rooms: storey.rooms.iter().map(|(_, room)| room.clone()).collect(),
        doors: Vec::new(),
        things: Vec::<Thing>::new(),
    };
    doors::put(graph, &storey, &mut house, &mut notes);
    things::put(graph, &storey, &mut house, &mut notes);
    Ok(FromGraph { house, notes })
}

/// Whether an object is part of the building rather than a thing in it.
fn is_structure(object: &Object) -> bool {
    ["floor", "ceiling", "wall"].iter().any(|name| object.label.same_class(name)) || is_door(object)
}

fn is_door(object: &Object) -> bool {
    ["door", "doorjamb", "doorway"].iter().any(|name| object.label.same_class(name))
}
