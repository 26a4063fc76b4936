//! Solid textures: the colour of a surface at a point of the thing's own frame.
//!
//! Stripes and checks are averaged over what a pixel covers, so that they fade where they are
//! finer than the picture.

use super::vector::{V3, floor, mix, scale};
use crate::simulation::mesh::{Material, Texture};

/// How much longer a speck of grain is along x than across.
const GRAIN_STRETCH: f32 = 6.0;
/// How far below the surface textures are taken, metres, so that a face between two cubes of a
/// checker does not flicker.
const BELOW_M: f32 = 2.0e-3;

/// Albedo, linear, of a material at `at` (frame of the thing) on a face with this normal, seen by
/// a pixel that covers `footprint` metres.
pub(super) fn albedo(material: &Material, at: V3, normal: V3, footprint: f32) -> V3 {
    let below = [0, 1, 2].map(|axis| at[axis] - normal[axis] * BELOW_M);
    // What the pixel covers along each axis of the thing.
    let cover = normal.map(|part| footprint * (1.0 - part * part).max(0.0).sqrt() + 1.0e-4);
    match material.texture {
        Texture::Plain => material.colour,
        Texture::Stripes { axis, period_m, second } => {
            let axis = usize::from(axis.min(2));
            let wave = square_wave(below[axis] / period_m, cover[axis] / period_m);
            mix(material.colour, second, 0.5 - 0.5 * wave)
        }
        Texture::Checker { side_m, second } => {
            let period = 2.0 * side_m;
            let waves =
                [0, 1, 2].map(|axis| square_wave(below[axis] / period, cover[axis] / period));
            mix(material.colour, second, 0.5 - 0.5 * waves[0] * waves[1] * waves[2])
        }
        Texture::Grain { scale_m, strength } => {
            let fade = (1.5 - footprint / scale_m).clamp(0.0, 1.0);
            if fade == 0.0 {
                return material.colour;
            }
            let finer = scale(below, 1.0 / scale_m);
            let lightness = grain([finer[0] / GRAIN_STRETCH, finer[1], finer[2]]);
            scale(material.colour, 1.0 + strength * fade * (lightness - 0.5))
        }
    }
}

/// The mean over `width` of the wave that is +1 in the first half of every unit and −1 in the
/// second.
fn square_wave(at: f32, width: f32) -> f32 {
    let half = 0.5 * width;
    (triangle_wave(at + half) - triangle_wave(at - half)) / width
}

/// An integral of the square wave: up and down between 0 and ½.
fn triangle_wave(at: f32) -> f32 {
    let within = at - floor(at);
    within.min(1.0 - within)
}

/// Smooth noise between 0 and 1 in cells of one unit.
fn grain(at: V3) -> f32 {
    let cell = at.map(floor);
    let [x, y, z] = [0, 1, 2].map(|axis| {
        let within = at[axis] - cell[axis];
        within * within * (3.0 - 2.0 * within)
    });
    let [i, j, k] = cell.map(|part| part as i32);
    let line = |j, k| blend(speck(i, j, k), speck(i.wrapping_add(1), j, k), x);
    let plane = |k| blend(line(j, k), line(j.wrapping_add(1), k), y);
    blend(plane(k), plane(k.wrapping_add(1)), z)
}

fn blend(a: f32, b: f32, share_of_b: f32) -> f32 {
    a + (b - a) * share_of_b
}

/// A number from 0 to 1 that looks random, for each cell.
fn speck(i: i32, j: i32, k: i32) -> f32 {
    let mut bits = (i as u32).wrapping_mul(0x8da6_b343)
        ^ (j as u32).wrapping_mul(0xd816_3841)
        ^ (k as u32).wrapping_mul(0xcb1a_b31f);
    bits = (bits ^ (bits >> 15)).wrapping_mul(0x2c1b_3c6d);
    bits = (bits ^ (bits >> 12)).wrapping_mul(0x297a_2d39);
    (bits >> 8) as f32 / (1 << 24) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    const BLACK: V3 = [0.0; 3];
    const WHITE: V3 = [1.0; 3];

    #[track_caller]
    fn check(texture: Texture, at: V3, footprint: f32, expected: f32) {
        let material = Material { colour: WHITE, texture };
        let found = albedo(&material, at, [0.0, 0.0, 1.0], footprint)[0];
        assert!((found - expected).abs() < 0.02, "{found} at {at:?}");
    }

    const STRIPES: Texture = Texture::Stripes { axis: 0, period_m: 0.2, second: BLACK };
    const CHECKER: Texture = Texture::Checker { side_m: 0.1, second: BLACK };

    #[test]
    fn stripes_follow_each_other_along_their_axis() {
        check(STRIPES, [0.05, 0.0, 0.0], 0.001, 1.0);
        check(STRIPES, [0.15, 0.0, 0.0], 0.001, 0.0);
        check(STRIPES, [0.25, 0.0, 0.0], 0.001, 1.0);
        check(STRIPES, [-0.05, 0.0, 0.0], 0.001, 0.0);
    }

    #[test]
    fn cubes_change_along_all_axes() {
        check(CHECKER, [0.05, 0.05, 0.05], 0.001, 1.0);
        check(CHECKER, [0.15, 0.05, 0.05], 0.001, 0.0);
        check(CHECKER, [0.15, 0.15, 0.05], 0.001, 1.0);
        check(CHECKER, [0.15, 0.15, 0.15], 0.001, 0.0);
    }

    #[test]
    fn a_face_on_the_border_of_cubes_shows_those_below_it() {
        check(CHECKER, [0.05, 0.05, 0.0], 0.001, 0.0);
    }

    #[test]
    fn what_is_finer_than_a_pixel_fades() {
        check(STRIPES, [0.05, 0.0, 0.0], 20.0, 0.5);
        check(CHECKER, [0.05, 0.05, 0.05], 20.0, 0.5);
        let grain = Texture::Grain { scale_m: 0.01, strength: 1.0 };
        check(grain, [0.313, 0.5, 0.7], 0.1, 1.0);
    }

    #[test]
    fn grain_keeps_to_its_strength() {
        let material =
            Material { colour: [0.5; 3], texture: Texture::Grain { scale_m: 0.01, strength: 0.4 } };
        for n in 0..1000_u16 {
            let at = f32::from(n) * 0.0137;
            let found = albedo(&material, [at, -at, 0.3 * at], [0.0, 0.0, 1.0], 0.0)[0];
            assert!((0.4..=0.6).contains(&found), "{found}");
        }
    }
}
