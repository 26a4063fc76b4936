//! Rooms and doors of a house file.

use super::{Complaints, in_range};
use crate::graph::Label;
use crate::simulation::house::structure::shared_wall;
use crate::simulation::house::{Door, DoorFile, House, HouseError, HouseFile, Room, RoomFile};
use crate::simulation::mesh::Material;
use crate::simulation::shapes::polygon;

/// Width of a door where a file does not say, metres.
const DOOR_WIDTH_M: f64 = 0.9;
/// Height of a door where a file does not say, metres.
const DOOR_HEIGHT_M: f64 = 2.05;
/// Rooms that overlap by less than this only touch, metres.
const TOUCH_M: f64 = 0.002;
/// Farthest coordinate of a room, metres.
const FAR_M: f64 = 1_000.0;

/// Room number `n`; `None` if it has no shape.
pub fn room(file: &RoomFile, n: usize, floor: Material, wrong: &mut Complaints) -> Option<Room> {
    let path = format!("rooms[{n}]");
    let label = Label::new(&file.label)
        .map_err(|error| wrong.push(HouseError::new(format!("{path}.label"), error.to_string())));
    let outline = outline(file, &path, wrong)?;
    let floor = match &file.floor {
        Some(look) => super::look::material(look, &format!("{path}.floor"), wrong),
        None => floor,
    };
    Some(Room { label: label.ok()?, outline, floor })
}

fn outline(file: &RoomFile, path: &str, wrong: &mut Complaints) -> Option<Vec<[f64; 2]>> {
    let refused = |problem: String| Err(HouseError::new(path, problem));
    let outline = match (&file.box_, &file.outline) {
        (Some(_), Some(_)) => refused("give box or outline, not both".to_owned()),
        (None, None) => refused("give box ([x0, y0, x1, y1]) or outline".to_owned()),
        (Some(sides), None) => from_box(*sides, path),
        (None, Some(corners)) => from_corners(corners, path),
    };
    outline.map_err(|error| wrong.push(error)).ok()
}

fn from_box([x0, y0, x1, y1]: [f64; 4], path: &str) -> Result<Vec<[f64; 2]>, HouseError> {
    for (low, high, n) in [(x0, x1, 2), (y0, y1, 3)] {
        let path = format!("{path}.box[{n}]");
        if high - low < 0.5 {
            let problem = format!("{high} must be at least half a metre beyond {low}");
            return Err(HouseError::new(path, problem));
        }
    }
    from_corners(&[[x0, y0], [x1, y0], [x1, y1], [x0, y1]], path)
}

fn from_corners(corners: &[[f64; 2]], path: &str) -> Result<Vec<[f64; 2]>, HouseError> {
    let refused = |problem: &str| Err(HouseError::new(format!("{path}.outline"), problem));
    if corners.iter().flatten().any(|c| !(c.abs() <= FAR_M)) {
        return refused("corners must be within 1000 m of the origin");
    }
    if corners.len() < 3 {
        return refused("a room has at least three corners");
    }
    if polygon::edges(corners).any(|(a, b)| libm::hypot(b[0] - a[0], b[1] - a[1]) < 0.01) {
        return refused("two corners that follow each other are at one place: leave one out");
    }
    if polygon::crosses_itself(corners) {
        return refused("the outline crosses itself: give the corners in order around the room");
    }
    let mut outline = corners.to_vec();
    let area = polygon::area(&outline);
    if area < 0.0 {
        outline.reverse();
    }
    if area.abs() < 0.25 {
        refused("the room is smaller than a quarter of a square metre")
    } else {
        Ok(outline)
    }
}

/// What doors and objects call the rooms; complains of rooms that share a name or a place.
pub fn names(file: &HouseFile, wrong: &mut Complaints) -> Vec<String> {
    let names: Vec<String> =
        file.rooms.iter().map(|room| room.name.clone().unwrap_or(room.label.clone())).collect();
    for (n, name) in names.iter().enumerate() {
        if let Some(first) = names[..n].iter().position(|other| other == name) {
            let problem =
                format!("{name:?} is the name of rooms[{first}] too: give it another `name`");
            wrong.push(HouseError::new(format!("rooms[{n}].name"), problem));
        }
    }
    names
}

/// Complains of rooms that overlap.
pub fn check_overlaps(house: &House, wrong: &mut Complaints) {
    for (n, room) in house.rooms.iter().enumerate() {
        for (m, other) in house.rooms[..n].iter().enumerate() {
            let depth = polygon::depth(&room.outline, &other.outline);
            if depth > TOUCH_M {
                let problem = format!(
                    "the {} overlaps the {} (rooms[{m}]) by {depth:.2} m: rooms may only share walls",
                    room.label, other.label
                );
                wrong.push(HouseError::new(format!("rooms[{n}]"), problem));
            }
        }
    }
}

/// The doors of a file.
pub fn doors(
    file: &HouseFile,
    house: &House,
    names: &[String],
    wrong: &mut Complaints,
) -> Vec<Door> {
    if !wrong.is_empty() {
        return Vec::new();
    }
    check_overlaps(house, wrong);
    let doors = file.doors.iter().enumerate();
    doors.filter_map(|(n, door)| one_door(door, n, house, names, wrong)).collect()
}

fn one_door(
    file: &DoorFile,
    n: usize,
    house: &House,
    names: &[String],
    wrong: &mut Complaints,
) -> Option<Door> {
    let path = format!("doors[{n}]");
    let mut rooms = [0; 2];
    for (k, name) in file.between.iter().enumerate() {
        rooms[k] = room_named(name, names, &format!("{path}.between[{k}]"), wrong)?;
    }
    let (width, height_m) =
        (file.width.unwrap_or(DOOR_WIDTH_M), file.height.unwrap_or(DOOR_HEIGHT_M));
    let fits = in_range(&format!("{path}.width"), width, [0.4, 10.0], wrong)
        & in_range(&format!("{path}.height"), height_m, [1.2, house.wall_height_m], wrong);
    if !fits {
        return None;
    }
    let ends = shared_wall(house, rooms, file.at, width).map_err(|problem| {
        let names = format!("{:?} and {:?}", file.between[0], file.between[1]);
        let [x, y] = file.at;
        let problem = format!("a door {width} m wide at ({x}, {y}) {problem} {names}");
        wrong.push(HouseError::new(format!("{path}.at"), problem));
    });
    Some(Door { rooms, ends: ends.ok()?, height_m })
}

/// Number of the room of this name.
pub fn room_named(
    name: &str,
    names: &[String],
    path: &str,
    wrong: &mut Complaints,
) -> Option<usize> {
    let found = names.iter().position(|known| known == name);
    if found.is_none() {
        let known = names.join(", ");
        wrong.push(HouseError::new(path, format!("there is no room {name:?}; there are {known}")));
    }
    found
}
