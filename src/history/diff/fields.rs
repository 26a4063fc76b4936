//! The fields of nodes that do not tell where an object is.

use std::fmt;

use crate::geometry::{Pose, Size, Tolerance};
use crate::graph::{Label, NodeId, Object, Region};
use crate::time::Stamp;

/// The value of a field.
#[derive(Clone, Debug, PartialEq)]
pub enum FieldValue {
    /// It has none.
    Nothing,
    /// A label.
    Label(Label),
    /// A number, in the unit of its field.
    Number(f64),
    /// An instant.
    Stamp(Stamp),
    /// A box.
    Size(Size),
    /// A pose.
    Pose(Pose),
    /// A node.
    Id(NodeId),
    /// Nodes.
    Ids(Vec<NodeId>),
}

/// A field with its values before and after.
pub(super) type Found = (&'static str, FieldValue, FieldValue);

/// The fields in which two objects differ, other than where they are.
pub(super) fn of_objects(before: &Object, after: &Object, tolerance: &Tolerance) -> Vec<Found> {
    let mut found = Vec::new();
    push_label(&mut found, &before.label, &after.label);
    if !tolerance.sizes(before.size, after.size) {
        found.push(("size", FieldValue::Size(before.size), FieldValue::Size(after.size)));
    }
    if before.decay_rate.to_bits() != after.decay_rate.to_bits() {
        let values = (before.decay_rate, after.decay_rate);
        found.push(("decay_rate", FieldValue::Number(values.0), FieldValue::Number(values.1)));
    }
    if before.last_observed != after.last_observed {
        let values = (before.last_observed, after.last_observed);
        found.push(("last_observed", FieldValue::Stamp(values.0), FieldValue::Stamp(values.1)));
    }
    found
}

/// The fields in which two regions differ, other than access.
pub(super) fn of_regions(before: &Region, after: &Region, tolerance: &Tolerance) -> Vec<Found> {
    let mut found = Vec::new();
    push_label(&mut found, &before.label, &after.label);
    let pose = |region: &Region| region.extent.map(|(pose, _)| pose);
    let size = |region: &Region| region.extent.map(|(_, size)| size);
    let same = match (pose(before), pose(after)) {
        (Some(a), Some(b)) => tolerance.poses(&a, &b),
        (a, b) => a == b,
    };
    if !same {
        found.push(("pose", optional(pose(before)), optional(pose(after))));
    }
    let same = match (size(before), size(after)) {
        (Some(a), Some(b)) => tolerance.sizes(a, b),
        (a, b) => a == b,
    };
    if !same {
        found.push(("size", optional(size(before)), optional(size(after))));
    }
    if before.parent != after.parent {
        found.push(("parent", optional(before.parent), optional(after.parent)));
    }
    found
}

fn push_label(found: &mut Vec<Found>, before: &Label, after: &Label) {
    if before != after {
        let values = (before.clone(), after.clone());
        found.push(("label", FieldValue::Label(values.0), FieldValue::Label(values.1)));
    }
}

fn optional<T: Into<FieldValue>>(value: Option<T>) -> FieldValue {
    value.map_or(FieldValue::Nothing, Into::into)
}

impl From<Pose> for FieldValue {
    fn from(pose: Pose) -> Self {
        Self::Pose(pose)
    }
}

impl From<Size> for FieldValue {
    fn from(size: Size) -> Self {
        Self::Size(size)
    }
}

impl From<NodeId> for FieldValue {
    fn from(id: NodeId) -> Self {
        Self::Id(id)
    }
}

/// For people: `nothing`, `0.5`, `(1, 2, 3)`, `R1, R2`.
impl fmt::Display for FieldValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let triple = |f: &mut fmt::Formatter<'_>, [x, y, z]: [f64; 3]| write!(f, "({x}, {y}, {z})");
        match self {
            Self::Nothing => f.write_str("nothing"),
            Self::Label(label) => write!(f, "{label}"),
            Self::Number(number) => write!(f, "{number}"),
            Self::Stamp(stamp) => write!(f, "{stamp}"),
            Self::Size(size) => triple(f, size.metres()),
            Self::Pose(pose) => triple(f, pose.position()),
            Self::Id(id) => write!(f, "{id}"),
            Self::Ids(ids) if ids.is_empty() => f.write_str("nothing"),
            Self::Ids(ids) => {
                let words: Vec<String> = ids.iter().map(NodeId::to_string).collect();
                f.write_str(&words.join(", "))
            }
        }
    }
}
