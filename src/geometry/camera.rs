//! A pinhole camera: [`Camera`].

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
}
