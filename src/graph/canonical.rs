//! The one byte form of a graph, and its hash.
//!
//! Layout (version 1), all numbers as in [`crate::bytes`]: version; the sorted table of labels;
//! buildings, floors, rooms (each: count, then per node index, label, extent, parent); pairs of
//! access; objects (count, then per node index, label, pose, size, λ, last observed, source of
//! the pose, room, support). Indices are stored as differences to the one before. Two graphs
//! are equal if and only if their bytes are.

use std::collections::BTreeMap;
use std::fmt;

use super::{
    GraphError, Label, LabelError, Layer, NodeId, Object, PoseSource, Region, SceneGraph,
};
use crate::bytes::{Reader, Writer};
use crate::geometry::{GeometryError, Pose, Size};
use crate::time::Stamp;

/// Version of the layout, the first number of the bytes.
pub const CANONICAL_VERSION: u64 = 1;

/// BLAKE3 hash of canonical bytes, printed as 64 hexadecimal digits.
#[derive(Clone, Copy, PartialEq, Eq, Hash)]
pub struct StateHash(pub [u8; 32]);

impl StateHash {
    /// The hash of some bytes.
    pub fn of(bytes: &[u8]) -> Self {
        Self(*blake3::hash(bytes).as_bytes())
    }
}

impl fmt::Display for StateHash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

impl std::str::FromStr for StateHash {
    type Err = CanonicalError;

    fn from_str(text: &str) -> Result<Self, CanonicalError> {
        let digits = text.as_bytes();
        let malformed = CanonicalError::Malformed { what: "a hash has 64 hexadecimal digits" };
        if digits.len() != 64 || !digits.iter().all(u8::is_ascii_hexdigit) {
            return Err(malformed);
        }
        let mut bytes = [0; 32];
        for (byte, pair) in bytes.iter_mut().zip(text.as_bytes().chunks_exact(2)) {
            let pair = std::str::from_utf8(pair).map_err(|_| malformed.clone())?;
            *byte = u8::from_str_radix(pair, 16).map_err(|_| malformed.clone())?;
        }
        Ok(Self(bytes))
    }
}

impl fmt::Debug for StateHash {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// Why bytes are not those of a graph.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CanonicalError {
    /// Written by another version of the layout.
    #[error("graph bytes have version {found}, this program reads version 1")]
    Version {
        /// The version found.
        found: u64,
    },
    /// The bytes end too early or hold a value that cannot be.
    #[error("graph bytes are malformed: {what}")]
    Malformed {
        /// Which part.
        what: &'static str,
    },
    /// A label that cannot be.
    #[error(transparent)]
    Label(#[from] LabelError),
    /// A pose or size that cannot be.
    #[error(transparent)]
    Geometry(#[from] GeometryError),
    /// Nodes that do not fit together.
    #[error(transparent)]
    Graph(#[from] GraphError),
}

const REGION_LAYERS: [Layer; 3] = [Layer::Building, Layer::Floor, Layer::Room];

impl SceneGraph {
    /// The canonical bytes.
    pub fn to_bytes(&self) -> Vec<u8> {
        let labels = self.label_table();
        let mut out = Writer(Vec::with_capacity(64 + 80 * self.object_count()));
        out.u64(CANONICAL_VERSION);
        out.u64(labels.len() as u64);
        labels.keys().for_each(|label| out.text(label.as_str()));
        for layer in REGION_LAYERS {
            out.u64(self.regions(layer).count() as u64);
            let mut last = 0;
            for (id, region) in self.regions(layer) {
                write_index(&mut out, id, &mut last);
                write_region(&mut out, region, &labels);
            }
        }
        out.u64(self.access().count() as u64);
        for (a, b) in self.access() {
            out.u64(a.index().into());
            out.u64(b.index().into());
        }
        out.u64(self.object_count() as u64);
        let mut last = 0;
        for (id, object) in self.all_objects() {
            write_index(&mut out, id, &mut last);
            write_object(&mut out, object, &labels);
        }
        out.0
    }

    /// BLAKE3 of the canonical bytes.
    pub fn hash(&self) -> StateHash {
        StateHash::of(&self.to_bytes())
    }

    /// The graph with these canonical bytes.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, CanonicalError> {
        let mut input = Reader(bytes);
        let graph = read_graph(&mut input)?;
        if input.0.is_empty() { Ok(graph) } else { Err(malformed("bytes follow the last object")) }
    }

    fn label_table(&self) -> BTreeMap<&Label, u64> {
        let regions = Layer::ALL.into_iter().flat_map(|l| self.regions(l)).map(|(_, r)| &r.label);
        let mut table: BTreeMap<&Label, u64> =
            self.all_objects().map(|(_, o)| &o.label).chain(regions).map(|l| (l, 0)).collect();
        table.values_mut().zip(0..).for_each(|(index, n)| *index = n);
        table
    }
}

fn write_index(out: &mut Writer, id: NodeId, last: &mut u32) {
    out.u64((id.index() - *last).into());
    *last = id.index();
}

fn write_region(out: &mut Writer, region: &Region, labels: &BTreeMap<&Label, u64>) {
    out.u64(labels[&region.label]);
    out.option(region.extent, |out, (pose, size)| {
        write_pose(out, &pose);
        write_size(out, size);
    });
    out.option(region.parent, |out, id| out.u64(id.bits()));
}

fn write_object(out: &mut Writer, object: &Object, labels: &BTreeMap<&Label, u64>) {
    out.u64(labels[&object.label]);
    write_object_bytes(out, object);
}

/// All of an object but its label.
pub(crate) fn write_object_bytes(out: &mut Writer, object: &Object) {
    write_pose(out, &object.pose);
    write_size(out, object.size);
    out.f64(object.decay_rate);
    out.u64(object.last_observed.nanos());
    out.u64(object.pose_source as u64);
    out.u64(object.room.index().into());
    out.u64(object.support.map_or(0, |id| u64::from(id.index()) + 1));
}

fn write_pose(out: &mut Writer, pose: &Pose) {
    pose.position_um().into_iter().for_each(|um| out.i64(um));
    pose.orientation_e7().into_iter().for_each(|step| out.i64(step.into()));
}

fn write_size(out: &mut Writer, size: Size) {
    size.micrometres().into_iter().for_each(|um| out.i64(um));
}

fn malformed(what: &'static str) -> CanonicalError {
    CanonicalError::Malformed { what }
}

fn read_graph(input: &mut Reader<'_>) -> Result<SceneGraph, CanonicalError> {
    let version = input.u64().ok_or(malformed("version"))?;
    if version != CANONICAL_VERSION {
        return Err(CanonicalError::Version { found: version });
    }
    let labels = read_labels(input)?;
    let mut graph = SceneGraph::new();
    for layer in REGION_LAYERS {
        let count = input.u64().ok_or(malformed("count of regions"))?;
        let mut next = 0;
        for n in 0..count {
            let id = read_index(input, layer, &mut next, n == 0)?;
            graph.insert_region(id, read_region(input, &labels)?)?;
        }
    }
    let count = input.u64().ok_or(malformed("count of accesses"))?;
    for _ in 0..count {
        let mut room = || input.u32().and_then(|index| NodeId::new(Layer::Room, index));
        let (a, b) = room().zip(room()).ok_or(malformed("access"))?;
        graph.connect(a, b)?;
    }
    read_objects(input, &labels, &mut graph)?;
    Ok(graph)
}

fn read_labels(input: &mut Reader<'_>) -> Result<Vec<Label>, CanonicalError> {
    let count = input.u64().ok_or(malformed("count of labels"))?;
    let mut labels: Vec<Label> = Vec::new();
    for _ in 0..count {
        let label = Label::new(input.text().ok_or(malformed("label"))?)?;
        if labels.last().is_some_and(|last| *last >= label) {
            return Err(malformed("labels are not sorted"));
        }
        labels.push(label);
    }
    Ok(labels)
}

/// The next index: ascending, each stored as the difference to the one before.
fn read_index(
    input: &mut Reader<'_>,
    layer: Layer,
    last: &mut u32,
    first: bool,
) -> Result<NodeId, CanonicalError> {
    let step = input.u32().filter(|step| first || *step > 0).ok_or(malformed("node index"))?;
    *last = last.checked_add(step).ok_or(malformed("node index"))?;
    NodeId::new(layer, *last).ok_or(malformed("node index"))
}

fn read_label(input: &mut Reader<'_>, labels: &[Label]) -> Result<Label, CanonicalError> {
    let index = input.u64().and_then(|n| usize::try_from(n).ok());
    index.and_then(|n| labels.get(n)).cloned().ok_or(malformed("index of a label"))
}

fn read_region(input: &mut Reader<'_>, labels: &[Label]) -> Result<Region, CanonicalError> {
    let label = read_label(input, labels)?;
    let extent = match input.u64().ok_or(malformed("extent of a region"))? {
        0 => None,
        1 => Some((read_pose(input)?, read_size(input)?)),
        _ => return Err(malformed("extent of a region")),
    };
    let parent = input
        .option(|input| NodeId::try_from(input.u64()?).ok())
        .ok_or(malformed("parent of a region"))?;
    Ok(Region { label, extent, parent })
}

/// Objects are inserted bare first: a support may come later in the order of ids.
fn read_objects(
    input: &mut Reader<'_>,
    labels: &[Label],
    graph: &mut SceneGraph,
) -> Result<(), CanonicalError> {
    let count = input.u64().ok_or(malformed("count of objects"))?;
    let mut last = 0;
    let mut resting = Vec::new();
    for n in 0..count {
        let id = read_index(input, Layer::Object, &mut last, n == 0)?;
        let object = read_object(input, labels)?;
        resting.extend(object.support.map(|support| (id, support)));
        graph.insert_object(id, Object { support: None, ..object })?;
    }
    Ok(graph.set_supports(&resting)?)
}

fn read_object(input: &mut Reader<'_>, labels: &[Label]) -> Result<Object, CanonicalError> {
    let label = read_label(input, labels)?;
    read_object_bytes(input, label)
}

/// All of an object but its label.
pub(crate) fn read_object_bytes(
    input: &mut Reader<'_>,
    label: Label,
) -> Result<Object, CanonicalError> {
    let pose = read_pose(input)?;
    let size = read_size(input)?;
    let decay_rate = input.f64().ok_or(malformed("decay rate"))?;
    let last_observed = input
        .u64()
        .filter(|nanos| *nanos <= Stamp::MAX.nanos())
        .map(Stamp::from_nanos)
        .ok_or(malformed("time of last observation"))?;
    let pose_source = match input.u64() {
        Some(0) => PoseSource::Measured,
        Some(1) => PoseSource::Topological,
        Some(2) => PoseSource::Held,
        _ => return Err(malformed("source of a pose")),
    };
    let room = input.u32().and_then(|n| NodeId::new(Layer::Room, n)).ok_or(malformed("room"))?;
    let support = match input.u32().ok_or(malformed("support"))? {
        0 => None,
        n => Some(NodeId::new(Layer::Object, n - 1).ok_or(malformed("support"))?),
    };
    Ok(Object { label, pose, size, decay_rate, last_observed, pose_source, room, support })
}

fn read_pose(input: &mut Reader<'_>) -> Result<Pose, CanonicalError> {
    let mut position = [0; 3];
    for um in &mut position {
        *um = input.i64().ok_or(malformed("position"))?;
    }
    let mut orientation = [0; 4];
    for step in &mut orientation {
        *step = input.i64().and_then(|n| n.try_into().ok()).ok_or(malformed("orientation"))?;
    }
    Ok(Pose::from_grid(position, orientation)?)
}

fn read_size(input: &mut Reader<'_>) -> Result<Size, CanonicalError> {
    let mut sides = [0; 3];
    for side in &mut sides {
        *side = input.i64().ok_or(malformed("size"))?;
    }
    Ok(Size::from_micrometres(sides)?)
}
