//! How the robot moves: [`Body`], a base that turns on the spot and drives straight, and a
//! camera on a pan-tilt head.

use std::collections::VecDeque;
use std::f64::consts::{PI, TAU};

use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What the robot is and how fast.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BodyConfig {
    /// Radius of the base, metres.
    pub radius_m: f64,
    /// Driving speed, metres per second.
    pub speed_m_s: f64,
    /// Turn rate of the base, radians per second.
    pub turn_rad_s: f64,
    /// Rate of the pan-tilt head, radians per second.
    pub head_rad_s: f64,
    /// Height of the camera above the floor, metres.
    pub camera_height_m: f64,
    /// How far the gripper reaches from the centre of the base, metres.
    pub reach_m: f64,
}

impl Default for BodyConfig {
    fn default() -> Self {
        Self {
            radius_m: 0.22,
            speed_m_s: 0.9,
            turn_rad_s: 2.0,
            head_rad_s: 2.0,
            camera_height_m: 1.3,
            reach_m: 1.1,
        }
    }
}

/// One leg of a way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Leg {
    /// Turn on the spot to this heading, radians from x.
    Turn(f64),
    /// Drive straight to this point.
    Drive([f64; 2]),
    /// Stand and look: (pan from the heading, tilt down, seconds once the head is there).
    Look(f64, f64, f64),
}

/// Camera angles while driving: this far to either side, this far down, radians.
const SWEEP_PAN: f64 = 0.8;
const SWEEP_TILT: f64 = 0.45;
/// The gripper is this far ahead and this high, metres.
const GRIPPER: [f64; 3] = [0.42, 0.0, 0.92];
/// The camera is this far ahead of the centre of the base, metres.
const MAST_AHEAD: f64 = 0.06;

/// Where the robot is, and what it is about to do.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    config: BodyConfig,
    /// Centre of the base on the floor, metres.
    pub at: [f64; 2],
    /// Heading, radians from x.
    pub yaw: f64,
    /// Pan of the head from the heading, radians, to the left.
    pub pan: f64,
    /// Tilt of the head, radians, down.
    pub tilt: f64,
    legs: VecDeque<Leg>,
    held_s: f64,
    sweep: f64,
}

impl Body {
    /// A robot that stands at a point.
    pub fn new(config: BodyConfig, at: [f64; 2], yaw: f64) -> Self {
        let (legs, tilt) = (VecDeque::new(), SWEEP_TILT);
        Self { config, at, yaw, pan: 0.0, tilt, legs, held_s: 0.0, sweep: 1.0 }
    }

    /// Whether it has nothing to do.
    pub fn is_idle(&self) -> bool {
        self.legs.is_empty()
    }

    /// Adds a leg to its way.
    pub fn add(&mut self, leg: Leg) {
        self.legs.push_back(leg);
    }

    /// Adds the way through these points.
    pub fn follow(&mut self, way: &[[f64; 2]]) {
        for pair in way.windows(2) {
            let [a, b] = [pair[0], pair[1]];
            self.add(Leg::Turn(libm::atan2(b[1] - a[1], b[0] - a[0])));
            self.add(Leg::Drive(b));
        }
    }

    /// Moves on for `seconds`; never faster than the configuration allows.
    pub fn step(&mut self, seconds: f64) {
        let done = match self.legs.front().copied() {
            None => {
                self.aim(0.0, SWEEP_TILT, seconds);
                return;
            }
            Some(Leg::Turn(yaw)) => {
                self.sweep(seconds);
                let turn = toward(self.yaw, yaw, self.config.turn_rad_s * seconds);
                self.yaw = wrapped(self.yaw + turn);
                (wrapped(yaw - self.yaw)).abs() < 1e-9
            }
            Some(Leg::Drive(to)) => {
                self.sweep(seconds);
                self.drive(to, self.config.speed_m_s * seconds)
            }
            Some(Leg::Look(pan, tilt, hold_s)) => {
                self.held_s += if self.aim(pan, tilt, seconds) { seconds } else { 0.0 };
                self.held_s + 1e-9 >= hold_s
            }
        };
        if done {
            self.legs.pop_front();
            self.held_s = 0.0;
        }
    }

    fn drive(&mut self, to: [f64; 2], most: f64) -> bool {
        let (dx, dy) = (to[0] - self.at[0], to[1] - self.at[1]);
        let left = libm::hypot(dx, dy);
        if left <= most {
            self.at = to;
            return true;
        }
        self.at = [self.at[0] + dx / left * most, self.at[1] + dy / left * most];
        false
    }

    /// Looks to one side and then to the other.
    fn sweep(&mut self, seconds: f64) {
        if self.aim(SWEEP_PAN * self.sweep, SWEEP_TILT, seconds * 0.4) {
            self.sweep = -self.sweep;
        }
    }

    /// Turns the head; whether it has arrived.
    fn aim(&mut self, pan: f64, tilt: f64, seconds: f64) -> bool {
        let most = self.config.head_rad_s * seconds;
        // The head does not turn through its back.
        self.pan += (pan - self.pan).clamp(-most, most);
        self.tilt += (tilt - self.tilt).clamp(-most, most);
        (pan - self.pan).abs() < 1e-9 && (tilt - self.tilt).abs() < 1e-9
    }

    /// `world_from_base`: x ahead, z up, on the floor.
    pub fn world_from_base(&self) -> Isometry3<f64> {
        turned([self.at[0], self.at[1], 0.0], self.yaw)
    }

    /// `base_from_mount`: the foot of the pan-tilt head.
    pub fn base_from_mount(&self) -> Isometry3<f64> {
        Translation3::new(MAST_AHEAD, 0.0, self.config.camera_height_m).into()
    }

    /// `mount_from_head`: x along the line of sight.
    pub fn mount_from_head(&self) -> Isometry3<f64> {
        let pan = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), self.pan);
        let tilt = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), self.tilt);
        Isometry3::from_parts(Translation3::identity(), pan * tilt)
    }

    /// `head_from_optical`: from x ahead, z up to z ahead, x right, y down (ROS REP 103).
    pub fn head_from_optical() -> Isometry3<f64> {
        let roll = UnitQuaternion::from_euler_angles(-PI / 2.0, 0.0, -PI / 2.0);
        Isometry3::from_parts(Translation3::identity(), roll)
    }

    /// `world_from_camera`, optical frame.
    pub fn world_from_camera(&self) -> Isometry3<f64> {
        self.world_from_base()
            * self.base_from_mount()
            * self.mount_from_head()
            * Self::head_from_optical()
    }

    /// `base_from_gripper`: between its fingers.
    pub fn base_from_gripper() -> Isometry3<f64> {
        Translation3::new(GRIPPER[0], GRIPPER[1], GRIPPER[2]).into()
    }

    /// Pan and tilt that look at a point, as [`Leg::Look`] takes them, when the base heads there.
    pub fn look_at(&self, from: [f64; 2], point: [f64; 3]) -> (f64, f64) {
        let ahead = libm::hypot(point[0] - from[0], point[1] - from[1]);
        (0.0, libm::atan2(self.config.camera_height_m - point[2], ahead))
    }
}

fn turned(at: [f64; 3], yaw: f64) -> Isometry3<f64> {
    let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw);
    Isometry3::from_parts(Translation3::new(at[0], at[1], at[2]), turn)
}

/// An angle as -π to π.
pub fn wrapped(angle: f64) -> f64 {
    angle - TAU * libm::round(angle / TAU)
}

/// The step from one heading toward another, at most `most`.
fn toward(from: f64, to: f64, most: f64) -> f64 {
    wrapped(to - from).clamp(-most, most)
}
