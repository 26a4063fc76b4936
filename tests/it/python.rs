//! Other readers agree: the Python packages of MCAP find what `info` tells.
//!
//! Where Python or the packages of `tests/python/requirements.txt` are missing, these tests say
//! so and pass; `.ci/run` has them. `SCENEFOLD_PYTHON` names the interpreter, and
//! `SCENEFOLD_SHARED_DATA` the folder with the files of other programs.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use scenefold::recording::Recording;
use scenefold::time::At;
use serde_json::Value;

use crate::golden;

fn interpreter() -> Command {
    let name = std::env::var_os("SCENEFOLD_PYTHON").unwrap_or("python3".into());
    Command::new(name)
}

/// Whether all of these can be imported.
fn has(modules: &str) -> bool {
    let found = interpreter().args(["-c", &format!("import {modules}")]).output();
    let found = found.is_ok_and(|output| output.status.success());
    // Where the packages were installed on purpose, missing ones are no excuse.
    assert!(
        found || std::env::var_os("SCENEFOLD_PYTHON").is_none(),
        "{modules} cannot be imported"
    );
    if !found {
        eprintln!("no python with {modules} here: not tested");
    }
    found
}

fn script(name: &str, args: &[&Path]) -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/python").join(name);
    let Output { status, stdout, stderr } = interpreter().arg(path).args(args).output().unwrap();
    assert!(status.success(), "{name} {args:?}: {}", String::from_utf8_lossy(&stderr));
    serde_json::from_slice(&stdout).unwrap()
}

fn info(path: &Path) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_scenefold"));
    let output = command.args(["info", "--json"]).arg(path).output().unwrap();
    assert!(output.status.success(), "{}: {output:?}", path.display());
    String::from_utf8(output.stdout).unwrap()
}

/// Messages by topic and schema, in JSON of either program.
fn counts(json: &Value) -> BTreeMap<(String, String), u64> {
    let mut counts = BTreeMap::new();
    for channel in json["channels"].as_array().unwrap() {
        let text = |key: &str| channel[key].as_str().unwrap().to_owned();
        let count = channel["count"].as_u64().unwrap();
        // A channel without messages is no difference.
        if count > 0 {
            *counts.entry((text("topic"), text("schema"))).or_default() += count;
        }
    }
    counts
}

fn assert_same_counts(path: &Path) {
    let ours: Value = serde_json::from_str(&info(path)).unwrap();
    let theirs = script("counts.py", &[path]);
    assert_eq!(counts(&ours), counts(&theirs), "{}", path.display());
    assert_eq!(ours["messages"], theirs["messages"], "{}", path.display());
}

#[test]
fn python_decodes_recordings_by_their_own_schemas() {
    if !has("mcap, mcap_protobuf") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    for golden in golden::all() {
        let told = folder.path().join("info.json");
        fs::write(&told, info(&golden.path)).unwrap();
        let found = script("check_recording.py", &[&golden.path, &told]);
        assert!(found["schemas"].as_u64().unwrap() > 0, "{}", golden.name);
        assert_same_counts(&golden.path);
    }
}

#[test]
fn python_decodes_what_was_passed_through() {
    if !has("mcap, mcap_ros2") {
        return;
    }
    let path = golden::all().remove(0).path;
    let found = script("check_ros2.py", &[&path]);
    let expected = [
        "/camera/color/image/compressed sensor_msgs/msg/CompressedImage",
        "/tf tf2_msgs/msg/TFMessage",
    ];
    assert_eq!(found.as_object().unwrap().keys().collect::<Vec<_>>(), expected);
}

#[test]
fn python_opens_the_pictures_of_a_simulated_camera() {
    if !has("mcap, mcap_ros2, PIL") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("in.mcap");
    let mut simulate = Command::new(env!("CARGO_BIN_EXE_scenefold"));
    simulate.args(["simulate", "--seed", "1", "--size", "64x48", "--rate", "0.2", "-o"]).arg(&path);
    assert!(simulate.output().unwrap().status.success());
    let found = script("camera.py", &[&path]);
    let pictures = found["colour"].as_u64().unwrap();
    assert!(pictures > 5, "{found}");
    assert_eq!((&found["depth"], &found["info"]), (&pictures.into(), &pictures.into()));
    assert_eq!(found["colour_kinds"], serde_json::json!([[64, 48, "jpeg", "jpeg"]]));
    assert_eq!(found["depth_kinds"], serde_json::json!([[64, 48, "16UC1", 128]]));
    let seen = found["least_seen"].as_u64().unwrap();
    assert!(seen > 64 * 48 / 3, "in some picture only {seen} pixels have a depth");
    assert!(found["farthest_mm"].as_u64().unwrap() < 20_000);
    let frames = found["frames"].to_string();
    for frame in ["base_link", "camera_mount", "camera_link", "camera_optical_frame", "gripper"] {
        assert!(frames.contains(frame), "{frame} is missing in {frames}");
    }
}

#[test]
fn files_of_other_programs_are_counted_as_python_counts_them() {
    let Some(data) = std::env::var_os("SCENEFOLD_SHARED_DATA") else {
        eprintln!("SCENEFOLD_SHARED_DATA is not set: not tested");
        return;
    };
    if !has("mcap") {
        return;
    }
    let entries = fs::read_dir(PathBuf::from(data).join("mcap")).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "mcap"));
    assert!(!paths.is_empty());
    paths.iter().for_each(|path| assert_same_counts(path));
}

#[test]
fn the_spark_dsg_package_loads_what_is_exported() {
    if !has("spark_dsg") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    for golden in golden::all() {
        let exported = folder.path().join(format!("{}.json", golden.name));
        let mut export = Command::new(env!("CARGO_BIN_EXE_scenefold"));
        export.arg("export").arg(&golden.path).args(["--format", "spark-dsg", "-o"]).arg(&exported);
        assert!(export.status().unwrap().success(), "{}", golden.name);
        let theirs = script("load_spark_dsg.py", &[&exported]);
        let state = Recording::open(&golden.path).unwrap().state_at(At::End, 1).unwrap();
        let graph = state.graph();
        let counted = |key: &str| theirs[key].as_u64().unwrap() as usize;
        assert_eq!(counted("objects"), graph.objects().count(), "{}", golden.name);
        assert_eq!(counted("rooms"), graph.rooms().count(), "{}", golden.name);
        assert_eq!(counted("accesses"), graph.access().count(), "{}", golden.name);
        assert_eq!(counted("objects_in_rooms"), graph.objects().count(), "{}", golden.name);
    }
}
