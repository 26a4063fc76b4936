//! The files of a recording: one, or a folder of segments in the order of their names.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

const PREFIX: &str = "segment-";
const SUFFIX: &str = ".mcap";

/// The MCAP files of a folder, in the order of their names.
pub(super) fn segment_files(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let is_mcap = path.extension().is_some_and(|extension| extension == "mcap");
        if is_mcap && path.is_file() {
            files.push(path);
        }
    }
    files.sort();
    Ok(files)
}

/// The name of the segment after the last one of a folder.
pub(super) fn next_segment(folder: &Path) -> io::Result<PathBuf> {
    let number = |path: &PathBuf| -> Option<u32> {
        let name = path.file_name()?.to_str()?;
        name.strip_prefix(PREFIX)?.strip_suffix(SUFFIX)?.parse().ok()
    };
    let last = segment_files(folder)?.iter().filter_map(number).max().unwrap_or(0);
    Ok(folder.join(format!("{PREFIX}{:06}{SUFFIX}", last + 1)))
}
