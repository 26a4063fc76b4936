//! What a sensor makes of the light that reaches it.

use rayon::prelude::*;

use super::config::NoiseConfig;
use super::dice::Dice;
use crate::simulation::render::{Frame, encode, linear};

/// The mean of a well exposed picture, in steps of 1/255.
const WELL_EXPOSED: f64 = 118.0;
/// Automatic exposure goes no farther than a factor of this, either way.
const GAIN_MAX: f64 = 2.0;

/// sRGB of picture number `dice`.
pub(super) fn exposed(config: &NoiseConfig, frame: &Frame, dice: Dice) -> Vec<[u8; 3]> {
    let width = frame.width as usize;
    if width == 0 {
        return Vec::new();
    }
    let response = response(gain(config, frame, dice.stream(1)));
    let (speckle, sigma) = (dice.stream(2), config.colour_sigma as f32);
    let mut colour = frame.colour.clone();
    colour.par_chunks_mut(width).enumerate().for_each(|(row, colour)| {
        for (column, pixel) in colour.iter_mut().enumerate() {
            let left = config.left_of_light(frame, column, row);
            let noise = if sigma > 0.0 {
                sigma * speckle.nearly_normal((row * width + column) as u64)
            } else {
                0.0
            };
            let part = |part: u8| (response[usize::from(part)] * left + noise + 0.5) as u8;
            *pixel = pixel.map(part);
        }
    });
    colour
}

impl NoiseConfig {
    /// What vignetting leaves of an encoded value: light falls off with the square of the
    /// distance from the middle; encoded values with about the square root of light.
    fn left_of_light(&self, frame: &Frame, column: usize, row: usize) -> f32 {
        let from_middle = |at: usize, size: u32| (at as f32 + 0.5) / size as f32 * 2.0 - 1.0;
        let (x, y) = (from_middle(column, frame.width), from_middle(row, frame.height));
        1.0 - 0.5 * self.vignetting as f32 * (x * x + y * y) / 2.0
    }
}

/// How much longer than usual the picture is exposed.
fn gain(config: &NoiseConfig, frame: &Frame, dice: Dice) -> f64 {
    let sum: u64 = frame.colour.iter().flatten().map(|part| u64::from(*part)).sum();
    let mean = sum as f64 / (3 * frame.colour.len()).max(1) as f64;
    let wanted = libm::pow(WELL_EXPOSED / mean.max(1.0), 2.2 * config.exposure);
    wanted.clamp(1.0 / GAIN_MAX, GAIN_MAX) * (1.0 + config.exposure_sigma * dice.normal(0))
}

/// Encoded values, in steps of 1/255, for bytes of light `gain` times as strong.
fn response(gain: f64) -> [f32; 256] {
    let mut table = [0.0; 256];
    for (byte, value) in (0..=u8::MAX).zip(&mut table) {
        *value = if (gain - 1.0).abs() < 1e-9 {
            byte.into()
        } else {
            let light = linear([f32::from(byte) / 255.0; 3]);
            encode(light.map(|part| part * gain as f32))[0].into()
        };
    }
    table
}
