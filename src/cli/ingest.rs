//! `scenefold ingest`

use std::io::{self, BufRead, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::time::Duration;

use anyhow::Context;
use clap::ValueEnum;
use serde::Serialize;

use super::decay::DecayArgs;
use super::language::LanguageArgs;
use super::output::Output;
use super::replay::state_at;
use super::source::{self, is_mcap, text};
use super::{Outcome, UsageError};
use crate::event::{Event, Logged};
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
Each update is answered by a line {\"order\":…,\"at\":…,\"acknowledged\":…,\"changes\":[…]}; once an event
number is acknowledged, everything up to it survives a crash as the --sync policy says.
A line that is refused is answered by {\"line\":…,\"error\":…} and changes nothing.

Examples:
  scenefold ingest --graph scene.json -o live.mcap < inputs.ndjson
  robot_bridge | scenefold ingest -o segments/ --sync every      a folder can be gone on with
  scenefold ingest -o live.mcap --server http://localhost:11434/v1 --model qwen2.5 < inputs.ndjson
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
    #[command(flatten)]
    language: LanguageArgs,
    #[command(flatten)]
    decay: DecayArgs,
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

/// Longest line that is taken: a sentence of the largest size, every byte of it escaped.
const LINE_BYTES: u64 = 8 << 20;

#[derive(Serialize)]
struct Acknowledgement {
    order: u64,
    /// Log time: later than what the line says if an event before it was later.
    at: String,
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
    let outcome = take_all(args, &mut recorder, out);
    // Whatever went wrong, what was taken is kept: the recording is ended either way.
    let ended = recorder.finish();
    let outcome = outcome?;
    ended?;
    Ok(outcome)
}

fn take_all(args: &Ingest, recorder: &mut Recorder, out: &mut Output) -> anyhow::Result<Outcome> {
    let mut outcome = Outcome::Clean;
    let lines = lines_of_stdin();
    let idle = Duration::from_nanos(args.interval.0);
    let mut number = 0;
    loop {
        let line = match lines.recv_timeout(idle) {
            Ok(line) => line?,
            // Nobody says anything: what was said last should not wait for more.
            Err(RecvTimeoutError::Timeout) => {
                if recorder.acknowledged() < recorder.updater().order() {
                    acknowledge(recorder, out)?;
                }
                continue;
            }
            Err(RecvTimeoutError::Disconnected) => break,
        };
        number += 1;
        if line.trim_ascii().is_empty() {
            continue;
        }
        if !take(recorder, &line, number, out)? {
            outcome = Outcome::Findings;
        }
        out.flush()?;
    }
    acknowledge(recorder, out)?;
    Ok(outcome)
}

/// Lines as they arrive, read by a thread so that waiting for one can be given up. Of a line that
/// is too long only the beginning is kept, enough to be refused.
fn lines_of_stdin() -> Receiver<io::Result<Vec<u8>>> {
    let (sender, receiver) = sync_channel(64);
    std::thread::spawn(move || {
        let mut stdin = io::stdin().lock();
        loop {
            let mut line = Vec::new();
            let read = (&mut stdin).take(LINE_BYTES + 1).read_until(b'\n', &mut line);
            let line = match read {
                Ok(0) => return,
                Ok(_) if line.len() as u64 > LINE_BYTES => skip_line(&mut stdin).map(|()| line),
                Ok(_) => Ok(line),
                Err(error) => Err(error),
            };
            let failed = line.is_err();
            if sender.send(line).is_err() || failed {
                return;
            }
        }
    });
    receiver
}

fn skip_line(input: &mut impl BufRead) -> io::Result<()> {
    loop {
        let buffer = input.fill_buf()?;
        let (n, done) = match buffer.iter().position(|byte| *byte == b'\n') {
            Some(end) => (end + 1, true),
            None => (buffer.len(), buffer.is_empty()),
        };
        input.consume(n);
        if done {
            return Ok(());
        }
    }
}

/// Makes everything safe, and says so.
fn acknowledge(recorder: &mut Recorder, out: &mut Output) -> anyhow::Result<()> {
    let (acknowledged, order) = (recorder.sync()?, recorder.updater().order());
    let (at, changes) = (recorder.updater().at().to_string(), Vec::new());
    out.json_line(&Acknowledgement { order, at, acknowledged, changes })?;
    out.flush()?;
    Ok(())
}

/// Records one line and answers it; `false` if it was refused or rejected.
fn take(
    recorder: &mut Recorder,
    line: &[u8],
    number: u64,
    out: &mut Output,
) -> anyhow::Result<bool> {
    let refuse = |out: &mut Output, error: String| {
        out.json_line(&Refusal { line: number, error })?;
        Ok(false)
    };
    if line.len() as u64 > LINE_BYTES {
        return refuse(out, format!("the line is longer than {LINE_BYTES} bytes"));
    }
    let Ok(line) = std::str::from_utf8(line) else {
        return refuse(out, "the line is not UTF-8 text".to_owned());
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
    let Logged { order, at, .. } = recorded.events[0];
    let at = at.to_string();
    (Acknowledgement { order, at, acknowledged: recorded.acknowledged, changes }, clean)
}

impl Ingest {
    fn recorder(&self) -> anyhow::Result<Recorder> {
        let sync = match self.sync {
            Sync::Every => SyncPolicy::Every,
            Sync::Interval => SyncPolicy::Interval(Duration::from_nanos(self.interval.0)),
            Sync::None => SyncPolicy::Never,
        };
        let options = RecorderOptions { sync, ..RecorderOptions::default() };
        if Recorder::can_append(&self.out)? {
            if self.graph.is_some() || self.config.is_some() || !self.decay.is_empty() {
                let what = "a recording that is gone on with has its graph and configuration already: \
                            leave out --graph, --config, --decay and --stale-below";
                return Err(UsageError(what.to_owned()).into());
            }
            return self.with_models(Recorder::append(&self.out, &options)?);
        }
        let config = match &self.config {
            Some(path) => {
                Config::from_json(&text(path)?).with_context(|| path.display().to_string())?
            }
            None => Config::default(),
        };
        let config = self.decay.apply(config)?;
        let config = self.language.applied_to(config);
        // Before the file is made, so that wrong use leaves none.
        self.language.models(&config)?;
        let initial = self.graph.as_deref().map(initial_graph).transpose()?;
        let recorder = Recorder::create(&self.out, config, &options)?;
        let mut recorder = self.with_models(recorder)?;
        if let Some((graph, at)) = initial {
            recorder.record(at, Event::InitialGraph(graph))?;
        }
        Ok(recorder)
    }

    fn with_models(&self, mut recorder: Recorder) -> anyhow::Result<Recorder> {
        let models = self.language.models(recorder.updater().config())?;
        recorder.set_language(Box::new(models));
        Ok(recorder)
    }
}

/// The graph of a scene, or the last state of a recording, and its moment.
pub(super) fn initial_graph(path: &Path) -> anyhow::Result<(crate::graph::SceneGraph, Stamp)> {
    if is_mcap(path) {
        let recording = source::open(path)?;
        let state = state_at(&recording, At::End)?;
        return Ok((state.world.graph().clone(), state.at));
    }
    let import = scene::import(&text(path)?).with_context(|| path.display().to_string())?;
    Ok((import.graph, import.start))
}
