//! From the JSON text to a [`SceneDocument`]: each value is what it must be, alone.

use super::{BuildingEntry, FloorEntry, ObjectEntry, RoomEntry, SceneDocument, SceneError};
use crate::geometry::{Pose, Size};
use crate::graph::{Label, Layer, NodeId, PoseSource};
use crate::interchange::JsonError;
use crate::interchange::json::{self, At};

impl SceneDocument {
    /// Reads the JSON text of a scene.
    pub fn parse(text: &str) -> Result<Self, SceneError> {
        let value = json::parse(text)?;
        let root = At::root(&value);
        root.only(&["at", "hash", "rooms", "objects", "held", "floors", "buildings"])?;
        let object = |held: bool| move |at: &At<'_>| object(at, held);
        Ok(Self {
            at: root.optional("at")?.map(|at| at.parsed()).transpose()?,
            hash: text_of(&root, "hash")?,
            rooms: each(&root, "rooms", room)?,
            objects: each(&root, "objects", object(false))?,
            held: each(&root, "held", object(true))?,
            floors: each(&root, "floors", floor)?,
            buildings: each(&root, "buildings", building)?,
        })
    }
}

fn each<T>(
    root: &At<'_>,
    name: &str,
    read: impl Fn(&At<'_>) -> Result<T, JsonError>,
) -> Result<Vec<T>, JsonError> {
    root.list(name)?.iter().map(read).collect()
}

fn text_of(at: &At<'_>, name: &str) -> Result<Option<String>, JsonError> {
    at.optional(name)?.map(|text| text.text().map(str::to_owned)).transpose()
}

fn id_of(at: &At<'_>, layer: Layer) -> Result<Option<NodeId>, JsonError> {
    let Some(at) = at.optional("id")? else { return Ok(None) };
    let id: NodeId = at.parsed()?;
    if id.layer() == layer {
        Ok(Some(id))
    } else {
        let letter = char::from(layer.letter());
        Err(at.error(format!("{id} is no {layer} id: it must begin with {letter}")))
    }
}

fn label_of(at: &At<'_>) -> Result<Label, JsonError> {
    let at = at.field("label")?;
    Label::new(at.text()?).map_err(|error| at.error(error))
}

fn pose_of(at: &At<'_>) -> Result<Option<Pose>, JsonError> {
    let Some(at) = at.optional("pose")? else { return Ok(None) };
    at.only(&["position", "orientation"])?;
    let position = at.field("position")?.triple()?;
    let orientation = match at.optional("orientation")? {
        Some(orientation) => {
            orientation.only(&["w", "x", "y", "z"])?;
            orientation.quaternion()?
        }
        None => [1.0, 0.0, 0.0, 0.0],
    };
    Pose::new(position, orientation).map(Some).map_err(|error| at.error(error))
}

fn size_of(at: &At<'_>) -> Result<Option<Size>, JsonError> {
    at.optional("size")?.map(|size| size.size()).transpose()
}

/// A region has both, or neither.
fn extent_of(at: &At<'_>) -> Result<(Option<Pose>, Option<Size>), JsonError> {
    let extent = (pose_of(at)?, size_of(at)?);
    match extent {
        (Some(_), None) => Err(at.error("it has a pose but no size: give both, or neither")),
        (None, Some(_)) => Err(at.error("it has a size but no pose: give both, or neither")),
        _ => Ok(extent),
    }
}

fn object(at: &At<'_>, held: bool) -> Result<ObjectEntry, JsonError> {
    at.only(&[
        "id",
        "label",
        "room",
        "support",
        "pose",
        "size",
        "decay_rate",
        "last_observed",
        "pose_source",
        "probability",
    ])?;
    let decay_rate = at.optional("decay_rate")?;
    let rate = decay_rate.as_ref().map(At::f64).transpose()?;
    if let Some((at, rate)) = decay_rate.zip(rate)
        && rate < 0.0
    {
        return Err(at.error(format!("a decay rate of {rate} must be 0 or more, in 1/s")));
    }
    Ok(ObjectEntry {
        id: id_of(at, Layer::Object)?,
        label: label_of(at)?,
        room: text_of(at, "room")?,
        support: text_of(at, "support")?,
        pose: pose_of(at)?,
        size: size_of(at)?,
        decay_rate: rate,
        last_observed: at.optional("last_observed")?.map(|at| at.parsed()).transpose()?,
        pose_source: source_of(at, held)?,
        probability: at.optional("probability")?.map(|at| at.f64()).transpose()?,
    })
}

fn source_of(at: &At<'_>, held: bool) -> Result<Option<PoseSource>, JsonError> {
    let Some(at) = at.optional("pose_source")? else {
        return Ok(held.then_some(PoseSource::Held));
    };
    match (at.text()?, held) {
        ("measured", false) => Ok(Some(PoseSource::Measured)),
        ("topological", false) => Ok(Some(PoseSource::Topological)),
        ("held", true) => Ok(Some(PoseSource::Held)),
        ("held", false) => Err(at.error("what is held stands in \"held\", not in \"objects\"")),
        (other, true) => Err(at.error(format!("{other:?} must be \"held\" here"))),
        (other, false) => {
            Err(at.error(format!("{other:?} must be \"measured\" or \"topological\"")))
        }
    }
}

fn room(at: &At<'_>) -> Result<RoomEntry, JsonError> {
    at.only(&["id", "label", "pose", "size", "floor", "building", "access_to"])?;
    let (pose, size) = extent_of(at)?;
    let access = at.list("access_to")?;
    let (floor, building) = (text_of(at, "floor")?, text_of(at, "building")?);
    if floor.is_some() && building.is_some() {
        return Err(at.error("it has a floor and a building: the floor says which building"));
    }
    Ok(RoomEntry {
        id: id_of(at, Layer::Room)?,
        label: label_of(at)?,
        pose,
        size,
        floor,
        building,
        access_to: access
            .iter()
            .map(|at| at.text().map(str::to_owned))
            .collect::<Result<_, _>>()?,
    })
}

fn floor(at: &At<'_>) -> Result<FloorEntry, JsonError> {
    at.only(&["id", "label", "pose", "size", "building"])?;
    let (pose, size) = extent_of(at)?;
    let building = text_of(at, "building")?;
    Ok(FloorEntry { id: id_of(at, Layer::Floor)?, label: label_of(at)?, pose, size, building })
}

fn building(at: &At<'_>) -> Result<BuildingEntry, JsonError> {
    at.only(&["id", "label", "pose", "size"])?;
    let (pose, size) = extent_of(at)?;
    Ok(BuildingEntry { id: id_of(at, Layer::Building)?, label: label_of(at)?, pose, size })
}
