//! The recordings that are measured, made once and kept with the other build outputs.

use std::fs;
use std::path::{Path, PathBuf};

use scenefold::recording::{Recorder, RecorderOptions};
use scenefold::updater::Config;

use super::household::{Dice, PICTURE_BYTES, PRIMITIVES_PER_UPDATE, inputs, picture};

/// A recording to be made.
#[derive(Clone, Copy)]
pub struct Log {
    /// Primitives in it.
    pub primitives: u64,
    /// Whether it has checkpoints.
    pub checkpoints: bool,
    /// Bytes of pictures among the events.
    pub sensor_bytes: u64,
}

impl Log {
    /// Its path; it is made if it is not there.
    pub fn path(self) -> PathBuf {
        let Self { primitives, checkpoints, sensor_bytes } = self;
        let name = format!("household-{primitives}-{checkpoints}-{sensor_bytes}.mcap");
        made(&name, |path| self.record(path))
    }

    fn record(self, path: &Path) {
        let ratio = if self.checkpoints { 10 } else { u64::MAX };
        let options = RecorderOptions { checkpoint_ratio: ratio, ..RecorderOptions::default() };
        let mut recorder =
            Recorder::create(path, Config::default(), &options).expect("the file is new");
        let updates = self.primitives / PRIMITIVES_PER_UPDATE;
        let pictures = self.sensor_bytes / PICTURE_BYTES;
        let every = updates.checked_div(pictures).unwrap_or(u64::MAX).max(1);
        let mut dice = Dice::new();
        for (n, (at, input)) in inputs(updates).enumerate() {
            recorder.record(at, input).expect("the input is valid");
            if n as u64 % every == every / 2 {
                recorder.record(at, picture(&mut dice)).expect("the picture is valid");
            }
        }
        recorder.finish().expect("the disk has room");
    }
}

/// The path of a file that `make` makes, if it is not there from an earlier run.
pub fn made(name: &str, make: impl FnOnce(&Path)) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    if !path.exists() {
        let unfinished = path.with_extension("unfinished");
        let _ = fs::remove_file(&unfinished);
        eprintln!("making {name}");
        make(&unfinished);
        fs::rename(&unfinished, &path).expect("the file was just written");
    }
    path
}
