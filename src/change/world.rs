//! [`World`]: the graph, and what is remembered of what left it.

use std::collections::BTreeMap;

use crate::graph::{GraphError, Layer, NodeId, Object, SceneGraph};

/// Everything that primitives act on: the graph now, the objects that left it (so that one that
/// comes back keeps its id and its attributes), and the next free id of each layer.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct World {
    pub(super) graph: SceneGraph,
    pub(super) departed: BTreeMap<NodeId, Object>,
    /// One more than the largest index ever used, by layer in the order of [`Layer::ALL`].
    pub(super) next: [u32; 4],
}

/// Why a primitive was refused. Nothing is changed in any case.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum WorldError {
    /// The graph refused.
    #[error(transparent)]
    Graph(#[from] GraphError),
    /// All ids of a layer are used up.
    #[error("no {layer} id is left")]
    NoIdLeft {
        /// The layer.
        layer: Layer,
    },
    /// A `Find` whose choice is not among its candidates.
    #[error("{chosen} was chosen but is no candidate")]
    NotACandidate {
        /// The choice.
        chosen: NodeId,
    },
}

impl World {
    /// A world that is known only by its graph.
    pub fn from_graph(graph: SceneGraph) -> Self {
        let next = Layer::ALL.map(|layer| graph.last_index(layer).map_or(0, |last| last + 1));
        Self { graph, departed: BTreeMap::new(), next }
    }

    /// The graph now.
    pub fn graph(&self) -> &SceneGraph {
        &self.graph
    }

    /// The object with this id as it was when it left the graph, if it is not there now.
    pub fn departed(&self, id: NodeId) -> Option<&Object> {
        self.departed.get(&id)
    }

    /// Objects that left the graph, in order of id.
    pub fn all_departed(&self) -> impl Iterator<Item = (NodeId, &Object)> {
        self.departed.iter().map(|(id, object)| (*id, object))
    }

    /// The object with this id: in the graph, held, or as it was when it left.
    pub fn known(&self, id: NodeId) -> Option<&Object> {
        self.graph.object(id).or_else(|| self.departed(id))
    }

    /// An id that was never used: one more than the last one, or where somebody has used the
    /// very last one, the first that is free.
    pub fn fresh_id(&self, layer: Layer) -> Result<NodeId, WorldError> {
        let next = NodeId::new(layer, self.next[layer as usize]);
        let free = |id: &NodeId| !self.graph.contains(*id) && !self.departed.contains_key(id);
        let any = || {
            (0..=NodeId::MAX_INDEX).filter_map(|index| NodeId::new(layer, index)).find(free)
        };
        next.or_else(any).ok_or(WorldError::NoIdLeft { layer })
    }

    /// The next index of each layer, in the order of [`Layer::ALL`].
    pub fn next_indices(&self) -> [u32; 4] {
        self.next
    }
}
