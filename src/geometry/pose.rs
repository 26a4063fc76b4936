//! Poses in SE(3): [`Pose`], and how far apart two may be: [`Tolerance`].

use nalgebra::{Isometry3, Point3, Quaternion, Translation3, UnitQuaternion, Vector3};

use super::grid::{GeometryError, Micrometres, metres, micrometres, on_grid};

/// Steps of the orientation grid in one unit of a quaternion component.
const QUATERNION_STEPS: f64 = 1.0e7;
/// The square of the length of a unit quaternion, in steps.
const UNIT_SQUARE: u64 = 100_000_000_000_000;

/// The pose `world_from_node` of a node: an element of SE(3).
///
/// Position in metres on a grid of a micrometre, orientation a unit quaternion on a grid of 1e-7
/// (at most 2e-7 rad from what was given) with w ≥ 0, or the first other non-zero component
/// positive where w = 0: one rotation, one representation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Pose {
    position_um: [Micrometres; 3],
    /// (w, x, y, z) in steps of 1e-7.
    orientation_e7: [i32; 4],
}

impl Pose {
    /// The origin, upright.
    pub const IDENTITY: Self = Self { position_um: [0; 3], orientation_e7: [10_000_000, 0, 0, 0] };

    /// A pose from a position in metres and a quaternion (w, x, y, z) of any non-zero length.
    pub fn new(position_m: [f64; 3], wxyz: [f64; 4]) -> Result<Self, GeometryError> {
        let [x, y, z] = position_m;
        let position_um = [micrometres("x", x)?, micrometres("y", y)?, micrometres("z", z)?];
        Ok(Self { position_um, orientation_e7: quantised(wxyz)? })
    }

    /// An upright pose at a position in metres.
    pub fn at(position_m: [f64; 3]) -> Result<Self, GeometryError> {
        Self::new(position_m, [1.0, 0.0, 0.0, 0.0])
    }

    /// A pose from its grid values, as recordings store them. The quaternion must have unit
    /// length to within the grid; it is taken as it is, so that what was stored reads back.
    pub fn from_grid(
        position_um: [Micrometres; 3],
        orientation_e7: [i32; 4],
    ) -> Result<Self, GeometryError> {
        // In whole steps: replay makes a pose for each edit, and rounding takes ten times as long.
        let squares = orientation_e7.map(|step| u64::from(step.unsigned_abs()).pow(2));
        let square = squares.into_iter().fold(0_u64, u64::saturating_add);
        let positive = orientation_e7.iter().find(|step| **step != 0).is_some_and(|step| *step > 0);
        if !positive || square.abs_diff(UNIT_SQUARE) > UNIT_SQUARE / 1_000_000 {
            let [w, x, y, z] = orientation_e7.map(|step| f64::from(step) / QUATERNION_STEPS);
            return Err(GeometryError::Orientation { w, x, y, z });
        }
        let [x, y, z] = position_um;
        let position_um = [on_grid("x", x)?, on_grid("y", y)?, on_grid("z", z)?];
        Ok(Self { position_um, orientation_e7 })
    }

    /// A pose from an isometry, rounded to the grid.
    pub fn from_isometry(world_from_node: &Isometry3<f64>) -> Result<Self, GeometryError> {
        let t = world_from_node.translation.vector;
        let q = world_from_node.rotation;
        Self::new([t.x, t.y, t.z], [q.w, q.i, q.j, q.k])
    }

    /// The pose as an isometry: maps points of the node's frame to the world.
    pub fn isometry(&self) -> Isometry3<f64> {
        let [x, y, z] = self.position();
        let [w, i, j, k] = self.orientation();
        let rotation = UnitQuaternion::from_quaternion(Quaternion::new(w, i, j, k));
        Isometry3::from_parts(Translation3::new(x, y, z), rotation)
    }

    /// Position in metres, world frame.
    pub fn position(&self) -> [f64; 3] {
        self.position_um.map(metres)
    }

    /// Position as a point, world frame, metres.
    pub fn point(&self) -> Point3<f64> {
        Point3::from(self.position())
    }

    /// Orientation (w, x, y, z).
    pub fn orientation(&self) -> [f64; 4] {
        self.orientation_e7.map(|step| f64::from(step) / QUATERNION_STEPS)
    }

    /// Position in micrometres.
    pub const fn position_um(&self) -> [Micrometres; 3] {
        self.position_um
    }

    /// Orientation (w, x, y, z) in steps of 1e-7.
    pub const fn orientation_e7(&self) -> [i32; 4] {
        self.orientation_e7
    }

    /// Distance to `other` as (metres, radians): the norms of the two parts of
    /// X₁ ⊟ X₂ = (t₁ − t₂, Log(R₂ᵀR₁)) (Hertzberg et al., "Integrating generic sensor fusion
    /// algorithms with sound state representations through encapsulation of manifolds", 2013).
    pub fn distance(&self, other: &Self) -> (f64, f64) {
        let translation = Vector3::from(self.position()) - Vector3::from(other.position());
        let (a, b) = (self.isometry().rotation, other.isometry().rotation);
        (translation.norm(), a.angle_to(&b))
    }

    /// Where this pose goes when what carries it moves rigidly from `before` to `after`:
    /// `X' = X_after · X_before⁻¹ · X`.
    pub fn carried(&self, before: &Self, after: &Self) -> Result<Self, GeometryError> {
        let moved = after.isometry() * before.isometry().inverse() * self.isometry();
        Self::from_isometry(&moved)
    }
}

/// The quaternion nearest on the grid, scaled to unit length and to a positive first component.
fn quantised(wxyz: [f64; 4]) -> Result<[i32; 4], GeometryError> {
    let [w, x, y, z] = wxyz;
    // Scaled by the largest component first: squares of tiny or huge numbers would be lost.
    let largest = wxyz.iter().fold(0.0_f64, |max, c| max.max(c.abs()));
    if !wxyz.iter().all(|c| c.is_finite()) || largest < 1.0e-9 {
        return Err(GeometryError::Orientation { w, x, y, z });
    }
    let scaled = wxyz.map(|c| c / largest);
    let norm = libm::sqrt(scaled.iter().map(|c| c * c).sum());
    // What already lies on the grid stays: reading one's own output must change nothing.
    let unit = if (norm * largest - 1.0).abs() < 1.0e-6 && is_on_grid(wxyz) {
        wxyz
    } else {
        scaled.map(|c| c / norm)
    };
    let steps = unit.map(|c| libm::round(c * QUATERNION_STEPS) as i32);
    let negative = steps.iter().find(|step| **step != 0).is_some_and(|step| *step < 0);
    Ok(if negative { steps.map(|step| -step) } else { steps })
}

fn is_on_grid(wxyz: [f64; 4]) -> bool {
    wxyz.iter().all(|c| {
        let steps = libm::round(c * QUATERNION_STEPS);
        // The grid value itself, as division gives it, bit for bit.
        (steps / QUATERNION_STEPS).to_bits() == (c + 0.0).to_bits() || *c == 0.0
    })
}

/// How far two poses or sizes may differ and still count as equal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Largest distance between positions, and between box sides, in metres.
    pub distance_m: f64,
    /// Largest angle between orientations, in radians.
    pub angle_rad: f64,
}

impl Tolerance {
    /// Only equal values are equal.
    pub const EXACT: Self = Self { distance_m: 0.0, angle_rad: 0.0 };

    /// Whether two poses are within the tolerance of each other.
    pub fn poses(&self, a: &Pose, b: &Pose) -> bool {
        if a == b {
            return true;
        }
        let (metres, radians) = a.distance(b);
        metres <= self.distance_m && radians <= self.angle_rad
    }

    /// Whether two sizes are within the tolerance of each other, side by side.
    pub fn sizes(&self, a: super::Size, b: super::Size) -> bool {
        a.metres().iter().zip(b.metres()).all(|(a, b)| (a - b).abs() <= self.distance_m)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    prop_compose! {
        fn pose()(position in prop::array::uniform3(-50.0..50.0_f64),
                  wxyz in prop::array::uniform4(-1.0..1.0_f64)) -> Pose {
            Pose::new(position, wxyz).unwrap_or(Pose::IDENTITY)
        }
    }

    proptest! {
        #[test]
        fn a_pose_reads_back_from_its_floats_and_its_grid(pose in pose()) {
            prop_assert_eq!(Pose::new(pose.position(), pose.orientation()), Ok(pose));
            prop_assert_eq!(Pose::from_grid(pose.position_um(), pose.orientation_e7()), Ok(pose));
        }

        #[test]
        fn opposite_quaternions_are_one_rotation(pose in pose()) {
            let opposite = pose.orientation().map(|c| -c);
            prop_assert_eq!(Pose::new(pose.position(), opposite), Ok(pose));
        }

        #[test]
        fn carrying_there_and_back_returns(pose in pose(), a in pose(), b in pose()) {
            let back = pose.carried(&a, &b).unwrap().carried(&b, &a).unwrap();
            let (metres, radians) = back.distance(&pose);
            prop_assert!(metres < 1e-4 && radians < 2e-6, "{metres} {radians}");
        }

        #[test]
        fn distance_to_itself_is_zero(pose in pose()) {
            let (metres, radians) = pose.distance(&pose);
            prop_assert!(metres < 1e-12 && radians < 1e-7);
        }
    }

    #[test]
    fn what_is_no_rotation_or_no_place_is_refused() {
        assert!(Pose::at([f64::NAN, 0.0, 0.0]).is_err());
        assert!(Pose::at([0.0, f64::INFINITY, 0.0]).is_err());
        assert!(Pose::at([0.0, 0.0, 1e9]).is_err());
        assert!(Pose::new([0.0; 3], [0.0; 4]).is_err());
        assert!(Pose::new([0.0; 3], [f64::NAN, 0.0, 0.0, 1.0]).is_err());
        assert!(Pose::from_grid([0; 3], [5_000_000, 0, 0, 0]).is_err());
        assert!(Pose::from_grid([i64::MAX; 3], [10_000_000, 0, 0, 0]).is_err());
        assert!(Pose::from_grid([0; 3], [i32::MIN; 4]).is_err());
    }

    #[test]
    fn minus_zero_never_enters() {
        let pose = Pose::new([-0.0, -1e-9, 0.0], [1.0, -0.0, 0.0, 0.0]).unwrap();
        assert!(pose.position().iter().chain(&pose.orientation()).all(|c| !c.is_sign_negative()));
    }
}
