//! The integration tests: one binary, so that it is linked once.
//!
//! - `laws`: properties of the whole pipeline over random inputs.
//! - `golden`: recordings of the past give the states they always gave.
//! - `synthetic`: the recording that holds every primitive and every rejection.
//! - `kill`: a recorder that is killed loses nothing it acknowledged.
//! - `mutations`, `forged`: damaged and edited files.
//! - `cli`: the program at its boundary.
//! - `language`: what models say, and what becomes of it.
//! - `patrol_gain`: what a planned patrol is worth against a fixed round.
//! - `python`: other readers agree.
//! - `readme`: the front door tells the truth.
//! - `fuzz_seeds`: what fuzzing starts from.
//! - `simulate`: what a simulated robot gets, and the truth.
//! - `utterances`: what people say, in numbers.
//! - `tidy`: the shape of the sources.

// Tests are read far more often than they run.
#![allow(clippy::format_push_string, clippy::format_collect, clippy::needless_for_each)]

mod cli;
mod forged;
mod fuzz_seeds;
mod golden;
mod house;
mod kill;
mod language;
mod laws;
mod mutations;
mod patrol_gain;
mod python;
mod readme;
mod sha256;
mod simulate;
mod synthetic;
mod tidy;
mod utterances;

// What the strategies of the crate's own tests name as `crate::…`.
use scenefold::{change, event, geometry, graph, time};

#[allow(dead_code)]
#[path = "../../src/testing.rs"]
mod testing;
