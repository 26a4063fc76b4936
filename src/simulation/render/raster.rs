//! Which triangle each pixel sees, by rasterising: exact, and far cheaper than a ray a pixel.
//!
//! With `P = K·X` the homogeneous pixel coordinates of a corner X of the camera frame, the ray of
//! pixel (u, v) meets the triangle (P0, P1, P2) where the three *edge functions*
//! `e_i = (P_j × P_k) · (u, v, 1)` have the sign of `det = P0 · (P1 × P2)`, at the depth z with
//! `1/z = (e_0 + e_1 + e_2) / det` (M. Olano and T. Greer, "Triangle scan conversion using 2D
//! homogeneous coordinates", 1997). All are linear in u and v, nothing need be clipped, and two
//! triangles that share an edge have the same edge function with the other sign, so that there is
//! no crack between them.

use nalgebra::Isometry3;
use rayon::prelude::*;

use super::scene::{Instance, Scene};
use super::visible::Visible;
use crate::geometry::Camera;

type D3 = [f64; 3];

/// Rows that are worked on together.
pub(super) const BAND: usize = 8;

/// A triangle as the camera sees it.
struct Facet {
    /// First and last row it may be in.
    rows: [u32; 2],
    /// Edge functions, positive inside: coefficients of u, v and 1.
    edges: [D3; 3],
    /// 1/z: coefficients of u, v and 1.
    nearness: D3,
    instance: u32,
    triangle: u32,
}

/// Fills in what is seen at each pixel of a camera without distortion.
pub(super) fn rasterise(
    scene: &Scene,
    camera: &Camera,
    camera_from_world: &Isometry3<f64>,
    visible: &mut [Visible],
) {
    let instances: Vec<usize> = (0..scene.instances.len()).collect();
    let facets: Vec<Vec<Facet>> =
        instances.into_par_iter().map(|n| facets_of(scene, n, camera, camera_from_world)).collect();
    let facets: Vec<&Facet> = facets.iter().flatten().collect();
    let width = camera.width as usize;
    let bands = in_bands(&facets, (camera.height as usize).div_ceil(BAND));
    visible
        .par_chunks_mut(width * BAND)
        .zip(bands)
        .enumerate()
        .for_each(|(n, (visible, facets))| band((n * BAND) as u32, width, &facets, visible));
}

/// For each band of rows the facets that reach into it.
fn in_bands<'f>(facets: &[&'f Facet], count: usize) -> Vec<Vec<&'f Facet>> {
    let mut bands = vec![Vec::new(); count];
    for facet in facets {
        let [first, last] = facet.rows.map(|row| row as usize / BAND);
        for band in &mut bands[first..=last] {
            band.push(*facet);
        }
    }
    bands
}

fn facets_of(
    scene: &Scene,
    number: usize,
    camera: &Camera,
    camera_from_world: &Isometry3<f64>,
) -> Vec<Facet> {
    let instance = &scene.instances[number];
    let solid = scene.solid(instance);
    let pixels = Pixels::of(camera, camera_from_world, instance);
    let corners = solid.box_corners().map(|corner| pixels.of_point(corner));
    if !instance.shown || pixels.miss(&corners) {
        return Vec::new();
    }
    let points: Vec<D3> = solid.mesh.vertices.iter().map(|at| pixels.of_point(*at)).collect();
    let facet = |(triangle, corners): (usize, &[u32; 3])| {
        let corners = corners.map(|corner| points[corner as usize]);
        let rows = pixels.rows(&corners)?;
        let (edges, nearness) = edges(&corners)?;
        Some(Facet { rows, edges, nearness, instance: number as u32, triangle: triangle as u32 })
    };
    solid.mesh.triangles.iter().enumerate().filter_map(facet).collect()
}

/// The edge functions and the nearness of a triangle; none if it is seen edge-on.
fn edges(corners: &[D3; 3]) -> Option<([D3; 3], D3)> {
    let [a, b, c] = corners;
    let edges = [cross(b, c), cross(c, a), cross(a, b)];
    let determinant = dot(a, &edges[0]);
    if determinant == 0.0 {
        return None;
    }
    let sign = determinant.signum();
    let sum = [0, 1, 2].map(|n| edges[0][n] + edges[1][n] + edges[2][n]);
    Some((edges.map(|edge| edge.map(|it| it * sign)), sum.map(|it| it / determinant)))
}

/// `K · camera_from_mesh`: from a mesh to homogeneous pixel coordinates.
struct Pixels {
    rows: [D3; 3],
    shift: D3,
    size: [f64; 2],
}

impl Pixels {
    fn of(camera: &Camera, camera_from_world: &Isometry3<f64>, instance: &Instance) -> Self {
        let camera_from_mesh = camera_from_world * instance.world_from_mesh;
        let matrix = camera_from_mesh.rotation.to_rotation_matrix();
        let [x, y, z] = [0, 1, 2].map(|row| [0, 1, 2].map(|column| matrix[(row, column)]));
        let t = camera_from_mesh.translation.vector;
        let ([fx, fy], [cx, cy]) = (camera.focal, camera.centre);
        let scaled = |a: D3, f: f64, c: f64| [0, 1, 2].map(|n| f * a[n] + c * z[n]);
        Self {
            rows: [scaled(x, fx, cx), scaled(y, fy, cy), z],
            shift: [fx * t.x + cx * t.z, fy * t.y + cy * t.z, t.z],
            size: [f64::from(camera.width), f64::from(camera.height)],
        }
    }

    fn of_point(&self, at: [f32; 3]) -> D3 {
        let at = at.map(f64::from);
        [0, 1, 2].map(|n| dot(&self.rows[n], &at) + self.shift[n])
    }

    /// Whether all points are beyond one side of the picture, or behind the camera.
    fn miss(&self, points: &[D3]) -> bool {
        let [width, height] = self.size;
        points.iter().all(|p| p[2] <= 0.0)
            || points.iter().all(|p| p[0] < 0.0)
            || points.iter().all(|p| p[0] > (width - 1.0) * p[2])
            || points.iter().all(|p| p[1] < 0.0)
            || points.iter().all(|p| p[1] > (height - 1.0) * p[2])
    }

    /// The rows a triangle may be in.
    fn rows(&self, corners: &[D3; 3]) -> Option<[u32; 2]> {
        if self.miss(corners) {
            return None;
        }
        let last = self.size[1] - 1.0;
        let nearest = corners.iter().fold(f64::INFINITY, |nearest, p| nearest.min(p[2]));
        if nearest <= 1.0e-6 {
            return Some([0, last as u32]);
        }
        let rows = corners.map(|p| p[1] / p[2]);
        let top = rows.into_iter().fold(f64::INFINITY, f64::min);
        let bottom = rows.into_iter().fold(f64::NEG_INFINITY, f64::max);
        // A little more, for what rounding has taken; the edge functions decide.
        let (top, bottom) = ((top - 1.0e-6).ceil().max(0.0), (bottom + 1.0e-6).floor().min(last));
        (top <= bottom).then_some([top as u32, bottom as u32])
    }
}

fn band(first_row: u32, width: usize, facets: &[&Facet], visible: &mut [Visible]) {
    let rows = visible.len() / width;
    let mut nearness = vec![0.0_f32; visible.len()];
    let mut seen = vec![u32::MAX; visible.len()];
    for (n, facet) in facets.iter().enumerate() {
        let last = facet.rows[1].min(first_row + rows as u32 - 1);
        for row in facet.rows[0].max(first_row)..=last {
            let Some((from, to)) = facet.span(f64::from(row), width) else { continue };
            let start = (row - first_row) as usize * width;
            let here = start + from..=start + to;
            let [du, dv, constant] = facet.nearness;
            let nearness_at = (du * from as f64 + (dv * f64::from(row) + constant)) as f32;
            let (nearness, seen) = (&mut nearness[here.clone()], &mut seen[here]);
            draw(nearness, seen, nearness_at, du as f32, n as u32);
        }
    }
    for (n, (seen, visible)) in seen.iter().zip(visible).enumerate() {
        if let Some(facet) = facets.get(*seen as usize) {
            let (column, row) = ((n % width) as f64, f64::from(first_row) + (n / width) as f64);
            *visible = facet.at(column, row);
        }
    }
}

/// Enters a facet where it is nearer than what was seen before.
fn draw(nearness: &mut [f32], seen: &mut [u32], start: f32, step: f32, facet: u32) {
    for (n, (nearest, seen)) in nearness.iter_mut().zip(seen).enumerate() {
        let near = start + step * n as f32;
        let nearer = near > *nearest;
        *nearest = if nearer { near } else { *nearest };
        *seen = if nearer { facet } else { *seen };
    }
}

impl Facet {
    /// First and last column of a row that the facet covers.
    fn span(&self, row: f64, width: usize) -> Option<(usize, usize)> {
        let last = (width - 1) as f64;
        let (mut from, mut to) = (0.0_f64, last);
        for [du, dv, constant] in self.edges {
            let rest = dv * row + constant;
            if du > 0.0 {
                from = from.max(-rest / du);
            } else if du < 0.0 {
                to = to.min(-rest / du);
            } else if rest < 0.0 {
                return None;
            }
        }
        if from > to {
            return None;
        }
        // Both lie in the picture now. `ceil` and `floor` would be calls on most machines.
        let (first, last) = (from as u32, to as u32);
        let first = first + u32::from(f64::from(first) < from);
        (first <= last).then_some((first as usize, last as usize))
    }

    fn at(&self, u: f64, v: f64) -> Visible {
        let [du, dv, constant] = self.nearness;
        let depth_m = (1.0 / (du * u + dv * v + constant)) as f32;
        Visible { instance: self.instance, triangle: self.triangle, depth_m }
    }
}

fn dot(a: &D3, b: &D3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// `cross(a, b)` is exactly `-cross(b, a)`, which keeps shared edges free of cracks.
fn cross(a: &D3, b: &D3) -> D3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
