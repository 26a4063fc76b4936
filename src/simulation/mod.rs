//! A house that renders what a robot's camera sees and knows the truth.
//!
//! Deterministic: same house, same scenario, same seed, same bytes, for any number of threads.

pub mod house;
pub mod mesh;
pub mod random;
pub mod render;
pub mod robot;
pub mod scenario;
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
impl house::Thing {
    /// A thing.
    pub fn of_class(
        name: String,
        label: crate::graph::Label,
        size: Option<[f64; 3]>,
    ) -> Result<Self, crate::geometry::GeometryError> {
        let [w, h, d] = size.unwrap_or([0.1; 3]);
        Ok(Self {
            name,
            label,
            pose: crate::geometry::Pose::IDENTITY,
            size: crate::geometry::Size::new(w, h, d)?,
            mesh: std::sync::Arc::default(),
            movable: true,
            decay_rate: 1e-5,
            room: 0,
            support: None,
            surfaces: Vec::new(),
        })
    }
}
