//! `scenefold info`

use std::io::Write;

use serde::Serialize;

use super::Outcome;
use super::output::{Output, Style, plain};
use super::source::{self, RecordingArg};
use crate::recording::Summary;
use crate::time::Span;

/// What is in a recording: channels, counts, span, checkpoints, damage
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  scenefold info day.mcap
  scenefold info any_ros2_bag.mcap --json | jq .channels
Exits with 3 if the file is damaged.")]
pub struct Info {
    #[command(flatten)]
    recording: RecordingArg,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct InfoDocument {
    start: Option<String>,
    end: Option<String>,
    messages: u64,
    channels: Vec<ChannelDocument>,
    primitives: u64,
    changes: u64,
    checkpoints: u64,
    segments: u64,
    finished: bool,
    program: Option<String>,
    library: Option<String>,
    damage: Vec<String>,
}

#[derive(Serialize)]
struct ChannelDocument {
    topic: String,
    schema: String,
    encoding: String,
    count: u64,
}

/// Runs `scenefold info`.
pub fn run(args: &Info, out: &mut Output) -> anyhow::Result<Outcome> {
    let recording = source::open(&args.recording.path)?;
    let summary = recording.summary();
    let outcome = if summary.trouble.is_empty() { Outcome::Clean } else { Outcome::Findings };
    if args.json {
        out.json(&document(summary))?;
    } else {
        print(&summary, out)?;
    }
    Ok(outcome)
}

fn document(summary: Summary) -> InfoDocument {
    let channels = summary.channels.into_iter().map(|channel| ChannelDocument {
        topic: channel.topic,
        schema: channel.schema,
        encoding: channel.encoding,
        count: channel.count,
    });
    InfoDocument {
        start: summary.start.map(|stamp| stamp.to_string()),
        end: summary.end.map(|stamp| stamp.to_string()),
        messages: summary.messages,
        channels: channels.collect(),
        primitives: summary.primitives,
        changes: summary.changes,
        checkpoints: summary.checkpoints,
        segments: summary.segments,
        finished: summary.finished,
        program: summary.program,
        library: summary.library,
        damage: summary.trouble,
    }
}

fn print(summary: &Summary, out: &mut Output) -> anyhow::Result<()> {
    if let (Some(start), Some(end)) = (summary.start, summary.end) {
        let span = Span(end.nanos() - start.nanos());
        writeln!(out, "{start} to {end} ({span})")?;
    }
    let by = summary.program.as_deref().or(summary.library.as_deref()).unwrap_or("unknown");
    writeln!(
        out,
        "{} messages, {} changes, {} primitives, {} checkpoints in {} file(s), by {}{}",
        summary.messages,
        summary.changes,
        summary.primitives,
        summary.checkpoints,
        summary.segments,
        plain(by),
        if summary.finished { "" } else { "; not ended by its writer" }
    )?;
    let widest = summary.channels.iter().map(|c| c.topic.chars().count()).max().unwrap_or(0);
    for channel in &summary.channels {
        let topic = plain(&channel.topic);
        let schema = out.paint(Style::Dim, &plain(&channel.schema));
        writeln!(out, "  {topic:widest$}  {:>9}  {schema}", channel.count)?;
    }
    for line in &summary.trouble {
        let line = out.paint(Style::Red, &plain(line));
        writeln!(out, "damage: {line}")?;
    }
    Ok(())
}
