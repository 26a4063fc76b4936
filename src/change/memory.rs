//! The bytes of a [`World`], as checkpoints store them.

use std::collections::BTreeMap;

use super::World;
use crate::bytes::{Reader, Writer};
use crate::graph::{
    CanonicalError, Label, Layer, NodeId, SceneGraph, StateHash, read_object_bytes,
    write_object_bytes,
};

impl World {
    /// Appends the bytes of this world: the canonical bytes of the graph, then the objects that
    /// left it, then the next index of each layer. Returns the hash of the graph.
    pub(crate) fn write_bytes(&self, out: &mut Writer) -> StateHash {
        let graph = self.graph.to_bytes();
        out.bytes(&graph);
        out.u64(self.departed.len() as u64);
        for (id, object) in &self.departed {
            out.u64(id.index().into());
            out.text(object.label.as_str());
            write_object_bytes(out, object);
        }
        self.next.iter().for_each(|next| out.u64((*next).into()));
        StateHash::of(&graph)
    }

    /// The world whose bytes come next in `input`.
    pub(crate) fn read_bytes(input: &mut Reader<'_>) -> Result<Self, CanonicalError> {
        let malformed = |what| CanonicalError::Malformed { what };
        let graph = SceneGraph::from_bytes(input.bytes().ok_or(malformed("graph"))?)?;
        let count = input.u64().ok_or(malformed("count of departed objects"))?;
        let mut departed = BTreeMap::new();
        for _ in 0..count {
            let index = input.u32().ok_or(malformed("departed object"))?;
            let id = NodeId::new(Layer::Object, index).ok_or(malformed("departed object"))?;
            let label = Label::new(input.text().ok_or(malformed("label"))?)?;
            departed.insert(id, read_object_bytes(input, label)?);
        }
        let mut next = [0; 4];
        for index in &mut next {
            *index = input.u32().ok_or(malformed("next index"))?;
        }
        Ok(Self { graph, departed, next })
    }
}
