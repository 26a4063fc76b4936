//! A pinhole camera with lens distortion: [`Camera`].

use nalgebra::{
    Isometry3, Point2, Point3, Rotation3, Translation3, UnitQuaternion, Vector2, Vector3,
};

/// Newton steps after which a distorted point is given up; ten suffice for real lenses.
const STEPS_MAX: u32 = 50;
/// Normalised coordinates (x/z, y/z) nearer than this are taken as equal: 1e-9 pixel.
const NORMALISED_TOLERANCE: f64 = 1.0e-12;

/// Intrinsics of a pinhole camera with lens distortion, as `sensor_msgs/CameraInfo` has them.
///
/// Camera frame (optical, ROS REP 103): z forward, x right, y down, metres. Pixels: u right,
/// v down, the centre of the upper left pixel is (0, 0).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Focal lengths in pixels (fx, fy).
    pub focal: [f64; 2],
    /// Principal point in pixels (cx, cy).
    pub centre: [f64; 2],
    /// Distortion of the "plumb bob" model: (k1, k2, p1, p2, k3); zeros for none.
    pub distortion: [f64; 5],
}

impl Camera {
    /// A camera without distortion whose picture is `horizontal_fov` radians wide.
    pub fn with_fov(width: u32, height: u32, horizontal_fov: f64) -> Self {
        let focal = f64::from(width) / 2.0 / libm::tan(horizontal_fov / 2.0);
        let centre = [(f64::from(width) - 1.0) / 2.0, (f64::from(height) - 1.0) / 2.0];
        Self { width, height, focal: [focal; 2], centre, distortion: [0.0; 5] }
    }

    /// Whether straight lines stay straight.
    pub fn is_ideal(&self) -> bool {
        self.distortion.iter().all(|it| *it == 0.0)
    }

    /// The pixel (u, v) at which a point of the camera frame appears, inside the picture or not.
    ///
    /// `u = fx·x″ + cx`, `v = fy·y″ + cy` with `(x″, y″)` the distorted `(x/z, y/z)`. None for
    /// points that are not in front of the camera, and for those so far aside that the distortion
    /// would fold them back into the picture.
    pub fn project(&self, in_camera: &Point3<f64>) -> Option<Point2<f64>> {
        if in_camera.z <= 0.0 {
            return None;
        }
        let ideal = Vector2::new(in_camera.x, in_camera.y) / in_camera.z;
        let [x, y] = if self.is_ideal() { ideal.into() } else { self.distorted(&ideal)?.into() };
        let pixel = Point2::new(
            self.focal[0] * x + self.centre[0],
            self.focal[1] * y + self.centre[1],
        );
        (pixel.x.is_finite() && pixel.y.is_finite()).then_some(pixel)
    }

    /// The point of the camera frame, at depth 1 m, that appears at pixel (u, v): the direction
    /// of its ray, scaled to z = 1. None where no ray meets the pixel (far outside the picture,
    /// with distortion).
    pub fn ray(&self, u: f64, v: f64) -> Option<Vector3<f64>> {
        let seen = Vector2::new(
            (u - self.centre[0]) / self.focal[0],
            (v - self.centre[1]) / self.focal[1],
        );
        let ideal = if self.is_ideal() { seen } else { self.undistorted(&seen)? };
        Some(Vector3::new(ideal.x, ideal.y, 1.0))
    }

    /// The point of the camera frame seen at pixel (u, v) with a depth (z, not distance) in
    /// metres: the inverse of [`Self::project`]. None as for [`Self::ray`].
    pub fn back_project(&self, u: f64, v: f64, depth_m: f64) -> Option<Point3<f64>> {
        self.ray(u, v).map(|ray| Point3::from(ray * depth_m))
    }

    /// Whether a pixel position lies in the picture; each pixel reaches half a pixel about its
    /// centre.
    pub fn contains(&self, pixel: &Point2<f64>) -> bool {
        let within = |at: f64, size: u32| (-0.5..f64::from(size) - 0.5).contains(&at);
        within(pixel.x, self.width) && within(pixel.y, self.height)
    }

    /// Plumb bob model (D. C. Brown, "Decentering distortion of lenses", 1966; coefficients in
    /// the order of `sensor_msgs/CameraInfo`), with r² = x² + y²:
    /// `x″ = x(1 + k1 r² + k2 r⁴ + k3 r⁶) + 2 p1 xy + p2(r² + 2x²)`, and
    /// `y″ = y(1 + k1 r² + k2 r⁴ + k3 r⁶) + p1(r² + 2y²) + 2 p2 xy`.
    fn distorted(&self, at: &Vector2<f64>) -> Option<Vector2<f64>> {
        let [k1, k2, _, _, k3] = self.distortion;
        let r2 = at.norm_squared();
        // Beyond the radius where r″ stops growing with r, the model describes no lens.
        let growth = 1.0 + r2 * (3.0 * k1 + r2 * (5.0 * k2 + r2 * 7.0 * k3));
        (growth > 0.0).then(|| self.distortion_at(at).0)
    }

    /// The distorted point and (∂x″/∂x, ∂x″/∂y = ∂y″/∂x, ∂y″/∂y).
    fn distortion_at(&self, at: &Vector2<f64>) -> (Vector2<f64>, [f64; 3]) {
        let [k1, k2, p1, p2, k3] = self.distortion;
        let (x, y) = (at.x, at.y);
        let r2 = x * x + y * y;
        let radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3));
        let slope = 2.0 * (k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3));
        let seen = Vector2::new(
            x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
            y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y,
        );
        let xx = radial + x * x * slope + 2.0 * p1 * y + 6.0 * p2 * x;
        let xy = x * y * slope + 2.0 * p1 * x + 2.0 * p2 * y;
        let yy = radial + y * y * slope + 6.0 * p1 * y + 2.0 * p2 * x;
        (seen, [xx, xy, yy])
    }

    /// The inverse of [`Self::distorted`] by Newton's method.
    fn undistorted(&self, seen: &Vector2<f64>) -> Option<Vector2<f64>> {
        let mut ideal = *seen;
        for _ in 0..STEPS_MAX {
            let (found, [xx, xy, yy]) = self.distortion_at(&ideal);
            let miss = seen - found;
            if miss.amax() < NORMALISED_TOLERANCE {
                return self.distorted(&ideal).map(|_| ideal);
            }
            let determinant = xx * yy - xy * xy;
            if determinant <= 0.0 || !determinant.is_finite() {
                return None;
            }
            ideal.x += (yy * miss.x - xy * miss.y) / determinant;
            ideal.y += (xx * miss.y - xy * miss.x) / determinant;
        }
        None
    }
}

/// `world_from_camera` of an optical frame at `eye`, upright, that looks along a heading (`yaw`,
/// counter-clockwise from x) and up by `pitch`, radians.
pub fn looking_along(eye: Point3<f64>, yaw: f64, pitch: f64) -> Isometry3<f64> {
    let level = libm::cos(pitch);
    let forward = Vector3::new(level * libm::cos(yaw), level * libm::sin(yaw), libm::sin(pitch));
    let right = Vector3::new(libm::sin(yaw), -libm::cos(yaw), 0.0);
    let basis = [right, forward.cross(&right), forward];
    let rotation = UnitQuaternion::from_rotation_matrix(&Rotation3::from_basis_unchecked(&basis));
    Isometry3::from_parts(Translation3::from(eye), rotation)
}

/// `world_from_camera` of an optical frame at `eye`, upright, that looks at `target`. Straight up
/// and down, the picture's upper edge is towards x; if the two are one, it looks along x.
pub fn looking_at(eye: Point3<f64>, target: Point3<f64>) -> Isometry3<f64> {
    let to = target - eye;
    let yaw = libm::atan2(to.y, to.x);
    looking_along(eye, yaw, libm::atan2(to.z, libm::hypot(to.x, to.y)))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// A lens as cheap RGB-D cameras have it.
    const LENS: [f64; 5] = [0.12, -0.25, 0.001, -0.0008, 0.08];

    fn camera(distortion: [f64; 5]) -> Camera {
        Camera { distortion, ..Camera::with_fov(640, 480, 1.2) }
    }

    #[test]
    fn the_field_of_view_ends_at_the_outer_edges_of_the_outer_pixels() {
        let camera = Camera::with_fov(640, 480, 1.2);
        let ray = camera.ray(-0.5, 239.5).unwrap();
        assert!((ray.x + libm::tan(0.6)).abs() < 1e-12 && ray.y.abs() < 1e-12, "{ray}");
    }

    #[test]
    fn right_and_down_are_positive() {
        let camera = camera([0.0; 5]);
        let pixel = camera.project(&Point3::new(0.1, 0.2, 1.0)).unwrap();
        assert!(pixel.x > camera.centre[0] && pixel.y > camera.centre[1]);
    }

    #[track_caller]
    fn check_looking(eye: [f64; 3], target: [f64; 3]) {
        let world_from_camera = looking_at(eye.into(), target.into());
        let seen = world_from_camera.inverse() * Point3::from(target);
        let distance = (Point3::from(target) - Point3::from(eye)).norm();
        assert!((seen - Point3::new(0.0, 0.0, distance)).norm() < 1e-9, "{seen}");
        let down = world_from_camera * Vector3::y();
        assert!(down.z <= 1e-9, "down in the picture is {down}");
        assert!((world_from_camera * Vector3::x()).z.abs() < 1e-9, "the horizon is level");
    }

    #[test]
    fn what_is_looked_at_is_in_the_middle_and_upright() {
        check_looking([0.0, 0.0, 1.0], [2.0, 0.0, 1.0]);
        check_looking([1.0, -2.0, 1.5], [-2.0, 3.0, 0.2]);
        check_looking([1.0, 2.0, 0.5], [1.0, -4.0, 2.0]);
        check_looking([1.0, 2.0, 3.0], [1.0, 2.0, 0.0]);
        check_looking([1.0, 2.0, 0.0], [1.0, 2.0, 3.0]);
    }

    #[test]
    fn what_is_behind_is_not_seen() {
        assert_eq!(camera([0.0; 5]).project(&Point3::new(0.0, 0.0, -1.0)), None);
        assert_eq!(camera(LENS).project(&Point3::new(0.0, 0.0, 0.0)), None);
    }

    #[test]
    fn what_a_lens_would_fold_back_into_the_picture_is_not_seen() {
        let barrel = camera([-0.3, 0.0, 0.0, 0.0, 0.0]);
        let at = |x: f64| barrel.project(&Point3::new(x, 0.0, 1.0));
        assert!(at(0.9).is_some());
        assert_eq!(at(1.8), None);
        assert_eq!(barrel.ray(5_000.0, 0.0), None);
    }

    proptest! {
        #[test]
        fn back_projection_is_the_inverse_of_projection(
            u in -0.5..639.5, v in -0.5..479.5, depth in 0.05..20.0, scale in -1.0..1.0_f64,
        ) {
            let camera = camera(LENS.map(|k| k * scale));
            let point = camera.back_project(u, v, depth).unwrap();
            prop_assert!((point.z - depth).abs() < 1e-12);
            let pixel = camera.project(&point).unwrap();
            prop_assert!((pixel - Point2::new(u, v)).amax() < 1e-8, "{pixel}");
            prop_assert!(camera.contains(&pixel) || u < -0.499_999 || v < -0.499_999);
        }

        #[test]
        fn projection_is_the_inverse_of_back_projection(
            x in -0.6..0.6, y in -0.45..0.45, z in 0.05..20.0, scale in -1.0..1.0_f64,
        ) {
            let camera = camera(LENS.map(|k| k * scale));
            let point = Point3::new(x * z, y * z, z);
            let pixel = camera.project(&point).unwrap();
            let back = camera.back_project(pixel.x, pixel.y, z).unwrap();
            prop_assert!((back - point).amax() < 1e-9 * z, "{back}");
        }
    }
}
