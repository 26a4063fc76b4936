//! Where to stand in a room to see what is in it.

use std::collections::BTreeMap;

use super::grid::{Cell, Grid, to_segment};
use super::path::distance;
use crate::simulation::blocks::Block;
use crate::simulation::house::House;
use crate::simulation::shapes::polygon::contains;

/// Things are seen well from this near and this far, metres.
const SEEN_M: std::ops::Range<f64> = 0.5..3.2;
/// Places to stand are tried this many cells apart.
const EVERY: i32 = 6;
/// At most this many per room.
const MOST: usize = 3;

/// Points of a room from which, together, all `targets` that can be seen are seen; the nearest
/// way from one to the next is for the caller to choose.
///
/// Greedy cover: the point that sees most, then the one that sees most of the rest.
pub fn viewpoints(
    house: &House,
    (grid, walls): (&Grid, &[Block]),
    reachable: &BTreeMap<Cell, f64>,
    room: usize,
    targets: &[[f64; 2]],
) -> Vec<[f64; 2]> {
    let walls: Vec<[[f64; 2]; 2]> = walls.iter().filter(|wall| wall.z[0] < 1.0).map(line).collect();
    let outline = &house.rooms[room].outline;
    let candidates: Vec<(Cell, [f64; 2])> = reachable
        .keys()
        .filter(|(column, row)| column % EVERY == 0 && row % EVERY == 0)
        .map(|cell| (*cell, grid.point(*cell)))
        .filter(|(_, point)| contains(outline, *point))
        .collect();
    let sees = |from: [f64; 2], to: [f64; 2]| {
        SEEN_M.contains(&distance(from, to)) && walls.iter().all(|wall| !crosses(from, to, *wall))
    };
    let mut left: Vec<[f64; 2]> = targets.to_vec();
    let mut chosen = Vec::new();
    while chosen.len() < MOST && (chosen.is_empty() || !left.is_empty()) {
        let best = candidates.iter().max_by_key(|(cell, point)| {
            let seen = left.iter().filter(|target| sees(*point, **target)).count();
            // Ties: where there is most room, then the first.
            (seen, grid.clearance_mm(*cell), std::cmp::Reverse(*cell))
        });
        let Some((_, point)) = best else { break };
        let before = left.len();
        left.retain(|target| !sees(*point, *target));
        if left.len() == before && !chosen.is_empty() {
            break;
        }
        chosen.push(*point);
    }
    chosen
}

/// The middle line of a wall.
fn line(wall: &Block) -> [[f64; 2]; 2] {
    let ([x, y], [c, s], half) = (wall.centre, wall.along, wall.half[0]);
    [[x - half * c, y - half * s], [x + half * c, y + half * s]]
}

/// Whether the line from `a` to `b` crosses a wall.
fn crosses(a: [f64; 2], b: [f64; 2], [p, q]: [[f64; 2]; 2]) -> bool {
    let side = |o: [f64; 2], d: [f64; 2], x: [f64; 2]| {
        (d[0] - o[0]) * (x[1] - o[1]) - (d[1] - o[1]) * (x[0] - o[0])
    };
    let ends_apart = side(p, q, a) * side(p, q, b) < 0.0;
    // What hangs on a wall is in the room all the same.
    ends_apart && side(a, b, p) * side(a, b, q) < 0.0 && to_segment(b, [p, q]) > 0.15
}
