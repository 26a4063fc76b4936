//! Where the robot fits: [`Grid`], an occupancy grid of the floor.

use crate::simulation::house::House;

/// A turned rectangle on the floor with the heights it takes up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// Centre, metres.
    pub centre: [f64; 2],
    /// Half extents along its own x and y, metres.
    pub half: [f64; 2],
    /// Turn about z, radians.
    pub yaw: f64,
}

impl Footprint {
    /// Distance of a point to the rectangle, metres; 0 inside.
    pub fn distance(&self, [x, y]: [f64; 2]) -> f64 {
        let (dx, dy) = (x - self.centre[0], y - self.centre[1]);
        let (sin, cos) = (libm::sin(self.yaw), libm::cos(self.yaw));
        let along = (dx * cos + dy * sin).abs() - self.half[0];
        let across = (dy * cos - dx * sin).abs() - self.half[1];
        libm::hypot(along.max(0.0), across.max(0.0))
    }
}

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
    /// The grid of a house for a robot of `radius_m` among `obstacles`.
    pub fn new(house: &House, obstacles: &[Footprint], radius_m: f64) -> Self {
        let corners = || house.rooms.iter().flat_map(|room| room.outline.iter());
        let least = |axis: usize| corners().map(|c| c[axis]).fold(f64::INFINITY, f64::min);
        let most = |axis: usize| corners().map(|c| c[axis]).fold(f64::NEG_INFINITY, f64::max);
        let origin = [least(0), least(1)];
        let cells = |axis: usize| (((most(axis) - origin[axis]) / CELL_M) as i32 + 1).max(1);
        let (width, height) = (cells(0), cells(1));
        let mut grid = Self { origin, width, height, clearance_mm: Vec::new() };
        let walls = walls(house);
        let thickness = house.wall_thickness_m / 2.0;
        grid.clearance_mm = (0..width * height)
            .map(|n| {
                let point = grid.point((n % width, n / width));
                let inside = house.rooms.iter().any(|room| contains(&room.outline, point))
                    || house.doors.iter().any(|door| to_segment(point, door.ends) < CELL_M);
                let to_wall = walls.iter().map(|wall| to_segment(point, *wall) - thickness);
                let to_thing = obstacles.iter().map(|thing| thing.distance(point));
                let nearest = to_wall.chain(to_thing).fold(FAR_M, f64::min);
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

/// Whether a point lies in a polygon (even-odd rule).
pub fn contains(outline: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let mut inside = false;
    for (n, a) in outline.iter().enumerate() {
        let b = outline[(n + 1) % outline.len()];
        if (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) {
            inside = !inside;
        }
    }
    inside
}

/// Distance of a point to a segment, metres.
pub fn to_segment([x, y]: [f64; 2], [a, b]: [[f64; 2]; 2]) -> f64 {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let square = dx * dx + dy * dy;
    let along = if square > 0.0 { ((x - a[0]) * dx + (y - a[1]) * dy) / square } else { 0.0 };
    let t = along.clamp(0.0, 1.0);
    libm::hypot(x - a[0] - t * dx, y - a[1] - t * dy)
}

/// The walls of a house as segments on the floor, door openings left out.
pub fn walls(house: &House) -> Vec<[[f64; 2]; 2]> {
    let mut walls = Vec::new();
    for room in &house.rooms {
        for (n, a) in room.outline.iter().enumerate() {
            let b = room.outline[(n + 1) % room.outline.len()];
            walls.extend(without_doors([*a, b], house));
        }
    }
    walls
}

fn without_doors([a, b]: [[f64; 2]; 2], house: &House) -> Vec<[[f64; 2]; 2]> {
    let length = libm::hypot(b[0] - a[0], b[1] - a[1]);
    let along = |p: [f64; 2]| {
        ((p[0] - a[0]) * (b[0] - a[0]) + (p[1] - a[1]) * (b[1] - a[1])) / length.max(1e-9)
    };
    let on_wall = |door: &[[f64; 2]; 2]| door.iter().all(|end| to_segment(*end, [a, b]) < 0.02);
    let mut gaps: Vec<(f64, f64)> = house
        .doors
        .iter()
        .map(|door| door.ends)
        .filter(on_wall)
        .map(|[p, q]| (along(p).min(along(q)), along(p).max(along(q))))
        .collect();
    gaps.sort_by(|p, q| p.0.total_cmp(&q.0));
    let at = |s: f64| [a[0] + (b[0] - a[0]) * s / length, a[1] + (b[1] - a[1]) * s / length];
    let (mut walls, mut from) = (Vec::new(), 0.0);
    for (start, end) in gaps {
        if start > from {
            walls.push([at(from), at(start)]);
        }
        from = end.max(from);
    }
    if length > from {
        walls.push([at(from), at(length)]);
    }
    walls
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_distance_to_a_turned_rectangle_is_that_of_its_nearest_side() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let thing = Footprint { centre: [1.0, 1.0], half: [2.0, 0.5], yaw: quarter };
        for (point, expected) in
            [([1.0, 1.0], 0.0), ([1.0, 2.9], 0.0), ([1.0, 3.5], 0.5), ([2.5, 1.0], 1.0)]
        {
            assert!((thing.distance(point) - expected).abs() < 1e-9, "{point:?}");
        }
    }

    #[test]
    fn a_point_is_in_a_polygon_by_its_corners() {
        let l_shape = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
        for (point, inside) in
            [([0.5, 0.5], true), ([1.5, 0.5], true), ([1.5, 1.5], false), ([-0.5, 0.5], false)]
        {
            assert_eq!(contains(&l_shape, point), inside, "{point:?}");
        }
    }
}
