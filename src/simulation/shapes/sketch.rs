//! Shapes from primitives: [`Sketch`].
//!
//! A shape is drawn in metres with the origin in the lower left front corner of its box: x to
//! the right, y away from the front, z up. [`Sketch::finish`] stretches it to fill the box.

use super::polygon;
use crate::simulation::house::Surface;
use crate::simulation::mesh::{Material, Mesh};

/// A point or a direction, metres.
pub type Point = [f64; 3];

/// A shape that is being drawn.
#[derive(Clone, Debug, Default)]
pub struct Sketch {
    /// Width, depth (front to back) and height of the box to fill, metres.
    pub size: Point,
    vertices: Vec<Point>,
    triangles: Vec<[u32; 3]>,
    material_of: Vec<u16>,
    materials: Vec<Material>,
    surfaces: Vec<Surface>,
    current: u16,
}

impl Sketch {
    /// Nothing yet.
    pub fn new(size: Point) -> Self {
        Self { size, ..Self::default() }
    }

    /// What comes next looks like this.
    pub fn paint(&mut self, material: Material) -> &mut Self {
        let known = self.materials.iter().position(|known| *known == material);
        self.current = known.unwrap_or(self.materials.len()) as u16;
        if known.is_none() {
            self.materials.push(material);
        }
        self
    }

    /// Other things can be put here: a level rectangle.
    pub fn surface(&mut self, name: &str, min: [f64; 2], max: [f64; 2], z: f64, free: Option<f64>) {
        let name = name.to_owned();
        self.surfaces.push(Surface { name, min, max, z, clearance_m: free });
    }

    /// The upper face of a box as a surface, a little inside its edges.
    pub fn top(&mut self, name: &str, min: Point, max: Point, clearance: Option<f64>) {
        let inset = 0.01_f64.min((max[0] - min[0]) / 8.0).min((max[1] - min[1]) / 8.0);
        let (low, high) = ([min[0] + inset, min[1] + inset], [max[0] - inset, max[1] - inset]);
        self.surface(name, low, high, max[2], clearance);
    }

    /// A surface begins further to the right: something stands on its left.
    pub fn narrow(&mut self, name: &str, x: f64) {
        for surface in self.surfaces.iter_mut().filter(|surface| surface.name == name) {
            surface.min[0] = x;
        }
    }

    fn vertex(&mut self, at: Point) -> u32 {
        self.vertices.push(at);
        self.vertices.len() as u32 - 1
    }

    fn triangle(&mut self, corners: [u32; 3]) {
        self.triangles.push(corners);
        self.material_of.push(self.current);
    }

    fn quad(&mut self, [a, b, c, d]: [u32; 4]) {
        self.triangle([a, b, c]);
        self.triangle([a, c, d]);
    }

    /// A box between two corners.
    pub fn block(&mut self, min: Point, max: Point) -> &mut Self {
        let corner =
            |n: usize| std::array::from_fn(|k| if n >> k & 1 == 0 { min[k] } else { max[k] });
        let v: [u32; 8] = std::array::from_fn(|n| self.vertex(corner(n)));
        for face in
            [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
        {
            self.quad(face.map(|n| v[n]));
        }
        self
    }

    /// A solid of revolution about an upright axis: (radius, height) from the lower end to the
    /// upper one. Both ends must lie on the axis for it to be closed.
    pub fn lathe(&mut self, [x, y]: [f64; 2], profile: &[(f64, f64)], sides: u32) -> &mut Self {
        let rings: Vec<Vec<u32>> = profile
            .iter()
            .map(|&(radius, z)| match radius > 0.0 {
                true => self.circle([x, y], radius, z, sides),
                false => vec![self.vertex([x, y, z])],
            })
            .collect();
        for pair in rings.windows(2) {
            self.stitch(&pair[0], &pair[1]);
        }
        self
    }

    /// Joins two rings, the second further along the axis about which they run.
    fn stitch(&mut self, lower: &[u32], upper: &[u32]) {
        let sides = lower.len().max(upper.len());
        for n in 0..sides {
            let next = (n + 1) % sides;
            match (lower.len(), upper.len()) {
                (1, 1) => {}
                (1, _) => self.triangle([lower[0], upper[next], upper[n]]),
                (_, 1) => self.triangle([lower[n], lower[next], upper[0]]),
                _ => self.quad([lower[n], lower[next], upper[next], upper[n]]),
            }
        }
    }

    /// An upright cylinder.
    pub fn cylinder(&mut self, centre: [f64; 2], r: f64, z: [f64; 2], sides: u32) -> &mut Self {
        self.lathe(centre, &[(0.0, z[0]), (r, z[0]), (r, z[1]), (0.0, z[1])], sides)
    }

    /// An upright pipe: a disc with a hole.
    pub fn ring(&mut self, [x, y]: [f64; 2], r: [f64; 2], z: [f64; 2], sides: u32) -> &mut Self {
        let corners = [(r[0], z[0]), (r[1], z[0]), (r[1], z[1]), (r[0], z[1])];
        let rings = corners.map(|(radius, z)| self.circle([x, y], radius, z, sides));
        for n in 0..4 {
            self.stitch(&rings[n], &rings[(n + 1) % 4]);
        }
        self
    }

    fn circle(&mut self, [x, y]: [f64; 2], radius: f64, z: f64, sides: u32) -> Vec<u32> {
        let at = |n| {
            let angle = turn(n, sides);
            [x + radius * libm::cos(angle), y + radius * libm::sin(angle), z]
        };
        (0..sides).map(at).map(|at| self.vertex(at)).collect()
    }

    /// An ellipsoid in a box.
    pub fn ball(&mut self, min: Point, max: Point, sides: u32) -> &mut Self {
        let from = self.vertices.len();
        let rings = sides / 2;
        let profile: Vec<(f64, f64)> = (0..=rings)
            .map(|n| {
                let angle = std::f64::consts::PI * f64::from(n) / f64::from(rings);
                let on_axis = n == 0 || n == rings;
                (if on_axis { 0.0 } else { libm::sin(angle) }, -libm::cos(angle))
            })
            .collect();
        self.lathe([0.0; 2], &profile, sides);
        self.stretch(from, min, max);
        self
    }

    /// A pillow in a box: an ellipsoid swollen towards the corners.
    pub fn cushion(&mut self, min: Point, max: Point, sides: u32) -> &mut Self {
        let from = self.vertices.len();
        self.ball([-1.0; 3], [1.0; 3], sides);
        for vertex in &mut self.vertices[from..] {
            let swollen = |c: f64| libm::copysign(libm::sqrt(c.abs()), c);
            *vertex = [swollen(vertex[0]), swollen(vertex[1]), vertex[2]];
        }
        self.stretch(from, min, max);
        self
    }

    /// Stretches the vertices since `from` to fill a box.
    fn stretch(&mut self, from: usize, min: Point, max: Point) {
        let (low, high) = bounds(&self.vertices[from..]);
        for vertex in &mut self.vertices[from..] {
            for k in 0..3 {
                let share = (vertex[k] - low[k]) / (high[k] - low[k]);
                vertex[k] = min[k] + share * (max[k] - min[k]);
            }
        }
    }

    /// A rod of round section through points, with a radius at each; its ends are flat.
    pub fn tube(&mut self, path: &[(Point, f64)], sides: u32) -> &mut Self {
        let mut rings = Vec::new();
        let along = |n: usize| {
            let (before, after) = (n.saturating_sub(1), (n + 1).min(path.len() - 1));
            unit(minus(path[after].0, path[before].0))
        };
        let mut across = perpendicular(along(0));
        rings.push(vec![self.vertex(path[0].0)]);
        for (n, (centre, radius)) in path.iter().enumerate() {
            let forward = along(n);
            // The section is carried along without twisting.
            across = unit(minus(across, scaled(forward, dot(across, forward))));
            let other = cross(forward, across);
            let ring = (0..sides).map(|n| {
                let angle = turn(n, sides);
                let (x, y) = (radius * libm::cos(angle), radius * libm::sin(angle));
                std::array::from_fn(|k| centre[k] + x * across[k] + y * other[k])
            });
            let ring: Vec<Point> = ring.collect();
            rings.push(ring.into_iter().map(|at| self.vertex(at)).collect());
        }
        rings.push(vec![self.vertex(path[path.len() - 1].0)]);
        for pair in rings.windows(2) {
            self.stitch(&pair[0], &pair[1]);
        }
        self
    }

    /// A straight rod.
    pub fn rod(&mut self, from: Point, to: Point, radius: f64, sides: u32) -> &mut Self {
        self.tube(&[(from, radius), (to, radius)], sides)
    }

    /// A polygon (any order of corners, no holes) drawn out along an axis. For axis 0 corners
    /// are (y, z), for 1 (x, z), for 2 (x, y).
    pub fn prism(&mut self, axis: usize, outline: &[[f64; 2]], span: [f64; 2]) -> &mut Self {
        let mut outline = outline.to_vec();
        if (polygon::area(&outline) < 0.0) != (axis == 1) {
            outline.reverse();
        }
        let place = |[a, b]: [f64; 2], c: f64| match axis {
            0 => [c, a, b],
            1 => [a, c, b],
            _ => [a, b, c],
        };
        let lower: Vec<u32> = outline.iter().map(|at| self.vertex(place(*at, span[0]))).collect();
        let upper: Vec<u32> = outline.iter().map(|at| self.vertex(place(*at, span[1]))).collect();
        self.stitch(&lower, &upper);
        // Seen against y, the outline runs clockwise.
        for [a, b, c] in polygon::triangles(&outline) {
            self.triangle([lower[a], lower[c], lower[b]]);
            self.triangle([upper[a], upper[b], upper[c]]);
        }
        self
    }

    /// Presses what reaches below a height flat onto it.
    pub fn cut_below(&mut self, z: f64) -> &mut Self {
        self.vertices.iter_mut().for_each(|vertex| vertex[2] = vertex[2].max(z));
        self
    }

    /// The mesh, stretched so that it fills a box of `size` exactly, and the surfaces with it.
    pub fn finish(self, size: Point) -> (Mesh, Vec<Surface>) {
        let (low, high) = bounds(&self.vertices);
        let half = size.map(|side| side / 2.0);
        let place = |k: usize, value: f64| {
            let share = (value - low[k]) / (high[k] - low[k]);
            (2.0 * share - 1.0) * half[k]
        };
        let fitted = |v: &Point| std::array::from_fn(|k| place(k, v[k]) as f32);
        let high_by = size[2] / (high[2] - low[2]);
        let surface = |s: Surface| Surface {
            clearance_m: s.clearance_m.map(|free| free * high_by),
            min: [place(0, s.min[0]), place(1, s.min[1])],
            max: [place(0, s.max[0]), place(1, s.max[1])],
            z: place(2, s.z),
            ..s
        };
        let mesh = Mesh {
            vertices: self.vertices.iter().map(fitted).collect(),
            triangles: self.triangles,
            material_of: self.material_of,
            materials: self.materials,
        };
        (mesh, self.surfaces.into_iter().map(surface).collect())
    }
}

/// Lowest and highest coordinates.
fn bounds(points: &[Point]) -> (Point, Point) {
    let low = |k| points.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min);
    let high = |k| points.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max);
    (std::array::from_fn(low), std::array::from_fn(high))
}

fn turn(n: u32, sides: u32) -> f64 {
    std::f64::consts::TAU * f64::from(n) / f64::from(sides)
}

fn minus(a: Point, b: Point) -> Point {
    std::array::from_fn(|k| a[k] - b[k])
}

fn scaled(a: Point, by: f64) -> Point {
    a.map(|c| c * by)
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Point, b: Point) -> Point {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: Point) -> Point {
    scaled(a, 1.0 / libm::sqrt(dot(a, a)))
}

/// Any direction across another.
fn perpendicular(a: Point) -> Point {
    let other = if a[2].abs() < 0.9 { [0.0, 0.0, 1.0] } else { [1.0, 0.0, 0.0] };
    unit(cross(other, a))
}
