//! Collision-free ways through a house.

use pathfinding::directed::astar::astar;
use pathfinding::directed::dijkstra::dijkstra_all;

use super::grid::{CELL_M, Cell, Grid};

/// Ways are kept this far from things where there is room, millimetres.
const COMFORT_MM: i16 = 200;

/// A way from `from` to `to` as the points where it turns, both ends included; `None` if there
/// is none. The ends are moved to the nearest place where the robot fits.
///
/// A* over the eight neighbours of each cell, nearness to obstacles costing extra; then every
/// turn that can be cut straight is.
pub fn plan(grid: &Grid, from: [f64; 2], to: [f64; 2]) -> Option<Vec<[f64; 2]>> {
    let (start, goal) = (nearest_free(grid, from)?, nearest_free(grid, to)?);
    let (cells, _) = astar(
        &start,
        |cell| neighbours(grid, *cell),
        |cell| octile(*cell, goal),
        |cell| *cell == goal,
    )?;
    let mut points: Vec<[f64; 2]> = cells.into_iter().map(|cell| grid.point(cell)).collect();
    if grid.is_free(grid.cell(from)) {
        points[0] = from;
    }
    Some(straightened(grid, &points))
}

/// Cells that can be reached from `from`, each with the length of the way in metres.
pub fn reachable(grid: &Grid, from: [f64; 2]) -> std::collections::BTreeMap<Cell, f64> {
    let Some(start) = nearest_free(grid, from) else { return std::collections::BTreeMap::new() };
    let found = dijkstra_all(&start, |cell| neighbours(grid, *cell));
    let metres = |cost: u32| f64::from(cost) / 10.0 * CELL_M;
    found.into_iter().map(|(cell, (_, cost))| (cell, metres(cost))).chain([(start, 0.0)]).collect()
}

/// Length of a way, metres.
pub fn length(way: &[[f64; 2]]) -> f64 {
    way.windows(2).map(|pair| distance(pair[0], pair[1])).sum()
}

/// Distance of two points, metres.
pub fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    libm::hypot(b[0] - a[0], b[1] - a[1])
}

/// The free cell nearest to a point, within a metre and a half.
fn nearest_free(grid: &Grid, point: [f64; 2]) -> Option<Cell> {
    const RINGS: i32 = 30;
    let (column, row) = grid.cell(point);
    (0..=RINGS).find_map(|ring| {
        let range = -ring..=ring;
        range
            .clone()
            .flat_map(|dx| range.clone().map(move |dy| (dx, dy)))
            .filter(|(dx, dy): &(i32, i32)| dx.abs().max(dy.abs()) == ring)
            .map(|(dx, dy)| (column + dx, row + dy))
            .filter(|cell| grid.is_free(*cell))
            .min_by(|a, b| {
                let to = |cell: &Cell| distance(grid.point(*cell), point);
                to(a).total_cmp(&to(b)).then(a.cmp(b))
            })
    })
}

/// Neighbours with the cost of going there: 10 a cell straight, 14 across, more near obstacles.
fn neighbours(grid: &Grid, (column, row): Cell) -> Vec<(Cell, u32)> {
    let mut found = Vec::with_capacity(8);
    for (dx, dy, cost) in [
        (1, 0, 10),
        (-1, 0, 10),
        (0, 1, 10),
        (0, -1, 10),
        (1, 1, 14),
        (1, -1, 14),
        (-1, 1, 14),
        (-1, -1, 14),
    ] {
        let cell = (column + dx, row + dy);
        let clearance = grid.clearance_mm(cell);
        let cuts_corner = dx != 0
            && dy != 0
            && !(grid.is_free((column + dx, row)) && grid.is_free((column, row + dy)));
        if clearance >= 0 && !cuts_corner {
            let near = u32::from((COMFORT_MM - clearance).max(0).unsigned_abs()) / 20;
            found.push((cell, cost + near));
        }
    }
    found
}

/// A lower bound of the cost from one cell to another.
fn octile(a: Cell, b: Cell) -> u32 {
    let (dx, dy) = (a.0.abs_diff(b.0), a.1.abs_diff(b.1));
    10 * dx.max(dy) + 4 * dx.min(dy)
}

/// Leaves out the points between which the robot can go straight.
fn straightened(grid: &Grid, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let Some(first) = points.first() else { return Vec::new() };
    let (mut way, mut at) = (vec![*first], 0);
    while at + 1 < points.len() {
        let clear = |n: &usize| grid.is_clear(points[at], points[*n]);
        at = (at + 2..points.len()).rev().find(clear).unwrap_or(at + 1);
        way.push(points[at]);
    }
    way
}
