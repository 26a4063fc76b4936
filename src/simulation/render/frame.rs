//! [`Frame`]: what a perfect camera sees.

/// Colour, depth and mask of every pixel, row by row from the upper left.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// sRGB.
    pub colour: Vec<[u8; 3]>,
    /// Depth along the optical axis, metres; 0 where nothing is seen.
    pub depth_m: Vec<f32>,
    /// The number of the thing that is seen; 0 for the building and for nothing.
    pub mask: Vec<u16>,
}

impl Frame {
    /// Depth as cameras send it: whole millimetres, 0 where nothing is seen or too far for it.
    pub fn depth_mm(&self) -> Vec<u16> {
        self.depth_m.iter().map(|depth| millimetres(*depth)).collect()
    }
}

/// Nearest whole millimetres; 0 for what is beyond 65.535 m.
pub(in crate::simulation) fn millimetres(depth_m: f32) -> u16 {
    let millimetres = (depth_m * 1000.0).round();
    if millimetres <= f32::from(u16::MAX) { millimetres as u16 } else { 0 }
}
