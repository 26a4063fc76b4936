//! The command line: one file per command; the terminal, the environment, exit codes.
//!
//! Exit codes: 0 clean; 1 failure; 2 usage; 3 finished with findings (differences, damage,
//! rejections). Everything a command does is a documented function of the crate.

mod bisect;
mod calibrate;
mod decay;
mod demo;
mod diff;
mod export;
mod house;
mod import;
mod info;
mod ingest;
mod language;
mod learn_decay;
mod log;
mod output;
mod patrol;
mod plan;
mod progress;
mod recover;
mod render;
mod replay;
mod reprocess;
mod simulate;
mod snapshot;
mod source;
mod tell;
mod tell_explain;
mod verify;
mod why;

use std::io::{self, Write};
use std::process::ExitCode;

use clap::{Parser, Subcommand};

use output::Output;

/// Record, replay and audit what a robot believes of a changing 3D scene.
///
/// A recording is an MCAP file, or a folder of segments, that holds everything people, the robot
/// and its sensors said, and every change it made to the robot's scene graph. Any past belief is
/// rebuilt from it bit for bit, and traced to the message that caused it.
#[derive(Debug, Parser)]
#[command(name = "scenefold", version, max_term_width = 100, after_help = EXAMPLES)]
pub struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
}

const EXAMPLES: &str = "\
Examples:
  scenefold                                     a tour on a built-in recording
  scenefold import actions day.csv -o day.mcap  make a recording of a household's day
  scenefold why day.mcap mug                    why the robot believes what it does of the mug
  scenefold replay day.mcap --at 36h            the graph after a day and a half
  scenefold diff day.mcap --from start --to end what has changed
  scenefold verify day.mcap                     is it whole, and does it replay to the same state

AT is one of: start, end, 12.5s, 36h, 65d (from the start), 2026-01-05T08:00:00Z, #42 (event),
c7 (change), or nanoseconds since 1970.
Exit codes: 0 clean, 1 failure, 2 usage, 3 finished with findings.";

#[derive(Debug, Subcommand)]
enum Command {
    Info(info::Info),
    Log(log::Log),
    Replay(replay::Replay),
    Diff(diff::Diff),
    Why(why::Why),
    Bisect(bisect::Bisect),
    Reprocess(reprocess::Reprocess),
    Verify(verify::Verify),
    Recover(recover::Recover),
    Snapshot(snapshot::Snapshot),
    Import(import::Import),
    Export(export::Export),
    Ingest(ingest::Ingest),
    Simulate(simulate::Simulate),
    House(house::House),
    Plan(plan::Plan),
    Render(render::Render),
    Tell(tell::Tell),
    LearnDecay(learn_decay::LearnDecay),
    Patrol(patrol::Patrol),
    Calibrate(calibrate::Calibrate),
    Demo(demo::Demo),
}

/// How a command ended, if it did not fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Nothing to report.
    Clean,
    /// There were differences, damage or rejections.
    Findings,
}

/// Wrong use that only shows when the command runs; exits with 2.
#[derive(Debug, thiserror::Error)]
#[error("{0}")]
pub struct UsageError(pub String);

/// Runs the program with the arguments of the process.
pub fn main() -> ExitCode {
    let cli = Cli::parse();
    let mut out = Output::new();
    let result = cli.run(&mut out).and_then(|outcome| {
        out.flush()?;
        Ok(outcome)
    });
    match result {
        Ok(Outcome::Clean) => ExitCode::SUCCESS,
        Ok(Outcome::Findings) => ExitCode::from(3),
        // Whoever reads us has seen enough, as `head` does.
        Err(error) if is_broken_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            // A closed stderr is no reason to panic.
            let _ = writeln!(io::stderr(), "error: {error:#}");
            ExitCode::from(if error.is::<UsageError>() { 2 } else { 1 })
        }
    }
}

impl Cli {
    fn run(self, out: &mut Output) -> anyhow::Result<Outcome> {
        match self.command.unwrap_or(Command::Demo(demo::Demo::default())) {
            Command::Info(args) => info::run(&args, out),
            Command::Log(args) => log::run(&args, out),
            Command::Replay(args) => replay::run(&args, out),
            Command::Diff(args) => diff::run(&args, out),
            Command::Why(args) => why::run(&args, out),
            Command::Bisect(args) => bisect::run(&args, out),
            Command::Reprocess(args) => reprocess::run(&args, out),
            Command::Verify(args) => verify::run(&args, out),
            Command::Recover(args) => recover::run(&args, out),
            Command::Snapshot(args) => snapshot::run(&args, out),
            Command::Import(args) => import::run(&args, out),
            Command::Export(args) => export::run(&args, out),
            Command::Ingest(args) => ingest::run(&args, out),
            Command::Simulate(args) => simulate::run(&args, out),
            Command::House(args) => house::run(&args, out),
            Command::Plan(args) => plan::run(&args, out),
            Command::Render(args) => render::run(&args, out),
            Command::Tell(args) => tell::run(&args, out),
            Command::LearnDecay(args) => learn_decay::run(&args, out),
            Command::Patrol(args) => patrol::run(&args, out),
            Command::Calibrate(args) => calibrate::run(&args, out),
            Command::Demo(args) => demo::run(&args, out),
        }
    }
}

fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error.chain().any(|cause| {
        let io = cause.downcast_ref::<io::Error>().map(io::Error::kind);
        let json =
            cause.downcast_ref::<serde_json::Error>().and_then(serde_json::Error::io_error_kind);
        io.or(json) == Some(io::ErrorKind::BrokenPipe)
    })
}
