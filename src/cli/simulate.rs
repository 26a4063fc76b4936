//! `scenefold simulate`

use std::io::Write;
use std::path::PathBuf;
use std::sync::Arc;

use anyhow::Context;
use serde::Serialize;

use super::Outcome;
use super::output::Output;
use super::progress::counter;
use super::source::text;
use crate::simulation::house::{self, House};
use crate::simulation::record::{Simulated, SimulationError, record};
use crate::simulation::scenario::{Draw, Scenario, generate, paper_mission};
use crate::simulation::sensor::NoiseConfig;

/// Simulate a robot in a house, and record what it gets
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Writes a recording of inputs only (pictures, poses, what people say, what the robot is told and
reports), and the truth beside it: in.mcap and in.truth.mcap. Same house, scenario and seed, same
bytes. Without --scenario and --random it is the mission of the paper.

Examples:
  scenefold simulate --seed 1 -o in.mcap                     the paper's mission
  scenefold reprocess in.mcap -o mission.mcap                let the robot notice what changed
  scenefold simulate --house loft --random 3 --seed 7 -o r.mcap
  scenefold simulate --scenario mine.json -o mine.mcap
  scenefold simulate --round kitchen,bathroom -o walk.mcap   rooms in the order of a patrol
  scenefold simulate --random 2 --seed 5 --print             the scenario, to start from
  scenefold log in.truth.mcap                                what really changed")]
pub struct Simulate {
    /// Built-in house, house file or VirtualHome graph, instead of the scenario's
    #[arg(long, value_name = "HOUSE")]
    house: Option<String>,
    /// Scenario file
    #[arg(long, value_name = "FILE", conflicts_with = "random")]
    scenario: Option<PathBuf>,
    /// A random scenario with N removals, N moves, N additions and a task
    #[arg(long, value_name = "N")]
    random: Option<u32>,
    /// Seed of everything random, instead of the scenario's
    #[arg(long, value_name = "K")]
    seed: Option<u64>,
    /// New recording; the truth goes beside it
    #[arg(short, long, value_name = "REC", required_unless_present = "print")]
    out: Option<PathBuf>,
    /// Rooms that the robot goes round, in this order, as `scenefold patrol` plans them
    #[arg(long, value_name = "ROOM,…", value_delimiter = ',')]
    round: Vec<String>,
    /// Sensors without noise
    #[arg(long)]
    no_noise: bool,
    /// Size of pictures in pixels, such as 640x480, instead of the scenario's
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<(u32, u32)>,
    /// Pictures per second, instead of the scenario's
    #[arg(long, value_name = "HZ")]
    rate: Option<f64>,
    /// Print the scenario as a file, and simulate nothing
    #[arg(long)]
    print: bool,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

fn size(text: &str) -> Result<(u32, u32), String> {
    let parsed = text.split_once('x').and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
    parsed.ok_or_else(|| format!("{text:?} is no size such as 640x480"))
}

#[derive(Serialize)]
struct SimulateDocument<'a> {
    recording: String,
    truth: String,
    scenario: &'a str,
    house: &'a str,
    seed: u64,
    seconds: f64,
    pictures: u64,
    changes: u64,
    metres: f64,
}

/// Runs `scenefold simulate`.
pub fn run(args: &Simulate, out: &mut Output) -> anyhow::Result<Outcome> {
    let (scenario, house) = args.scenario()?;
    let Some(path) = args.out.as_ref().filter(|_| !args.print) else {
        writeln!(out, "{}", scenario.to_json())?;
        return Ok(Outcome::Clean);
    };
    let progress = counter("seconds simulated");
    let done = record(&scenario, &house, path, &mut |s| progress.set_position(s as u64)).map_err(
        |error| match error {
            SimulationError::Story(_) => anyhow::Error::from(error).context(source_name(args)),
            other => other.into(),
        },
    )?;
    progress.finish_and_clear();
    if args.json {
        out.json(&document(&scenario, &done))?;
    } else {
        print(&scenario, &done, out)?;
    }
    Ok(Outcome::Clean)
}

fn source_name(args: &Simulate) -> String {
    let file = args.scenario.as_ref().map(|path| path.display().to_string());
    file.unwrap_or_else(|| "the scenario".to_owned())
}

fn document<'a>(scenario: &'a Scenario, done: &Simulated) -> SimulateDocument<'a> {
    SimulateDocument {
        recording: done.recording.display().to_string(),
        truth: done.truth.display().to_string(),
        scenario: &scenario.name,
        house: &scenario.house,
        seed: scenario.seed,
        seconds: done.seconds,
        pictures: done.pictures,
        changes: done.changes,
        metres: crate::simulation::robot::path::length(&done.way),
    }
}

fn print(scenario: &Scenario, done: &Simulated, out: &mut Output) -> anyhow::Result<()> {
    let it = document(scenario, done);
    writeln!(out, "{} in the house {:?}, seed {}", it.scenario, it.house, it.seed)?;
    writeln!(
        out,
        "  {:.0} s awake, {:.1} m driven, {} pictures, {} true changes",
        it.seconds, it.metres, it.pictures, it.changes
    )?;
    writeln!(out, "  inputs  {}", it.recording)?;
    writeln!(out, "  truth   {}", it.truth)?;
    Ok(())
}

impl Simulate {
    /// The scenario as the flags want it, and its house.
    fn scenario(&self) -> anyhow::Result<(Scenario, Arc<House>)> {
        let mut scenario = match &self.scenario {
            Some(path) => {
                Scenario::from_json(&text(path)?).with_context(|| path.display().to_string())?
            }
            None => paper_mission(self.seed.unwrap_or(0)),
        };
        if let Some(house) = &self.house {
            scenario.house.clone_from(house);
        }
        let house = Arc::new(house::load(&scenario.house)?);
        if let Some(count) = self.random {
            let draw = Draw { removed: count, moved: count, added: count, ..Draw::default() };
            scenario = generate(&scenario.house, &house, self.seed.unwrap_or(0), draw);
        }
        if !self.round.is_empty() {
            scenario.robot.round.clone_from(&self.round);
        }
        self.adjust(&mut scenario);
        Ok((scenario, house))
    }

    fn adjust(&self, scenario: &mut Scenario) {
        let camera = &mut scenario.robot.camera;
        (camera.width, camera.height) = self.size.unwrap_or((camera.width, camera.height));
        camera.rate_hz = self.rate.unwrap_or(camera.rate_hz);
        scenario.seed = self.seed.unwrap_or(scenario.seed);
        if self.no_noise {
            scenario.noise = NoiseConfig::none();
        }
    }
}
