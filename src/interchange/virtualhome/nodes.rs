//! The nodes of a `VirtualHome` graph.

use std::collections::BTreeMap;

use super::VirtualHomeError;
use super::frame;
use crate::geometry::{Pose, Size};
use crate::graph::{Label, NodeId};
use crate::interchange::json::{At, JsonError};

/// What a category means to us.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Category {
    Room,
    Character,
    /// Floors, ceilings, walls, with the words that count those skipped.
    Structure(&'static str),
    Door,
    Thing,
}

impl Category {
    fn named(name: &str) -> Self {
        match name {
            "Rooms" => Self::Room,
            "Characters" => Self::Character,
            "Floor" | "Floors" => Self::Structure("floors skipped"),
            "Ceiling" => Self::Structure("ceilings skipped"),
            "Walls" => Self::Structure("walls skipped"),
            "Doors" => Self::Door,
            _ => Self::Thing,
        }
    }
}

/// A node, in our frame.
#[derive(Debug)]
pub(super) struct VhNode {
    pub category: Category,
    pub class: Label,
    pub extent: Option<(Pose, Size)>,
    pub movable: bool,
    /// Whether the box was made thicker than Unity has it.
    pub thickened: bool,
}

pub(super) fn read(root: &At<'_>) -> Result<BTreeMap<u64, VhNode>, VirtualHomeError> {
    let mut nodes = BTreeMap::new();
    for at in root.field("nodes")?.items()? {
        let number = read_number(&at)?;
        if nodes.insert(number, read_node(&at)?).is_some() {
            let problem = format!("{number} is the id of another node too: ids are unique");
            return Err(at.field("id")?.error(problem).into());
        }
    }
    Ok(nodes)
}

fn read_number(at: &At<'_>) -> Result<u64, JsonError> {
    let id = at.field("id")?;
    let number = id.u64()?;
    if number > u64::from(NodeId::MAX_INDEX) {
        return Err(id.error(format!("{number} must be at most {}", NodeId::MAX_INDEX)));
    }
    Ok(number)
}

fn read_node(at: &At<'_>) -> Result<VhNode, JsonError> {
    let class = at.field("class_name")?;
    let category = match at.optional("category")? {
        Some(category) => Category::named(category.text()?),
        None => Category::Thing,
    };
    let extent = at.optional("bounding_box")?.map(|at| read_box(&at)).transpose()?;
    let properties = at.list("properties")?;
    let movable = properties
        .iter()
        .any(|property| matches!(property.value.as_str(), Some("GRABBABLE" | "MOVABLE")));
    Ok(VhNode {
        category,
        class: Label::new(class.text()?).map_err(|error| class.error(error))?,
        extent: extent.map(|(extent, _)| extent),
        movable,
        thickened: extent.is_some_and(|(_, thin)| thin),
    })
}

fn read_box(at: &At<'_>) -> Result<((Pose, Size), bool), JsonError> {
    let (centre, size) = (at.field("center")?.triple()?, at.field("size")?.triple()?);
    frame::extent(centre, size).map_err(|error| at.error(error))
}
