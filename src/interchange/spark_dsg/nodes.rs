//! Which node is what: layers, ids and edges of the file.

use std::collections::{BTreeMap, BTreeSet};

use super::SparkDsgError;
use crate::graph::{Layer, NodeId};
use crate::interchange::json::{At, JsonError};

/// What a node is to us.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Kind {
    Known(Layer),
    Place,
    Agent,
    Other,
}

/// A layer of the file: its number and partition.
pub(super) type Key = (u64, u64);

/// A node of the file.
#[derive(Debug)]
pub(super) struct FileNode<'a> {
    pub kind: Kind,
    pub key: Key,
    pub attributes: At<'a>,
}

/// All nodes and edges of the file, by the ids there.
#[derive(Debug)]
pub(super) struct File<'a> {
    pub nodes: BTreeMap<u64, FileNode<'a>>,
    /// Every edge once, as (source, target).
    pub edges: Vec<(u64, u64)>,
    /// How many edges there are that begin or end at no node of the file.
    pub loose_edges: u64,
    /// For each node those above it, of higher layers.
    above: BTreeMap<u64, BTreeSet<u64>>,
}

impl<'a> File<'a> {
    pub fn read(root: &At<'a>) -> Result<Self, JsonError> {
        let names = layer_names(root)?;
        let mut nodes = BTreeMap::new();
        for at in root.field("nodes")?.items()? {
            let id = at.field("id")?;
            let (bits, node) = (id.u64()?, node(&at, id.u64()?, &names)?);
            if nodes.insert(bits, node).is_some() {
                return Err(
                    id.error(format!("{bits} is the id of another node too: ids are unique"))
                );
            }
        }
        let mut file = Self { nodes, edges: Vec::new(), above: BTreeMap::new(), loose_edges: 0 };
        for at in root.list("edges")? {
            let (source, target) = (at.field("source")?.u64()?, at.field("target")?.u64()?);
            let layer = |bits| file.nodes.get(&bits).map(|node| node.key.0);
            let (Some(upper), Some(lower)) = (layer(source), layer(target)) else {
                file.loose_edges += 1;
                continue;
            };
            file.edges.push((source, target));
            if upper != lower {
                let (above, below) =
                    if upper > lower { (source, target) } else { (target, source) };
                file.above.entry(below).or_default().insert(above);
            }
        }
        Ok(file)
    }

    /// The nearest node of `layer` above this one; of several the one with the smallest id.
    pub fn ancestor(&self, bits: u64, layer: Layer) -> Option<u64> {
        let mut level = BTreeSet::from([bits]);
        // Each step goes up a layer at least, so this ends.
        while !level.is_empty() {
            level =
                level.iter().filter_map(|below| self.above.get(below)).flatten().copied().collect();
            let found = level.iter().find(|bits| self.nodes[bits].kind == Kind::Known(layer));
            if let Some(found) = found {
                return Some(*found);
            }
        }
        None
    }

    /// Our ids: those of the file where they fit, else the next that are free.
    pub fn ids(&self) -> Result<BTreeMap<u64, NodeId>, SparkDsgError> {
        let known = |(bits, node): (&u64, &FileNode<'_>)| match node.kind {
            Kind::Known(layer) => Some((*bits, layer)),
            _ => None,
        };
        let known: Vec<(u64, Layer)> = self.nodes.iter().filter_map(known).collect();
        let fits = |bits, layer| NodeId::try_from(bits).ok().filter(|id| id.layer() == layer);
        let mut ids: BTreeMap<u64, NodeId> =
            known.iter().filter_map(|(bits, layer)| Some((*bits, fits(*bits, *layer)?))).collect();
        let mut used: BTreeSet<NodeId> = ids.values().copied().collect();
        let mut next = BTreeMap::new();
        for (bits, layer) in known {
            if ids.contains_key(&bits) {
                continue;
            }
            let from = next.entry(layer).or_insert(0);
            let id = loop {
                let id = NodeId::new(layer, *from).ok_or(SparkDsgError::NoIdLeft { bits })?;
                *from += 1;
                if used.insert(id) {
                    break id;
                }
            };
            ids.insert(bits, id);
        }
        Ok(ids)
    }
}

/// The layers with names of their own, by number and partition.
fn layer_names(root: &At<'_>) -> Result<BTreeMap<Key, Kind>, JsonError> {
    let usual = [
        ((2, 0), Kind::Known(Layer::Object)),
        ((3, 0), Kind::Place),
        ((4, 0), Kind::Known(Layer::Room)),
        ((5, 0), Kind::Known(Layer::Building)),
    ];
    let mut names = BTreeMap::from(usual);
    let named = [
        ("OBJECTS", Kind::Known(Layer::Object)),
        ("PLACES", Kind::Place),
        ("MESH_PLACES", Kind::Place),
        ("ROOMS", Kind::Known(Layer::Room)),
        ("FLOORS", Kind::Known(Layer::Floor)),
        ("BUILDINGS", Kind::Known(Layer::Building)),
    ];
    let Some(layers) = root.optional("layer_names")? else { return Ok(names) };
    for (name, kind) in named {
        let Some(at) = layers.optional(name)? else { continue };
        let key = match at.value.as_u64() {
            Some(layer) => (layer, 0),
            None => (at.field("layer")?.u64()?, partition(&at)?),
        };
        names.insert(key, kind);
    }
    Ok(names)
}

fn partition(at: &At<'_>) -> Result<u64, JsonError> {
    at.optional("partition")?.map_or(Ok(0), |at| at.u64())
}

fn node<'a>(
    at: &At<'a>,
    bits: u64,
    names: &BTreeMap<Key, Kind>,
) -> Result<FileNode<'a>, JsonError> {
    let attributes = at.field("attributes")?;
    // Before partitions, the layers of agents had the letter of the robot as prefix.
    let partition = match at.optional("prefix")? {
        Some(prefix) => match prefix.value.as_str() {
            Some(letter) => letter.bytes().next().map_or(0, u64::from),
            None => prefix.u64()?,
        },
        None => partition(at)?,
    };
    let key = (at.field("layer")?.u64()?, partition);
    let kind_name = attributes.optional("type")?.map_or(Ok(""), |at| at.text())?;
    let letter = (bits >> 56) as u8;
    let kind = match (kind_name, names.get(&key)) {
        ("AgentNodeAttributes", _) => Kind::Agent,
        (_, None) if key.0 == 2 && partition == u64::from(letter) => Kind::Agent,
        (_, Some(kind)) => *kind,
        (name, None) if name.contains("Place") => Kind::Place,
        (_, None) => Kind::Other,
    };
    Ok(FileNode { kind, key, attributes })
}
