//! Doors for a house from a graph.

use super::is_door;
use super::rooms::Storey;
use crate::graph::SceneGraph;
use crate::simulation::blocks::Block;
use crate::simulation::house::structure::shared_wall;
use crate::simulation::house::{Door, House, footprint};
use crate::simulation::shapes::polygon;

/// A door of a graph may be this far from the wall it is in, metres.
const NEAR_M: f64 = 0.5;
/// Widths that are tried, widest first, metres.
const WIDTHS_M: [f64; 2] = [0.9, 0.7];
const HEIGHT_M: f64 = 2.05;
/// Places for a door are tried this far apart, metres.
const STEP_M: f64 = 0.1;
/// Before and behind a door there should be room, this far from the wall, metres.
const BEFORE_M: f64 = 0.45;

pub fn put(graph: &SceneGraph, storey: &Storey, house: &mut House, notes: &mut Vec<String>) {
    let things = in_the_way(graph);
    for (_, object) in graph.objects().filter(|(_, object)| is_door(object)) {
        let [x, y, _] = object.pose.position();
        for pair in pairs(house.rooms.len()) {
            let [sx, sy, _] = object.size.metres();
            let width = sx.max(sy).clamp(WIDTHS_M[1], WIDTHS_M[0]);
            if let Some(door) = near(house, pair, [x, y], width) {
                add(house, door);
            }
        }
    }
    for (a, b) in graph.access() {
        let number = |id| storey.rooms.iter().position(|(room, _)| *room == id);
        let (Some(a), Some(b)) = (number(a), number(b)) else { continue };
        let known = house.doors.iter().any(|door| same(door.rooms, [a, b]));
        if !known && !where_free(house, &things, [a, b]) {
            let [a, b] = [a, b].map(|n| house.rooms[n].label.clone());
            notes.push(format!("{a} and {b} give access to each other but share no wall: no door"));
        }
    }
    connect(house, &things, notes);
}

fn pairs(count: usize) -> Vec<[usize; 2]> {
    (0..count).flat_map(|a| (a + 1..count).map(move |b| [a, b])).collect()
}

fn same(a: [usize; 2], b: [usize; 2]) -> bool {
    a == b || a == [b[1], b[0]]
}

/// A door where an object is one: on the nearest wall that the rooms share.
fn near(house: &House, rooms: [usize; 2], at: [f64; 2], width: f64) -> Option<Door> {
    let walls = polygon::edges(&house.rooms[rooms[0]].outline);
    let mut on_wall = walls.filter_map(|(a, b)| {
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let share = ((at[0] - a[0]) * dx + (at[1] - a[1]) * dy) / (dx * dx + dy * dy);
        let foot = [a[0] + share * dx, a[1] + share * dy];
        let far = libm::hypot(at[0] - foot[0], at[1] - foot[1]);
        (far < NEAR_M).then_some(foot)
    });
    let ends = on_wall.find_map(|foot| shared_wall(house, rooms, foot, width).ok())?;
    Some(Door { rooms, ends, height_m: HEIGHT_M })
}

/// Adds a door unless there is one at the place.
fn add(house: &mut House, door: Door) {
    let middle = |door: &Door| [0, 1].map(|k| f64::midpoint(door.ends[0][k], door.ends[1][k]));
    let [x, y] = middle(&door);
    let apart = |other: &Door| {
        let [u, v] = middle(other);
        libm::hypot(x - u, y - v) > 1.2
    };
    if house.doors.iter().all(apart) {
        house.doors.push(door);
    }
}

/// A door in the wall that two rooms share, if they share one: a graph says that there is a way,
/// not where, so it is put where things on the floor leave most room, as near to the middle as
/// may be.
fn where_free(house: &mut House, things: &[Block], rooms: [usize; 2]) -> bool {
    let [a, b] = rooms.map(|n| house.rooms[n].outline.clone());
    let box_of = |outline: &[[f64; 2]], k: usize| {
        let values = outline.iter().map(|p| p[k]);
        (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max))
    };
    for k in 0..2 {
        let ((_, a1), (b0, b1)) = (box_of(&a, k), box_of(&b, k));
        let line = if (a1 - b0).abs() < 0.01 { a1 } else { b1 };
        let ((p0, p1), (q0, q1)) = (box_of(&a, 1 - k), box_of(&b, 1 - k));
        let point = |off: f64, along: f64| match k {
            0 => [line + off, along],
            _ => [along, line + off],
        };
        for width in WIDTHS_M {
            let range = (p0.max(q0), p1.min(q1));
            let ends = by_room(things, range, width, &point)
                .into_iter()
                .find_map(|along| shared_wall(house, rooms, point(0.0, along), width).ok());
            if let Some(ends) = ends {
                house.doors.push(Door { rooms, ends, height_m: HEIGHT_M });
                return true;
            }
        }
    }
    false
}

/// Places along a wall, those with most room before and behind them first.
fn by_room(
    things: &[Block],
    (low, high): (f64, f64),
    width: f64,
    point: &dyn Fn(f64, f64) -> [f64; 2],
) -> Vec<f64> {
    let (middle, steps) = (f64::midpoint(low, high), ((high - low) / STEP_M) as i32 / 2);
    let mut places: Vec<(i32, i32)> = (-steps..=steps)
        .map(|n| {
            let along = middle + f64::from(n) * STEP_M;
            let before = [-BEFORE_M, 0.0, BEFORE_M].map(|off| point(off, along));
            let nearest = things.iter().flat_map(|thing| before.map(|at| thing.distance(at)));
            let room = nearest.fold(width / 2.0, f64::min);
            // Whole centimetres, so that equal is equal; then the nearest to the middle.
            (-((room * 100.0) as i32), n)
        })
        .collect();
    places.sort_by_key(|(room, n)| (*room, n.abs(), *n));
    places.into_iter().map(|(_, n)| middle + f64::from(n) * STEP_M).collect()
}

/// What stands on the floor in the way of people.
fn in_the_way(graph: &SceneGraph) -> Vec<Block> {
    let blocks = graph.objects().map(|(_, object)| footprint(&object.pose, object.size));
    blocks.filter(|block| block.z[0] < 1.2 && block.z[1] > 0.05).collect()
}

/// Adds doors until every room that shares a wall with another can be reached.
fn connect(house: &mut House, things: &[Block], notes: &mut Vec<String>) {
    let mut part: Vec<usize> = (0..house.rooms.len()).collect();
    let merge = |part: &mut Vec<usize>, [a, b]: [usize; 2]| {
        let (a, b) = (part[a], part[b]);
        part.iter_mut().filter(|p| **p == b).for_each(|p| *p = a);
    };
    for door in house.doors.clone() {
        merge(&mut part, door.rooms);
    }
    for pair in pairs(house.rooms.len()) {
        if part[pair[0]] != part[pair[1]] && where_free(house, things, pair) {
            merge(&mut part, pair);
            let [a, b] = pair.map(|n| house.rooms[n].label.clone());
            notes.push(format!("a door was made between {a} and {b}: nothing else led there"));
        }
    }
    let apart = part.iter().filter(|p| **p != part[0]).count();
    if apart > 0 {
        notes.push(format!("{apart} of {} rooms cannot be reached", part.len()));
    }
}
