//! [`Stillness`]: whether two poses of an object are one place.

use crate::geometry::{Pose, Size};

/// When an object counts as static: d(X, X₀) = ‖X ⊟ X₀‖ < ε on SE(3) (paper, "Time").
///
/// Metres and radians are weighed by an arm r: d² = |t − t₀|² + (r·θ)², θ = ‖Log(R₀ᵀR)‖. A turn
/// by θ carries a point at distance r from the centre by about r·θ, so with r of half the box's
/// diagonal d bounds how far any point of the object has gone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stillness {
    /// ε in metres, at least 0.
    pub epsilon_m: f64,
    /// r in metres; `None`: half the diagonal of the object's box.
    pub arm_m: Option<f64>,
}

impl Default for Stillness {
    /// ε of 10 cm, above what poses of one thing seen twice differ by; the arm is that of the
    /// object.
    fn default() -> Self {
        Self { epsilon_m: 0.1, arm_m: None }
    }
}

impl Stillness {
    /// d(X, X₀) in metres for an object of this size.
    pub fn distance(&self, now: &Pose, then: &Pose, size: Size) -> f64 {
        let (metres, radians) = now.distance(then);
        let arm = self.arm_m.unwrap_or_else(|| half_diagonal(size));
        libm::hypot(metres, arm * radians)
    }

    /// Whether an object of this size that was at `then` and is at `now` counts as static.
    pub fn holds(&self, now: &Pose, then: &Pose, size: Size) -> bool {
        now == then || self.distance(now, then, size) < self.epsilon_m
    }
}

fn half_diagonal(size: Size) -> f64 {
    let [w, h, d] = size.metres();
    libm::sqrt(w * w + h * h + d * d) / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turned(x: f64, degrees: f64) -> Pose {
        let half = degrees.to_radians() / 2.0;
        Pose::new([x, 0.0, 0.0], [libm::cos(half), 0.0, 0.0, libm::sin(half)]).unwrap()
    }

    #[track_caller]
    fn check(side_m: f64, x: f64, degrees: f64, still: bool) {
        let size = Size::new(side_m, side_m, side_m).unwrap();
        let found = Stillness::default().holds(&turned(x, degrees), &turned(0.0, 0.0), size);
        assert_eq!(found, still, "side {side_m}, by {x} m and {degrees} degrees");
    }

    #[test]
    fn a_turn_counts_by_the_size_of_what_turns() {
        check(0.1, 0.0, 0.0, true);
        check(0.1, 0.09, 0.0, true);
        check(0.1, 0.11, 0.0, false);
        check(0.1, 0.0, 45.0, true); // a cup turned on its saucer
        check(2.0, 0.0, 45.0, false); // a sofa turned round
        check(0.1, 0.08, 45.0, false);
    }

    #[test]
    fn metres_and_radians_add_as_in_a_right_triangle() {
        let size = Size::new(0.2, 0.2, 0.2).unwrap();
        let by = Stillness { epsilon_m: 0.1, arm_m: Some(2.0) };
        let d = by.distance(&turned(0.3, 0.2_f64.to_degrees()), &turned(0.0, 0.0), size);
        assert!((d - 0.5).abs() < 1e-6, "{d}");
    }
}
