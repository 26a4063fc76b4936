//! Pictures of what is known.

mod depth;
mod scenes;
pub(super) mod shapes;
