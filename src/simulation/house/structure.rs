//! What the building consists of: walls with openings, floors, ceilings.

use std::sync::Arc;

use super::{Door, House};
use crate::geometry::{Pose, Size};
use crate::simulation::mesh::{Material, Mesh};
use crate::simulation::shapes::paint;
use crate::simulation::shapes::polygon;

/// A piece of the building.
#[derive(Clone, Debug, PartialEq)]
pub struct Slab {
    /// `world_from_slab` of the centre of its box.
    pub pose: Pose,
    /// Its box.
    pub size: Size,
    /// How it looks; fills the box.
    pub mesh: Arc<Mesh>,
}

/// Points closer than this to a line are on it, metres.
pub const ON_LINE_M: f64 = 0.01;
/// Thickness of floors and ceilings, metres.
const FLOOR_M: f64 = 0.05;

/// A straight piece of wall on the floor: from `at(low)` to `at(high)`.
#[derive(Clone, Copy, Debug)]
struct Line {
    start: [f64; 2],
    along: [f64; 2],
    length: f64,
}

impl Line {
    fn new(a: [f64; 2], b: [f64; 2]) -> Self {
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let length = libm::hypot(dx, dy);
        Self { start: a, along: [dx / length, dy / length], length }
    }

    fn at(&self, s: f64) -> [f64; 2] {
        [self.start[0] + s * self.along[0], self.start[1] + s * self.along[1]]
    }

    /// Where a point lies along the line, and how far to its left.
    fn of(&self, p: [f64; 2]) -> (f64, f64) {
        let (dx, dy) = (p[0] - self.start[0], p[1] - self.start[1]);
        let [c, s] = self.along;
        (dx * c + dy * s, dy * c - dx * s)
    }

    /// The stretch of this line that two points on it span; `None` if they are beside it.
    fn stretch(&self, ends: [[f64; 2]; 2]) -> Option<(f64, f64)> {
        let [(p, a), (q, b)] = ends.map(|end| self.of(end));
        let on_line = a.abs() < ON_LINE_M && b.abs() < ON_LINE_M;
        on_line.then_some((p.min(q), p.max(q)))
    }
}

/// The ends of an opening `width` wide around `at` in the wall that two rooms share.
pub fn shared_wall(
    house: &House,
    rooms: [usize; 2],
    at: [f64; 2],
    width: f64,
) -> Result<[[f64; 2]; 2], &'static str> {
    if rooms[0] == rooms[1] {
        return Err("needs two different rooms, not");
    }
    let [a, b] = rooms.map(|n| &house.rooms[n].outline);
    let margin = house.wall_thickness_m / 2.0;
    let mut near = false;
    for (from, to) in polygon::edges(a) {
        let line = Line::new(from, to);
        let (s, aside) = line.of(at);
        if aside.abs() > ON_LINE_M || s < -ON_LINE_M || s > line.length + ON_LINE_M {
            continue;
        }
        let ends = [line.at(s - width / 2.0), line.at(s + width / 2.0)];
        let within = |low: f64, high: f64| {
            s - width / 2.0 >= low + margin - 1e-6 && s + width / 2.0 <= high - margin + 1e-6
        };
        for (from, to) in polygon::edges(b) {
            if let Some((low, high)) = line.stretch([from, to]) {
                near |= low < s && s < high;
                if within(low.max(0.0), high.min(line.length)) {
                    return Ok(ends);
                }
            }
        }
    }
    Err(if near { "reaches beyond the wall shared by" } else { "is not on a wall shared by" })
}

/// A stretch of wall with nothing in it, and what it is: whole, or over an opening.
struct Run {
    line: Line,
    from: f64,
    to: f64,
    z: [f64; 2],
}

impl House {
    /// The walls as boxes, door openings left out; above an opening hangs a lintel. A wall that
    /// two rooms share is there once. x of each box runs along the wall.
    pub fn walls(&self) -> Vec<Slab> {
        let mut runs = Vec::new();
        for line in self.wall_lines() {
            self.cut(&line, &mut runs);
        }
        runs.iter().filter_map(|run| self.wall_slab(run)).collect()
    }

    /// The floors of the rooms; their upper faces are at z = 0.
    pub fn floors(&self) -> Vec<Slab> {
        let rooms = self.rooms.iter();
        rooms.filter_map(|room| level(&room.outline, -FLOOR_M, room.floor)).collect()
    }

    /// The ceilings of the rooms; their lower faces are at the height of the walls.
    pub fn ceilings(&self) -> Vec<Slab> {
        let white = paint::plain(0x00fa_faf7);
        let rooms = self.rooms.iter();
        rooms.filter_map(|room| level(&room.outline, self.wall_height_m, white)).collect()
    }

    /// Lines of all walls, each once.
    fn wall_lines(&self) -> Vec<(Line, f64, f64)> {
        let mut lines: Vec<(Line, f64, f64)> = Vec::new();
        for (a, b) in self.rooms.iter().flat_map(|room| polygon::edges(&room.outline)) {
            let line = Line::new(a, b);
            let known = lines
                .iter()
                .filter_map(|(other, from, to)| line.stretch([other.at(*from), other.at(*to)]));
            let left = without(vec![(0.0, line.length)], known.collect());
            let half = self.wall_thickness_m / 2.0;
            // Walls meet in the corners: both reach into them.
            lines.extend(left.into_iter().map(|(from, to)| {
                let from = if from < ON_LINE_M { -half } else { from };
                let to = if to > line.length - ON_LINE_M { line.length + half } else { to };
                (line, from, to)
            }));
        }
        lines
    }

    /// Cuts the doors out of a wall.
    fn cut(&self, (line, from, to): &(Line, f64, f64), runs: &mut Vec<Run>) {
        let height = self.wall_height_m;
        let openings: Vec<(f64, f64, &Door)> = self
            .doors
            .iter()
            .filter_map(|door| line.stretch(door.ends).map(|(low, high)| (low, high, door)))
            .filter(|(low, high, _)| *low < *to && *high > *from)
            .collect();
        for (low, high, door) in &openings {
            let z = [door.height_m, height];
            runs.push(Run { line: *line, from: low.max(*from), to: high.min(*to), z });
        }
        let gaps = openings.iter().map(|(low, high, _)| (*low, *high)).collect();
        let solid = without(vec![(*from, *to)], gaps).into_iter();
        runs.extend(solid.map(|(from, to)| Run { line: *line, from, to, z: [0.0, height] }));
    }

    fn wall_slab(&self, run: &Run) -> Option<Slab> {
        let [x, y] = run.line.at(f64::midpoint(run.from, run.to));
        // Half the angle, from its tangent: exact for walls along an axis.
        let half = libm::atan2(run.line.along[1], run.line.along[0]) / 2.0;
        let z = f64::midpoint(run.z[0], run.z[1]);
        let pose = Pose::new([x, y, z], [libm::cos(half), 0.0, 0.0, libm::sin(half)]).ok()?;
        let size = Size::new(run.to - run.from, self.wall_thickness_m, run.z[1] - run.z[0]).ok()?;
        let mesh = crate::simulation::shapes::block(size, self.wall);
        Some(Slab { pose, size, mesh: Arc::new(mesh) })
    }
}

/// Stretches less others.
fn without(mut left: Vec<(f64, f64)>, gaps: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    for (low, high) in gaps {
        left = left
            .into_iter()
            .flat_map(|(from, to)| [(from, to.min(low)), (from.max(high), to)])
            .filter(|(from, to)| to - from > ON_LINE_M)
            .collect();
    }
    left
}

/// A level slab under or over a room.
fn level(outline: &[[f64; 2]], bottom: f64, material: Material) -> Option<Slab> {
    let least = |k: usize| outline.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min);
    let most = |k: usize| outline.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max);
    let (low, high) = ([least(0), least(1)], [most(0), most(1)]);
    let size = Size::new(high[0] - low[0], high[1] - low[1], FLOOR_M).ok()?;
    let centre = [0, 1].map(|k| f64::midpoint(low[k], high[k]));
    let pose = Pose::at([centre[0], centre[1], bottom + FLOOR_M / 2.0]).ok()?;
    let mesh = crate::simulation::shapes::slab(outline, size, material);
    Some(Slab { pose, size, mesh: Arc::new(mesh) })
}
