//! The ROS 2 messages that perception needs, in CDR, and their schemas.
//!
//! Classic CDR (XCDR1), little or big endian, as every ROS 2 recording holds it; written little
//! endian. Data of images is borrowed. Units and frames are those of ROS: metres, seconds,
//! unit quaternions; optical frames look along z, x to the right, y down (REP 103).

mod camera;
mod cdr;
mod messages;

pub use camera::{CameraInfoError, camera_info, camera_of};
pub use messages::{
    CameraInfo, CompressedImage, Header, Image, RegionOfInterest, Time, TransformStamped,
    decode_camera_info, decode_compressed_image, decode_image, decode_tf, encode_camera_info,
    encode_compressed_image, encode_image, encode_tf,
};

use super::Schema;

/// Why bytes are not the message that was asked for.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CdrError {
    /// Not the header of classic CDR.
    #[error("{message} begins with {found:02x?}: it must be classic CDR (00 00 or 00 01)")]
    Encapsulation {
        /// The message.
        message: &'static str,
        /// The first bytes.
        found: [u8; 2],
    },
    /// Too short for what it says it holds.
    #[error("{message}.{field} ends early: {needed} bytes were announced, {left} are left")]
    Short {
        /// The message.
        message: &'static str,
        /// The field.
        field: &'static str,
        /// Bytes announced.
        needed: u64,
        /// Bytes there.
        left: usize,
    },
    /// A text that is not UTF-8 with a zero at its end.
    #[error("{message}.{field} is no text: it must be UTF-8 and end with a zero")]
    Text {
        /// The message.
        message: &'static str,
        /// The field.
        field: &'static str,
    },
}

macro_rules! ros2_schema {
    ($name:literal, $file:literal) => {
        Schema {
            name: $name,
            encoding: "ros2msg",
            data: include_bytes!(concat!("../../schemas/ros2/", $file, ".msg")),
            message_encoding: "cdr",
        }
    };
}

/// `tf2_msgs/msg/TFMessage`: transforms between frames.
pub const TF_MESSAGE: Schema = ros2_schema!("tf2_msgs/msg/TFMessage", "TFMessage");
/// `sensor_msgs/msg/Image`: an image, pixel by pixel.
pub const IMAGE: Schema = ros2_schema!("sensor_msgs/msg/Image", "Image");
/// `sensor_msgs/msg/CompressedImage`: an image as a JPEG or PNG file.
pub const COMPRESSED_IMAGE: Schema =
    ros2_schema!("sensor_msgs/msg/CompressedImage", "CompressedImage");
/// `sensor_msgs/msg/CameraInfo`: the calibration of a camera.
pub const CAMERA_INFO: Schema = ros2_schema!("sensor_msgs/msg/CameraInfo", "CameraInfo");

/// The schema with this name, if it is one of the four.
pub fn schema_named(name: &str) -> Option<Schema> {
    [TF_MESSAGE, IMAGE, COMPRESSED_IMAGE, CAMERA_INFO].into_iter().find(|it| it.name == name)
}
