//! Import of a log of object handling: who was picked up when, and put where.
//!
//! A CSV with a header line and the columns `split,day,minute,action,object,object_id,
//! destination,destination_id`:
//!
//! | column | holds |
//! |---|---|
//! | `split` | `train` or `test`; the days of `test` follow the last one of `train` |
//! | `day` | day of the split, from 0 |
//! | `minute` | minutes since midnight, with decimals; a day may run past 1440 |
//! | `action` | `grab`, or one of `putback`, `putin`, `putobjback` |
//! | `object`, `object_id` | class and number of the thing |
//! | `destination`, `destination_id` | class and number of where it is put; empty for `grab`; empty for a put means where it was grabbed |
//!
//! Object 1204 becomes the node `O1204`. Destination 114 is the node `O114` of the base graph,
//! or the room `R114`; else a row of the places CSV (`id,class,room`; a place without a room is
//! a room itself, such as `outside`), else a thing that is handled itself, else a piece of
//! furniture in a room called `unknown`.
//!
//! # The arrangement every day starts from
//! The initial CSV (`object,object_id,place`) names the class of the place of each thing. Which
//! place of that class is meant is told by where the log puts that thing most often. Things it
//! does not name begin where they are first put.
//!
//! # Events
//! Every row becomes one task status, *picked* or *placed*, in the order of the file. At each
//! midnight what is elsewhere than in the arrangement is put back by further events. To know
//! what is where, the import plays the log through the planner, as the updater will.
//! Knows nothing of files.

mod csv_rows;
mod days;
mod homes;
mod places;
mod rows;
#[cfg(test)]
mod tests;

use super::{Import, ImportReport};
use crate::graph::{GraphError, SceneGraph};
use crate::time::Stamp;

/// What the log stands on.
#[derive(Clone, Debug, Default)]
pub struct Options<'a> {
    /// The base graph; destination ids are its node ids.
    pub graph: Option<SceneGraph>,
    /// CSV `id,class,room` of places the graph lacks.
    pub places_csv: Option<&'a str>,
    /// CSV `object,object_id,place` of the arrangement that every day starts from.
    pub initial_csv: Option<&'a str>,
    /// Midnight of the first day.
    pub start: Stamp,
    /// First part of the task ids.
    pub name: &'a str,
}

/// Why a log was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ActionsError {
    /// The columns are others.
    #[error("{file}: the header is {found:?}, it must be {expected:?}")]
    Header {
        /// Which of the CSVs.
        file: &'static str,
        /// What is there.
        found: String,
        /// What must be there.
        expected: String,
    },
    /// A line that cannot be.
    #[error("{file} line {line}: {problem}")]
    Line {
        /// Which of the CSVs.
        file: &'static str,
        /// Its line, from 1, the header being the first.
        line: u64,
        /// What is wrong, and how to mend it.
        problem: String,
    },
    /// Nodes that do not fit together.
    #[error(transparent)]
    Graph(#[from] GraphError),
    /// More nodes than ids.
    #[error("no id is left for {what}; use smaller ids, at most 16777215")]
    NoIdLeft {
        /// What would need one.
        what: String,
    },
}

/// Reads a log of object handling.
pub fn import(csv: &str, options: &Options<'_>) -> Result<Import, ActionsError> {
    let rows = rows::read(csv)?;
    let mut report = ImportReport::default();
    let initial = options.initial_csv.map(homes::read).transpose()?.unwrap_or_default();
    let things = rows.iter().map(|row| row.object).chain(initial.keys().copied());
    let things = things.map(crate::graph::NodeId::index).collect();
    let mut places = places::Places::new(options, &rows, &things)?;
    let homes = homes::find(&mut places, options, &rows, &initial, &mut report)?;
    places.tell(&mut report);
    let graph = places.graph;
    let inputs = days::play(&graph, &homes, &rows, options, &places.destinations, &mut report);
    report.count_graph(&graph);
    report.count("rows", rows.len() as u64);
    report.count("events", inputs.len() as u64);
    Ok(Import { graph, start: options.start, inputs, report })
}
