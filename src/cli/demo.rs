//! `scenefold demo`, also what `scenefold` alone does

use super::Outcome;
use super::output::Output;

/// A tour on a built-in recording
#[derive(Debug, Default, clap::Args)]
pub struct Demo {}

/// Runs `scenefold demo`.
pub fn run(_: &Demo, _: &mut Output) -> anyhow::Result<Outcome> {
    Ok(Outcome::Clean)
}
