//! Colours and textures that the shapes share.

use crate::simulation::mesh::{Material, Texture};

/// sRGB from a number such as 0xff8800.
pub fn rgb(hex: u32) -> [f32; 3] {
    [16, 8, 0].map(|shift| ((hex >> shift) & 0xff) as f32 / 255.0)
}

/// One colour.
pub fn plain(hex: u32) -> Material {
    Material { colour: rgb(hex), texture: Texture::Plain }
}

/// Wood: drawn-out grain.
pub fn wood(hex: u32) -> Material {
    Material { colour: rgb(hex), texture: Texture::Grain { scale_m: 0.03, strength: 0.25 } }
}

/// Cloth: fine grain.
pub fn cloth(hex: u32) -> Material {
    Material { colour: rgb(hex), texture: Texture::Grain { scale_m: 0.008, strength: 0.15 } }
}

/// Bands of two colours that follow each other along an axis.
pub fn striped(hex: u32, second: u32, axis: u8, period: f64) -> Material {
    let texture = Texture::Stripes { axis, period_m: period as f32, second: rgb(second) };
    Material { colour: rgb(hex), texture }
}

/// Cubes of two colours.
pub fn checked(hex: u32, second: u32, side: f64) -> Material {
    let texture = Texture::Checker { side_m: side as f32, second: rgb(second) };
    Material { colour: rgb(hex), texture }
}
