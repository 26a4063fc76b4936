//! [`DiffDocument`]: a diff in JSON.

use serde::Serialize;

use super::{Changed, Diff, FieldValue, Moved, Presence};
use crate::change::NodeRef;
use crate::document::PoseDocument;
use crate::graph::NodeId;
use crate::history::PlaceDocument;

/// What differs between two graphs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct DiffDocument {
    /// Nodes that only the second graph has.
    pub added: Vec<PresenceDocument>,
    /// Nodes that only the first graph has.
    pub removed: Vec<PresenceDocument>,
    /// Objects that are elsewhere.
    pub moved: Vec<MovedDocument>,
    /// All other fields that differ.
    pub changed: Vec<ChangedDocument>,
}

/// A node that only one of two graphs has.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PresenceDocument {
    /// Its id.
    pub id: String,
    /// Its label.
    pub label: String,
    /// Where it is, if it is an object.
    pub place: Option<PlaceDocument>,
}

/// An object that is elsewhere.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MovedDocument {
    /// Its id.
    pub id: String,
    /// Its label.
    pub label: String,
    /// Which of `room`, `support`, `pose` and `pose_source` differ.
    pub fields: Vec<&'static str>,
    /// How far apart the poses are, in metres.
    pub distance: f64,
    /// How far apart the orientations are, in radians.
    pub angle: f64,
    /// Where it was.
    pub from: PlaceDocument,
    /// Where it is.
    pub to: PlaceDocument,
}

/// A field that differs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChangedDocument {
    /// Id of the node.
    pub id: String,
    /// Label of the node.
    pub label: String,
    /// The field.
    pub field: &'static str,
    /// What it was.
    pub from: ValueDocument,
    /// What it is.
    pub to: ValueDocument,
}

/// The value of a field: null, a text, a number, a box, a pose or ids.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum ValueDocument {
    /// There is none.
    Nothing,
    /// A label, an instant or an id.
    Text(String),
    /// A number, in the unit of its field.
    Number(f64),
    /// A box (w, h, d) in metres.
    Size([f64; 3]),
    /// A pose.
    Pose(PoseDocument),
    /// Ids.
    Ids(Vec<String>),
}

impl DiffDocument {
    /// The document of a diff.
    pub fn of(diff: &Diff) -> Self {
        Self {
            added: diff.added.iter().map(presence).collect(),
            removed: diff.removed.iter().map(presence).collect(),
            moved: diff.moved.iter().map(moved).collect(),
            changed: diff.changed.iter().map(changed).collect(),
        }
    }
}

fn id(node: &NodeRef) -> String {
    node.id.map_or_else(String::new, |id| id.to_string())
}

fn label(node: &NodeRef) -> String {
    node.label.as_ref().map_or_else(String::new, ToString::to_string)
}

fn presence(it: &Presence) -> PresenceDocument {
    let place = it.place.as_ref().map(PlaceDocument::of);
    PresenceDocument { id: id(&it.node), label: label(&it.node), place }
}

fn moved(it: &Moved) -> MovedDocument {
    // Equal orientations can be a rounding error apart.
    let same = it.from.pose == it.to.pose;
    let (distance, angle) = if same { (0.0, 0.0) } else { it.from.pose.distance(&it.to.pose) };
    MovedDocument {
        id: id(&it.node),
        label: label(&it.node),
        fields: it.fields.clone(),
        distance,
        angle,
        from: PlaceDocument::of(&it.from),
        to: PlaceDocument::of(&it.to),
    }
}

fn changed(it: &Changed) -> ChangedDocument {
    ChangedDocument {
        id: id(&it.node),
        label: label(&it.node),
        field: it.field,
        from: value(&it.from),
        to: value(&it.to),
    }
}

fn value(value: &FieldValue) -> ValueDocument {
    match value {
        FieldValue::Nothing => ValueDocument::Nothing,
        FieldValue::Label(label) => ValueDocument::Text(label.to_string()),
        FieldValue::Number(number) => ValueDocument::Number(*number),
        FieldValue::Stamp(stamp) => ValueDocument::Text(stamp.to_string()),
        FieldValue::Size(size) => ValueDocument::Size(size.metres()),
        FieldValue::Pose(pose) => ValueDocument::Pose(PoseDocument::of(pose)),
        FieldValue::Id(id) => ValueDocument::Text(id.to_string()),
        FieldValue::Ids(ids) => ValueDocument::Ids(ids.iter().map(NodeId::to_string).collect()),
    }
}
