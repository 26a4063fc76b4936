//! `scenefold snapshot`

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;
use serde::Serialize;
use similar::{ChangeTag, TextDiff};

use super::output::{Output, Style};
use super::progress::bar;
use super::source;
use super::{Outcome, UsageError};
use crate::snapshot::{points, render};
use crate::time::At;

/// Compare recordings with the states and changes they are known to give
#[derive(Debug, clap::Args)]
#[command(after_help = "\
A golden file DIR/NAME.snap holds the states at chosen points and the change log of NAME.mcap as
text. It is made and updated with --accept, and meant to be committed and reviewed.

Examples:
  scenefold snapshot missions/*.mcap                        compare
  scenefold snapshot missions/*.mcap --accept               take what they give now as right
  scenefold snapshot day.mcap --at 8h --at 20h --accept     with the states at 8 and 20 hours
Exits with 3 if something differs or has no golden file.")]
pub struct Snapshot {
    /// Recordings: MCAP files or folders of segments
    #[arg(value_name = "REC", required = true)]
    recordings: Vec<PathBuf>,
    /// Folder of golden files
    #[arg(long, value_name = "DIR", default_value = "snapshots")]
    dir: PathBuf,
    /// With --accept: points whose states to keep; start and end if none is given and there is
    /// no golden file yet
    #[arg(long, value_name = "AT")]
    at: Vec<At>,
    /// Take what the recordings give now as right
    #[arg(long)]
    accept: bool,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

#[derive(Default, Serialize)]
struct SnapshotDocument {
    passed: Vec<String>,
    accepted: Vec<String>,
    failed: Vec<FailureDocument>,
}

#[derive(Serialize)]
struct FailureDocument {
    recording: String,
    golden: String,
    reason: &'static str,
    diff: String,
}

/// Runs `scenefold snapshot`.
pub fn run(args: &Snapshot, out: &mut Output) -> anyhow::Result<Outcome> {
    args.check_names()?;
    let mut document = SnapshotDocument::default();
    let progress = bar("recordings", args.recordings.len() as u64);
    for recording in &args.recordings {
        args.one(recording, &mut document)?;
        progress.inc(1);
    }
    progress.finish_and_clear();
    let outcome = if document.failed.is_empty() { Outcome::Clean } else { Outcome::Findings };
    if args.json {
        out.json(&document)?;
    } else {
        print(&document, out)?;
    }
    Ok(outcome)
}

impl Snapshot {
    /// Two recordings of one name would share a golden file.
    fn check_names(&self) -> anyhow::Result<()> {
        let mut names: Vec<PathBuf> =
            self.recordings.iter().map(|path| self.golden(path)).collect();
        names.sort();
        match names.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => Err(UsageError(format!(
                "two recordings share the golden file {}: rename one",
                pair[0].display()
            ))
            .into()),
            None => Ok(()),
        }
    }

    fn golden(&self, recording: &Path) -> PathBuf {
        let name = recording.file_stem().unwrap_or(recording.as_os_str());
        self.dir.join(Path::new(name).with_extension("snap"))
    }

    fn one(&self, path: &Path, document: &mut SnapshotDocument) -> anyhow::Result<()> {
        let golden = self.golden(path);
        let expected = match std::fs::read_to_string(&golden) {
            Ok(text) => Some(text),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => None,
            Err(error) => return Err(error).context(golden.display().to_string()),
        };
        let recording = source::open(path)?;
        let found = render(&recording, &self.points(expected.as_deref()))
            .with_context(|| path.display().to_string())?;
        source::warn(&recording);
        let name = path.display().to_string();
        if expected.as_deref() == Some(found.as_str()) {
            document.passed.push(name);
        } else if self.accept {
            std::fs::create_dir_all(&self.dir).with_context(|| self.dir.display().to_string())?;
            std::fs::write(&golden, found).with_context(|| golden.display().to_string())?;
            document.accepted.push(name);
        } else {
            let reason = if expected.is_some() { "different" } else { "no golden file" };
            let diff = diff(expected.as_deref().unwrap_or_default(), &found);
            let golden = golden.display().to_string();
            document.failed.push(FailureDocument { recording: name, golden, reason, diff });
        }
        Ok(())
    }

    fn points(&self, expected: Option<&str>) -> Vec<At> {
        let known = expected.map(points).filter(|points| !points.is_empty());
        match (self.at.as_slice(), known) {
            ([], Some(known)) => known,
            ([], None) => vec![At::Start, At::End],
            (given, _) => given.to_vec(),
        }
    }
}

fn diff(expected: &str, found: &str) -> String {
    let diff = TextDiff::from_lines(expected, found);
    let lines = diff.iter_all_changes().filter_map(|change| {
        let sign = match change.tag() {
            ChangeTag::Equal => return None,
            ChangeTag::Delete => '-',
            ChangeTag::Insert => '+',
        };
        Some(format!("{sign}{}", change.value()))
    });
    lines.collect()
}

fn print(document: &SnapshotDocument, out: &mut Output) -> anyhow::Result<()> {
    for failure in &document.failed {
        let failed = out.paint(Style::Red, "failed");
        writeln!(out, "{failed} {}: {} ({})", failure.recording, failure.reason, failure.golden)?;
        for line in failure.diff.lines().take(40) {
            let style = if line.starts_with('-') { Style::Red } else { Style::Green };
            writeln!(out, "  {}", out.paint(style, line))?;
        }
        let more = failure.diff.lines().count().saturating_sub(40);
        if more > 0 {
            writeln!(out, "  … and {more} more lines")?;
        }
    }
    for name in &document.accepted {
        writeln!(out, "accepted {name}")?;
    }
    let (passed, failed) = (document.passed.len(), document.failed.len());
    writeln!(out, "{passed} passed, {failed} failed")?;
    if failed > 0 {
        writeln!(out, "if what they give now is right, run it again with --accept")?;
    }
    Ok(())
}
