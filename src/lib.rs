//! Event-sourced record-and-replay of dynamic 3D scene graphs.
//!
//! A robot carries a 3D scene graph: rooms and the objects in them. The world it shares with
//! people changes, and four modalities notice: people's words, the robot's own actions, its
//! camera, and time. All of them speak one *unified language*, the change record, which is
//! compiled to a few graph primitives (E. Olivastri et al., "Multi-Modal 3D Scene Graph Updater
//! for Shared and Dynamic Environments", 2024; cited here as *the paper*).
//!
//! scenefold records every input, every change and every primitive in MCAP files. The graph is
//! a pure fold of the primitives, so any past belief is rebuilt bit for bit, and traced to the
//! message that caused it.
//!
//! # The house
//! Lowest first; a module uses only those above it in this list. A test holds it to that.
//!
//! | module | job | IO |
//! |---|---|---|
//! | [`time`] | instants on the recording clock, and how a person names one | no |
//! | [`geometry`] | poses, boxes, tolerances, all on one exact grid | no |
//! | `bytes` | varints: the alphabet of canonical bytes | no |
//! | [`graph`] | the scene graph as a value, its canonical bytes, its hash | no |
//! | [`change`] | change records, primitives, transactions, the planner between them | no |
//! | [`event`] | everything that stands in a log, and the log's order | no |
//! | [`modality`] | the detectors: robot action, human language, time | no |
//! | [`updater`] | U: one input in, records out; where detectors meet the graph | no |
//! | [`document`] | the JSON documents of the command line | no |
//! | [`history`] | diff, why, bisect | no |
//! | [`learn`] | how long things stay, learned from logs; how good predictions are | no |
//! | [`patrol`] | in which order to look into rooms | no |
//! | [`wire`] | protobuf and CDR contracts to events and back | no |
//! | [`interchange`] | scenes of others in and out: parsers and printers | no |
//! | [`container`] | MCAP files as raw messages, whole or damaged | yes |
//! | [`recording`] | write, replay, seek, verify, recover, reprocess | yes |
//! | [`model`] | language models: a chat server, label embeddings | yes |
//! | [`simulation`] | a house, its people, its robot and what the camera sees | at the edge |
//! | [`snapshot`] | a recording as text, for regression tests | no |
//! | [`view`] | floor plans and diagrams: SVG, PNG | no |
//! | [`cli`] | one file per command; terminal, environment, exit codes | yes |
//!
//! # One update
//! A `TaskStatus` arrives at a [`recording::Recorder`]. The [`updater`] shows it to
//! [`modality::action`], which claims a change; the [`change`] planner finds the node and plans
//! primitives, or rejects the claim with a reason; the primitives are applied as one
//! [`change::Transaction`]. Input, evidence, change record and transaction go through [`wire`]
//! into the file. A replay is the last step read back: transactions in, graph out.
//!
//! # Invariants
//! - Invariant: a graph changes only through [`change::Primitive::apply`]; a refused one changes
//!   nothing, and a transaction is applied whole or not at all.
//! - Invariant: the core (all modules without IO) reads no clock, file or environment, iterates
//!   nothing in hash order, and takes no platform mathematics; lints deny it.
//! - Invariant: same log, same state, same hash, on every machine and any number of threads.
//! - Invariant: same inputs, same options, same bytes in the file.
//! - Invariant: (log time, position in the file) is the order in which events arrived, and log
//!   time never decreases.
//! - Invariant: every change record names the messages it rests on; every primitive names the
//!   change or the message that caused it.
//! - Invariant: claims that are ambiguous, impossible or contradicted are recorded as rejected,
//!   never dropped.
//! - Invariant: node ids are never used for another thing; what leaves and comes back keeps its.
//! - Invariant: what was acknowledged survives `kill -9`; chunks are closed between updates, so
//!   a torn file never shows half of one.
//! - Invariant: checkpoints are caches, verified by hash before use; no state depends on them.
//! - Invariant: no bytes make a reader panic, abort, hang or allocate without bound, and damage
//!   costs no more than the chunk it lies in.
//! - Invariant: every pose lies on a grid of a micrometre and 1e-7 of a unit quaternion, so
//!   equality is exact and text, JSON and integers carry it without loss.
//!
//! # Where this goes beyond or besides the design
//! - An object in the gripper stays in the graph as *held*, but is not among its objects: it is
//!   temporarily removed, as the paper has it, and keeps its attributes and id.
//! - A task status may itself name the object, room and support, so that one report is one event.
//! - Time makes no change records: an object that has become improbable is reported on
//!   `/evidence/staleness`, as a wish for a look, and stays where the graph has it.
//! - The decay table and the threshold of staleness are off unless configured, so that what older
//!   recordings derive stays as it was.
//! - The MCAP framing is our own (record types are those of the `mcap` crate): see [`container`].
//!
//! # Use as a library
//! ```
//! use scenefold::event::Event;
//! use scenefold::interchange::{lines, scene};
//! use scenefold::recording::{Recorder, RecorderOptions, Recording};
//! use scenefold::time::At;
//! use scenefold::updater::Config;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let folder = tempfile::tempdir()?;
//! let path = folder.path().join("live.mcap");
//! let scene = scene::import(
//!     r#"{"rooms": [{"label": "kitchen"}, {"label": "bedroom"}],
//!         "objects": [{"label": "mug", "room": "kitchen"}]}"#,
//! )?;
//! let mut recorder = Recorder::create(&path, Config::default(), &RecorderOptions::default())?;
//! recorder.record(scene.start, Event::InitialGraph(scene.graph))?;
//! let (at, input) = lines::parse(
//!     r#"{"at": "2026-01-05T08:00:00Z", "topic": "/robot/task_status", "message":
//!         {"task_id": "t1", "status": "picked", "object": {"label": "mug"}}}"#,
//! )?;
//! recorder.record(at, input)?;
//! recorder.finish()?;
//!
//! let recording = Recording::open(&path)?;
//! assert_eq!(recording.state_at(At::Start, 1)?.graph().objects().count(), 1);
//! assert_eq!(recording.state_at(At::End, 1)?.graph().objects().count(), 0);
//! assert_eq!(recording.state_at(At::End, 1)?.graph().held().count(), 1);
//! # Ok(())
//! # }
//! ```
//!
//! # Words
//! | word | meaning |
//! |---|---|
//! | recording | an MCAP file, or a folder of segments |
//! | event | a message of the log: input, model output or derived record; numbered from 1, `#42` |
//! | change record | what changed, in the unified language; numbered from 1, `c7` |
//! | claim | what a change record says, before and after it is known which node is meant |
//! | primitive | smallest edit of a graph |
//! | transaction | the primitives of one update |
//! | evidence | the messages a change rests on |
//! | held | in the gripper: temporarily removed |
//! | topological | of a pose: only the room or the support is known |
//! | checkpoint | the full state after some event, a cache |
//! | chain | running hash over the events |
//! | stale | of a belief: probably no longer true |
//! | dwell | how long a thing stayed, as far as two looks tell |

macro_rules! core_modules {
    ($($(#[$meta:meta])* $vis:vis mod $name:ident;)*) => {
        $(
            $(#[$meta])*
            #[deny(clippy::disallowed_types, clippy::disallowed_methods)]
            $vis mod $name;
        )*
    };
}

core_modules! {
    pub mod time;
    pub mod geometry;
    mod bytes;
    pub mod graph;
    pub mod change;
    pub mod event;
    pub mod modality;
    pub mod updater;
    pub mod document;
    pub mod history;
    pub mod learn;
    pub mod patrol;
    pub mod wire;
    pub mod interchange;
}
pub mod cli;
pub mod container;
pub mod model;
pub mod recording;
pub mod simulation;
pub mod snapshot;
pub mod view;

#[cfg(test)]
mod testing;
