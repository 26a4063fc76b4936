//! What a node is called.

use serde_json::Value;

use super::nodes::FileNode;
use crate::graph::{Label, Layer, NodeId};
use crate::interchange::json::{At, JsonError};

/// What Spark-DSG writes for no label: the largest 32-bit number.
pub(super) const NO_LABEL: u64 = 0xffff_ffff;

/// The label of the node that is `id` with us.
pub(super) fn read(root: &At<'_>, node: &FileNode<'_>, id: NodeId) -> Result<Label, JsonError> {
    let attributes = &node.attributes;
    if let Some(own) = own_label(attributes)? {
        return Ok(own);
    }
    if let Some(name) = attributes.optional("name")? {
        let text = name.text()?;
        if is_meaningful(text) {
            return Label::new(text).map_err(|error| name.error(error));
        }
    }
    let class = attributes.optional("semantic_label")?.and_then(|at| at.value.as_u64());
    let class = class.filter(|class| *class != NO_LABEL);
    if let Some(name) = class.and_then(|class| in_label_space(root, node, class)) {
        return Label::new(name)
            .map_err(|error| attributes.error(format!("its label in the label space: {error}")));
    }
    let made = match (id.layer(), class) {
        (Layer::Object, Some(class)) => format!("class_{class}"),
        (Layer::Object, None) => "object".to_owned(),
        (layer, _) => format!("{layer} {}", id.index()),
    };
    Ok(Label::new(&made).expect("it is short and plain"))
}

/// What our export wrote of a label that looks as if it only said the id.
fn own_label(attributes: &At<'_>) -> Result<Option<Label>, JsonError> {
    let Some(metadata) = attributes.optional("metadata")? else { return Ok(None) };
    let Some(own) = metadata.optional("scenefold")? else { return Ok(None) };
    let Some(label) = own.optional("label")? else { return Ok(None) };
    Label::new(label.text()?).map(Some).map_err(|error| label.error(error))
}

/// `O(12)` only says the id.
pub(super) fn is_meaningful(name: &str) -> bool {
    let index = name.strip_suffix(')').and_then(|name| name.split_once('('));
    let is_id = |(letter, index): (&str, &str)| {
        letter.chars().count() <= 1 && index.bytes().all(|byte| byte.is_ascii_digit())
    };
    !name.trim().is_empty() && !index.is_some_and(is_id)
}

/// The name of a class in `metadata.labelspaces["_l2p0"] = [[number, name], …]`.
fn in_label_space<'a>(root: &At<'a>, node: &FileNode<'_>, class: u64) -> Option<&'a str> {
    let (layer, partition) = node.key;
    let spaces = root.value.get("metadata")?.get("labelspaces")?;
    let entries = spaces.get(format!("_l{layer}p{partition}"))?.as_array()?;
    let entry = entries.iter().find(|entry| entry.get(0).and_then(Value::as_u64) == Some(class))?;
    entry.get(1)?.as_str().filter(|name| !name.trim().is_empty())
}
