//! `scenefold reprocess`

use std::io::Write;
use std::path::PathBuf;

use anyhow::Context;
use serde::Serialize;

use super::Outcome;
use super::decay::DecayArgs;
use super::output::{Output, Style};
use super::progress::counter;
use super::source::{self, RecordingArg, text};
use crate::document::ContentDocument;
use crate::recording::{
    Difference, RecordError, Recorder, RecorderOptions, Reprocessed, reprocess,
};
use crate::updater::{Config, Detectors};

/// Run the detectors again over the recorded inputs, and compare
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  scenefold reprocess day.mcap                          do the detectors still say the same
  scenefold reprocess day.mcap --config new.json        what another configuration would change
  scenefold reprocess inputs.mcap -o updated.mcap       run inputs of another program through
Exits with 3 if something else is derived now than was recorded.")]
pub struct Reprocess {
    #[command(flatten)]
    recording: RecordingArg,
    /// Write what is derived now to a new recording
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Configuration (JSON) instead of the recorded one; recordings of inputs only are run through
    /// all detectors
    #[arg(long, value_name = "FILE")]
    config: Option<PathBuf>,
    #[command(flatten)]
    decay: DecayArgs,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct ReprocessDocument {
    equal: bool,
    inputs: u64,
    different: u64,
    hash: String,
    differences: Vec<DifferenceDocument>,
}

#[derive(Serialize)]
struct DifferenceDocument {
    order: u64,
    at: String,
    recorded: Vec<ContentDocument>,
    now: Vec<ContentDocument>,
}

/// Runs `scenefold reprocess`.
pub fn run(args: &Reprocess, out: &mut Output) -> anyhow::Result<Outcome> {
    let recording = source::open(&args.recording.path)?;
    let mut config = match &args.config {
        Some(path) => {
            Config::from_json(&text(path)?).with_context(|| path.display().to_string())?
        }
        None => recording.meta().map_or_else(Config::default, |meta| meta.config.clone()),
    };
    // Inputs only: there is nothing to compare with yet.
    let first_time = args.config.is_none() && config.detectors == Detectors::None;
    if first_time {
        config.detectors = Detectors::All;
    }
    let config = args.decay.apply(config)?;
    let options = RecorderOptions::default();
    let recorder = args.out.as_ref().map(|path| Recorder::create(path, config.clone(), &options));
    let mut recorder = recorder.transpose()?;
    let progress = counter("inputs");
    let result = reprocess(&recording, &config, &mut |input, now| {
        progress.inc(1);
        let Some(recorder) = &mut recorder else { return Ok::<_, RecordError>(()) };
        let outputs = now.iter().map(|logged| &logged.event).filter(|it| it.is_model_output());
        let outputs = outputs.cloned().collect();
        recorder.record_with(input.published, input.event.clone(), outputs).map(drop)
    })?;
    progress.finish_and_clear();
    if let Some(recorder) = recorder {
        recorder.finish()?;
    }
    if args.json {
        out.json(&document(&result))?;
    } else if first_time {
        let (inputs, changes) = (result.inputs, result.updater.changes());
        writeln!(out, "{inputs} inputs, which nobody had run through, give {changes} changes")?;
    } else {
        print(&result, out)?;
    }
    let outcome = source::warn(&recording);
    if first_time {
        return Ok(outcome);
    }
    Ok(if result.different > 0 { Outcome::Findings } else { outcome })
}

fn document(result: &Reprocessed) -> ReprocessDocument {
    let difference = |difference: &Difference| DifferenceDocument {
        order: difference.order,
        at: difference.at.to_string(),
        recorded: difference.recorded.iter().map(ContentDocument::of).collect(),
        now: difference.now.iter().map(ContentDocument::of).collect(),
    };
    ReprocessDocument {
        equal: result.different == 0,
        inputs: result.inputs,
        different: result.different,
        hash: result.updater.graph().hash().to_string(),
        differences: result.differences.iter().map(difference).collect(),
    }
}

fn print(result: &Reprocessed, out: &mut Output) -> anyhow::Result<()> {
    if result.different == 0 {
        let equal = out.paint(Style::Green, "equal");
        writeln!(out, "{equal}: {} inputs give again what was recorded", result.inputs)?;
        return Ok(());
    }
    let different = out.paint(Style::Red, "different");
    writeln!(
        out,
        "{different}: {} of {} inputs give something else now",
        result.different, result.inputs
    )?;
    for difference in result.differences.iter().take(20) {
        writeln!(out, "\nevent #{} at {}", difference.order, difference.at)?;
        for (sign, style, events) in
            [("-", Style::Red, &difference.recorded), ("+", Style::Green, &difference.now)]
        {
            for event in events {
                let line = serde_json::to_string(&ContentDocument::of(event))?;
                writeln!(out, "{}", out.paint(style, &format!("{sign} {line}")))?;
            }
        }
    }
    Ok(())
}
