//! Depth and masks for people: false colours.

use super::frame::Frame;

/// Polynomial of the fifth degree through the colour map Turbo, for red, green and blue, lowest
/// power first (A. Mikhailov, "Turbo, an improved rainbow colormap for visualization", 2019; the
/// fit by R. Du, gist.github.com/mikhailov-work/0d177465a8151eb6ede1768d51d476c7).
const TURBO: [[f32; 6]; 3] = [
    [0.135_721_38, 4.615_392_6, -42.660_323, 132.131_08, -152.942_4, 59.286_38],
    [0.091_402_61, 2.194_188_4, 4.842_966_6, -14.185_033, 4.277_298_6, 2.829_566],
    [0.106_673_3, 12.641_946, -60.582_05, 110.362_77, -89.903_11, 27.348_25],
];

/// Where on Turbo the nearest depth is: below, it is nearly black, which stands for no depth.
const NEAREST: f32 = 0.08;

impl Frame {
    /// Depth in colours from blue (near) to red (far), over the depths there are; black where
    /// nothing is seen.
    pub fn depth_colours(&self) -> Vec<[u8; 3]> {
        depth_colours(&self.depth_mm())
    }

    /// A colour for each thing; dark grey for the building.
    pub fn mask_colours(&self) -> Vec<[u8; 3]> {
        self.mask.iter().map(|mask| mask_colour(*mask)).collect()
    }
}

/// Depths in millimetres in colours from blue (near) to red (far); black for 0.
pub fn depth_colours(depth_mm: &[u16]) -> Vec<[u8; 3]> {
    let seen = || depth_mm.iter().copied().filter(|mm| *mm > 0);
    let (nearest, farthest) = (seen().min().unwrap_or(0), seen().max().unwrap_or(0));
    let range = f32::from((farthest - nearest).max(1));
    let colour = |mm: u16| match mm.checked_sub(nearest) {
        Some(beyond) if mm > 0 => turbo(NEAREST + (1.0 - NEAREST) * f32::from(beyond) / range),
        _ => [0; 3],
    };
    depth_mm.iter().map(|mm| colour(*mm)).collect()
}

/// Turbo, from 0 to 1.
fn turbo(at: f32) -> [u8; 3] {
    TURBO.map(|powers| {
        let value = powers.iter().rev().fold(0.0, |sum, factor| sum * at + factor);
        (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
    })
}

/// The colour that stands for number `mask`; neighbours differ.
pub fn mask_colour(mask: u16) -> [u8; 3] {
    if mask == 0 {
        return [40; 3];
    }
    // Steps of the golden ratio never come back to a hue, and leave the largest gaps.
    let hue = (f32::from(mask) * 0.618_034).fract() * 6.0;
    let light = [1.0, 0.75, 0.9][usize::from(mask) % 3];
    [0.0, 4.0, 2.0].map(|shift: f32| {
        let place = (hue + shift) % 6.0;
        let full = (place - 3.0).abs() - 1.0;
        ((0.2 + 0.8 * full.clamp(0.0, 1.0)) * light * 255.0 + 0.5) as u8
    })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    #[test]
    fn near_is_blue_and_far_is_red() {
        let colours = depth_colours(&[0, 500, 1000, 3000, 500]);
        assert_eq!(colours[0], [0; 3]);
        assert_eq!(colours[1], colours[4]);
        let [red, _, blue] = colours[1];
        assert!(blue > red, "{:?}", colours[1]);
        let [red, green, blue] = turbo(1.0);
        assert!(red > green.max(blue) + 50, "{red} {green} {blue}");
        let [red, green, blue] = turbo(0.5);
        assert!(green > red.max(blue), "{red} {green} {blue}");
    }

    #[test]
    fn things_of_a_house_have_colours_of_their_own() {
        let colours: BTreeSet<[u8; 3]> = (0..200).map(mask_colour).collect();
        assert!(colours.len() > 180, "{}", colours.len());
    }
}
