//! The four messages as plain structs.

use super::CdrError;
use super::cdr::{Reader, Writer};

/// An instant as ROS has it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Time {
    /// Whole seconds since 1970.
    pub sec: i32,
    /// Nanoseconds within the second.
    pub nanosec: u32,
}

/// When and in which frame something was measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Header<'a> {
    /// When.
    pub stamp: Time,
    /// The frame.
    pub frame_id: &'a str,
}

/// `parent_from_child`: the pose of `child_frame_id` in `header.frame_id`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TransformStamped<'a> {
    /// When, and the parent frame.
    pub header: Header<'a>,
    /// The child frame.
    pub child_frame_id: &'a str,
    /// Translation (x, y, z), metres.
    pub translation: [f64; 3],
    /// Rotation (x, y, z, w): ROS puts the scalar last.
    pub rotation_xyzw: [f64; 4],
}

/// An image, row by row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Image<'a> {
    /// When, and the optical frame.
    pub header: Header<'a>,
    /// Rows.
    pub height: u32,
    /// Columns.
    pub width: u32,
    /// What a pixel is, such as `rgb8` or `16UC1` (depth in millimetres).
    pub encoding: &'a str,
    /// Whether numbers in pixels are big endian: 0 or 1.
    pub is_bigendian: u8,
    /// Bytes from one row to the next.
    pub step: u32,
    /// The pixels; nothing is promised of its length.
    pub data: &'a [u8],
}

/// An image as a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CompressedImage<'a> {
    /// When, and the optical frame.
    pub header: Header<'a>,
    /// The format, such as `jpeg` or `png`.
    pub format: &'a str,
    /// The file.
    pub data: &'a [u8],
}

/// The part of the sensor that was read out; all zero means the whole of it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RegionOfInterest {
    /// First column.
    pub x_offset: u32,
    /// First row.
    pub y_offset: u32,
    /// Rows.
    pub height: u32,
    /// Columns.
    pub width: u32,
    /// Whether a rectified region is to be taken from it.
    pub do_rectify: bool,
}

/// The calibration of a camera. Focal lengths and centres are in pixels.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraInfo<'a> {
    /// When, and the optical frame.
    pub header: Header<'a>,
    /// Rows.
    pub height: u32,
    /// Columns.
    pub width: u32,
    /// Name of the distortion model, such as `plumb_bob`.
    pub distortion_model: &'a str,
    /// Distortion parameters.
    pub d: Vec<f64>,
    /// Intrinsic matrix (fx 0 cx; 0 fy cy; 0 0 1), row by row.
    pub k: [f64; 9],
    /// Rectification, row by row.
    pub r: [f64; 9],
    /// Projection of the rectified image, 3×4, row by row.
    pub p: [f64; 12],
    /// Columns binned into one; 0 is 1.
    pub binning_x: u32,
    /// Rows binned into one; 0 is 1.
    pub binning_y: u32,
    /// What was read out.
    pub roi: RegionOfInterest,
}

/// The least that a transform takes: empty names and seven numbers.
const LEAST_TRANSFORM: u64 = 72;

fn read_header<'a>(input: &mut Reader<'a>) -> Result<Header<'a>, CdrError> {
    let stamp = Time { sec: input.i32("header.stamp")?, nanosec: input.u32("header.stamp")? };
    Ok(Header { stamp, frame_id: input.text("header.frame_id")? })
}

fn write_header(out: &mut Writer, header: &Header<'_>) {
    out.i32(header.stamp.sec);
    out.u32(header.stamp.nanosec);
    out.text(header.frame_id);
}

/// Reads a `tf2_msgs/msg/TFMessage`.
pub fn decode_tf(payload: &[u8]) -> Result<Vec<TransformStamped<'_>>, CdrError> {
    let mut input = Reader::new("TFMessage", payload)?;
    let count = input.count("transforms", LEAST_TRANSFORM)?;
    let read = |_| {
        Ok(TransformStamped {
            header: read_header(&mut input)?,
            child_frame_id: input.text("child_frame_id")?,
            translation: input.f64s("translation")?,
            rotation_xyzw: input.f64s("rotation")?,
        })
    };
    (0..count).map(read).collect()
}

/// The payload of a `tf2_msgs/msg/TFMessage`.
pub fn encode_tf(transforms: &[TransformStamped<'_>]) -> Vec<u8> {
    let mut out = Writer::new();
    out.count(transforms.len());
    for transform in transforms {
        write_header(&mut out, &transform.header);
        out.text(transform.child_frame_id);
        out.f64s(&transform.translation);
        out.f64s(&transform.rotation_xyzw);
    }
    out.finish()
}

/// Reads a `sensor_msgs/msg/Image`.
pub fn decode_image(payload: &[u8]) -> Result<Image<'_>, CdrError> {
    let mut input = Reader::new("Image", payload)?;
    Ok(Image {
        header: read_header(&mut input)?,
        height: input.u32("height")?,
        width: input.u32("width")?,
        encoding: input.text("encoding")?,
        is_bigendian: input.u8("is_bigendian")?,
        step: input.u32("step")?,
        data: input.bytes("data")?,
    })
}

/// The payload of a `sensor_msgs/msg/Image`.
pub fn encode_image(image: &Image<'_>) -> Vec<u8> {
    let mut out = Writer::new();
    write_header(&mut out, &image.header);
    out.u32(image.height);
    out.u32(image.width);
    out.text(image.encoding);
    out.u8(image.is_bigendian);
    out.u32(image.step);
    out.bytes(image.data);
    out.finish()
}

/// Reads a `sensor_msgs/msg/CompressedImage`.
pub fn decode_compressed_image(payload: &[u8]) -> Result<CompressedImage<'_>, CdrError> {
    let mut input = Reader::new("CompressedImage", payload)?;
    Ok(CompressedImage {
        header: read_header(&mut input)?,
        format: input.text("format")?,
        data: input.bytes("data")?,
    })
}

/// The payload of a `sensor_msgs/msg/CompressedImage`.
pub fn encode_compressed_image(image: &CompressedImage<'_>) -> Vec<u8> {
    let mut out = Writer::new();
    write_header(&mut out, &image.header);
    out.text(image.format);
    out.bytes(image.data);
    out.finish()
}

/// Reads a `sensor_msgs/msg/CameraInfo`.
pub fn decode_camera_info(payload: &[u8]) -> Result<CameraInfo<'_>, CdrError> {
    let mut input = Reader::new("CameraInfo", payload)?;
    Ok(CameraInfo {
        header: read_header(&mut input)?,
        height: input.u32("height")?,
        width: input.u32("width")?,
        distortion_model: input.text("distortion_model")?,
        d: {
            let count = input.count("d", 8)?;
            (0..count).map(|_| input.f64("d")).collect::<Result<_, _>>()?
        },
        k: input.f64s("k")?,
        r: input.f64s("r")?,
        p: input.f64s("p")?,
        binning_x: input.u32("binning_x")?,
        binning_y: input.u32("binning_y")?,
        roi: RegionOfInterest {
            x_offset: input.u32("roi.x_offset")?,
            y_offset: input.u32("roi.y_offset")?,
            height: input.u32("roi.height")?,
            width: input.u32("roi.width")?,
            do_rectify: input.u8("roi.do_rectify")? != 0,
        },
    })
}

/// The payload of a `sensor_msgs/msg/CameraInfo`.
pub fn encode_camera_info(info: &CameraInfo<'_>) -> Vec<u8> {
    let mut out = Writer::new();
    write_header(&mut out, &info.header);
    out.u32(info.height);
    out.u32(info.width);
    out.text(info.distortion_model);
    out.count(info.d.len());
    out.f64s(&info.d);
    out.f64s(&info.k);
    out.f64s(&info.r);
    out.f64s(&info.p);
    out.u32(info.binning_x);
    out.u32(info.binning_y);
    let roi = &info.roi;
    for n in [roi.x_offset, roi.y_offset, roi.height, roi.width] {
        out.u32(n);
    }
    out.u8(u8::from(roi.do_rectify));
    out.finish()
}
