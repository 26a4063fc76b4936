//! A house that renders what a robot's camera sees and knows the truth.
//!
//! Deterministic: same house, same scenario, same seed, same bytes, for any number of threads.

pub mod blocks;
pub mod house;
pub mod mesh;
pub mod random;
pub mod render;
pub mod robot;
pub mod scenario;
pub mod shapes;
pub mod solid;
pub mod story;
pub mod world;

#[cfg(test)]
mod tests;

// TEMPORARY until the branches are merged.
/// Noise.
pub mod sensor {
    use schemars::JsonSchema;
    use serde::{Deserialize, Serialize};
    /// Noise.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct NoiseConfig {}
}
