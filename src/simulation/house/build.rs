//! From a house file to a house: [`build`].

mod look;
mod objects;
mod place;
mod rooms;

use std::path::Path;

use super::check;
use super::{Door, House, HouseError, HouseFile, Room, Thing};
use crate::simulation::mesh::Material;
use crate::simulation::shapes::paint;

/// Complaints, so that all are told at once.
pub(super) type Complaints = Vec<HouseError>;

/// Floor to ceiling where a file does not say, metres.
const WALL_HEIGHT_M: f64 = 2.5;
/// Thickness of walls where a file does not say, metres.
const WALL_THICKNESS_M: f64 = 0.1;

/// Reads the text of a house file.
pub fn read(text: &str) -> Result<HouseFile, HouseError> {
    let mut reader = serde_json::Deserializer::from_str(text);
    let file = serde_path_to_error::deserialize(&mut reader).map_err(|error| {
        let path = error.path().to_string();
        let path = if path == "." { "the document".to_owned() } else { path };
        HouseError::new(path, error.inner().to_string())
    })?;
    reader.end().map_err(|error| HouseError::new("the document", error.to_string()))?;
    Ok(file)
}

/// Makes a house from what its file says. Paths of OBJ files are relative to `folder`. All that
/// is wrong is told at once, in the order of the file.
pub fn build(file: &HouseFile, folder: Option<&Path>) -> Result<House, Vec<HouseError>> {
    let mut wrong = Complaints::new();
    let mut house = shell(file, &mut wrong);
    let names = rooms::names(file, &mut wrong);
    house.doors = rooms::doors(file, &house, &names, &mut wrong);
    // What stands where means nothing while the rooms are wrong.
    stop_if(&mut wrong)?;
    let drafts = objects::read(file, folder, &mut wrong);
    stop_if(&mut wrong)?;
    house.things = place::place(file, &house, drafts, &names, &mut wrong);
    stop_if(&mut wrong)?;
    check::check(&house, &mut wrong);
    stop_if(&mut wrong)?;
    Ok(house)
}

fn stop_if(wrong: &mut Complaints) -> Result<(), Vec<HouseError>> {
    if wrong.is_empty() { Ok(()) } else { Err(std::mem::take(wrong)) }
}

/// The rooms and the walls; no doors, no things.
fn shell(file: &HouseFile, wrong: &mut Complaints) -> House {
    let wall_height_m = file.wall_height.unwrap_or(WALL_HEIGHT_M);
    let wall_thickness_m = file.wall_thickness.unwrap_or(WALL_THICKNESS_M);
    in_range("wall_height", wall_height_m, [1.8, 10.0], wrong);
    in_range("wall_thickness", wall_thickness_m, [0.01, 1.0], wrong);
    if file.rooms.is_empty() {
        wrong.push(HouseError::new("rooms", "there is none: give at least one"));
    }
    let plain = |look: &Option<super::Look>, path: &str, otherwise: Material, wrong: &mut _| {
        look.as_ref().map_or(otherwise, |it| look::material(it, path, wrong))
    };
    let wall = plain(&file.wall, "wall", paint::plain(0x00f2_efe9), wrong);
    let floor = plain(&file.floor, "floor", paint::wood(0x00b8_9468), wrong);
    let rooms: Vec<Room> = file
        .rooms
        .iter()
        .enumerate()
        .filter_map(|(n, room)| rooms::room(room, n, floor, wrong))
        .collect();
    let (doors, things) = (Vec::<Door>::new(), Vec::<Thing>::new());
    let name = file.name.clone();
    House { name, wall_height_m, wall_thickness_m, wall, rooms, doors, things }
}

/// Complains unless a number lies in a range.
fn in_range(path: &str, value: f64, [least, most]: [f64; 2], wrong: &mut Complaints) -> bool {
    let fine = value.is_finite() && (least..=most).contains(&value);
    if !fine {
        let problem = format!("{value} must be {least} to {most}");
        wrong.push(HouseError::new(path, problem));
    }
    fine
}
