//! Coloured triangles: [`Mesh`].

/// Triangles in metres, in the frame of the thing: origin at the centre of its bounding box,
/// x its width, y its height, z up, as [`crate::geometry::Size`] has them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// Corners.
    pub vertices: Vec<[f32; 3]>,
    /// Three corners each, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle the number of its material.
    pub material_of: Vec<u16>,
    /// The materials.
    pub materials: Vec<Material>,
}

/// How a surface looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// sRGB, each 0 to 1.
    pub colour: [f32; 3],
    /// What is drawn over the colour.
    pub texture: Texture,
}

/// A solid texture: a function of the point in the frame of the thing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Texture {
    /// One colour.
    #[default]
    Plain,
    /// Bands across an axis (0 x, 1 y, 2 z), of a second colour.
    Stripes {
        /// Axis along which the bands follow each other.
        axis: u8,
        /// Metres from band to band.
        period_m: f32,
        /// sRGB of every second band.
        second: [f32; 3],
    },
    /// Cubes of two colours.
    Checker {
        /// Side of a cube in metres.
        side_m: f32,
        /// sRGB of every second cube.
        second: [f32; 3],
    },
    /// Smooth lightness noise, drawn out along x: wood, cloth.
    Grain {
        /// Metres of a speck across.
        scale_m: f32,
        /// 0 none, 1 from black to white.
        strength: f32,
    },
}
