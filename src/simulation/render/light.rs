//! What shines in a scene: [`Lighting`].

use super::tone::linear;
use super::vector::{V3, add, dot, scale, sub, times, unit};

/// The light in a scene: lamps, and light from all around.
#[derive(Clone, Debug, PartialEq)]
pub struct Lighting {
    /// The lamps.
    pub lamps: Vec<Lamp>,
    /// Light that comes from everywhere.
    pub ambient: Ambient,
    /// sRGB of where nothing is.
    pub background: [f32; 3],
}

/// A round lamp that hangs level.
#[derive(Clone, Debug, PartialEq)]
pub struct Lamp {
    /// Its centre, world frame, metres.
    pub position: [f64; 3],
    /// Half its width, metres: the larger, the softer its shadows.
    pub radius_m: f64,
    /// sRGB of its light.
    pub colour: [f32; 3],
    /// How light it makes a white surface one metre away: 1 is white.
    pub strength: f32,
    /// Corners of the floor of the room it lights, metres; empty if it lights everything.
    pub room: Vec<[f64; 2]>,
}

/// Light from all around, a little different from direction to direction, as light that has been
/// reflected often is: `E(n) = mean + slope · n` (the first order of R. Ramamoorthi and
/// P. Hanrahan, "An efficient representation for irradiance environment maps", 2001).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ambient {
    /// How light it makes a white surface on average: 1 is white; one value per colour, linear.
    pub mean: [f32; 3],
    /// How much lighter a surface is that faces +x, +y, +z, world frame.
    pub slope: [f32; 3],
}

impl Default for Ambient {
    fn default() -> Self {
        Self { mean: [0.30, 0.30, 0.31], slope: [0.035, 0.055, 0.09] }
    }
}

impl Default for Lighting {
    /// No lamps: light from all around, mostly from above.
    fn default() -> Self {
        let ambient = Ambient { mean: [0.55; 3], slope: [0.08, 0.12, 0.2] };
        Self { lamps: Vec::new(), ambient, background: [0.55, 0.6, 0.66] }
    }
}

/// The light as shading wants it: linear, in floats.
pub(super) struct Light {
    lamps: Vec<ReadyLamp>,
    ambient: Ambient,
    pub background: V3,
}

pub(super) struct ReadyLamp {
    pub position: V3,
    pub radius: f32,
    power: V3,
    room: Vec<[f32; 2]>,
}

impl Light {
    pub fn of(lighting: &Lighting) -> Self {
        let lamps = lighting.lamps.iter().map(|lamp| ReadyLamp {
            position: lamp.position.map(|it| it as f32),
            radius: lamp.radius_m as f32,
            power: scale(linear(lamp.colour), lamp.strength),
            room: lamp.room.iter().map(|corner| corner.map(|it| it as f32)).collect(),
        });
        let background = linear(lighting.background);
        Self { lamps: lamps.collect(), ambient: lighting.ambient, background }
    }

    /// The lamp that lights a place: the first whose room it is in.
    pub fn lamp_at(&self, at: V3) -> Option<&ReadyLamp> {
        self.lamps.iter().find(|lamp| lamp.room.is_empty() || contains(&lamp.room, at))
    }

    /// Irradiance of a surface: `open` is the share of the directions around it, and `lit` the
    /// share of its lamp, that nothing stands before.
    pub fn on(&self, at: V3, normal: V3, open: f32, lit: f32) -> V3 {
        let slope = dot(self.ambient.slope, normal);
        let around = scale(self.ambient.mean.map(|mean| (mean + slope).max(0.0)), open);
        match self.lamp_at(at) {
            Some(lamp) if lit > 0.0 => add(around, scale(lamp.on(at, normal), lit)),
            _ => around,
        }
    }
}

impl ReadyLamp {
    /// Irradiance without anything between, from a lamp that shines downwards and to the sides.
    fn on(&self, at: V3, normal: V3) -> V3 {
        let towards = sub(self.position, at);
        let square = dot(towards, towards);
        let facing = dot(unit(towards), normal).max(0.0);
        // A lamp has a size: right beside it the light stays finite.
        scale(self.power, facing / (square + 0.5))
    }
}

/// Whether a point is above a polygon, by the crossings of a ray along x.
fn contains(outline: &[[f32; 2]], at: V3) -> bool {
    let mut inside = false;
    let mut from = outline[outline.len() - 1];
    for to in outline {
        let crosses = (from[1] > at[1]) != (to[1] > at[1]);
        if crosses && at[0] < from[0] + (at[1] - from[1]) / (to[1] - from[1]) * (to[0] - from[0]) {
            inside = !inside;
        }
        from = *to;
    }
    inside
}

/// The light that a surface throws back: diffuse.
pub(super) fn reflected(albedo: V3, irradiance: V3) -> V3 {
    times(albedo, irradiance)
}
