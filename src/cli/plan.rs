//! `scenefold plan`

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;

use super::output::Output;
use super::replay::state_at;
use super::source::{self, is_mcap, text};
use super::{Outcome, UsageError};
use crate::interchange::scene;
use crate::recording::RecordError;
use crate::simulation::house::{self, FileKind};
use crate::time::At;
use crate::view::plan::Plan as FloorPlan;
use crate::view::raster;

/// The floor plan of a house or of any state of a graph, as SVG or PNG
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  scenefold plan apartment -o plan.svg                 a built-in house
  scenefold plan my_house.json -o plan.png             a house file, a VirtualHome graph or a scene
  scenefold plan day.mcap --at 8h -o morning.png       a state of a recording
  scenefold plan day.mcap --since start -o changed.png what was added, removed and moved since
  scenefold plan mission.mcap --path -o way.png        the way of the robot, from /tf
  scenefold plan day.mcap --probability -o stale.svg   how sure it is that things are still there")]
pub struct Plan {
    /// Recording, scene (JSON), house file (JSON), VirtualHome graph (JSON) or built-in house
    #[arg(value_name = "SOURCE")]
    source: PathBuf,
    /// The point in a recording: start, end, 12.5s, 36h, 65d, an RFC 3339 instant, #42 or c7
    #[arg(long, value_name = "AT", default_value = "end")]
    at: At,
    /// Show what changed since this point
    #[arg(long, value_name = "AT")]
    since: Option<At>,
    /// Show by colour how probable it is that things are still where they were seen
    #[arg(long)]
    probability: bool,
    /// Draw the way of the robot, from /tf; FRAME is `base_link` if left out
    #[arg(long, value_name = "FRAME", num_args = 0..=1, default_missing_value = "base_link")]
    path: Option<String>,
    /// New file to write: .svg or .png; SVG to standard output if left out
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Pixels across of a PNG
    #[arg(long, value_name = "PIXELS", default_value_t = 1600, value_parser = clap::value_parser!(u32).range(16..=8192))]
    width: u32,
}

/// Runs `scenefold plan`.
pub fn run(args: &Plan, out: &mut Output) -> anyhow::Result<Outcome> {
    let png = match &args.out {
        Some(path) => is_png(path)?,
        None => false,
    };
    let (plan, outcome) = args.plan()?;
    let svg = plan.svg();
    let bytes = if png { raster::png(&svg, args.width)? } else { svg.into_bytes() };
    match &args.out {
        Some(path) => File::create_new(path)
            .and_then(|mut file| file.write_all(&bytes))
            .map_err(|error| RecordError::io(path, error))?,
        None => out.write_all(&bytes)?,
    }
    Ok(outcome)
}

fn is_png(path: &Path) -> anyhow::Result<bool> {
    match path.extension().and_then(|extension| extension.to_str()) {
        Some("png") => Ok(true),
        Some("svg") => Ok(false),
        _ => {
            let name = path.display();
            Err(UsageError(format!("{name}: a plan is written to a .svg or a .png file")).into())
        }
    }
}

impl Plan {
    fn plan(&self) -> anyhow::Result<(FloorPlan, Outcome)> {
        let name = self.source.display().to_string();
        let built_in = house::BuiltIn::named(&name).is_some();
        if !built_in && (name == "-" || is_mcap(&self.source)) {
            return self.of_recording(&name);
        }
        if self.since.is_some() || self.probability || self.path.is_some() {
            let problem = "--since, --path and --probability are about recordings";
            return Err(UsageError(format!("{name}: {problem}")).into());
        }
        if !built_in && self.source.exists() {
            let text = text(&self.source)?;
            if house::kind(&text) == FileKind::Scene {
                let import = scene::import(&text).with_context(|| name.clone())?;
                return Ok((
                    FloorPlan::of_graph(&import.graph, &stem(&self.source)),
                    Outcome::Clean,
                ));
            }
        }
        Ok((FloorPlan::of_house(&house::load(&name)?), Outcome::Clean))
    }

    fn of_recording(&self, name: &str) -> anyhow::Result<(FloorPlan, Outcome)> {
        let recording = source::open(&self.source)?;
        let state = state_at(&recording, self.at)?;
        let mut title = format!("{}, {}", stem(Path::new(name)), state.at);
        let before = self.since.map(|since| state_at(&recording, since)).transpose()?;
        if let Some(before) = &before {
            title = format!("{title} since {}", before.at);
        }
        let mut plan = FloorPlan::of_graph(state.graph(), &title);
        if self.probability {
            plan = plan.with_probabilities(state.graph(), state.at);
        }
        if let Some(before) = &before {
            plan = plan.with_changes(before.graph(), state.graph());
        }
        if let Some(frame) = &self.path {
            let first = before.map_or(1, |before| before.order + 1);
            let way = recording.way_of(frame, first, state.order)?;
            if way.is_empty() {
                let what = format!("{name}: /tf tells nothing of a frame {frame:?} by then");
                return Err(anyhow::anyhow!("{what}; name another with --path FRAME"));
            }
            plan = plan.with_path(way);
        }
        Ok((plan, source::warn(&recording)))
    }
}

fn stem(path: &Path) -> String {
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    stem.unwrap_or_else(|| path.display().to_string()).replace('_', " ")
}
