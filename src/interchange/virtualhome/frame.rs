//! From Unity's frame to ours; the reasons are in the documentation of the parent module.

use crate::geometry::{GeometryError, Pose, Size};

/// Thinnest side that is taken: Unity gives flat things boxes of 1e-18 m.
pub(super) const THINNEST_M: f64 = 0.001;

/// (x right, y up, z ahead), left-handed, to (x right, y ahead, z up), right-handed. Nothing is
/// mirrored. Serves points and sides of boxes alike.
pub(super) fn world_from_unity([x, y, z]: [f64; 3]) -> [f64; 3] {
    [x, z, y]
}

/// An axis-aligned box of Unity; says whether a side had to be made [`THINNEST_M`].
pub(super) fn extent(
    centre: [f64; 3],
    size: [f64; 3],
) -> Result<((Pose, Size), bool), GeometryError> {
    let thin = size.iter().any(|side| *side >= 0.0 && *side < THINNEST_M);
    let thick = |side: f64| if side >= 0.0 { side.max(THINNEST_M) } else { side };
    let [w, h, d] = world_from_unity(size).map(thick);
    Ok(((Pose::at(world_from_unity(centre))?, Size::new(w, h, d)?), thin))
}
