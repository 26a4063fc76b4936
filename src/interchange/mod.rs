//! Scene graphs and logs of other programs: imports and exports.
//!
//! Pure: text in, values out; whoever calls reads and writes the files. Knows nothing of
//! recordings. What an import takes, leaves out and makes up is in its [`ImportReport`].
//!
//! | module | in | out |
//! |---|---|---|
//! | [`scene`] | our own JSON | our own JSON |
//! | [`spark_dsg`] | Hydra, Khronos, Clio | Spark-DSG 1.1 |
//! | [`virtualhome`] | a Unity apartment | |
//! | [`actions`] | a CSV of object handling | |
//! | [`dot`] | | Graphviz |

pub mod actions;
pub mod dot;
mod json;
pub mod lines;
mod report;
pub mod scene;
pub mod spark_dsg;
#[cfg(test)]
mod testing;
pub mod virtualhome;

pub use json::JsonError;
pub use report::{Import, ImportReport};

use crate::graph::{GraphError, NodeId, Object, Placement, SceneGraph};

/// λ of things that people carry about, where nothing else is known, in 1/s.
///
/// p = 2 / (1 + e^{λΔt}) is one half where e^{λΔt} = 3; this one is that of a half-life of
/// twelve hours: ln 3 / 43,200 s.
pub const MOVABLE_DECAY_RATE: f64 = 1.098_612_288_668_109_8 / 43_200.0;

/// λ of what stays: furniture, walls.
pub const IMMOVABLE_DECAY_RATE: f64 = 0.0;

/// Adds objects whatever their order. A support that cannot be is left out; returns which.
fn insert_all(
    graph: &mut SceneGraph,
    objects: Vec<(NodeId, Object)>,
) -> Result<Vec<NodeId>, GraphError> {
    let mut resting = Vec::new();
    for (id, object) in objects {
        if object.support.is_some() {
            resting.push((id, Placement::of(&object)));
        }
        graph.insert_object(id, Object { support: None, ..object })?;
    }
    let refused = |(id, placement)| graph.place_object(id, &placement).err().map(|_| id);
    Ok(resting.into_iter().filter_map(refused).collect())
}

/// `3 words: O1, O2, O5`, or as many as one reads.
fn counted(ids: &[NodeId], words: &str) -> String {
    let shown: Vec<String> = ids.iter().take(12).map(NodeId::to_string).collect();
    let rest = ids.len() - shown.len();
    let more = if rest > 0 { format!(" and {rest} more") } else { String::new() };
    format!("{} {words}: {}{more}", ids.len(), shown.join(", "))
}
