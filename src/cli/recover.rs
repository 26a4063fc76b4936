//! `scenefold recover`

use std::io::Write;
use std::path::PathBuf;

use serde::Serialize;

use super::Outcome;
use super::output::{Output, plain};
use super::progress::counter;
use super::source::{self, RecordingArg};
use crate::recording::{LostEvents, Recovered, recover};

/// Save what is intact of a damaged recording
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  scenefold recover damaged.mcap -o saved.mcap
  scenefold recover segments/ -o whole.mcap       also joins segments into one file
The original is never changed. Exits with 3 if something is lost.")]
pub struct Recover {
    #[command(flatten)]
    recording: RecordingArg,
    /// New file to write
    #[arg(short, long, value_name = "FILE")]
    out: PathBuf,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct RecoverDocument {
    messages_recovered: u64,
    lost: Vec<LostDocument>,
    edited_before: Option<u64>,
    damage: Vec<String>,
}

#[derive(Serialize)]
struct LostDocument {
    first_event: u64,
    last_event: Option<u64>,
}

/// Runs `scenefold recover`.
pub fn run(args: &Recover, out: &mut Output) -> anyhow::Result<Outcome> {
    let progress = counter("messages recovered");
    let recording = source::scan(&args.recording.path)?;
    let recovered =
        recover(&recording, &args.out, &mut |messages| progress.set_position(messages))?;
    progress.finish_and_clear();
    if args.json {
        out.json(&document(&recovered))?;
    } else {
        print(&recovered, out)?;
    }
    let whole =
        recovered.events.is_empty() && recovered.damage.is_empty() && recovered.edited.is_none();
    Ok(if whole { Outcome::Clean } else { Outcome::Findings })
}

fn document(recovered: &Recovered) -> RecoverDocument {
    let lost = |lost: &LostEvents| LostDocument { first_event: lost.first, last_event: lost.last };
    RecoverDocument {
        messages_recovered: recovered.messages,
        lost: recovered.events.iter().map(lost).collect(),
        edited_before: recovered.edited,
        damage: recovered.damage.clone(),
    }
}

fn print(recovered: &Recovered, out: &mut Output) -> anyhow::Result<()> {
    writeln!(out, "{} messages recovered", recovered.messages)?;
    for LostEvents { first, last } in &recovered.events {
        match last {
            Some(last) => writeln!(out, "lost: events #{first} to #{last}")?,
            None => writeln!(out, "lost: whatever came from event #{first} on")?,
        }
    }
    if let Some(order) = recovered.edited {
        writeln!(
            out,
            "edited: the hash chain does not hold up to event #{order}; verify will say so"
        )?;
    }
    for line in &recovered.damage {
        writeln!(out, "damage: {}", plain(line))?;
    }
    Ok(())
}
