//! What several messages share: poses, sizes, nodes, references, times.
//!
//! Each part has a function that makes the generated struct and one that reads and checks it.

use super::fields::{Field, Fields, required};
use super::put::Put;
use super::{WireError, proto};
use crate::change::{EvidenceRef, NodeRef};
use crate::event::Topic;
use crate::geometry::{Pose, Size};
use crate::graph::{Label, Layer, NodeId, Object, PoseSource, Region};
use crate::time::Stamp;

const INDEX_BITS: u32 = 24;
const IDENTITY: [i32; 4] = Pose::IDENTITY.orientation_e7();

/// A node in a field that may hold any layer: the index plus 2^24 times the layer.
pub(super) fn node(id: NodeId) -> u32 {
    index(id, Layer::Object)
}

/// A node in a field that implies `layer`: the index. A node of another layer, which no valid
/// log has there, becomes a number that readers refuse.
pub(super) fn index(id: NodeId, layer: Layer) -> u32 {
    let layers_off = (id.layer() as u32).wrapping_sub(layer as u32) % 4;
    (layers_off << INDEX_BITS) | id.index()
}

/// The first node of a layer: what a field holds that is absent.
pub(super) fn first(layer: Layer) -> NodeId {
    NodeId::new(layer, 0).expect("every layer has an index 0")
}

/// Reads what [`node`] makes.
pub(super) fn read_node(field: &Field<'_>, name: &'static str) -> Result<NodeId, WireError> {
    node_of(field, name, field.u64()?)
}

/// Reads what [`node`] made of one of the numbers in `field`.
pub(super) fn node_of(
    field: &Field<'_>,
    name: &'static str,
    value: u64,
) -> Result<NodeId, WireError> {
    let layer = usize::try_from(value >> INDEX_BITS).ok().and_then(|n| Layer::ALL.get(n));
    let index = value as u32 & NodeId::MAX_INDEX;
    layer
        .and_then(|layer| NodeId::new(*layer, index))
        .ok_or_else(|| field.refuse(name, value, "an index plus 2^24 times a layer from 0 to 3"))
}

/// Reads what [`index`] makes.
#[inline]
pub(super) fn read_index(
    field: &Field<'_>,
    name: &'static str,
    layer: Layer,
) -> Result<NodeId, WireError> {
    index_of(field, name, layer, field.u64()?)
}

/// Reads what [`index`] made of one of the numbers in `field`.
#[inline]
pub(super) fn index_of(
    field: &Field<'_>,
    name: &'static str,
    layer: Layer,
    value: u64,
) -> Result<NodeId, WireError> {
    u32::try_from(value)
        .ok()
        .and_then(|index| NodeId::new(layer, index))
        .ok_or_else(|| field.refuse(name, value, "an index up to 16777215"))
}

pub(super) fn pose(pose: &Pose) -> proto::Pose {
    let [x_um, y_um, z_um] = pose.position_um();
    let turned = pose.orientation_e7() != IDENTITY;
    let [qw_e7, qx_e7, qy_e7, qz_e7] = if turned { pose.orientation_e7() } else { [0; 4] };
    proto::Pose { x_um, y_um, z_um, qw_e7, qx_e7, qy_e7, qz_e7 }
}

#[inline]
pub(super) fn read_pose(mut fields: Fields<'_>) -> Result<Pose, WireError> {
    let mut position = [0; 3];
    let mut orientation = [0; 4];
    while let Some(field) = fields.next()? {
        match field.number {
            1 => position[0] = field.sint64()?,
            2 => position[1] = field.sint64()?,
            3 => position[2] = field.sint64()?,
            4 => orientation[0] = field.sint32("qw_e7")?,
            5 => orientation[1] = field.sint32("qx_e7")?,
            6 => orientation[2] = field.sint32("qy_e7")?,
            7 => orientation[3] = field.sint32("qz_e7")?,
            _ => {}
        }
    }
    let orientation = if orientation == [0; 4] { IDENTITY } else { orientation };
    Pose::from_grid(position, orientation)
        .map_err(|error| WireError::Geometry { message: "Pose", error })
}

pub(super) fn size(size: Size) -> proto::Size {
    // Sides are positive.
    let [w_um, h_um, d_um] = size.micrometres().map(i64::unsigned_abs);
    proto::Size { w_um, h_um, d_um }
}

pub(super) fn read_size(mut fields: Fields<'_>) -> Result<Size, WireError> {
    let mut sides = [0_u64; 3];
    while let Some(field) = fields.next()? {
        if let n @ 1..=3 = field.number {
            sides[n as usize - 1] = field.u64()?;
        }
    }
    // A side beyond i64 is beyond every limit: the largest one is refused as well.
    let sides = sides.map(|side| i64::try_from(side).unwrap_or(i64::MAX));
    Size::from_micrometres(sides).map_err(|error| WireError::Geometry { message: "Size", error })
}

pub(super) fn pose_source(source: PoseSource) -> i32 {
    use proto::PoseSource as Wire;
    let wire = match source {
        PoseSource::Measured => Wire::Measured,
        PoseSource::Topological => Wire::Topological,
        PoseSource::Held => Wire::Held,
    };
    wire.into()
}

#[inline]
pub(super) fn read_pose_source(field: &Field<'_>) -> Result<PoseSource, WireError> {
    match field.u64()? {
        1 => Ok(PoseSource::Measured),
        2 => Ok(PoseSource::Topological),
        3 => Ok(PoseSource::Held),
        other => {
            Err(field.refuse("pose_source", other, "1 (measured), 2 (topological) or 3 (held)"))
        }
    }
}

pub(super) fn read_stamp(field: &Field<'_>, name: &'static str) -> Result<Stamp, WireError> {
    let nanos = field.fixed64()?;
    if nanos > Stamp::MAX.nanos() {
        return Err(field.refuse(name, nanos, "nanoseconds since 1970, up to 2262"));
    }
    Ok(Stamp::from_nanos(nanos))
}

/// Reads λ: finite and not negative; −0.0 becomes 0.0.
pub(super) fn read_decay_rate(field: &Field<'_>) -> Result<f64, WireError> {
    let value = field.double()?;
    if value.is_finite() && value >= 0.0 {
        Ok(value + 0.0)
    } else {
        Err(field.refuse("decay_rate_per_s", value, "a number of at least 0, in 1/s"))
    }
}

pub(super) fn read_label(field: &Field<'_>, message: &'static str) -> Result<Label, WireError> {
    Label::new(field.text("label")?).map_err(|error| WireError::Label { message, error })
}

/// `at` is the log time of the message that holds the object, if its own time is to be left out
/// where it is the same.
pub(super) fn object(object: &Object, at: Option<Stamp>) -> proto::Object {
    proto::Object {
        label: object.label.as_str().to_owned(),
        pose: Some(pose(&object.pose)),
        size: Some(size(object.size)),
        decay_rate_per_s: object.decay_rate,
        last_observed_nanos: other_time(object.last_observed, at),
        pose_source: pose_source(object.pose_source),
        room: index(object.room, Layer::Room),
        support: object.support.map(|id| index(id, Layer::Object)),
    }
}

/// `stamp` unless it is `at`.
pub(super) fn other_time(stamp: Stamp, at: Option<Stamp>) -> Option<u64> {
    (Some(stamp) != at).then_some(stamp.nanos())
}

/// `read_label` reads the label: that may be more than once the same.
pub(super) fn read_object(
    mut fields: Fields<'_>,
    at: Stamp,
    read_label: &mut dyn FnMut(&Field<'_>) -> Result<Label, WireError>,
) -> Result<Object, WireError> {
    const NAME: &str = "Object";
    let (mut label, mut pose, mut size, mut pose_source) = (None, None, None, None);
    let (mut decay_rate, mut last_observed) = (0.0, at);
    let (mut room, mut support) = (first(Layer::Room), None);
    while let Some(field) = fields.next()? {
        match field.number {
            1 => label = Some(read_label(&field)?),
            2 => field.once(&mut pose, read_pose(field.message("Pose")?)?)?,
            3 => field.once(&mut size, read_size(field.message("Size")?)?)?,
            4 => decay_rate = read_decay_rate(&field)?,
            5 => last_observed = read_stamp(&field, "last_observed_nanos")?,
            6 => pose_source = Some(read_pose_source(&field)?),
            7 => room = read_index(&field, "room", Layer::Room)?,
            8 => support = Some(read_index(&field, "support", Layer::Object)?),
            _ => {}
        }
    }
    Ok(Object {
        label: required(label, NAME, "label")?,
        pose: required(pose, NAME, "pose")?,
        size: required(size, NAME, "size")?,
        decay_rate,
        last_observed,
        pose_source: required(pose_source, NAME, "pose_source")?,
        room,
        support,
    })
}

pub(super) fn region(region: &Region) -> proto::Region {
    proto::Region {
        label: region.label.as_str().to_owned(),
        pose: region.extent.as_ref().map(|(at, _)| pose(at)),
        size: region.extent.map(|(_, sides)| size(sides)),
        parent_node: region.parent.map(node),
    }
}

pub(super) fn read_region(mut fields: Fields<'_>) -> Result<Region, WireError> {
    const NAME: &str = "Region";
    let (mut label, mut pose, mut size, mut parent) = (None, None, None, None);
    while let Some(field) = fields.next()? {
        match field.number {
            1 => label = Some(read_label(&field, NAME)?),
            2 => field.once(&mut pose, read_pose(field.message("Pose")?)?)?,
            3 => field.once(&mut size, read_size(field.message("Size")?)?)?,
            4 => parent = Some(read_node(&field, "parent_node")?),
            _ => {}
        }
    }
    let extent = match (pose, size) {
        (None, None) => None,
        (pose, size) => Some((required(pose, NAME, "pose")?, required(size, NAME, "size")?)),
    };
    Ok(Region { label: required(label, NAME, "label")?, extent, parent })
}

pub(super) fn node_ref(reference: &NodeRef) -> proto::NodeRef {
    proto::NodeRef {
        id: reference.id.map_or(0, NodeId::bits),
        label: reference.label.as_ref().map_or_else(String::new, |label| label.as_str().to_owned()),
    }
}

/// A reference that may be absent.
pub(super) fn optional_ref(reference: Option<&NodeRef>) -> Option<proto::NodeRef> {
    reference.map(node_ref)
}

pub(super) fn read_node_ref(field: &Field<'_>) -> Result<NodeRef, WireError> {
    let mut fields = field.message("NodeRef")?;
    let mut reference = NodeRef::default();
    while let Some(field) = fields.next()? {
        match field.number {
            1 => reference.id = read_id(&field)?,
            2 if field.bytes()?.is_empty() => reference.label = None,
            2 => reference.label = Some(read_label(&field, "NodeRef")?),
            _ => {}
        }
    }
    Ok(reference)
}

fn read_id(field: &Field<'_>) -> Result<Option<NodeId>, WireError> {
    match field.fixed64()? {
        0 => Ok(None),
        bits => NodeId::try_from(bits).map(Some).map_err(|_| {
            field.refuse("id", bits, "a layer letter (O, R, F, B) in the top byte and an index")
        }),
    }
}

pub(super) fn evidence(reference: &EvidenceRef) -> proto::EvidenceRef {
    proto::EvidenceRef { topic: reference.topic.to_string(), order: reference.order }
}

pub(super) fn read_evidence(field: &Field<'_>) -> Result<EvidenceRef, WireError> {
    const NAME: &str = "EvidenceRef";
    let mut fields = field.message(NAME)?;
    let (mut topic, mut order) = (None, 0);
    while let Some(field) = fields.next()? {
        match field.number {
            1 => topic = Some(Topic::named(field.text("topic")?).name()),
            2 => order = field.u64()?,
            _ => {}
        }
    }
    let order = required(Some(order).filter(|order| *order > 0), NAME, "order")?;
    // Protobuf cannot tell an empty text from none.
    let topic = required(topic.filter(|topic| !topic.is_empty()), NAME, "topic")?;
    Ok(EvidenceRef { topic, order })
}

/// Appends what [`pose`] makes.
pub(super) fn put_pose(put: &mut Put<'_>, pose: &Pose) {
    for (field, um) in (1..).zip(pose.position_um()) {
        put.sint(field, um);
    }
    if pose.orientation_e7() != IDENTITY {
        for (field, step) in (4..).zip(pose.orientation_e7()) {
            put.sint(field, step.into());
        }
    }
}

/// Appends what [`size`] makes.
pub(super) fn put_size(put: &mut Put<'_>, size: Size) {
    for (field, um) in (1..).zip(size.micrometres()) {
        put.u64(field, um.unsigned_abs());
    }
}

/// Appends what [`node_ref`] makes.
pub(super) fn put_node_ref(put: &mut Put<'_>, field: u64, reference: Option<&NodeRef>) {
    if let Some(reference) = reference {
        put.message(field, |put| {
            put.fixed64(1, reference.id.map_or(0, NodeId::bits));
            put.text(2, reference.label.as_ref().map_or("", |label| label.as_str()));
        });
    }
}

/// Appends what [`evidence`] makes.
pub(super) fn put_evidence(put: &mut Put<'_>, reference: &EvidenceRef) {
    put.text(1, &reference.topic);
    put.u64(2, reference.order);
}
