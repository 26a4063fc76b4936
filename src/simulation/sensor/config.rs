//! How bad a camera is: [`NoiseConfig`].

use serde::{Deserialize, Serialize};

/// What a real RGB-D camera does to what a perfect one sees. The defaults are those of a camera
/// with structured light, after K. Khoshelham and S. Oude Elberink, "Accuracy and resolution of
/// Kinect depth data for indoor mapping applications", Sensors 12(2), 2012 (cited as KE).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
#[serde(default, deny_unknown_fields)]
pub struct NoiseConfig {
    /// Standard deviation of depth at 1 m, metres; grows with the square of depth. KE equation 9
    /// with σ of half a step of disparity: 1.43 mm at 1 m, 3.6 cm at 5 m.
    pub depth_sigma_m: f64,
    /// Step of depth at 1 m, metres; grows with the square of depth, as disparity comes in whole
    /// steps. KE equation 10: 2.85 mm at 1 m, 7 cm at 5 m.
    pub depth_step_m: f64,
    /// Pixels across the window that the camera matches: noise is alike within it.
    pub window_px: u32,
    /// From camera to projector (to the right of it), metres: what the projector cannot see has
    /// no depth. KE: 7.5 cm.
    pub baseline_m: f64,
    /// Share of the pixels at a jump in depth that have none.
    pub edge_holes: f64,
    /// Angle between ray and surface normal from which on there is no depth, degrees; after
    /// C. Nguyen, S. Izadi and D. Lovell, "Modeling Kinect sensor noise for improved 3D
    /// reconstruction and tracking", 2012, who find depth up to about 80°.
    pub grazing_deg: f64,
    /// Nearest depth, metres.
    pub min_depth_m: f64,
    /// Farthest depth, metres.
    pub max_depth_m: f64,
    /// Standard deviation of colour, in steps of 1/255.
    pub colour_sigma: f64,
    /// How much of a difference in brightness automatic exposure takes away: 0 none, 1 all.
    pub exposure: f64,
    /// Standard deviation of exposure from picture to picture, as a share.
    pub exposure_sigma: f64,
    /// Share of the light that is lost in the corners.
    pub vignetting: f64,
}

impl Default for NoiseConfig {
    fn default() -> Self {
        Self {
            depth_sigma_m: 1.425e-3,
            depth_step_m: 2.85e-3,
            window_px: 8,
            baseline_m: 0.075,
            edge_holes: 0.3,
            grazing_deg: 80.0,
            min_depth_m: 0.3,
            max_depth_m: 8.0,
            colour_sigma: 2.0,
            exposure: 0.5,
            exposure_sigma: 0.02,
            vignetting: 0.12,
        }
    }
}

impl NoiseConfig {
    /// A perfect camera, but that it reaches no farther than 65.535 m.
    pub const fn none() -> Self {
        Self {
            depth_sigma_m: 0.0,
            depth_step_m: 0.0,
            window_px: 1,
            baseline_m: 0.0,
            edge_holes: 0.0,
            grazing_deg: 90.0,
            min_depth_m: 0.0,
            max_depth_m: 65.535,
            colour_sigma: 0.0,
            exposure: 0.0,
            exposure_sigma: 0.0,
            vignetting: 0.0,
        }
    }

    /// Checks that every number is one that a camera can have.
    pub fn check(&self) -> Result<(), NoiseError> {
        let limits = [
            ("depth_sigma_m", self.depth_sigma_m, 1.0),
            ("depth_step_m", self.depth_step_m, 1.0),
            ("window_px", f64::from(self.window_px), 1024.0),
            ("baseline_m", self.baseline_m, 1.0),
            ("edge_holes", self.edge_holes, 1.0),
            ("grazing_deg", self.grazing_deg, 90.0),
            ("min_depth_m", self.min_depth_m, 65.535),
            ("max_depth_m", self.max_depth_m, 65.535),
            ("colour_sigma", self.colour_sigma, 255.0),
            ("exposure", self.exposure, 1.0),
            ("exposure_sigma", self.exposure_sigma, 0.5),
            ("vignetting", self.vignetting, 1.0),
        ];
        match limits.into_iter().find(|(_, value, most)| !(0.0..=*most).contains(value)) {
            Some((field, value, most)) => Err(NoiseError { field, value, most }),
            None if self.window_px == 0 => {
                Err(NoiseError { field: "window_px (at least 1)", value: 0.0, most: 1024.0 })
            }
            None => Ok(()),
        }
    }
}

/// A number that no camera has.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("noise.{field} is {value}: it must be from 0 to {most}")]
pub struct NoiseError {
    /// The field.
    pub field: &'static str,
    /// Its value.
    pub value: f64,
    /// The most it may be.
    pub most: f64,
}
