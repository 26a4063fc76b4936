//! Calibrations to and from the camera of `geometry`.

use super::{CameraInfo, Header, RegionOfInterest};
use crate::geometry::Camera;

/// The distortion model that is understood, besides none.
const PLUMB_BOB: &str = "plumb_bob";

/// A calibration that describes no camera, or one of another kind.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CameraInfoError {
    /// No pixels.
    #[error("CameraInfo is of {width}×{height} pixels: both must be positive")]
    Empty {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// A focal length that is not positive, or a number that is not finite.
    #[error(
        "CameraInfo.k says fx {fx}, fy {fy}, cx {cx}, cy {cy}: fx and fy must be positive and all \
         finite (all zero means uncalibrated)"
    )]
    Intrinsics {
        /// Focal length across.
        fx: f64,
        /// Focal length down.
        fy: f64,
        /// Column of the principal point.
        cx: f64,
        /// Row of the principal point.
        cy: f64,
    },
    /// A distortion model that is not known here.
    #[error(
        "CameraInfo.distortion_model is {model:?} with {parameters} parameters: \
         it must be \"plumb_bob\" with 4 or 5, or none"
    )]
    Distortion {
        /// Its name.
        model: String,
        /// How many parameters it was given.
        parameters: usize,
    },
}

/// The calibration of a camera, unrectified.
pub fn camera_info<'a>(camera: &Camera, header: Header<'a>) -> CameraInfo<'a> {
    let ([fx, fy], [cx, cy]) = (camera.focal, camera.centre);
    CameraInfo {
        header,
        height: camera.height,
        width: camera.width,
        distortion_model: PLUMB_BOB,
        d: camera.distortion.to_vec(),
        k: [fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0],
        r: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        p: [fx, 0.0, cx, 0.0, 0.0, fy, cy, 0.0, 0.0, 0.0, 1.0, 0.0],
        binning_x: 0,
        binning_y: 0,
        roi: RegionOfInterest::default(),
    }
}

/// The camera of a calibration, for its raw (unrectified) pictures at full size.
pub fn camera_of(info: &CameraInfo<'_>) -> Result<Camera, CameraInfoError> {
    let (width, height) = (info.width, info.height);
    if width == 0 || height == 0 {
        return Err(CameraInfoError::Empty { width, height });
    }
    let [fx, _, cx, _, fy, cy, ..] = info.k;
    let finite = [fx, fy, cx, cy].iter().all(|it| it.is_finite());
    if !finite || fx <= 0.0 || fy <= 0.0 {
        return Err(CameraInfoError::Intrinsics { fx, fy, cx, cy });
    }
    let distortion = distortion(info)?;
    Ok(Camera { width, height, focal: [fx, fy], centre: [cx, cy], distortion })
}

fn distortion(info: &CameraInfo<'_>) -> Result<[f64; 5], CameraInfoError> {
    let unknown = || CameraInfoError::Distortion {
        model: info.distortion_model.to_owned(),
        parameters: info.d.len(),
    };
    if info.d.iter().all(|it| *it == 0.0) {
        return Ok([0.0; 5]);
    }
    let finite = info.d.iter().all(|it| it.is_finite());
    let mut distortion = [0.0; 5];
    let slots = distortion.get_mut(..info.d.len()).filter(|slots| slots.len() >= 4);
    match slots {
        Some(slots) if finite && info.distortion_model == PLUMB_BOB => {
            slots.copy_from_slice(&info.d);
            Ok(distortion)
        }
        _ => Err(unknown()),
    }
}

#[cfg(test)]
// Numbers come back bit by bit.
#[allow(clippy::float_cmp)]
mod tests {
    use super::*;

    fn info() -> CameraInfo<'static> {
        let camera = Camera::with_fov(320, 240, 1.1);
        let distortion = [0.1, 0.2, 0.3, 0.4, 0.5];
        camera_info(&Camera { distortion, ..camera }, Header::default())
    }

    #[track_caller]
    fn check(info: &CameraInfo<'_>, expected: &str) {
        assert_eq!(camera_of(info).unwrap_err().to_string(), expected);
    }

    #[test]
    fn four_parameters_or_none_are_understood() {
        let four = CameraInfo { d: vec![0.1, 0.2, 0.3, 0.4], ..info() };
        assert_eq!(camera_of(&four).unwrap().distortion, [0.1, 0.2, 0.3, 0.4, 0.0]);
        let none = CameraInfo { d: Vec::new(), distortion_model: "", ..info() };
        assert_eq!(camera_of(&none).unwrap().distortion, [0.0; 5]);
    }

    #[test]
    fn what_is_no_camera_is_refused_by_field() {
        let empty = CameraInfo { height: 0, ..info() };
        check(&empty, "CameraInfo is of 320×0 pixels: both must be positive");
        let uncalibrated = CameraInfo { k: [0.0; 9], ..info() };
        let expected = "CameraInfo.k says fx 0, fy 0, cx 0, cy 0: fx and fy must be positive and \
                        all finite (all zero means uncalibrated)";
        check(&uncalibrated, expected);
        let expected = "CameraInfo.distortion_model is \"equidistant\" with 5 parameters: it must \
                        be \"plumb_bob\" with 4 or 5, or none";
        check(&CameraInfo { distortion_model: "equidistant", ..info() }, expected);
        let expected = "CameraInfo.distortion_model is \"plumb_bob\" with 8 parameters: it must \
                        be \"plumb_bob\" with 4 or 5, or none";
        check(&CameraInfo { d: vec![0.1; 8], ..info() }, expected);
    }
}
