//! House files: [`HouseFile`], as serde reads them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A house: one storey, in metres and degrees; x and y along the floor, z up, the floor at z = 0.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "scenefold house")]
pub struct HouseFile {
    /// Where the schema of this file is; for editors.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// What the house is called.
    pub name: String,
    /// Floor to ceiling, metres; 2.5 if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wall_height: Option<f64>,
    /// Thickness of the walls, metres; 0.1 if left out. They stand half in each of the rooms they
    /// part.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wall_thickness: Option<f64>,
    /// How the walls look.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wall: Option<Look>,
    /// How the floor looks where a room does not say.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub floor: Option<Look>,
    /// The rooms; the first is R1 of the graph.
    pub rooms: Vec<RoomFile>,
    /// The doors between them.
    #[serde(default)]
    pub doors: Vec<DoorFile>,
    /// The things in them; the first is O1 of the graph.
    #[serde(default)]
    pub objects: Vec<ObjectFile>,
}

/// A room: give either `box` or `outline`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RoomFile {
    /// What it is, such as "kitchen".
    pub label: String,
    /// What doors and objects call it; its label if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Lowest x, lowest y, highest x, highest y.
    #[serde(rename = "box", default, skip_serializing_if = "Option::is_none")]
    pub box_: Option<[f64; 4]>,
    /// Corners in order around it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub outline: Option<Vec<[f64; 2]>>,
    /// How its floor looks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub floor: Option<Look>,
}

/// A door: an opening in the wall that two rooms share. It gives access to both.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DoorFile {
    /// The two rooms.
    pub between: [String; 2],
    /// Its middle, on the line of the shared wall.
    pub at: [f64; 2],
    /// Width, metres; 0.9 if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width: Option<f64>,
    /// Height, metres; 2.05 if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<f64>,
}

/// A thing.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ObjectFile {
    /// What scenarios call it, unlike any other; its label (and a number) if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Its class, such as "tv remote".
    pub label: String,
    /// The room it is in; found by its place if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub room: Option<String>,
    /// Middle of its box: [x, y], and z if it hangs; without z it stands on its support or the
    /// floor.
    #[schemars(length(min = 2, max = 3))]
    pub position: Vec<f64>,
    /// Turn about z, degrees counter-clockwise. Unturned things face −y: the back of a sofa is at
    /// +y.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub yaw: Option<f64>,
    /// Orientation as a quaternion, instead of `yaw`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub orientation: Option<QuaternionFile>,
    /// Width, depth (front to back) and height of its box; as usual for its class if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub size: Option<[f64; 3]>,
    /// Its shape: a class, "box", or the path of an OBJ file; as its label if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub mesh: Option<String>,
    /// Its main colour, such as "#cc3322".
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colour: Option<String>,
    /// What is drawn over its main colour.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub texture: Option<TextureFile>,
    /// Whether people carry it about; if left out, whether its decay class lets it move.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub movable: Option<bool>,
    /// Name of the thing it stands on or lies in.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub support: Option<String>,
    /// Which surface of the support, such as "seat" or "shelf 2"; the first that fits if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub surface: Option<String>,
    /// How soon it is moved: a decay class such as "food"; as usual for its label if left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub decay: Option<String>,
    /// Hours after which it is as likely as not that it was moved, instead of `decay`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub half_life_h: Option<f64>,
}

/// A rotation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct QuaternionFile {
    /// Scalar part.
    pub w: f64,
    /// Vector part.
    pub x: f64,
    /// Vector part.
    pub y: f64,
    /// Vector part.
    pub z: f64,
}

/// How a surface looks.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Look {
    /// Such as "#cc3322".
    pub colour: String,
    /// What is drawn over it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub texture: Option<TextureFile>,
}

/// A texture.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
pub enum TextureFile {
    /// Bands.
    Stripes {
        /// Axis along which they follow each other.
        axis: AxisName,
        /// Metres from band to band.
        period: f64,
        /// Colour of every second band.
        second: String,
    },
    /// Cubes.
    Checker {
        /// Side of a cube, metres.
        side: f64,
        /// Colour of every second cube.
        second: String,
    },
    /// Lightness noise, as of wood.
    Grain {
        /// Metres of a speck across.
        scale: f64,
        /// 0 none, 1 from black to white.
        strength: f64,
    },
}

/// An axis of the frame of a thing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AxisName {
    /// To its right.
    X,
    /// To its back.
    Y,
    /// Up.
    Z,
}
