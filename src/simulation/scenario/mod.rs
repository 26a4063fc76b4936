//! What happens in a house: [`Scenario`].

pub mod check;
mod generate;
mod mission;

pub use check::ScenarioError;
pub use generate::{Draw, generate};
pub use mission::paper_mission;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::robot::motion::BodyConfig;
use super::sensor::NoiseConfig;
use crate::time::{Span, Stamp};

/// A story to simulate. Times are counted from the start, as `90s`, `2m30s` or `2d`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scenario {
    /// What it is called.
    pub name: String,
    /// A built-in house, or the path of a house file.
    pub house: String,
    /// Seed of everything random: places that are not given, noise.
    #[serde(default)]
    pub seed: u64,
    /// When it begins.
    #[serde(default = "default_start", with = "text")]
    #[schemars(with = "String")]
    pub start: Stamp,
    /// The robot and its camera.
    #[serde(default)]
    pub robot: RobotConfig,
    /// What people do.
    #[serde(default)]
    pub actions: Vec<VirtualAction>,
    /// What people say.
    #[serde(default)]
    pub utterances: Vec<Said>,
    /// What the robot is told to do.
    #[serde(default)]
    pub tasks: Vec<Errand>,
    /// When the robot sleeps.
    #[serde(default)]
    pub gaps: Vec<Gap>,
    /// Noise of the sensors.
    #[serde(default)]
    pub noise: NoiseConfig,
}

/// The robot, its camera and its rounds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct RobotConfig {
    /// Label of the room it starts in; the first room if not given.
    pub room: Option<String>,
    /// Body and speeds.
    pub body: BodyConfig,
    /// Labels of the rooms it goes round, in this order; all, by the shortest way, if empty.
    pub round: Vec<String>,
    /// How many rounds it makes once everything has happened.
    pub rounds: u32,
    /// The camera.
    pub camera: CameraConfig,
}

/// The camera on the robot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CameraConfig {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Horizontal field of view, degrees.
    pub fov_deg: f64,
    /// Pictures per second.
    pub rate_hz: f64,
    /// Quality of colour as JPEG, 1 to 100; 0 is PNG, without loss.
    pub jpeg_quality: u8,
}

/// What somebody did.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "action", rename_all = "snake_case", deny_unknown_fields)]
pub enum VirtualAction {
    /// A thing was taken away.
    Removed {
        /// When.
        #[serde(with = "text")]
        #[schemars(with = "String")]
        time: Span,
        /// Name of the thing in the house file, or its label if no other has it.
        object: String,
    },
    /// A thing was put elsewhere.
    Moved {
        /// When.
        #[serde(with = "text")]
        #[schemars(with = "String")]
        time: Span,
        /// Name or label of the thing.
        object: String,
        /// Where it is now.
        to: Place,
    },
    /// Something new was put somewhere.
    Added {
        /// When.
        #[serde(with = "text")]
        #[schemars(with = "String")]
        time: Span,
        /// What.
        object: NewThing,
        /// Where.
        to: Place,
    },
}

impl VirtualAction {
    /// When it happens.
    pub fn time(&self) -> Span {
        match self {
            Self::Removed { time, .. } | Self::Moved { time, .. } | Self::Added { time, .. } => {
                *time
            }
        }
    }
}

/// Something that was not in the house before.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NewThing {
    /// Its name, unlike that of anything in the house; its label if not given.
    pub name: Option<String>,
    /// Its class.
    pub label: String,
    /// Its box, metres; that of its class if not given.
    pub size: Option<[f64; 3]>,
}

/// Where a thing is put. What is not given is chosen by the seed, where it fits.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Place {
    /// Name or label of what it is put on.
    pub on: Option<String>,
    /// Which surface of that: `top`, `seat`, `arm`, …
    pub surface: Option<String>,
    /// Label of the room whose floor it is put on, where there is no support.
    pub room: Option<String>,
    /// Point of its centre in the world (x, y), metres.
    pub at: Option<[f64; 2]>,
    /// Turn about z, degrees.
    pub yaw_deg: Option<f64>,
}

/// What somebody said.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Said {
    /// When.
    #[serde(with = "text")]
    #[schemars(with = "String")]
    pub time: Span,
    /// Who.
    #[serde(default)]
    pub speaker: String,
    /// The words.
    pub text: String,
}

/// What the robot is told to do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Errand {
    /// When.
    #[serde(with = "text")]
    #[schemars(with = "String")]
    pub time: Span,
    /// The words.
    pub instruction: String,
    /// Name or label of what it picks.
    pub pick: String,
    /// Where it places that.
    pub place: Place,
    /// Whether the planner names the nodes in `/robot/task`; else only the words are there.
    #[serde(default)]
    pub planned: bool,
}

/// A time in which the robot sleeps; `/clock` tells.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Gap {
    /// When it falls asleep; everything later in the scenario is that much later.
    #[serde(with = "text")]
    #[schemars(with = "String")]
    pub time: Span,
    /// For how long.
    #[serde(with = "text")]
    #[schemars(with = "String")]
    pub length: Span,
}

impl Default for RobotConfig {
    fn default() -> Self {
        Self {
            room: None,
            body: BodyConfig::default(),
            round: Vec::new(),
            rounds: 1,
            camera: CameraConfig::default(),
        }
    }
}

impl Default for CameraConfig {
    fn default() -> Self {
        Self { width: 320, height: 240, fov_deg: 70.0, rate_hz: 2.0, jpeg_quality: 75 }
    }
}

fn default_start() -> Stamp {
    Stamp::from_nanos(1_767_600_000_000_000_000)
}

/// Instants and spans as people write them.
mod text {
    use std::fmt::Display;
    use std::str::FromStr;

    use serde::{Deserialize, Deserializer, Serializer};

    pub fn serialize<T: Display, S: Serializer>(value: &T, to: S) -> Result<S::Ok, S::Error> {
        to.collect_str(value)
    }

    pub fn deserialize<'de, T, D>(from: D) -> Result<T, D::Error>
    where
        T: FromStr<Err: Display>,
        D: Deserializer<'de>,
    {
        String::deserialize(from)?.parse().map_err(serde::de::Error::custom)
    }
}

impl Place {
    /// Whether nothing is left to chance.
    pub fn is_exact(&self) -> bool {
        self.at.is_some() && self.yaw_deg.is_some()
    }
}

impl Scenario {
    /// Reads a scenario file; says where and why not.
    pub fn from_json(text: &str) -> Result<Self, serde_json::Error> {
        serde_json::from_str(text)
    }

    /// The JSON Schema of scenario files.
    pub fn schema() -> String {
        let schema = schemars::schema_for!(Scenario);
        serde_json::to_string_pretty(&schema).expect("a schema always has a JSON form") + "\n"
    }

    /// The scenario as a file, every value written out.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("numbers and texts always have a JSON form")
    }

    /// Nanoseconds of the robot's sleep before what the scenario has at `time`.
    pub fn slept_before(&self, time: Span) -> u64 {
        self.gaps.iter().filter(|gap| gap.time.0 <= time.0).map(|gap| gap.length.0).sum()
    }

    /// When what the scenario has at `time` happens.
    pub fn at(&self, time: Span) -> Stamp {
        self.start.plus_nanos(time.0.saturating_add(self.slept_before(time)))
    }
}
