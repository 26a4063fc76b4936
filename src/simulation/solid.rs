//! Upright boxes and whether they meet: [`Solid`].

use crate::geometry::{Pose, Size};

/// An upright box turned about z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solid {
    /// Centre, metres.
    pub centre: [f64; 3],
    /// Half extents along its own axes, metres.
    pub half: [f64; 3],
    /// Turn about z, radians.
    pub yaw: f64,
}

/// Boxes that meet by less than this do not, metres: things lie on each other.
pub const TOUCH_M: f64 = 0.002;

impl Solid {
    /// The box of a thing; its pose is upright.
    pub fn of(pose: &Pose, size: Size) -> Self {
        Self { centre: pose.position(), half: size.metres().map(|side| side / 2.0), yaw: yaw(pose) }
    }

    /// Lowest point, metres.
    pub fn bottom(&self) -> f64 {
        self.centre[2] - self.half[2]
    }

    /// Highest point, metres.
    pub fn top(&self) -> f64 {
        self.centre[2] + self.half[2]
    }

    /// Corners on the floor, counter-clockwise.
    pub fn corners(&self) -> [[f64; 2]; 4] {
        let (sin, cos) = (libm::sin(self.yaw), libm::cos(self.yaw));
        let [hx, hy, _] = self.half;
        [(hx, hy), (-hx, hy), (-hx, -hy), (hx, -hy)]
            .map(|(x, y)| [self.centre[0] + x * cos - y * sin, self.centre[1] + x * sin + y * cos])
    }

    /// How deep two boxes meet, metres: the least shift that parts them; negative if apart.
    ///
    /// Separating axes of two rectangles on the floor, and the heights.
    pub fn depth(&self, other: &Self) -> f64 {
        let mut least = self.top().min(other.top()) - self.bottom().max(other.bottom());
        let (a, b) = (self.corners(), other.corners());
        for yaw in [self.yaw, other.yaw] {
            for [x, y] in [[libm::cos(yaw), libm::sin(yaw)], [-libm::sin(yaw), libm::cos(yaw)]] {
                let range = |corners: &[[f64; 2]; 4]| {
                    let along = corners.map(|corner| corner[0] * x + corner[1] * y);
                    along.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
                        (low.min(*v), high.max(*v))
                    })
                };
                let ((low_a, high_a), (low_b, high_b)) = (range(&a), range(&b));
                least = least.min(high_a.min(high_b) - low_a.max(low_b));
            }
        }
        least
    }

    /// Whether two boxes take up the same space.
    pub fn meets(&self, other: &Self) -> bool {
        self.depth(other) > TOUCH_M
    }
}

/// Turn of a pose about z, radians.
pub fn yaw(pose: &Pose) -> f64 {
    let [w, x, y, z] = pose.orientation();
    libm::atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
}

/// An upright pose turned about z; `None` beyond the grid of poses.
pub fn upright(at: [f64; 3], yaw: f64) -> Option<Pose> {
    Pose::new(at, [libm::cos(yaw / 2.0), 0.0, 0.0, libm::sin(yaw / 2.0)]).ok()
}
