//! `scenefold import`

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::Subcommand;
use serde::Serialize;

use super::Outcome;
use super::decay::DecayArgs;
use super::output::{Output, plain};
use super::progress::bar;
use super::replay::state_at;
use super::source::{self, is_mcap, text};
use crate::event::Event;
use crate::graph::SceneGraph;
use crate::interchange::{
    Import as Imported, ImportReport, actions, scene, spark_dsg, virtualhome,
};
use crate::recording::{Recorder, RecorderOptions, Seal};
use crate::time::{At, Stamp};
use crate::updater::Config;

/// Make a recording of a scene graph, or of what happened to one, from elsewhere
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  scenefold import scene scene.json -o new.mcap
  scenefold import spark-dsg dsg.json -o apartment.mcap        Hydra, Khronos, Clio
  scenefold import virtualhome scene2.json -o flat.mcap
  scenefold import actions household.csv --graph scene2.json --places places.csv \\
      --initial initial.csv -o household.mcap")]
pub struct Import {
    #[command(subcommand)]
    format: Format,
}

#[derive(Debug, Subcommand)]
enum Format {
    /// Our own JSON, as `replay --json` prints it; what a hand-written one leaves out gets defaults
    Scene(Plain),
    /// JSON of Spark-DSG: Hydra, Khronos, Clio; format versions 1.0.0 to 1.1.3
    SparkDsg(Plain),
    /// The graph of a VirtualHome apartment
    Virtualhome(Virtualhome),
    /// A CSV of who picked what and where it was put, on top of a graph
    #[command(after_help = ACTIONS)]
    Actions(Actions),
}

const ACTIONS: &str = "\
Columns of FILE:    split,day,minute,action,object,object_id,destination,destination_id
  split is train or test (test follows the last day of train), minute counts from midnight,
  action is grab, putback, putin or putobjback; destination ids are node ids of the graph.
Columns of --places:  id,class,room       furniture that the graph lacks
Columns of --initial: object,object_id,place   the arrangement every day starts from: what is
  elsewhere at midnight is put back by recorded events.";

#[derive(Debug, clap::Args)]
struct Target {
    /// New recording to write: a file, or a folder if it ends in /
    #[arg(short, long, value_name = "REC")]
    out: PathBuf,
    /// Configuration (JSON) to record with
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
    #[command(flatten)]
    decay: DecayArgs,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

#[derive(Debug, clap::Args)]
struct Plain {
    /// File to import, or - for standard input
    file: PathBuf,
    #[command(flatten)]
    target: Target,
}

#[derive(Debug, clap::Args)]
struct Virtualhome {
    /// File to import, or - for standard input
    file: PathBuf,
    /// Take floors, ceilings and walls as objects too
    #[arg(long)]
    structure: bool,
    #[command(flatten)]
    target: Target,
}

#[derive(Debug, clap::Args)]
struct Actions {
    /// File to import, or - for standard input
    file: PathBuf,
    /// Graph it happens in: a VirtualHome graph, scene JSON, or the last state of a recording
    #[arg(long, value_name = "GRAPH")]
    graph: Option<PathBuf>,
    /// Furniture that the graph lacks
    #[arg(long, value_name = "CSV")]
    places: Option<PathBuf>,
    /// The arrangement every day starts from
    #[arg(long, value_name = "CSV")]
    initial: Option<PathBuf>,
    /// Midnight of the first day
    #[arg(long, value_name = "INSTANT", default_value = "2026-01-05T00:00:00Z")]
    start: Stamp,
    #[command(flatten)]
    target: Target,
}

#[derive(Serialize)]
struct ImportDocument {
    recording: String,
    events: u64,
    changes: u64,
    primitives: u64,
    hash: String,
    chain: String,
    #[serde(flatten)]
    report: ImportReport,
}

/// Runs `scenefold import`.
pub fn run(args: &Import, out: &mut Output) -> anyhow::Result<Outcome> {
    match &args.format {
        Format::Scene(args) => {
            let imported = read(&args.file, scene::import)?;
            record(imported, &args.target, out)
        }
        Format::SparkDsg(args) => {
            let imported = read(&args.file, spark_dsg::import)?;
            record(imported, &args.target, out)
        }
        Format::Virtualhome(args) => {
            let options = virtualhome::Options {
                structure: args.structure,
                ..virtualhome::Options::default()
            };
            let imported = read(&args.file, |text| virtualhome::import(text, &options))?;
            record(imported, &args.target, out)
        }
        Format::Actions(args) => import_actions(args, out),
    }
}

fn read<E: std::error::Error + Send + Sync + 'static>(
    path: &Path,
    parse: impl FnOnce(&str) -> Result<Imported, E>,
) -> anyhow::Result<Imported> {
    parse(&text(path)?).with_context(|| path.display().to_string())
}

fn import_actions(args: &Actions, out: &mut Output) -> anyhow::Result<Outcome> {
    let graph = args.graph.as_deref().map(|path| base_graph(path, args.start)).transpose()?;
    let places = args.places.as_deref().map(text).transpose()?;
    let initial = args.initial.as_deref().map(text).transpose()?;
    let name = args.file.file_stem().unwrap_or_default().to_string_lossy();
    let name = if name == "-" { "actions".into() } else { name };
    let options = actions::Options {
        graph,
        places_csv: places.as_deref(),
        initial_csv: initial.as_deref(),
        start: args.start,
        name: &name,
    };
    let files = [Some(&args.file), args.places.as_ref(), args.initial.as_ref()];
    let files: Vec<String> =
        files.iter().flatten().map(|file| file.display().to_string()).collect();
    let imported =
        actions::import(&text(&args.file)?, &options).with_context(|| files.join(", "))?;
    record(imported, &args.target, out)
}

/// The graph that actions happen in, whatever it is written in.
fn base_graph(path: &Path, start: Stamp) -> anyhow::Result<SceneGraph> {
    if is_mcap(path) {
        let recording = source::open(path)?;
        let state = state_at(&recording, At::End)?;
        source::warn(&recording);
        return Ok(state.world.graph().clone());
    }
    let text = text(path)?;
    // VirtualHome graphs have `nodes` and `edges`, our own scenes have `rooms` and `objects`.
    let looks_like_virtualhome = text.contains("\"nodes\"") && text.contains("\"edges\"");
    let imported = if looks_like_virtualhome {
        let options = virtualhome::Options { start, ..virtualhome::Options::default() };
        virtualhome::import(&text, &options).map_err(anyhow::Error::new)
    } else {
        scene::import(&text).map_err(anyhow::Error::new)
    };
    Ok(imported.with_context(|| path.display().to_string())?.graph)
}

fn record(imported: Imported, target: &Target, out: &mut Output) -> anyhow::Result<Outcome> {
    let config = match &target.config {
        Some(path) => {
            Config::from_json(&text(path)?).with_context(|| path.display().to_string())?
        }
        None => Config::default(),
    };
    let config = target.decay.apply(config)?;
    let mut recorder = Recorder::create(&target.out, config, &RecorderOptions::default())?;
    let progress = bar("events recorded", imported.inputs.len() as u64);
    recorder.record(imported.start, Event::InitialGraph(imported.graph))?;
    for (at, input) in imported.inputs {
        recorder.record(at, input)?;
        progress.inc(1);
    }
    progress.finish_and_clear();
    let hash = recorder.updater().graph().hash().to_string();
    let seal = recorder.finish()?;
    report(&imported.report, &seal, hash, target, out)?;
    Ok(Outcome::Clean)
}

fn report(
    report: &ImportReport,
    seal: &Seal,
    hash: String,
    target: &Target,
    out: &mut Output,
) -> anyhow::Result<()> {
    if target.json {
        return out.json(&ImportDocument {
            recording: target.out.display().to_string(),
            events: seal.events,
            changes: seal.changes,
            primitives: seal.primitives,
            hash,
            chain: seal.chain.to_string(),
            report: report.clone(),
        });
    }
    for (what, count) in &report.counts {
        writeln!(out, "{count:>8} {what}")?;
    }
    for note in &report.notes {
        writeln!(out, "note: {}", plain(note))?;
    }
    writeln!(
        out,
        "recorded {} events, {} changes, {} primitives in {}",
        seal.events,
        seal.changes,
        seal.primitives,
        target.out.display()
    )?;
    writeln!(out, "state {hash}\nchain {}", seal.chain)?;
    Ok(())
}
