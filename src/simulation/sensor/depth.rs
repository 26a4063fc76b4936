//! What a camera that matches patterns makes of true depth.

use rayon::prelude::*;

use super::config::NoiseConfig;
use super::dice::Dice;
use super::field::Field;
use crate::geometry::Camera;
use crate::simulation::render::{Frame, millimetres};

/// Depth in millimetres, 0 where there is none, of picture number `dice`.
///
/// The camera measures disparity, δ = 1/z up to a factor: to it go noise and whole steps, which
/// is why both grow with z² in depth.
pub(super) fn measured(
    config: &NoiseConfig,
    camera: &Camera,
    frame: &Frame,
    dice: Dice,
) -> Vec<u16> {
    let width = frame.width as usize;
    if width == 0 {
        return Vec::new();
    }
    let field = Field::new(dice.stream(1), frame.width, frame.height, config.window_px);
    let holes = dice.stream(2);
    let mut depth = vec![0; frame.depth_m.len()];
    depth.par_chunks_mut(width).enumerate().for_each(|(row, measured)| {
        let mut dark = in_shadow(config, camera, &frame.depth_m[row * width..(row + 1) * width]);
        for (column, measured) in measured.iter_mut().enumerate() {
            let n = row * width + column;
            let true_depth = f64::from(frame.depth_m[n]);
            if true_depth == 0.0 || std::mem::take(&mut dark[column]) {
                continue;
            }
            let surface = Surface::at(frame, camera, column, row);
            if surface.jump && holes.share(n as u64) < config.edge_holes
                || surface.incidence_deg() > config.grazing_deg
            {
                continue;
            }
            *measured = config.depth(true_depth, || field.at(column, row));
        }
    });
    depth
}

impl NoiseConfig {
    /// Millimetres for a true depth in metres; `noise` has standard deviation 1.
    fn depth(&self, true_depth_m: f64, noise: impl FnOnce() -> f64) -> u16 {
        let mut disparity = 1.0 / true_depth_m;
        if self.depth_sigma_m > 0.0 {
            disparity += self.depth_sigma_m * noise();
        }
        if self.depth_step_m > 0.0 {
            disparity = libm::round(disparity / self.depth_step_m) * self.depth_step_m;
        }
        let depth_m = 1.0 / disparity;
        let reached = (self.min_depth_m..=self.max_depth_m).contains(&depth_m);
        if reached && disparity > 0.0 { millimetres(depth_m as f32) } else { 0 }
    }
}

/// Which pixels of a row the projector cannot see.
///
/// A point at depth z, column u, is at `u − f·b/z` for a projector that is b to the right; it is
/// in shadow if something farther to the right in the picture is at the same place or farther to
/// the left for the projector.
fn in_shadow(config: &NoiseConfig, camera: &Camera, depth_m: &[f32]) -> Vec<bool> {
    let mut dark = vec![false; depth_m.len()];
    let reach = (camera.focal[0] * config.baseline_m) as f32;
    if reach == 0.0 {
        return dark;
    }
    let mut leftmost = f32::INFINITY;
    for (column, depth) in depth_m.iter().enumerate().rev() {
        if *depth > 0.0 {
            let seen_at = column as f32 - reach / depth;
            dark[column] = seen_at >= leftmost;
            leftmost = leftmost.min(seen_at);
        }
    }
    dark
}

/// How a surface lies at a pixel.
struct Surface {
    /// Whether depth jumps to a pixel beside it.
    jump: bool,
    /// Cosine between ray and normal.
    facing: f64,
}

impl Surface {
    /// On a plane `n·X = D`, 1/z is linear in the pixel: with its slopes (a, b) per pixel,
    /// `n/D = (a·fx, b·fy, 1/z − a(u − cx) − b(v − cy))`.
    fn at(frame: &Frame, camera: &Camera, column: usize, row: usize) -> Self {
        let (width, height) = (frame.width as usize, frame.height as usize);
        let near = |x: usize, y: usize| {
            let depth = f64::from(frame.depth_m[y * width + x]);
            if depth > 0.0 { 1.0 / depth } else { 0.0 }
        };
        let own = near(column, row);
        let slope = |before: Option<f64>, after: Option<f64>| {
            // The gentler side: the other may be beyond an edge.
            let sides = [before.map(|it| own - it), after.map(|it| it - own)];
            let gentle = sides.into_iter().flatten().min_by(|a, b| a.abs().total_cmp(&b.abs()));
            let steep = sides.into_iter().flatten().map(f64::abs).fold(0.0, f64::max);
            (gentle.unwrap_or(0.0), steep)
        };
        let left = column.checked_sub(1).map(|x| near(x, row));
        let right = (column + 1 < width).then(|| near(column + 1, row));
        let above = row.checked_sub(1).map(|y| near(column, y));
        let below = (row + 1 < height).then(|| near(column, row + 1));
        let ((a, across), (b, down)) = (slope(left, right), slope(above, below));
        // A jump is a step far steeper than the surface itself goes on.
        let jumps = |steep: f64, gentle: f64| steep - gentle.abs() > 0.05 * own;
        let jump = jumps(across, a) || jumps(down, b);
        let (u, v) = (column as f64 - camera.centre[0], row as f64 - camera.centre[1]);
        let [fx, fy] = camera.focal;
        let normal = [a * fx, b * fy, own - a * u - b * v];
        let ray = [u / fx, v / fy, 1.0];
        let length = |it: [f64; 3]| libm::sqrt(it.iter().map(|part| part * part).sum());
        Self { jump, facing: own / (length(normal) * length(ray)) }
    }

    fn incidence_deg(&self) -> f64 {
        libm::acos(self.facing.clamp(-1.0, 1.0)).to_degrees()
    }
}
