//! Export of a graph as a picture for Graphviz: `dot -Tsvg`.
//!
//! Buildings, floors and rooms are nested frames; an arrow leads from an object to what it rests
//! on; a dashed line joins rooms with access to each other. Objects whose pose is only
//! topological have rounded corners, held ones a dashed frame. Same graph, same text. Knows
//! nothing of files.

use std::collections::BTreeSet;
use std::fmt::Write;

use crate::graph::{Layer, NodeId, Object, PoseSource, SceneGraph};

/// In how many columns those objects stand that neither rest on anything nor carry anything.
const COLUMNS: usize = 4;

/// The graph in the DOT language.
pub fn export(graph: &SceneGraph) -> String {
    let mut dot = Dot { graph, text: String::new(), depth: 0 };
    dot.line("digraph scene {");
    dot.depth = 1;
    dot.line(
        "graph [rankdir=LR, compound=true, nodesep=0.08, ranksep=0.35, fontname=\"sans-serif\"];",
    );
    dot.line(
        "node [shape=box, fontname=\"sans-serif\", fontsize=11, height=0.3, margin=\"0.08,0.04\"];",
    );
    dot.line("edge [arrowsize=0.6, color=\"#555555\"];");
    for layer in [Layer::Building, Layer::Floor, Layer::Room] {
        for (id, region) in graph.regions(layer) {
            if region.parent.is_none() {
                dot.region(id);
            }
        }
    }
    dot.supports();
    dot.access();
    dot.depth = 0;
    dot.line("}");
    dot.text
}

struct Dot<'a> {
    graph: &'a SceneGraph,
    text: String,
    depth: usize,
}

impl Dot<'_> {
    fn line(&mut self, line: impl AsRef<str>) {
        let indent = "  ".repeat(self.depth);
        writeln!(self.text, "{indent}{}", line.as_ref()).expect("a string takes what is written");
    }

    /// A frame with everything that belongs to the region.
    fn region(&mut self, id: NodeId) {
        let graph = self.graph;
        let label = graph.label(id).map(|label| escaped(label.as_str())).unwrap_or_default();
        let (colour, fill) = match id.layer() {
            Layer::Room => ("#4a6fa5", "#f3f7fc"),
            Layer::Floor => ("#888888", "#fcfcfc"),
            Layer::Building | Layer::Object => ("#444444", "#ffffff"),
        };
        self.line(format!("subgraph cluster_{id} {{"));
        self.depth += 1;
        self.line(format!(
            "label=\"{label} {id}\"; fontsize=14; color=\"{colour}\"; style=filled; fillcolor=\"{fill}\";"
        ));
        for layer in [Layer::Floor, Layer::Room] {
            for (child, region) in graph.regions(layer) {
                if region.parent == Some(id) {
                    self.region(child);
                }
            }
        }
        if id.layer() == Layer::Room {
            self.objects(id);
        }
        self.depth -= 1;
        self.line("}");
    }

    fn objects(&mut self, room: NodeId) {
        let graph = self.graph;
        // Where lines of access begin and end; also keeps an empty room visible.
        self.line(format!("{room} [shape=point, style=invis, width=0];"));
        let inside: Vec<(NodeId, &Object)> =
            graph.all_objects().filter(|(_, object)| object.room == room).collect();
        for (id, object) in &inside {
            let label = escaped(object.label.as_str());
            let style = match object.pose_source {
                PoseSource::Measured => "style=filled",
                PoseSource::Topological => "style=\"filled,rounded\"",
                PoseSource::Held => "style=\"filled,dashed\"",
            };
            self.line(format!("{id} [label=\"{label} {id}\", {style}, fillcolor=white];"));
        }
        let supports: BTreeSet<NodeId> =
            graph.all_objects().filter_map(|(_, object)| object.support).collect();
        let alone =
            |(id, object): &&(NodeId, &Object)| object.support.is_none() && !supports.contains(id);
        let alone: Vec<NodeId> = inside.iter().filter(alone).map(|(id, _)| *id).collect();
        // A few columns, next to each other.
        let rows = alone.len().div_ceil(COLUMNS);
        for n in rows..alone.len() {
            self.line(format!("{} -> {} [style=invis];", alone[n - rows], alone[n]));
        }
    }

    fn supports(&mut self) {
        for (id, object) in self.graph.all_objects() {
            if let Some(support) = object.support {
                // Written backwards, so that what stands on the floor is in one column.
                self.line(format!("{support} -> {id} [dir=back];"));
            }
        }
    }

    fn access(&mut self) {
        let graph = self.graph;
        for (a, b) in graph.access() {
            self.line(format!(
                "{a} -> {b} [dir=none, style=dashed, color=\"#4a6fa5\", penwidth=1.5, \
                 ltail=cluster_{a}, lhead=cluster_{b}];"
            ));
        }
    }
}

/// A text between the quotes of a DOT string; a label has no control characters.
fn escaped(text: &str) -> String {
    text.replace('\\', "\\\\").replace('"', "\\\"")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interchange::scene;
    use crate::interchange::testing::scene_graph;
    use proptest::prelude::*;

    #[test]
    fn frames_nodes_supports_and_access_are_drawn() {
        let text = r#"{"rooms": [{"label": "a \"room\"", "floor": "F0"},
                                 {"label": "hall", "access_to": ["R0"]}],
            "floors": [{"label": "ground"}],
            "objects": [{"label": "table", "room": "R0", "pose": {"position": [0, 0, 0]}},
                        {"label": "mug\\", "support": "table"}],
            "held": [{"label": "cup", "room": "R1"}]}"#;
        let dot = export(&scene::import(text).unwrap().graph);
        for line in [
            "  subgraph cluster_F0 {\n",
            "    subgraph cluster_R0 {\n",
            r#"label="a \"room\" R0""#,
            r#"O0 [label="table O0", style=filled,"#,
            r#"O1 [label="mug\\ O1", style="filled,rounded","#,
            r#"O2 [label="cup O2", style="filled,dashed","#,
            "O0 -> O1 [dir=back];",
            "R0 -> R1 [dir=none, style=dashed,",
        ] {
            assert!(dot.contains(line), "{line}\n{dot}");
        }
    }

    proptest! {
        #[test]
        fn every_frame_is_closed(graph in scene_graph()) {
            let dot = export(&graph);
            let count = |end: char| dot.lines().filter(|line| line.ends_with(end)).count();
            prop_assert_eq!(count('{'), count('}'));
        }
    }
}
