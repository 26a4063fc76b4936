//! What a real camera makes of what a perfect one would see: noise from a seed, and files and
//! ROS messages of it.
//!
//! Picture number n of a seed has the same noise whichever pictures were taken before it.

mod colour;
mod config;
mod depth;
mod dice;
mod field;
mod files;
mod messages;
#[cfg(test)]
mod tests;

pub use config::{NoiseConfig, NoiseError};
pub use files::{FileError, jpeg, png, png_16};
pub use messages::{
    COLOUR_TOPIC, DEPTH_TOPIC, INFO_TOPIC, MASK_TOPIC, TF_STATIC_TOPIC, TF_TOPIC, Transform,
    colour_message, depth_message, image_16, info_message, mask_message, ros_time, tf_message,
};

use self::dice::Dice;
use super::render::Frame;
use crate::geometry::Camera;

/// What a camera hands out: colour and depth registered to it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Picture {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// sRGB, row by row.
    pub colour: Vec<[u8; 3]>,
    /// Depth along the optical axis in millimetres, row by row; 0 where there is none.
    pub depth_mm: Vec<u16>,
}

impl Picture {
    /// Picture number `number` of a camera with this noise.
    pub fn take(
        frame: &Frame,
        camera: &Camera,
        noise: &NoiseConfig,
        seed: u64,
        number: u64,
    ) -> Self {
        let dice = Dice::new(seed).stream(number);
        Self {
            width: frame.width,
            height: frame.height,
            colour: colour::exposed(noise, frame, dice.stream(1)),
            depth_mm: depth::measured(noise, camera, frame, dice.stream(2)),
        }
    }
}
