//! What a camera sees of a house: colour, depth and masks.
//!
//! A [`Scene`] holds meshes in their places. Which triangle a pixel sees is found by rasterising
//! (exactly what a ray through the pixel would meet; cameras with lens distortion do cast rays);
//! shadows and ambient occlusion by parry's rays through a tree of the meshes' trees.

mod frame;
mod house;
mod light;
mod occlusion;
mod pictures;
mod raster;
mod scene;
mod shade;
mod solid;
#[cfg(test)]
mod tests;
mod texture;
mod tone;
mod vector;
mod visible;

pub use frame::Frame;
pub(super) use frame::millimetres;
pub use house::HouseScene;
pub use light::{Ambient, Lamp, Lighting};
pub use pictures::{depth_colours, mask_colour};
pub use scene::{InstanceId, RayHit, Scene};
pub(super) use tone::{encode, linear};
