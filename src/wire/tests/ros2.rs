//! ROS 2 messages read back, in both byte orders, and any bytes are read without panic.

use proptest::collection::vec;
use proptest::prelude::*;

use crate::wire::ros2::{
    CameraInfo, CompressedImage, Header, Image, RegionOfInterest, Time, TransformStamped,
    decode_camera_info, decode_compressed_image, decode_image, decode_tf, encode_camera_info,
    encode_compressed_image, encode_image, encode_tf,
};

fn header(frame_id: &str) -> Header<'_> {
    Header { stamp: Time { sec: 1_767_571_200, nanosec: 5 }, frame_id }
}

fn camera_info<'a>(
    frame: &'a str,
    model: &'a str,
    d: Vec<f64>,
    do_rectify: bool,
) -> CameraInfo<'a> {
    CameraInfo {
        header: header(frame),
        height: 480,
        width: 640,
        distortion_model: model,
        d,
        k: [500.0, 0.0, 320.0, 0.0, 500.0, 240.0, 0.0, 0.0, 1.0],
        r: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        p: [500.0, 0.0, 320.0, 0.0, 0.0, 500.0, 240.0, 0.0, 0.0, 0.0, 1.0, 0.0],
        binning_x: 1,
        binning_y: 2,
        roi: RegionOfInterest { x_offset: 3, y_offset: 4, height: 5, width: 6, do_rectify },
    }
}

proptest! {
    #[test]
    fn messages_read_back(
        frame in ".{0,9}", text in ".{0,9}", numbers in prop::array::uniform7(-1e3..1e3_f64),
        data in vec(any::<u8>(), 0..60), n in 0..4_usize, flag: bool,
    ) {
        prop_assume!(!frame.contains('\0') && !text.contains('\0'));
        let [x, y, z, i, j, k, w] = numbers;
        let transform = TransformStamped {
            header: header(&frame), child_frame_id: &text,
            translation: [x, y, z], rotation_xyzw: [i, j, k, w],
        };
        let transforms = vec![transform; n];
        let payload = encode_tf(&transforms);
        prop_assert_eq!(decode_tf(&payload), Ok(transforms));
        let image = Image {
            header: header(&frame), height: 2, width: 3, encoding: &text,
            is_bigendian: u8::from(flag), step: 6, data: &data,
        };
        let payload = encode_image(&image);
        prop_assert_eq!(decode_image(&payload), Ok(image));
        let file = CompressedImage { header: header(&frame), format: &text, data: &data };
        let payload = encode_compressed_image(&file);
        prop_assert_eq!(decode_compressed_image(&payload), Ok(file));
        let info = camera_info(&frame, &text, numbers[..n].to_vec(), flag);
        let payload = encode_camera_info(&info);
        prop_assert_eq!(decode_camera_info(&payload), Ok(info));
    }

    #[test]
    fn any_bytes_are_read_without_panic(kind in 0..3_u8, bytes in vec(any::<u8>(), 0..200)) {
        let payload = [&[0, kind, 0, 0], &*bytes].concat();
        let _ = (decode_tf(&payload), decode_image(&payload), decode_tf(&bytes));
        let _ = (decode_compressed_image(&payload), decode_camera_info(&payload));
    }

    #[test]
    fn damaged_messages_are_read_without_panic(place: prop::sample::Index, byte: u8, cut: bool) {
        let mut payload = encode_camera_info(&camera_info("camera", "plumb_bob", vec![0.0; 5], true));
        let n = place.index(payload.len());
        payload[n] = byte;
        if cut {
            payload.truncate(n);
        }
        let _ = decode_camera_info(&payload);
    }
}

#[test]
fn big_endian_messages_are_read() {
    let payload =
        b"\0\0\0\0\0\0\0\x01\0\0\0\x02\0\0\0\x02c\0\0\0\0\0\0\x05jpeg\0\0\0\0\0\0\0\x02\xff\xd8";
    let read = decode_compressed_image(payload).unwrap();
    let header = Header { stamp: Time { sec: 1, nanosec: 2 }, frame_id: "c" };
    assert_eq!(read, CompressedImage { header, format: "jpeg", data: b"\xff\xd8" });
}

#[test]
fn what_is_not_classic_cdr_is_refused_by_name() {
    let error = decode_image(b"\0\x07\0\0").unwrap_err().to_string();
    assert_eq!(error, "Image begins with [00, 07]: it must be classic CDR (00 00 or 00 01)");
    let error = decode_tf(b"\0\x01\0\0\xff\xff\xff\xff").unwrap_err().to_string();
    assert!(error.starts_with("TFMessage.transforms ends early"), "{error}");
    let unended = b"\0\x01\0\0\0\0\0\0\0\0\0\0\x01\0\0\0c";
    let error = decode_image(unended).unwrap_err().to_string();
    assert!(error.starts_with("Image.header.frame_id is no text"), "{error}");
}
