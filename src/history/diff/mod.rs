//! What differs between two graphs, per node and field; and how to get from one to the other.

mod document;
mod fields;
mod path;
mod primitives;
mod route;
mod text;

pub use document::{ChangedDocument, DiffDocument, MovedDocument, PresenceDocument, ValueDocument};
pub use fields::FieldValue;
pub use primitives::primitives_between;

use crate::change::NodeRef;
use crate::geometry::Tolerance;
use crate::graph::{Layer, NodeId, Object, Placement, SceneGraph};

use super::place::{Place, named};

/// What differs between two graphs. Every list is in order of id.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Diff {
    /// Nodes that only the second graph has.
    pub added: Vec<Presence>,
    /// Nodes that only the first graph has.
    pub removed: Vec<Presence>,
    /// Objects that are elsewhere.
    pub moved: Vec<Moved>,
    /// All other fields that differ.
    pub changed: Vec<Changed>,
}

/// A node that only one of two graphs has.
#[derive(Clone, Debug, PartialEq)]
pub struct Presence {
    /// The node.
    pub node: NodeRef,
    /// Where it is, if it is an object.
    pub place: Option<Place>,
}

/// An object that is elsewhere: its room, support or pose differs, or how the pose is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Moved {
    /// The object.
    pub node: NodeRef,
    /// Which of `room`, `support`, `pose` and `pose_source` differ.
    pub fields: Vec<&'static str>,
    /// Where it was.
    pub from: Place,
    /// Where it is.
    pub to: Place,
}

/// A field that differs and does not tell where a node is.
#[derive(Clone, Debug, PartialEq)]
pub struct Changed {
    /// The node.
    pub node: NodeRef,
    /// The field, as JSON names it.
    pub field: &'static str,
    /// What it was.
    pub from: FieldValue,
    /// What it is.
    pub to: FieldValue,
}

/// Whether to report objects that differ in when they were last observed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum LastObserved {
    Ignored,
    Reported,
}

impl Diff {
    /// What differs, beyond `tolerance` where poses and boxes are concerned. When a node was last
    /// observed is left out: it changes with every glance.
    pub fn between(from: &SceneGraph, to: &SceneGraph, tolerance: &Tolerance) -> Self {
        Self::compare(from, to, tolerance, LastObserved::Ignored)
    }

    /// As [`Diff::between`], with `last_observed` among the changed fields. With
    /// [`Tolerance::EXACT`] it is empty if and only if the graphs are equal.
    pub fn complete(from: &SceneGraph, to: &SceneGraph, tolerance: &Tolerance) -> Self {
        Self::compare(from, to, tolerance, LastObserved::Reported)
    }

    /// Whether nothing differs.
    pub fn is_empty(&self) -> bool {
        self.added.is_empty()
            && self.removed.is_empty()
            && self.moved.is_empty()
            && self.changed.is_empty()
    }

    fn compare(
        from: &SceneGraph,
        to: &SceneGraph,
        tolerance: &Tolerance,
        last_observed: LastObserved,
    ) -> Self {
        let (removed, added) = (only_in(from, to), only_in(to, from));
        let mut diff = Self { added, removed, ..Self::default() };
        // The layers in the order of the letters of their ids.
        for layer in [Layer::Building, Layer::Floor] {
            diff.compare_regions(layer, from, to, tolerance);
        }
        diff.compare_objects(from, to, tolerance, last_observed);
        diff.compare_regions(Layer::Room, from, to, tolerance);
        diff
    }

    fn compare_objects(
        &mut self,
        from: &SceneGraph,
        to: &SceneGraph,
        tolerance: &Tolerance,
        last_observed: LastObserved,
    ) {
        for (id, before) in from.all_objects() {
            let Some(after) = to.object(id) else { continue };
            let fields = moved_fields(before, after, tolerance);
            if !fields.is_empty() {
                let (from, to) = (Place::of(from, before), Place::of(to, after));
                self.moved.push(Moved { node: object_ref(id, after), fields, from, to });
            }
            let found = fields::of_objects(before, after, tolerance);
            let reported = found.into_iter().filter(|(field, ..)| {
                *field != "last_observed" || last_observed == LastObserved::Reported
            });
            self.push_changed(&object_ref(id, after), reported);
        }
    }

    fn compare_regions(
        &mut self,
        layer: Layer,
        from: &SceneGraph,
        to: &SceneGraph,
        tolerance: &Tolerance,
    ) {
        for (id, before) in from.regions(layer) {
            let Some(after) = to.region(id) else { continue };
            let found = fields::of_regions(before, after, tolerance);
            self.push_changed(&named(to, id), found.into_iter());
            let access = |graph: &SceneGraph| FieldValue::Ids(graph.access_from(id).collect());
            let (from, to_access) = (access(from), access(to));
            if from != to_access {
                let found = ("access_to", from, to_access);
                self.push_changed(&named(to, id), std::iter::once(found));
            }
        }
    }

    fn push_changed(
        &mut self,
        node: &NodeRef,
        found: impl Iterator<Item = (&'static str, FieldValue, FieldValue)>,
    ) {
        let changed = |(field, from, to)| Changed { node: node.clone(), field, from, to };
        self.changed.extend(found.map(changed));
    }
}

fn object_ref(id: NodeId, object: &Object) -> NodeRef {
    NodeRef { id: Some(id), label: Some(object.label.clone()) }
}

/// Nodes of `graph` that `other` has not, in order of id.
fn only_in(graph: &SceneGraph, other: &SceneGraph) -> Vec<Presence> {
    let regions = |layer| graph.regions(layer).map(|(id, _)| id);
    let above = regions(Layer::Building).chain(regions(Layer::Floor));
    let objects = graph.all_objects().map(|(id, _)| id);
    let ids = above.chain(objects).chain(regions(Layer::Room));
    let presence = |id: NodeId| Presence {
        node: named(graph, id),
        place: graph.object(id).map(|object| Place::of(graph, object)),
    };
    ids.filter(|id| !other.contains(*id)).map(presence).collect()
}

fn moved_fields(before: &Object, after: &Object, tolerance: &Tolerance) -> Vec<&'static str> {
    let (from, to) = (Placement::of(before), Placement::of(after));
    let differ = [
        ("room", from.room != to.room),
        ("support", from.support != to.support),
        ("pose", !tolerance.poses(&from.pose, &to.pose)),
        ("pose_source", from.pose_source != to.pose_source),
    ];
    differ.into_iter().filter(|(_, differs)| *differs).map(|(field, _)| field).collect()
}
