//! Ids of the nodes of one layer of a document, and what a name in it means.

use std::collections::BTreeMap;

use super::SceneError;
use crate::graph::{Label, Layer, NodeId};
use crate::interchange::JsonError;

/// The nodes of one layer in the order of the document.
#[derive(Debug)]
pub(super) struct Ids {
    layer: Layer,
    /// Id and label, by position in the document.
    pub nodes: Vec<(NodeId, Label)>,
    position: BTreeMap<NodeId, usize>,
    /// By the plain form of the label.
    by_label: BTreeMap<String, Vec<NodeId>>,
}

impl Ids {
    /// Numbers the nodes without ids in order with the indices that are free. `path` says where
    /// a node stands.
    pub fn new(
        layer: Layer,
        given: Vec<(Option<NodeId>, Label)>,
        path: impl Fn(usize) -> String,
    ) -> Result<Self, SceneError> {
        let mut position = BTreeMap::new();
        for (n, id) in given.iter().enumerate().filter_map(|(n, (id, _))| Some((n, (*id)?))) {
            if let Some(first) = position.insert(id, n) {
                let problem = format!("{id} is the id of {} already: ids are unique", path(first));
                return Err(JsonError { path: path(n) + ".id", problem }.into());
            }
        }
        let mut ids = Self { layer, nodes: Vec::new(), position, by_label: BTreeMap::new() };
        let mut free = 0;
        for (n, (id, label)) in given.into_iter().enumerate() {
            let id = match id {
                Some(id) => id,
                None => {
                    ids.number(&mut free).ok_or_else(|| SceneError::NoIdLeft { path: path(n) })?
                }
            };
            ids.position.insert(id, n);
            ids.by_label.entry(plain(label.as_str())).or_default().push(id);
            ids.nodes.push((id, label));
        }
        Ok(ids)
    }

    fn number(&self, free: &mut u32) -> Option<NodeId> {
        loop {
            let id = NodeId::new(self.layer, *free)?;
            *free += 1;
            if !self.position.contains_key(&id) {
                return Some(id);
            }
        }
    }

    /// Where the node with this id stands.
    pub fn position(&self, id: NodeId) -> Option<usize> {
        self.position.get(&id).copied()
    }

    /// The node that `name` means: an id, or a label that only one has.
    pub fn find(&self, name: &str, path: impl FnOnce() -> String) -> Result<NodeId, SceneError> {
        if let Ok(id) = name.parse::<NodeId>()
            && self.position.contains_key(&id)
        {
            return Ok(id);
        }
        let layer = self.layer;
        let problem = match self.by_label.get(&plain(name)).map(Vec::as_slice) {
            Some([only]) => return Ok(*only),
            Some(several) => {
                format!("{name:?} is the label of several: {}; give an id", words(several))
            }
            None => format!("no {layer} has the id or label {name:?}; add one, or mend the name"),
        };
        Err(JsonError { path: path(), problem }.into())
    }
}

fn words(ids: &[NodeId]) -> String {
    ids.iter().take(12).map(NodeId::to_string).collect::<Vec<_>>().join(", ")
}

/// What [`Label::same_class`] compares.
fn plain(text: &str) -> String {
    let kept = text.chars().filter(|c| !matches!(c, '_' | '-' | ' '));
    kept.flat_map(char::to_lowercase).collect()
}
