//! Recordings of the past give the states, changes and hashes that they always gave.
//!
//! The files in `recordings/` are never made again to make a test pass: a later version must read
//! what this one wrote. What they give is in `snapshots/`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use insta::{Settings, assert_snapshot};
use scenefold::recording::{Recording, verify};
use scenefold::snapshot::render;
use scenefold::time::At;

use crate::sha256;

/// Most bytes of a recording without pictures, and of one with them.
const BYTES_MAX: [usize; 2] = [256 << 10, 6_000_000];

/// A golden recording and what its `.toml` says of it.
pub struct Golden {
    pub name: String,
    pub path: PathBuf,
    facts: toml::Table,
}

impl Golden {
    fn text(&self, key: &str) -> &str {
        self.facts[key].as_str().unwrap()
    }

    fn number(&self, key: &str) -> u64 {
        self.facts[key].as_integer().unwrap().try_into().unwrap()
    }

    fn points(&self) -> Vec<At> {
        let points = self.facts["points"].as_array().unwrap();
        points.iter().map(|point| point.as_str().unwrap().parse().unwrap()).collect()
    }
}

/// All of them, in order of name.
pub fn all() -> Vec<Golden> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("recordings");
    let mut paths: Vec<PathBuf> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "mcap"));
    paths.sort();
    let golden = |path: PathBuf| {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let facts = fs::read_to_string(path.with_extension("toml")).unwrap();
        Golden { name, path, facts: facts.parse().unwrap() }
    };
    paths.into_iter().map(golden).collect()
}

/// Snapshots lie in the top-level folder, under names of their own.
pub fn in_snapshots(run: impl FnOnce()) {
    let mut settings = Settings::clone_current();
    settings.set_snapshot_path(Path::new(env!("CARGO_MANIFEST_DIR")).join("snapshots"));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(run);
}

#[test]
fn they_are_the_files_that_were_recorded() {
    let golden = all();
    assert_eq!(golden.len(), 5);
    for golden in golden {
        let bytes = fs::read(&golden.path).unwrap();
        let most = BYTES_MAX[usize::from(golden.name == "paper_mission")];
        assert!(bytes.len() <= most, "{}: {} bytes", golden.name, bytes.len());
        assert_eq!(sha256::hex(&bytes), golden.text("sha256"), "{}", golden.name);
        assert!(!golden.text("origin").is_empty() && !golden.text("command").is_empty());
        assert!(!golden.text("licence").is_empty());
    }
}

#[test]
fn they_verify_as_they_did() {
    let mut text = String::new();
    for golden in all() {
        let verified = verify(&golden.path, &mut |_| ()).unwrap();
        assert_eq!(verified.status.as_str(), golden.text("status"), "{}", golden.name);
        assert_eq!(verified.events, golden.number("events"), "{}", golden.name);
        assert_eq!(verified.checkpoints, golden.number("checkpoints"), "{}", golden.name);
        let summary = Recording::open(&golden.path).unwrap().summary();
        assert_eq!(summary.changes, golden.number("changes"), "{}", golden.name);
        assert_eq!(summary.primitives, golden.number("primitives"), "{}", golden.name);
        text += &format!(
            "{}\n  status {}\n  state {}\n  chain {}\n",
            golden.name,
            verified.status.as_str(),
            verified.hash,
            verified.chain.unwrap()
        );
        for finding in verified.findings {
            text += &format!("  {}: {}\n", finding.status.as_str(), finding.what);
        }
    }
    in_snapshots(|| assert_snapshot!("hashes", text));
}

#[test]
fn they_give_the_states_and_changes_that_they_gave() {
    for golden in all() {
        let recording = Recording::open(&golden.path).unwrap();
        let text = render(&recording, &golden.points()).unwrap();
        assert_eq!(recording.trouble(), Vec::<String>::new());
        in_snapshots(|| assert_snapshot!(format!("states__{}", golden.name), text));
    }
}

#[test]
fn their_summary_is_what_it_was() {
    for golden in all() {
        let mut info = Command::new(env!("CARGO_BIN_EXE_scenefold"));
        let output = info.args(["info", "--json"]).arg(&golden.path).output().unwrap();
        assert!(output.status.success());
        let text = String::from_utf8(output.stdout).unwrap();
        in_snapshots(|| assert_snapshot!(format!("info__{}", golden.name), text));
    }
}
