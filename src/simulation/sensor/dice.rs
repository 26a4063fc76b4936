//! Numbers that look random, by counting: the n-th is had without those before it, so that rows
//! can be worked on in any order and by any number of threads.

use std::f64::consts::TAU;

/// The finaliser of `SplitMix64` (G. Steele, D. Lea and C. Flood, "Fast splittable pseudorandom
/// number generators", 2014): fixed for good, as recordings depend on it.
const fn mixed(mut bits: u64) -> u64 {
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}

/// A stream of numbers, named by a seed and by what they are for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dice(u64);

impl Dice {
    pub const fn new(seed: u64) -> Self {
        Self(mixed(seed ^ 0x9e37_79b9_7f4a_7c15))
    }

    /// A stream of its own.
    pub const fn stream(self, name: u64) -> Self {
        Self(mixed(self.0 ^ mixed(name.wrapping_add(0x9e37_79b9_7f4a_7c15))))
    }

    /// 64 random bits.
    pub const fn bits(self, n: u64) -> u64 {
        mixed(self.0.wrapping_add(n.wrapping_mul(0x9e37_79b9_7f4a_7c15)))
    }

    /// From 0 to 1, 1 left out.
    pub fn share(self, n: u64) -> f64 {
        (self.bits(n) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Of the normal distribution (G. Box and M. Muller, "A note on the generation of random
    /// normal deviates", 1958).
    pub fn normal(self, n: u64) -> f64 {
        let bits = self.bits(n);
        let (first, second) = ((bits >> 32) as u32, bits as u32);
        let radius = libm::sqrt(-2.0 * libm::log((f64::from(first) + 0.5) / 4_294_967_296.0));
        radius * libm::cos(TAU * f64::from(second) / 4_294_967_296.0)
    }

    /// Nearly of the normal distribution (±3.45 σ at most), and cheap: the sum of four bytes.
    pub fn nearly_normal(self, n: u64) -> f32 {
        /// √(4 (256² − 1) / 12)
        const SIGMA: f32 = 147.8;
        let bytes = (self.bits(n) as u32).to_le_bytes();
        let sum: i32 = bytes.into_iter().map(i32::from).sum();
        (sum - 510) as f32 / SIGMA
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(draw: impl Fn(u64) -> f64, mean: f64, sigma: f64) {
        const COUNT: u64 = 40_000;
        let found = (0..COUNT).map(&draw).sum::<f64>() / COUNT as f64;
        let square = (0..COUNT).map(|n| (draw(n) - mean).powi(2)).sum::<f64>() / COUNT as f64;
        assert!((found - mean).abs() < 0.02, "mean {found}");
        assert!((square.sqrt() - sigma).abs() < 0.02, "σ {}", square.sqrt());
    }

    #[test]
    fn numbers_are_distributed_as_promised() {
        let dice = Dice::new(7).stream(3);
        check(|n| dice.share(n), 0.5, (1.0_f64 / 12.0).sqrt());
        check(|n| dice.normal(n), 0.0, 1.0);
        check(|n| dice.nearly_normal(n).into(), 0.0, 1.0);
    }

    #[test]
    fn the_numbers_of_a_seed_are_fixed_for_good() {
        assert_eq!(Dice::new(1).stream(2).bits(3), 8_696_800_260_926_573_263);
    }
}
