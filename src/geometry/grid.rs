//! The grid on which all lengths lie: whole micrometres, exact in text, integers and floats.

/// Longest length or coordinate that is taken: 10,000 km, so that no sum overflows.
const LIMIT_M: f64 = 1.0e7;

/// A length or coordinate in whole micrometres.
pub type Micrometres = i64;

/// Why a pose or a size was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GeometryError {
    /// NaN, infinite, or farther than 10,000 km.
    #[error("{what} is {value:?}: it must be a number within ±10,000 km, in metres")]
    OutOfRange {
        /// Which quantity.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A quaternion of (nearly) zero length names no rotation.
    #[error(
        "the orientation (w {w}, x {x}, y {y}, z {z}) is no rotation: its length is zero or not finite"
    )]
    Orientation {
        /// Scalar part.
        w: f64,
        /// Vector part.
        x: f64,
        /// Vector part.
        y: f64,
        /// Vector part.
        z: f64,
    },
    /// A box side that is not positive.
    #[error("{what} is {value:?}: a box side must be positive, in metres")]
    NotPositive {
        /// Which side.
        what: &'static str,
        /// Its value in metres.
        value: f64,
    },
}

/// Rounds metres to whole micrometres.
pub(super) fn micrometres(what: &'static str, metres: f64) -> Result<Micrometres, GeometryError> {
    if metres.is_finite() && metres.abs() <= LIMIT_M {
        Ok(libm::round(metres * 1.0e6) as Micrometres)
    } else {
        Err(GeometryError::OutOfRange { what, value: metres })
    }
}

/// Metres from micrometres: the float nearest to the decimal, so it prints with six digits.
pub(super) fn metres(micrometres: Micrometres) -> f64 {
    micrometres as f64 / 1.0e6
}
