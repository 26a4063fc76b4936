//! The robot: where it fits, how it gets there, how it moves and what it does.

pub mod behaviour;
pub mod grid;
pub mod motion;
pub mod path;
pub mod views;
