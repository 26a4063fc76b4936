//! Colours and textures of house files.

use super::{Complaints, in_range};
use crate::simulation::house::{AxisName, HouseError, Look, TextureFile};
use crate::simulation::mesh::{Material, Texture};

/// The material of a look; complaints name fields of `path`.
pub fn material(look: &Look, path: &str, wrong: &mut Complaints) -> Material {
    let colour = colour(&look.colour, &format!("{path}.colour"), wrong);
    let texture = match &look.texture {
        Some(file) => texture(file, &format!("{path}.texture"), wrong),
        None => Texture::Plain,
    };
    Material { colour, texture }
}

/// sRGB from "#cc3322".
pub fn colour(text: &str, path: &str, wrong: &mut Complaints) -> [f32; 3] {
    let digits = text.strip_prefix('#').filter(|digits| digits.len() == 6);
    let digits = digits.filter(|digits| digits.bytes().all(|byte| byte.is_ascii_hexdigit()));
    let Some(value) = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok()) else {
        let problem = format!("{text:?} is no colour: write it as \"#cc3322\"");
        wrong.push(HouseError::new(path, problem));
        return [0.0; 3];
    };
    crate::simulation::shapes::paint::rgb(value)
}

/// The texture of a file.
pub fn texture(file: &TextureFile, path: &str, wrong: &mut Complaints) -> Texture {
    match file {
        TextureFile::Stripes { axis, period, second } => {
            in_range(&format!("{path}.stripes.period"), *period, [0.001, 10.0], wrong);
            Texture::Stripes {
                axis: match axis {
                    AxisName::X => 0,
                    AxisName::Y => 1,
                    AxisName::Z => 2,
                },
                period_m: *period as f32,
                second: colour(second, &format!("{path}.stripes.second"), wrong),
            }
        }
        TextureFile::Checker { side, second } => {
            in_range(&format!("{path}.checker.side"), *side, [0.001, 10.0], wrong);
            let second = colour(second, &format!("{path}.checker.second"), wrong);
            Texture::Checker { side_m: *side as f32, second }
        }
        TextureFile::Grain { scale, strength } => {
            in_range(&format!("{path}.grain.scale"), *scale, [0.001, 10.0], wrong);
            in_range(&format!("{path}.grain.strength"), *strength, [0.0, 1.0], wrong);
            Texture::Grain { scale_m: *scale as f32, strength: *strength as f32 }
        }
    }
}
