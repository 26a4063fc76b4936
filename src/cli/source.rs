//! Opening what the user names: a recording, a folder of segments, or standard input.

use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use anyhow::Context;

use super::Outcome;
use super::output::plain;
use crate::recording::Recording;

/// A recording to read.
#[derive(Clone, Debug, clap::Args)]
pub struct RecordingArg {
    /// Recording: an MCAP file, a folder of segments, or - for standard input
    #[arg(value_name = "REC")]
    pub path: PathBuf,
}

/// Opens the recording at `path`, or the one on standard input if that is `-`.
pub fn open(path: &Path) -> anyhow::Result<Recording> {
    if path == Path::new("-") {
        return Ok(Recording::from_bytes("standard input", stdin_bytes()?)?);
    }
    Ok(Recording::open(path)?)
}

/// As [`open`], without trusting any index.
pub fn scan(path: &Path) -> anyhow::Result<Recording> {
    if path == Path::new("-") {
        return Ok(Recording::scan_bytes("standard input", stdin_bytes()?)?);
    }
    Ok(Recording::scan(path)?)
}

/// All of standard input.
pub fn stdin_bytes() -> anyhow::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    io::stdin().lock().read_to_end(&mut bytes).context("reading standard input")?;
    Ok(bytes)
}

/// The text of a file, or of standard input if `path` is `-`.
pub fn text(path: &Path) -> anyhow::Result<String> {
    let mut bytes = Vec::new();
    let read = if path == Path::new("-") {
        io::stdin().lock().read_to_end(&mut bytes)
    } else {
        std::fs::File::open(path).and_then(|mut file| file.read_to_end(&mut bytes))
    };
    read.with_context(|| path.display().to_string())?;
    String::from_utf8(bytes).with_context(|| format!("{}: not UTF-8 text", path.display()))
}

/// Whether a file starts as MCAP files do.
pub fn is_mcap(path: &Path) -> bool {
    let mut magic = [0; 8];
    path.is_dir()
        || std::fs::File::open(path)
            .and_then(|mut file| file.read_exact(&mut magic))
            .is_ok_and(|()| magic == mcap::MAGIC)
}

/// Tells on stderr what was found to be wrong with the recording while it was read.
pub fn warn(recording: &Recording) -> Outcome {
    let trouble = recording.trouble();
    let mut stderr = io::stderr().lock();
    for line in trouble.iter().take(10) {
        let _ = writeln!(stderr, "warning: {}", plain(line));
    }
    if trouble.len() > 10 {
        let _ =
            writeln!(stderr, "warning: and {} more; see `scenefold verify`", trouble.len() - 10);
    }
    if trouble.is_empty() { Outcome::Clean } else { Outcome::Findings }
}

/// Threads that are worth using.
pub fn threads() -> usize {
    std::thread::available_parallelism().map_or(1, |n| n.get().min(8))
}
