//! The program at its boundary: arguments in, text, JSON and exit codes out.

mod exit_codes;
mod files;
mod help;
mod houses;
mod ingest;
mod json;
mod render;
mod streams;
mod tell;
mod time;

use std::path::{Path, PathBuf};
use std::process::Output;

use assert_cmd::Command;

/// What one run came to.
struct Ran {
    code: i32,
    out: String,
    err: String,
}

impl Ran {
    fn of(output: &Output) -> Self {
        let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
        let code = output.status.code().expect("it was not killed");
        Self { code, out: text(&output.stdout), err: text(&output.stderr) }
    }

    #[track_caller]
    fn expect(self, code: i32) -> Self {
        assert_eq!(self.code, code, "{}\n{}", self.out, self.err);
        self
    }

    /// The error says all of these.
    #[track_caller]
    fn says(self, words: &[&str]) -> Self {
        for word in words {
            assert!(self.err.contains(word), "{word:?} is not in: {}", self.err);
        }
        self
    }

    fn json(&self) -> serde_json::Value {
        serde_json::from_str(&self.out).unwrap()
    }

    fn json_lines(&self) -> Vec<serde_json::Value> {
        self.out.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
    }
}

fn program() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_scenefold"));
    command.env_remove("NO_COLOR");
    command
}

fn run<S: AsRef<std::ffi::OsStr>>(args: &[S]) -> Ran {
    Ran::of(&program().args(args).output().unwrap())
}

/// Runs `line`, in which REC is the golden recording that most tests are about.
fn on_recording(line: &str) -> Ran {
    run(&words(line))
}

fn words(line: &str) -> Vec<String> {
    let recording = golden("every_rejection");
    let word = |word: &str| match word {
        "REC" => recording.display().to_string(),
        other => other.replace('_', " "),
    };
    line.split(' ').map(word).collect()
}

fn golden(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("recordings");
    folder.join(name).with_extension("mcap")
}

/// The keys of a JSON object, in alphabetical order, joined.
fn keys(value: &serde_json::Value) -> String {
    let mut keys: Vec<&str> = value.as_object().unwrap().keys().map(String::as_str).collect();
    keys.sort_unstable();
    keys.join(" ")
}

/// A copy of a golden recording of which a piece in the middle is lost.
fn damaged(folder: &Path) -> PathBuf {
    let mut bytes = std::fs::read(golden("every_rejection")).unwrap();
    let middle = bytes.len() / 3;
    bytes[middle..middle + 64].fill(0xaa);
    let path = folder.join("damaged.mcap");
    std::fs::write(&path, bytes).unwrap();
    path
}
