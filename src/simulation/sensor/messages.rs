//! What a camera says on its topics, as inputs for a recording.

use nalgebra::Isometry3;

use super::Picture;
use super::files::{FileError, jpeg};
use crate::event::{Event, SensorMessage};
use crate::geometry::Camera;
use crate::simulation::render::Frame;
use crate::time::Stamp;
use crate::wire::Schema;
use crate::wire::ros2::{
    CAMERA_INFO, COMPRESSED_IMAGE, CompressedImage, Header, IMAGE, Image, TF_MESSAGE, Time,
    TransformStamped, camera_info, encode_camera_info, encode_compressed_image, encode_image,
    encode_tf,
};

/// Topic of colour, JPEG.
pub const COLOUR_TOPIC: &str = "/camera/color/image/compressed";
/// Topic of the calibration, which holds for depth as well.
pub const INFO_TOPIC: &str = "/camera/color/camera_info";
/// Topic of depth, 16UC1 in millimetres, registered to colour.
pub const DEPTH_TOPIC: &str = "/camera/depth/image";
/// Topic of true masks, in truth files only.
pub const MASK_TOPIC: &str = "/truth/mask";
/// Topic of poses that change.
pub const TF_TOPIC: &str = "/tf";
/// Topic of poses that do not.
pub const TF_STATIC_TOPIC: &str = "/tf_static";

/// The instant as ROS has it; its seconds end in 2038.
pub fn ros_time(at: Stamp) -> Time {
    let (sec, nanosec) = (at.nanos() / 1_000_000_000, at.nanos() % 1_000_000_000);
    Time { sec: i32::try_from(sec).unwrap_or(i32::MAX), nanosec: nanosec as u32 }
}

fn message(topic: &str, schema: &Schema, data: Vec<u8>) -> Event {
    Event::Sensor(SensorMessage {
        topic: topic.into(),
        message_encoding: schema.message_encoding.into(),
        schema_name: schema.name.into(),
        schema_encoding: schema.encoding.into(),
        schema: schema.data.into(),
        data: data.into(),
    })
}

/// `sensor_msgs/msg/CompressedImage` on [`COLOUR_TOPIC`]: a JPEG of this quality, 1 to 100.
pub fn colour_message(
    at: Stamp,
    frame_id: &str,
    picture: &Picture,
    quality: u8,
) -> Result<Event, FileError> {
    let file = jpeg(picture.width, picture.height, &picture.colour, quality)?;
    let header = Header { stamp: ros_time(at), frame_id };
    let image = CompressedImage { header, format: "jpeg", data: &file };
    Ok(message(COLOUR_TOPIC, &COMPRESSED_IMAGE, encode_compressed_image(&image)))
}

/// `sensor_msgs/msg/Image` on [`DEPTH_TOPIC`]: 16UC1, millimetres, little endian.
pub fn depth_message(at: Stamp, frame_id: &str, picture: &Picture) -> Event {
    message(DEPTH_TOPIC, &IMAGE, image_16(at, frame_id, picture.width, &picture.depth_mm))
}

/// The payload of a `sensor_msgs/msg/Image` of one 16-bit value a pixel, row by row.
pub fn image_16(at: Stamp, frame_id: &str, width: u32, values: &[u16]) -> Vec<u8> {
    let data: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    encode_image(&Image {
        header: Header { stamp: ros_time(at), frame_id },
        height: (values.len() as u32).checked_div(width).unwrap_or(0),
        width,
        encoding: "16UC1",
        is_bigendian: 0,
        step: width * 2,
        data: &data,
    })
}

/// `sensor_msgs/msg/Image` on [`MASK_TOPIC`]: 16UC1, at each pixel the number of the thing seen.
pub fn mask_message(at: Stamp, frame_id: &str, frame: &Frame) -> Event {
    message(MASK_TOPIC, &IMAGE, image_16(at, frame_id, frame.width, &frame.mask))
}

/// `sensor_msgs/msg/CameraInfo` on [`INFO_TOPIC`].
pub fn info_message(at: Stamp, frame_id: &str, camera: &Camera) -> Event {
    let header = Header { stamp: ros_time(at), frame_id };
    message(INFO_TOPIC, &CAMERA_INFO, encode_camera_info(&camera_info(camera, header)))
}

/// A pose between two frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transform<'a> {
    /// The frame in which the pose is given.
    pub parent: &'a str,
    /// The frame whose pose it is.
    pub child: &'a str,
    /// The pose.
    pub parent_from_child: Isometry3<f64>,
}

/// `tf2_msgs/msg/TFMessage` on [`TF_TOPIC`] or [`TF_STATIC_TOPIC`].
pub fn tf_message(at: Stamp, topic: &str, transforms: &[Transform<'_>]) -> Event {
    let stamped = transforms.iter().map(|transform| TransformStamped {
        header: Header { stamp: ros_time(at), frame_id: transform.parent },
        child_frame_id: transform.child,
        translation: transform.parent_from_child.translation.vector.into(),
        rotation_xyzw: transform.parent_from_child.rotation.coords.into(),
    });
    let stamped: Vec<TransformStamped<'_>> = stamped.collect();
    message(topic, &TF_MESSAGE, encode_tf(&stamped))
}

#[cfg(test)]
// Numbers come back bit by bit.
#[allow(clippy::float_cmp)]
mod tests {
    use super::*;
    use crate::wire::ros2::{
        camera_of, decode_camera_info, decode_compressed_image, decode_image, decode_tf,
    };

    const AT: Stamp = Stamp::from_nanos(1_767_571_200_250_000_000);

    #[track_caller]
    fn check(event: Event, topic: &str, schema: &str) -> SensorMessage {
        let Event::Sensor(message) = event else { panic!("not a sensor's") };
        assert_eq!((&*message.topic, &*message.schema_name), (topic, schema));
        assert_eq!((&*message.message_encoding, &*message.schema_encoding), ("cdr", "ros2msg"));
        message
    }

    #[test]
    fn pictures_say_when_and_in_which_frame() {
        let picture =
            Picture { width: 2, height: 1, colour: vec![[9; 3]; 2], depth_mm: vec![258, 0] };
        let colour = colour_message(AT, "eye", &picture, 80).unwrap();
        let colour = check(colour, COLOUR_TOPIC, "sensor_msgs/msg/CompressedImage");
        let header =
            Header { stamp: Time { sec: 1_767_571_200, nanosec: 250_000_000 }, frame_id: "eye" };
        assert_eq!(decode_compressed_image(&colour.data).unwrap().header, header);
        let depth = depth_message(AT, "eye", &picture);
        let depth = check(depth, DEPTH_TOPIC, "sensor_msgs/msg/Image");
        let depth = decode_image(&depth.data).unwrap();
        assert_eq!(
            (depth.header, depth.encoding, depth.data),
            (header, "16UC1", &[2, 1, 0, 0][..])
        );
        assert_eq!((depth.width, depth.height, depth.step), (2, 1, 4));
    }

    #[test]
    fn a_calibration_comes_back() {
        let distortion = [0.1, -0.2, 0.003, 0.004, 0.05];
        let camera = Camera { distortion, ..Camera::with_fov(320, 240, 1.1) };
        let info =
            check(info_message(AT, "eye", &camera), INFO_TOPIC, "sensor_msgs/msg/CameraInfo");
        assert_eq!(camera_of(&decode_camera_info(&info.data).unwrap()), Ok(camera));
    }

    #[test]
    fn a_pose_comes_back() {
        let pose = Isometry3::new([1.0, 2.0, 3.0].into(), [0.1, 0.2, 0.3].into());
        let transform = Transform { parent: "map", child: "base", parent_from_child: pose };
        let message = tf_message(AT, TF_STATIC_TOPIC, &[transform]);
        let message = check(message, TF_STATIC_TOPIC, "tf2_msgs/msg/TFMessage");
        let read = decode_tf(&message.data).unwrap();
        assert_eq!((read[0].header.frame_id, read[0].child_frame_id), ("map", "base"));
        assert_eq!(read[0].translation, [1.0, 2.0, 3.0]);
        assert_eq!(read[0].rotation_xyzw[3], pose.rotation.w);
    }
}
