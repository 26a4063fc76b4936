//! `scenefold diff`

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;

use super::output::Output;
use super::replay::state_at;
use super::source::{self, is_mcap, text};
use super::{Outcome, UsageError};
use crate::geometry::Tolerance;
use crate::graph::SceneGraph;
use crate::history::{Diff as GraphDiff, DiffDocument};
use crate::interchange::scene;
use crate::recording::Recording;
use crate::time::At;

/// What changed between two points of a recording, or between two recordings
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  scenefold diff day.mcap --from start --to end
  scenefold diff day.mcap --from 8h --to 20h --json
  scenefold diff monday.mcap tuesday.mcap            the last states of two recordings
  scenefold diff day.mcap expected.json              a recording against a scene
Exits with 3 if there are differences.")]
pub struct Diff {
    /// Recording (or scene JSON) to compare from
    #[arg(value_name = "REC")]
    a: PathBuf,
    /// Second recording (or scene JSON) to compare to; the same one if left out
    #[arg(value_name = "REC2")]
    b: Option<PathBuf>,
    /// Point in the first one; start if there is no second one, else end
    #[arg(long, value_name = "AT")]
    from: Option<At>,
    /// Point in the second one
    #[arg(long, value_name = "AT", default_value = "end")]
    to: At,
    /// Positions and sizes closer than this count as equal
    #[arg(long, value_name = "METRES", default_value_t = 0.0)]
    tolerance: f64,
    /// Orientations closer than this count as equal
    #[arg(long, value_name = "RADIANS", default_value_t = 0.0)]
    angle_tolerance: f64,
    /// Also report objects that were only seen again
    #[arg(long)]
    observed: bool,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

/// Runs `scenefold diff`.
pub fn run(args: &Diff, out: &mut Output) -> anyhow::Result<Outcome> {
    let tolerance = args.tolerance()?;
    let default_from = if args.b.is_some() { At::End } else { At::Start };
    let a = Side::open(&args.a)?;
    let from = a.graph(args.from.unwrap_or(default_from))?;
    let to = match &args.b {
        Some(b) => Side::open(b)?.graph(args.to)?,
        // Opened once: standard input cannot be read twice.
        None => a.graph(args.to)?,
    };
    let compare = if args.observed { GraphDiff::complete } else { GraphDiff::between };
    let diff = compare(&from, &to, &tolerance);
    if args.json {
        out.json(&DiffDocument::of(&diff))?;
    } else if diff.is_empty() {
        writeln!(out, "no difference")?;
    } else {
        write!(out, "{diff}")?;
    }
    Ok(if diff.is_empty() { Outcome::Clean } else { Outcome::Findings })
}

impl Diff {
    fn tolerance(&self) -> anyhow::Result<Tolerance> {
        let valid = |value: f64| value.is_finite() && value >= 0.0;
        if valid(self.tolerance) && valid(self.angle_tolerance) {
            return Ok(Tolerance { distance_m: self.tolerance, angle_rad: self.angle_tolerance });
        }
        Err(UsageError("a tolerance must be a number ≥ 0".to_owned()).into())
    }
}

/// What is compared: any state of a recording, or the one of a scene.
enum Side {
    Recording(Recording),
    Scene(SceneGraph),
}

impl Side {
    fn open(path: &Path) -> anyhow::Result<Self> {
        if path.as_os_str() == "-" || is_mcap(path) || !looks_like_json(path) {
            return Ok(Self::Recording(source::open(path)?));
        }
        let import = scene::import(&text(path)?).with_context(|| path.display().to_string())?;
        Ok(Self::Scene(import.graph))
    }

    fn graph(&self, at: At) -> anyhow::Result<SceneGraph> {
        match self {
            Self::Recording(recording) => {
                let state = state_at(recording, at)?;
                source::warn(recording);
                Ok(state.world.graph().clone())
            }
            Self::Scene(graph) => Ok(graph.clone()),
        }
    }
}

fn looks_like_json(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension == "json")
}
