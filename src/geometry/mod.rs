//! Poses, boxes and tolerances in metres and radians.
//!
//! Knows nothing of graphs, messages or files. World frame `w`: right-handed, z up.
//! Every value is finite and lies on a fixed grid (a micrometre; 1e-7 of a unit quaternion), so
//! equality is exact, text and integers carry it without loss, and −0.0 never occurs.

mod camera;
mod extent;
mod grid;
mod pose;

pub use camera::{Camera, looking_along, looking_at};
pub use extent::Size;
pub use grid::{GeometryError, Micrometres};
pub use pose::{Pose, Tolerance};
