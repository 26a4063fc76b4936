//! `--decay` and `--time-model`, as several commands take them.

use std::path::{Path, PathBuf};

use anyhow::Context;

use super::UsageError;
use super::source::text;
use crate::learn::{Beliefs, Learned, TimeModel};
use crate::updater::Config;

/// How the probability that things are still where they were is told.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct BeliefArgs {
    /// How fast things move: a table written by hand or by learn-decay; default: λ of each node
    #[arg(long, value_name = "FILE")]
    decay: Option<PathBuf>,
    /// How time is thought to work: sigmoid (the paper's), birth-death (things come back) or
    /// places (by place and hour of the day); the last two need --decay
    #[arg(long, value_name = "MODEL", default_value_t)]
    time_model: TimeModel,
}

/// Settings of time in a new recording.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct DecayArgs {
    /// How fast things move, recorded with it: a table written by hand or by learn-decay
    #[arg(long, value_name = "FILE")]
    decay: Option<PathBuf>,
    /// Report what is there with less than this probability as a target to look at
    #[arg(long, value_name = "P")]
    stale_below: Option<f64>,
}

/// What a file says of how fast things move.
pub fn learned(path: &Path) -> anyhow::Result<Learned> {
    let mut learned =
        Learned::from_json(&text(path)?).with_context(|| path.display().to_string())?;
    if learned.table.name.is_empty() {
        learned.table.name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    }
    Ok(learned)
}

impl BeliefArgs {
    /// What was learned, if a file was given.
    pub fn learned(&self) -> anyhow::Result<Option<Learned>> {
        if self.decay.is_none() && self.time_model != TimeModel::Sigmoid {
            let what = format!(
                "--time-model {} needs rates: give --decay FILE, as `scenefold learn-decay` writes it",
                self.time_model
            );
            return Err(UsageError(what).into());
        }
        self.decay.as_deref().map(learned).transpose()
    }

    /// The model, over what [`Self::learned`] gave.
    pub fn beliefs<'l>(&self, learned: Option<&'l Learned>) -> Beliefs<'l> {
        Beliefs { model: self.time_model, learned }
    }
}

impl DecayArgs {
    /// `config`, with these settings.
    pub fn apply(&self, mut config: Config) -> anyhow::Result<Config> {
        if let Some(path) = &self.decay {
            config.decay = Some(learned(path)?.table);
        }
        if let Some(threshold) = self.stale_below {
            config.stale_below = Some(threshold);
            let checked = Config::from_json(&config.to_json());
            return checked.map_err(|error| UsageError(format!("--stale-below: {error}")).into());
        }
        Ok(config)
    }

    /// Whether nothing is set.
    pub fn is_empty(&self) -> bool {
        self.decay.is_none() && self.stale_below.is_none()
    }
}
