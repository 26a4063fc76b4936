//! [`Field`]: noise that is alike within a window.

use super::dice::Dice;

/// Noise of mean 0 and standard deviation 1 at every pixel, smooth over windows.
pub(super) struct Field {
    /// At the corners of windows.
    knots: Vec<f64>,
    across: usize,
    window: usize,
}

impl Field {
    pub fn new(dice: Dice, width: u32, height: u32, window_px: u32) -> Self {
        let window = window_px.max(1) as usize;
        let across = width as usize / window + 2;
        let down = height as usize / window + 2;
        let knots = (0..(across * down) as u64).map(|n| dice.normal(n)).collect();
        Self { knots, across, window }
    }

    /// Between the four knots around a pixel; scaled, as a mean of several varies less than one.
    pub fn at(&self, column: usize, row: usize) -> f64 {
        let place = |at: usize| (at / self.window, (at % self.window) as f64 / self.window as f64);
        let ((i, x), (j, y)) = (place(column), place(row));
        let knot = |i: usize, j: usize| self.knots[j * self.across + i];
        let above = knot(i, j) * (1.0 - x) + knot(i + 1, j) * x;
        let below = knot(i, j + 1) * (1.0 - x) + knot(i + 1, j + 1) * x;
        let square = |share: f64| share * share + (1.0 - share) * (1.0 - share);
        (above * (1.0 - y) + below * y) / libm::sqrt(square(x) * square(y))
    }
}
