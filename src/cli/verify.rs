//! `scenefold verify`

use std::io::Write;
use std::path::Path;

use anyhow::bail;
use serde::Serialize;

use super::Outcome;
use super::output::{Output, Style, plain};
use super::progress::counter;
use super::source::{self, RecordingArg};
use crate::recording::{Status, Verified, verify, verify_bytes};

/// Is the recording whole, unedited, and does it replay to the same states
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Tells apart: intact; truncated (the end is missing, as after a crash); corrupt (bytes were lost
or changed); tampered (all checksums hold, but the events are not those recorded);
nondeterministic (the primitives or the detectors do not give what was recorded).

Examples:
  scenefold verify day.mcap
  scenefold verify day.mcap --chain 5f1c…   compare with a chain noted elsewhere
Exits with 3 unless the recording is intact.")]
pub struct Verify {
    #[command(flatten)]
    recording: RecordingArg,
    /// The chain that the recording had when it was noted; an edited one that was given a new
    /// chain differs
    #[arg(long, value_name = "HASH")]
    chain: Option<String>,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct VerifyDocument {
    status: &'static str,
    hash: String,
    chain: Option<String>,
    events: u64,
    checkpoints: u64,
    reprocessed: u64,
    missing_after: Vec<u64>,
    findings: Vec<FindingDocument>,
}

#[derive(Serialize)]
struct FindingDocument {
    status: &'static str,
    segment: String,
    what: String,
}

/// Runs `scenefold verify`.
pub fn run(args: &Verify, out: &mut Output) -> anyhow::Result<Outcome> {
    let path = &args.recording.path;
    let progress = counter("events verified");
    let verified = match path == Path::new("-") {
        true => verify_bytes("standard input", source::stdin_bytes()?)?,
        false => verify(path, &mut |events| progress.set_position(events))?,
    };
    progress.finish_and_clear();
    if args.json {
        out.json(&document(&verified))?;
    } else {
        print(&verified, out)?;
    }
    if let Some(expected) = &args.chain {
        let found = chain(&verified);
        if *expected != found {
            out.flush()?;
            bail!(
                "the chain is {found}, not {expected}: this is another recording, or an edited one"
            );
        }
    }
    Ok(if verified.status == Status::Intact { Outcome::Clean } else { Outcome::Findings })
}

fn chain(verified: &Verified) -> String {
    let unknown = || "unknown, for events are missing".to_owned();
    verified.chain.map_or_else(unknown, |link| link.to_string())
}

fn document(verified: &Verified) -> VerifyDocument {
    let findings = verified.findings.iter().map(|finding| FindingDocument {
        status: finding.status.as_str(),
        segment: finding.segment.clone(),
        what: finding.what.clone(),
    });
    VerifyDocument {
        status: verified.status.as_str(),
        hash: verified.hash.to_string(),
        chain: verified.chain.map(|link| link.to_string()),
        events: verified.events,
        checkpoints: verified.checkpoints,
        reprocessed: verified.reprocessed,
        missing_after: verified.gaps.clone(),
        findings: findings.collect(),
    }
}

fn print(verified: &Verified, out: &mut Output) -> anyhow::Result<()> {
    let style = if verified.status == Status::Intact { Style::Green } else { Style::Red };
    writeln!(out, "{}", out.paint(style, verified.status.as_str()))?;
    writeln!(
        out,
        "  {} events, {} checkpoints right, {} inputs gave again what was recorded",
        verified.events, verified.checkpoints, verified.reprocessed
    )?;
    writeln!(out, "  state {}\n  chain {}", verified.hash, chain(verified))?;
    for gap in &verified.gaps {
        writeln!(out, "  recovered earlier: events after #{gap} are missing")?;
    }
    for finding in &verified.findings {
        let status = out.paint(Style::Yellow, finding.status.as_str());
        writeln!(out, "  {status}: {}: {}", plain(&finding.segment), plain(&finding.what))?;
    }
    Ok(())
}
