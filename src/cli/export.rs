//! `scenefold export`

use std::fs::File;
use std::io::Write;
use std::path::PathBuf;

use clap::ValueEnum;

use super::Outcome;
use super::output::Output;
use super::replay::state_at;
use super::source::{self, RecordingArg};
use crate::interchange::scene::SceneDocument;
use crate::interchange::{dot, spark_dsg};
use crate::recording::RecordError;
use crate::time::At;

/// The graph for other tools
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  scenefold export day.mcap --format scene -o scene.json
  scenefold export day.mcap --format spark-dsg -o dsg.json     load it with the spark-dsg package
  scenefold export day.mcap --format dot --at 36h | dot -Tsvg > graph.svg")]
pub struct Export {
    #[command(flatten)]
    recording: RecordingArg,
    /// What to write
    #[arg(long)]
    format: Format,
    /// The point: start, end, 12.5s, 36h, 65d, an RFC 3339 instant, #42, c7 or nanoseconds
    #[arg(long, value_name = "AT", default_value = "end")]
    at: At,
    /// New file to write instead of standard output
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum Format {
    /// Our own JSON, as `replay --json` prints it
    Scene,
    /// JSON that Spark-DSG loads (Hydra, Khronos, Clio)
    SparkDsg,
    /// Graphviz
    Dot,
}

/// Runs `scenefold export`.
pub fn run(args: &Export, out: &mut Output) -> anyhow::Result<Outcome> {
    let recording = source::open(&args.recording.path)?;
    let state = state_at(&recording, args.at)?;
    let graph = state.graph();
    let text = match args.format {
        Format::Scene => serde_json::to_string_pretty(&SceneDocument::of(graph, state.at))? + "\n",
        Format::SparkDsg => serde_json::to_string_pretty(&spark_dsg::export(graph))? + "\n",
        Format::Dot => dot::export(graph),
    };
    match &args.out {
        // Like everything here, it overwrites nothing: least of all the recording itself.
        Some(path) => File::create_new(path)
            .and_then(|mut file| file.write_all(text.as_bytes()))
            .map_err(|error| RecordError::io(path, error))?,
        None => out.write_all(text.as_bytes())?,
    }
    Ok(source::warn(&recording))
}
