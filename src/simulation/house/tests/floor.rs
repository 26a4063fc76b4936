//! Walls, doors, and whether one gets through.

use super::*;
use crate::simulation::blocks::Block;
use crate::simulation::shapes::polygon;

/// Side of a cell, metres.
const CELL_M: f64 = 0.05;
/// Half the width of the robot, metres.
const ROBOT_M: f64 = 0.22;

/// What is in the way of a robot 1.3 m high.
fn obstacles(house: &House) -> Vec<Block> {
    let walls = house.walls().into_iter().map(|slab| footprint(&slab.pose, slab.size));
    let things = house.things.iter().map(|thing| footprint(&thing.pose, thing.size));
    walls.chain(things).filter(|block| block.z[0] < 1.3 && block.z[1] > 0.05).collect()
}

fn distance(block: &Block, [x, y]: [f64; 2]) -> f64 {
    let (dx, dy) = (x - block.centre[0], y - block.centre[1]);
    let [c, s] = block.along;
    let along = ((dx * c + dy * s).abs() - block.half[0]).max(0.0);
    let across = ((dy * c - dx * s).abs() - block.half[1]).max(0.0);
    libm::hypot(along, across)
}

/// Cells that a robot reaches from a point.
fn reached(house: &House, from: [f64; 2]) -> std::collections::BTreeSet<(i32, i32)> {
    let obstacles = obstacles(house);
    let at =
        |(i, j): (i32, i32)| [from[0] + CELL_M * f64::from(i), from[1] + CELL_M * f64::from(j)];
    let free = |cell: (i32, i32)| {
        let point = at(cell);
        let inside = house.rooms.iter().any(|room| polygon::contains(&room.outline, point));
        inside && obstacles.iter().all(|block| distance(block, point) > ROBOT_M)
    };
    let mut found = std::collections::BTreeSet::new();
    let mut open = vec![(0, 0)];
    while let Some((i, j)) = open.pop() {
        if free((i, j)) && found.insert((i, j)) {
            open.extend([(i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)]);
        }
    }
    found
}

#[test]
fn a_robot_gets_through_every_door_into_every_room() {
    for house in houses() {
        let middle = |door: &Door| [0, 1].map(|k| f64::midpoint(door.ends[0][k], door.ends[1][k]));
        // A hair beside the line of the wall, which belongs to neither room.
        let start = middle(&house.doors[0]).map(|c| c + 0.013);
        let cells = reached(&house, start);
        let at = |(i, j): &(i32, i32)| {
            [start[0] + CELL_M * f64::from(*i), start[1] + CELL_M * f64::from(*j)]
        };
        for room in &house.rooms {
            let count =
                cells.iter().filter(|cell| polygon::contains(&room.outline, at(cell))).count();
            let area_m2 = count as f64 * CELL_M * CELL_M;
            assert!(area_m2 > 0.6, "{}: {} has {area_m2:.2} m2", house.name, room.label);
        }
        for door in &house.doors {
            let [x, y] = middle(door);
            let near = cells.iter().any(|cell| {
                let [u, v] = at(cell);
                libm::hypot(x - u, y - v) < 0.1
            });
            assert!(near, "{}: the door at ({x}, {y}) is blocked", house.name);
        }
    }
}

#[test]
fn walls_stand_around_every_room_and_leave_the_doors_open() {
    for house in houses() {
        let walls: Vec<Block> =
            house.walls().iter().map(|slab| footprint(&slab.pose, slab.size)).collect();
        let holds = |[x, y]: [f64; 2], z: f64| {
            let inside = |it: &Block| distance(it, [x, y]) == 0.0 && it.z[0] < z && z < it.z[1];
            walls.iter().any(inside)
        };
        let in_door = |p: [f64; 2]| {
            house.doors.iter().any(|door| {
                let [a, b] = door.ends;
                let far = |q: [f64; 2]| libm::hypot(p[0] - q[0], p[1] - q[1]);
                far(a) + far(b) < libm::hypot(a[0] - b[0], a[1] - b[1]) + 1e-6
            })
        };
        for (a, b) in house.rooms.iter().flat_map(|room| polygon::edges(&room.outline)) {
            for n in 0..=40 {
                let share = (f64::from(n) + 0.37) / 41.0;
                let p = [0, 1].map(|k| a[k] + share * (b[k] - a[k]));
                assert_eq!(holds(p, 1.0), !in_door(p), "{}: {p:?}", house.name);
                assert!(holds(p, 2.3), "{}: no lintel at {p:?}", house.name);
            }
        }
    }
}

#[test]
fn a_shared_wall_is_there_once() {
    for house in houses() {
        let walls: Vec<Block> =
            house.walls().iter().map(|slab| footprint(&slab.pose, slab.size)).collect();
        for (n, a) in walls.iter().enumerate() {
            for b in &walls[..n] {
                // They meet in corners, by their thickness.
                assert!(a.depth(b) < house.wall_thickness_m + 1e-6, "{}: {a:?} {b:?}", house.name);
            }
        }
    }
}

#[test]
fn floors_and_ceilings_fill_the_rooms() {
    for house in houses() {
        for (floor, room) in house.floors().iter().zip(&house.rooms) {
            let up = |[a, b, c]: &[u32; 3]| {
                let at = |n: &u32| {
                    let [x, y, _] = floor.mesh.vertices[*n as usize].map(f64::from);
                    [x, y]
                };
                let level = [a, b, c].iter().all(|n| floor.mesh.vertices[**n as usize][2] > 0.0);
                if level { polygon::side(at(a), at(b), at(c)) / 2.0 } else { 0.0 }
            };
            let area: f64 = floor.mesh.triangles.iter().map(up).sum();
            assert!((area - room.area_m2()).abs() < 1e-3, "{}: {area}", room.label);
            assert!((footprint(&floor.pose, floor.size).z[1]).abs() < 1e-9);
        }
        let low = |slab: &Slab| footprint(&slab.pose, slab.size).z[0];
        assert!(house.ceilings().iter().all(|it| (low(it) - house.wall_height_m).abs() < 1e-6));
    }
}
