//! `scenefold ingest`

use std::io::{self, BufRead, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::time::Duration;

use anyhow::Context;
use clap::ValueEnum;
use serde::Serialize;

use super::output::Output;
use super::replay::state_at;
use super::source::{self, is_mcap, text};
use super::{Outcome, UsageError};
use crate::event::Event;
use crate::interchange::lines;
use crate::interchange::scene;
use crate::recording::{Recorded, Recorder, RecorderOptions, SyncPolicy};
use crate::time::{At, Span, Stamp};
use crate::updater::Config;

/// Record inputs as they arrive on standard input, a JSON document per line
#[derive(Debug, clap::Args)]
#[command(after_help = "\
A line names the time, the topic and the message:
  {\"at\":\"2026-01-05T08:00:00Z\",\"topic\":\"/robot/task\",\"message\":{\"task_id\":\"t1\",
   \"instruction\":\"Take the mug to the bedroom.\",\"object\":{\"label\":\"mug\"},
   \"target_room\":{\"label\":\"bedroom\"}}}
  {\"at\":\"2026-01-05T08:01:00Z\",\"topic\":\"/robot/task_status\",
   \"message\":{\"task_id\":\"t1\",\"status\":\"picked\"}}
Each update is answered by a line {\"order\":…,\"acknowledged\":…,\"changes\":[…]}; once an event
number is acknowledged, everything up to it survives a crash as the --sync policy says.
A line that is refused is answered by {\"line\":…,\"error\":…} and changes nothing.

Examples:
  scenefold ingest --graph scene.json -o live.mcap < inputs.ndjson
  robot_bridge | scenefold ingest -o segments/ --sync every      a folder can be gone on with
Exits with 3 if a line was refused or a change rejected.")]
pub struct Ingest {
    /// New recording, or a folder of segments to go on with
    #[arg(short, long, value_name = "REC")]
    out: PathBuf,
    /// Graph to start from: scene JSON, or the last state of a recording
    #[arg(long, value_name = "GRAPH")]
    graph: Option<PathBuf>,
    /// When an update is acknowledged
    #[arg(long, default_value = "none")]
    sync: Sync,
    /// With --sync interval: how often the disk is synced; with any policy: how long an update
    /// waits for an acknowledgement when no other follows
    #[arg(long, value_name = "SPAN", default_value = "1s")]
    interval: Span,
    /// Configuration (JSON) of a new recording
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Sync {
    /// Once it is on the disk
    Every,
    /// Once it is on the disk, which is synced at most every --interval
    Interval,
    /// Once the operating system has it
    #[value(alias = "never")]
    None,
}

#[derive(Serialize)]
struct Acknowledgement {
    order: u64,
    acknowledged: u64,
    changes: Vec<crate::document::ChangeDocument>,
}

#[derive(Serialize)]
struct Refusal {
    line: u64,
    error: String,
}

/// Runs `scenefold ingest`.
pub fn run(args: &Ingest, out: &mut Output) -> anyhow::Result<Outcome> {
    let mut recorder = args.recorder()?;
    let mut outcome = Outcome::Clean;
    let lines = lines_of_stdin();
    let idle = Duration::from_nanos(args.interval.0);
    let mut number = 0;
    loop {
        let line = match lines.recv_timeout(idle) {
            Ok(line) => line.context("reading standard input")?,
            // Nobody says anything: what was said last should not wait for more.
            Err(RecvTimeoutError::Timeout) => {
                if recorder.acknowledged() < recorder.updater().order() {
                    acknowledge(&mut recorder, out)?;
                }
                continue;
            }
            Err(RecvTimeoutError::Disconnected) => break,
        };
        number += 1;
        if !line.trim().is_empty() && !take(&mut recorder, &line, number, out)? {
            outcome = Outcome::Findings;
        }
        out.flush()?;
    }
    acknowledge(&mut recorder, out)?;
    recorder.finish()?;
    Ok(outcome)
}

/// Lines as they arrive, read by a thread so that waiting for one can be given up.
fn lines_of_stdin() -> Receiver<io::Result<String>> {
    let (sender, receiver) = sync_channel(1024);
    std::thread::spawn(move || {
        for line in io::stdin().lock().lines() {
            if sender.send(line).is_err() {
                return;
            }
        }
    });
    receiver
}

/// Makes everything safe, and says so.
fn acknowledge(recorder: &mut Recorder, out: &mut Output) -> anyhow::Result<()> {
    let (acknowledged, order) = (recorder.sync()?, recorder.updater().order());
    out.json_line(&Acknowledgement { order, acknowledged, changes: Vec::new() })?;
    out.flush()?;
    Ok(())
}

/// Records one line and answers it; `false` if it was refused or rejected.
fn take(
    recorder: &mut Recorder,
    line: &str,
    number: u64,
    out: &mut Output,
) -> anyhow::Result<bool> {
    let refuse = |out: &mut Output, error: String| {
        out.json_line(&Refusal { line: number, error })?;
        Ok(false)
    };
    let (at, event) = match lines::parse(line) {
        Ok(input) => input,
        Err(error) => return refuse(out, error.to_string()),
    };
    match recorder.record(at, event) {
        Ok(recorded) => {
            let (answer, clean) = answer(&recorded);
            out.json_line(&answer)?;
            Ok(clean)
        }
        Err(crate::recording::RecordError::Update(error)) => refuse(out, error.to_string()),
        Err(error) => Err(error.into()),
    }
}

fn answer(recorded: &Recorded) -> (Acknowledgement, bool) {
    let mut clean = true;
    let changes = recorded.events.iter().filter_map(|logged| match &logged.event {
        Event::Change(record) => {
            clean &= record.is_applied();
            Some(crate::document::ChangeDocument::of(record))
        }
        _ => None,
    });
    let changes = changes.collect();
    let order = recorded.events[0].order;
    (Acknowledgement { order, acknowledged: recorded.acknowledged, changes }, clean)
}

impl Ingest {
    fn recorder(&self) -> anyhow::Result<Recorder> {
        let sync = match self.sync {
            Sync::Every => SyncPolicy::Every,
            Sync::Interval => SyncPolicy::Interval(Duration::from_nanos(self.interval.0)),
            Sync::None => SyncPolicy::Never,
        };
        let options = RecorderOptions { sync, ..RecorderOptions::default() };
        let goes_on = self.out.is_dir() && std::fs::read_dir(&self.out)?.next().is_some();
        if goes_on {
            if self.graph.is_some() || self.config.is_some() {
                let what = "a recording that is gone on with has its graph and configuration already: \
                            leave out --graph and --config";
                return Err(UsageError(what.to_owned()).into());
            }
            return Ok(Recorder::append(&self.out, &options)?);
        }
        let config = match &self.config {
            Some(path) => {
                Config::from_json(&text(path)?).with_context(|| path.display().to_string())?
            }
            None => Config::default(),
        };
        let initial = self.graph.as_deref().map(initial_graph).transpose()?;
        let mut recorder = Recorder::create(&self.out, config, &options)?;
        if let Some((graph, at)) = initial {
            recorder.record(at, Event::InitialGraph(graph))?;
        }
        Ok(recorder)
    }
}

fn initial_graph(path: &Path) -> anyhow::Result<(crate::graph::SceneGraph, Stamp)> {
    if is_mcap(path) {
        let recording = source::open(path)?;
        let state = state_at(&recording, At::End)?;
        return Ok((state.world.graph().clone(), state.at));
    }
    let import = scene::import(&text(path)?).with_context(|| path.display().to_string())?;
    Ok((import.graph, import.start))
}
