//! Where the robot fits: [`Grid`], an occupancy grid of the floor.

use crate::simulation::blocks::Block;
use crate::simulation::house::House;
use crate::simulation::shapes::polygon::contains;

/// Side of a cell, metres.
pub const CELL_M: f64 = 0.05;

/// A cell: column along x, row along y.
pub type Cell = (i32, i32);

/// Cells whose centre the robot's centre may take.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    origin: [f64; 2],
    width: i32,
    height: i32,
    /// Distance to the nearest obstacle less the robot's radius, millimetres; < 0 where it would
    /// touch.
    clearance_mm: Vec<i16>,
}

/// Farther than this from anything is as good as any distance.
const FAR_M: f64 = 1.0;

impl Grid {
    /// The grid of a house for a robot of `radius_m` among `obstacles`, walls included.
    pub fn new(house: &House, obstacles: &[Block], radius_m: f64) -> Self {
        let corners = || house.rooms.iter().flat_map(|room| room.outline.iter());
        let least = |axis: usize| corners().map(|c| c[axis]).fold(f64::INFINITY, f64::min);
        let most = |axis: usize| corners().map(|c| c[axis]).fold(f64::NEG_INFINITY, f64::max);
        let origin = [least(0), least(1)];
        let cells = |axis: usize| (((most(axis) - origin[axis]) / CELL_M) as i32 + 1).max(1);
        let (width, height) = (cells(0), cells(1));
        let mut grid = Self { origin, width, height, clearance_mm: Vec::new() };
        grid.clearance_mm = (0..width * height)
            .map(|n| {
                let point = grid.point((n % width, n / width));
                let inside = house.rooms.iter().any(|room| contains(&room.outline, point))
                    || house.doors.iter().any(|door| to_segment(point, door.ends) < CELL_M);
                let distances = obstacles.iter().map(|block| block.distance(point));
                let nearest = distances.fold(FAR_M, f64::min);
                if inside { ((nearest - radius_m) * 1000.0) as i16 } else { i16::MIN }
            })
            .collect();
        grid
    }

    /// The cell of a point, which may lie outside of the grid.
    pub fn cell(&self, [x, y]: [f64; 2]) -> Cell {
        let index = |value: f64, origin: f64| libm::floor((value - origin) / CELL_M) as i32;
        (index(x, self.origin[0]), index(y, self.origin[1]))
    }

    /// The centre of a cell, metres.
    pub fn point(&self, (column, row): Cell) -> [f64; 2] {
        let at = |n: i32, origin: f64| origin + (f64::from(n) + 0.5) * CELL_M;
        [at(column, self.origin[0]), at(row, self.origin[1])]
    }

    /// Free space around a robot in this cell, millimetres; negative where it does not fit.
    pub fn clearance_mm(&self, (column, row): Cell) -> i16 {
        if !(0..self.width).contains(&column) || !(0..self.height).contains(&row) {
            return i16::MIN;
        }
        self.clearance_mm[(row * self.width + column) as usize]
    }

    /// Whether the robot fits there.
    pub fn is_free(&self, cell: Cell) -> bool {
        self.clearance_mm(cell) >= 0
    }

    /// All free cells, row by row.
    pub fn free_cells(&self) -> impl Iterator<Item = Cell> + '_ {
        (0..self.width * self.height)
            .map(|n| (n % self.width, n / self.width))
            .filter(|cell| self.is_free(*cell))
    }

    /// Whether the robot can go straight from one point to the other.
    pub fn is_clear(&self, from: [f64; 2], to: [f64; 2]) -> bool {
        let length = libm::hypot(to[0] - from[0], to[1] - from[1]);
        // Twice in every cell.
        let steps = (length / CELL_M * 2.0) as i32 + 1;
        (0..=steps).all(|n| {
            let t = f64::from(n) / f64::from(steps);
            let at = [from[0] + (to[0] - from[0]) * t, from[1] + (to[1] - from[1]) * t];
            self.is_free(self.cell(at))
        })
    }
}

/// Distance of a point to a segment, metres.
pub fn to_segment([x, y]: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let square = dx * dx + dy * dy;
    let along = if square > 0.0 { ((x - a[0]) * dx + (y - a[1]) * dy) / square } else { 0.0 };
    let t = along.clamp(0.0, 1.0);
    libm::hypot(x - a[0] - t * dx, y - a[1] - t * dy)
}
