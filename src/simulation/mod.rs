//! A house that renders what a robot's camera sees and knows the truth.
//!
//! Deterministic: same house, same scenario, same seed, same bytes, for any number of threads.

pub mod house;
pub mod mesh;
pub mod shapes;
