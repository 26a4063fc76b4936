//! A diff as a person reads it: a line per node and field, in order of id.

use std::fmt;

use super::{Changed, Diff, Moved, Presence};
use crate::graph::{Layer, NodeId};

/// Lines that begin with `+`, `-` or `~`, in order of id; nothing if nothing differs.
impl fmt::Display for Diff {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let removed = self.removed.iter().map(|it| (it.node.id, 0, presence('-', it)));
        let added = self.added.iter().map(|it| (it.node.id, 1, presence('+', it)));
        let moved = self.moved.iter().map(|it| (it.node.id, 2, moved(it)));
        let changed = self.changed.iter().map(|it| (it.node.id, 3, changed(it)));
        let mut lines: Vec<(Option<NodeId>, u8, String)> =
            removed.chain(added).chain(moved).chain(changed).collect();
        lines.sort_by_key(|(id, kind, _)| (*id, *kind));
        lines.iter().try_for_each(|(_, _, line)| writeln!(f, "{line}"))
    }
}

fn presence(sign: char, it: &Presence) -> String {
    match (&it.place, it.node.id.map(NodeId::layer)) {
        (Some(place), _) => format!("{sign} {}  {place}", it.node),
        (None, Some(layer)) if layer != Layer::Object => format!("{sign} {}  {layer}", it.node),
        (None, _) => format!("{sign} {}", it.node),
    }
}

fn moved(it: &Moved) -> String {
    let (metres, radians) = it.from.pose.distance(&it.to.pose);
    let mut notes = Vec::new();
    if it.fields.contains(&"pose") {
        // A turn on the spot has no distance worth telling.
        let turned = metres < 0.005 && radians > 0.0;
        let turn = || format!("turned {:.1}°", radians.to_degrees());
        notes.push(if turned { turn() } else { format!("{metres:.2} m") });
    }
    let (from, to) = (it.from.pose_source, it.to.pose_source);
    if it.fields.contains(&"pose_source") && !it.from.is_held() && !it.to.is_held() {
        notes.push(format!("{} → {}", from.as_str(), to.as_str()));
    }
    let notes = if notes.is_empty() { String::new() } else { format!(" ({})", notes.join(", ")) };
    let (from, to) = (it.from.to_string(), it.to.to_string());
    if from == to {
        return format!("~ {}  {to} {notes}", it.node);
    }
    format!("~ {}  {from}  →  {to}{notes}", it.node)
}

fn changed(it: &Changed) -> String {
    format!("~ {}  {}: {}  →  {}", it.node, it.field, it.from, it.to)
}
