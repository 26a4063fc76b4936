//! Soft shadows and ambient occlusion, from few rays.
//!
//! Rays start at every second pixel of every second row only, each pixel of a 4×4 tile of those
//! in other directions; the mean over a tile, of points on the same surface, is smooth again.
//! (After A. Keller and W. Heidrich, "Interleaved sampling", 2001.)

use std::f64::consts::TAU;

use rayon::prelude::*;

use super::light::{Light, ReadyLamp};
use super::scene::Scene;
use super::vector::{V3, add, dot, scale, sub};
use super::visible::{Point, View, Visible};

/// Pixels from sample to sample.
const STRIDE: usize = 2;
/// Samples across a tile.
const TILE: usize = 4;
/// Rays of a sample to its lamp.
const LAMP_RAYS: usize = 1;
/// Rays of a sample around it.
const AROUND_RAYS: usize = 1;
/// How far away a surface still takes away light from all around, metres.
const REACH_M: f32 = 0.6;
/// Rays start so far from their surface, metres.
const CLEAR_M: f32 = 2.0e-3;

/// How much light gets to a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Openness {
    /// Share of the directions around it, by cosine, that are free.
    pub open: f32,
    /// Share of its lamp that it sees.
    pub lit: f32,
}

/// A sample and the surface it was taken on.
#[derive(Clone, Copy)]
struct Sample {
    at: V3,
    normal: V3,
    openness: Openness,
}

/// The openness at every pixel of a picture.
pub(super) struct Shadows {
    /// Row by row; none where nothing is seen.
    samples: Vec<Option<Sample>>,
    columns: usize,
    rows: usize,
    rays: Rays,
}

impl Shadows {
    pub fn of(
        scene: &Scene,
        light: &Light,
        view: &View,
        visible: &[Visible],
        width: usize,
    ) -> Self {
        let (columns, height) = (width.div_ceil(STRIDE), visible.len() / width);
        let rows = height.div_ceil(STRIDE);
        let rays = Rays::new();
        let sample = |column: usize, row: usize| {
            let (x, y) = (column * STRIDE, row * STRIDE);
            let seen = &visible[y * width + x];
            let point = seen.is_something().then(|| view.point(scene, x, y, seen))?;
            let turn = column % TILE + row % TILE * TILE;
            let openness = rays.openness(scene, light, &point, turn);
            Some(Sample { at: point.at, normal: point.flat, openness })
        };
        let raw = by_rows(columns, rows, sample);
        let smooth = |column: usize, row: usize| {
            let own = raw[row * columns + column]?;
            let over = |tiles: usize| {
                let near = window(column, row, columns, rows, tiles).filter_map(|n| raw[n]);
                let near = near.filter(move |it| alike(it, own.at, own.normal));
                near.map(|it| (it.openness, 1.0))
            };
            // At the edge of a surface a tile lacks directions: those farther off make up for it.
            let tiles = if over(1).count() < TILE * TILE { 2 } else { 1 };
            Some(Sample { openness: mean(over(tiles))?, ..own })
        };
        let samples = by_rows(columns, rows, smooth);
        Self { samples, columns, rows, rays }
    }

    /// The openness of what is seen at a pixel: between the samples around it that are on the
    /// same surface, or else by rays of its own.
    pub fn at(&self, scene: &Scene, light: &Light, point: &Point, x: usize, y: usize) -> Openness {
        let (column, row) = (x / STRIDE, y / STRIDE);
        let (across, down) = ((x % STRIDE) as f32, (y % STRIDE) as f32);
        let (across, down) = (across / STRIDE as f32, down / STRIDE as f32);
        let corners = [
            (0, 0, (1.0 - across) * (1.0 - down)),
            (1, 0, across * (1.0 - down)),
            (0, 1, (1.0 - across) * down),
            (1, 1, across * down),
        ];
        let near = corners.into_iter().filter_map(|(right, below, weight)| {
            let (column, row) = (column + right, row + below);
            let inside = weight > 0.0 && column < self.columns && row < self.rows;
            let sample =
                self.samples[if inside { row * self.columns + column } else { return None }]?;
            alike(&sample, point.at, point.flat).then_some((sample.openness, weight))
        });
        mean(near).unwrap_or_else(|| self.rays.openness(scene, light, point, (x + y * 7) % 16))
    }
}

/// `make(column, row)` for all samples, row by row.
fn by_rows(
    columns: usize,
    rows: usize,
    make: impl Fn(usize, usize) -> Option<Sample> + Sync,
) -> Vec<Option<Sample>> {
    let mut samples = vec![None; columns * rows];
    samples.par_chunks_mut(columns).enumerate().for_each(|(row, samples)| {
        for (column, sample) in samples.iter_mut().enumerate() {
            *sample = make(column, row);
        }
    });
    samples
}

/// The samples of so many tiles each way about a sample; of one tile, each of the 16 directions
/// once.
fn window(
    column: usize,
    row: usize,
    columns: usize,
    rows: usize,
    tiles: usize,
) -> impl Iterator<Item = usize> {
    let half = tiles * TILE / 2;
    let span = move |at: usize, size: usize| at.saturating_sub(half - 1)..(at + half + 1).min(size);
    let across = span(column, columns);
    span(row, rows).flat_map(move |row| across.clone().map(move |column| row * columns + column))
}

/// Whether a sample is on the surface through `at`.
fn alike(sample: &Sample, at: V3, normal: V3) -> bool {
    dot(sample.normal, normal) > 0.8 && dot(sub(sample.at, at), normal).abs() < 0.02
}

fn mean(weighted: impl Iterator<Item = (Openness, f32)>) -> Option<Openness> {
    let (mut open, mut lit, mut sum) = (0.0, 0.0, 0.0);
    for (openness, weight) in weighted {
        open += openness.open * weight;
        lit += openness.lit * weight;
        sum += weight;
    }
    (sum > 0.0).then(|| Openness { open: open / sum, lit: lit / sum })
}

/// Directions of rays, for each sample of a tile.
struct Rays {
    /// About z, distributed by cosine.
    around: Vec<V3>,
    /// On a disc of radius 1.
    on_lamp: Vec<[f32; 2]>,
}

impl Rays {
    fn new() -> Self {
        let samples = (TILE * TILE) as u32;
        let around = (0..samples * AROUND_RAYS as u32).map(|n| {
            let [x, y] = on_disc(n, samples * AROUND_RAYS as u32);
            [x, y, (1.0 - x * x - y * y).max(0.0).sqrt()]
        });
        let on_lamp =
            (0..samples * LAMP_RAYS as u32).map(|n| on_disc(n, samples * LAMP_RAYS as u32));
        Self { around: around.collect(), on_lamp: on_lamp.collect() }
    }

    fn openness(&self, scene: &Scene, light: &Light, point: &Point, turn: usize) -> Openness {
        let origin = add(point.at, scale(point.flat, CLEAR_M));
        let lit = light
            .lamp_at(point.at)
            .map_or(0.0, |lamp| self.lit(scene, lamp, origin, point.flat, turn));
        Openness { open: self.open(scene, origin, point.flat, turn), lit }
    }

    fn open(&self, scene: &Scene, origin: V3, normal: V3, turn: usize) -> f32 {
        let [across, along] = tangents(normal);
        let free = |ray: &V3| {
            let direction =
                add(add(scale(across, ray[0]), scale(along, ray[1])), scale(normal, ray[2]));
            scene.distance(origin, direction, REACH_M).map_or(1.0, |distance| distance / REACH_M)
        };
        let rays = self.around.iter().skip(turn).step_by(TILE * TILE);
        rays.map(free).sum::<f32>() / AROUND_RAYS as f32
    }

    fn lit(&self, scene: &Scene, lamp: &ReadyLamp, origin: V3, normal: V3, turn: usize) -> f32 {
        let reaches = |on_lamp: &[f32; 2]| {
            let [x, y] = on_lamp.map(|it| it * lamp.radius);
            let towards = sub(add(lamp.position, [x, y, 0.0]), origin);
            dot(towards, normal) > 0.0 && scene.distance(origin, towards, 1.0).is_none()
        };
        let rays = self.on_lamp.iter().skip(turn).step_by(TILE * TILE);
        rays.filter(|it| reaches(it)).count() as f32 / LAMP_RAYS as f32
    }
}

/// Point n of `count` that cover a disc evenly: Hammersley's points, by area.
fn on_disc(n: u32, count: u32) -> [f32; 2] {
    let radius = libm::sqrt((f64::from(n) + 0.5) / f64::from(count));
    let angle = TAU * f64::from(n.reverse_bits()) / f64::from(u32::MAX);
    [radius * libm::cos(angle), radius * libm::sin(angle)].map(|it| it as f32)
}

/// Two directions square to a normal and to each other (T. Duff et al., "Building an orthonormal
/// basis, revisited", 2017).
fn tangents(normal: V3) -> [V3; 2] {
    let [x, y, z] = normal;
    let sign = if z < 0.0 { -1.0 } else { 1.0 };
    let a = -1.0 / (sign + z);
    let b = x * y * a;
    [[1.0 + sign * x * x * a, sign * b, -sign * x], [b, sign + y * y * a, -y]]
}
