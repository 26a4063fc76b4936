//! The size of a box: [`Size`].

use super::grid::{GeometryError, Micrometres, metres, micrometres, on_grid};

/// Full extents (w, h, d) of a bounding box in metres, each positive; the paper's `b ∈ R³₊`.
///
/// In the frame of the object: w along x, h along y, d along z (up for an upright object).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Size([Micrometres; 3]);

impl Size {
    /// A box of (w, h, d) metres.
    pub fn new(w: f64, h: f64, d: f64) -> Result<Self, GeometryError> {
        let sides = [("width", w), ("height", h), ("depth", d)];
        let mut grid = [0; 3];
        for (slot, (what, value)) in grid.iter_mut().zip(sides) {
            *slot = micrometres(what, value)?;
            if *slot <= 0 {
                return Err(GeometryError::NotPositive { what, value });
            }
        }
        Ok(Self(grid))
    }

    /// A box from whole micrometres.
    pub fn from_micrometres(sides: [Micrometres; 3]) -> Result<Self, GeometryError> {
        for (what, side) in ["width", "height", "depth"].into_iter().zip(sides) {
            if on_grid(what, side)? <= 0 {
                return Err(GeometryError::NotPositive { what, value: metres(side) });
            }
        }
        Ok(Self(sides))
    }

    /// (w, h, d) in metres.
    pub fn metres(self) -> [f64; 3] {
        self.0.map(metres)
    }

    /// (w, h, d) in micrometres.
    pub const fn micrometres(self) -> [Micrometres; 3] {
        self.0
    }
}
