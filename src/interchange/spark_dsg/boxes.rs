//! Bounding boxes of the file, and boxes around what belongs to a region.

use nalgebra::{Point3, Vector3};

use crate::geometry::{Pose, Size};
use crate::interchange::json::{At, JsonError};

/// How thick a side becomes that is less than half a micrometre.
const THIN_M: f64 = 0.001;

fn thick(side_m: f64) -> f64 {
    if side_m < 0.5e-6 { THIN_M } else { side_m }
}

/// The `bounding_box` of a node, if it has a valid one.
pub(super) fn read(attributes: &At<'_>) -> Result<Option<(Pose, Size)>, JsonError> {
    let Some(at) = attributes.optional("bounding_box")? else { return Ok(None) };
    let turned = match at.optional("type")? {
        Some(kind) => match (kind.value.as_str(), kind.value.as_u64()) {
            (Some("AABB"), _) | (_, Some(1)) => false,
            (Some("OBB" | "RAABB"), _) | (_, Some(2 | 3)) => true,
            _ => return Ok(None),
        },
        None => return Ok(None),
    };
    let (centre, sides) = centre_and_sides(&at)?;
    let valid = sides.iter().all(|side| side.is_finite() && *side >= 0.0);
    if !valid || sides.iter().all(|side| *side < 0.5e-6) {
        return Ok(None);
    }
    let orientation = match at.optional("world_R_center")? {
        Some(orientation) if turned => orientation.quaternion()?,
        _ => [1.0, 0.0, 0.0, 0.0],
    };
    let [w, h, d] = sides.map(thick);
    let pose = Pose::new(centre, orientation).map_err(|error| at.error(error))?;
    Ok(Some((pose, Size::new(w, h, d).map_err(|error| at.error(error))?)))
}

/// From `dimensions` and the centre, or before version 1.1 from `min` and `max`.
fn centre_and_sides(at: &At<'_>) -> Result<([f64; 3], [f64; 3]), JsonError> {
    let centre = at.optional("world_P_center")?.map(|at| at.triple()).transpose()?;
    if let Some(sides) = at.optional("dimensions")? {
        return Ok((centre.unwrap_or_default(), sides.triple()?));
    }
    let (min, max) = (at.field("min")?.triple()?, at.field("max")?.triple()?);
    let of = |f: fn(f64, f64) -> f64| [0, 1, 2].map(|n| f(min[n], max[n]));
    Ok((centre.unwrap_or(of(f64::midpoint)), of(|min, max| max - min)))
}

/// A box aligned with the axes that grows around what it is given.
#[derive(Clone, Copy, Debug)]
pub(super) struct Around {
    min: Point3<f64>,
    max: Point3<f64>,
}

impl Default for Around {
    fn default() -> Self {
        Self { min: [f64::INFINITY; 3].into(), max: [f64::NEG_INFINITY; 3].into() }
    }
}

impl Around {
    pub fn point(&mut self, point: Point3<f64>) {
        self.min = self.min.inf(&point);
        self.max = self.max.sup(&point);
    }

    pub fn extent(&mut self, (pose, size): (Pose, Size)) {
        let [w, h, d] = size.metres().map(|side| side / 2.0);
        for n in 0..8_u32 {
            let sign = |bit: u32| if n & bit == 0 { -1.0 } else { 1.0 };
            let corner = Point3::from(Vector3::new(w * sign(1), h * sign(2), d * sign(4)));
            self.point(pose.isometry() * corner);
        }
    }

    /// The box, if anything is in it.
    pub fn finish(self) -> Option<(Pose, Size)> {
        let sides = self.max - self.min;
        let centre = nalgebra::center(&self.min, &self.max);
        let [w, h, d] = [sides.x, sides.y, sides.z].map(thick);
        Pose::at([centre.x, centre.y, centre.z]).ok().zip(Size::new(w, h, d).ok())
    }
}
