//! Pictures of what is known.

mod depth;
mod houses;
mod scenes;
pub(super) mod shapes;
