//! Pictures for people: floor plans and diagrams as SVG and PNG.
//!
//! Knows nothing of recordings. Same input, same bytes; fonts come from the crate, never from
//! the system.
//!
//! - [`svg`]: a writer of SVG, in the style all our drawings share.
//! - [`patrol`]: a walk through rooms on the floor plan.
//! - [`reliability`]: what was predicted against what came.
//! - [`raster`]: SVG to PNG.
//! - [`plan`]: the floor plan of a house or of a graph, and what changed in it.

pub mod patrol;
pub mod plan;
pub mod raster;
pub mod reliability;
pub mod svg;
