//! Files that are missing, empty, of another kind, or there already.

use std::fs;

use super::{golden, on_recording, program, run};

#[test]
fn what_is_no_recording_is_said_to_be_none() {
    let folder = tempfile::tempdir().unwrap();
    let noise = folder.path().join("noise.mcap");
    let bytes: Vec<u8> = (0..5000_u32).map(|n| ((n * n) >> 3) as u8).collect();
    fs::write(&noise, bytes).unwrap();
    let noise = noise.display().to_string();
    for args in [
        vec!["info", &noise],
        vec!["log", &noise],
        vec!["replay", &noise],
        vec!["why", &noise, "mug"],
        vec!["verify", &noise],
        vec!["reprocess", &noise],
    ] {
        run(&args).expect(1).says(&["not an MCAP file", "noise.mcap"]);
    }
    run(&["import", "scene", &noise, "-o", "never.mcap"]).expect(1).says(&["not UTF-8 text"]);
}

#[test]
fn an_empty_file_is_a_recording_cut_off_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let empty = folder.path().join("empty.mcap");
    fs::write(&empty, "").unwrap();
    let empty = empty.display().to_string();
    run(&["info", &empty]).expect(3);
    run(&["verify", &empty]).expect(3);
    run(&["replay", &empty]).expect(1).says(&["empty.mcap", "no event"]);
    run(&["why", &empty, "mug"]).expect(1).says(&["no event"]);
}

#[test]
fn a_folder_without_segments_is_said_to_be_one() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().display().to_string();
    run(&["info", &path]).expect(1).says(&["holds no .mcap file"]);
}

#[test]
fn what_is_there_is_never_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let there = folder.path().join("there.mcap");
    let scene = folder.path().join("scene.json");
    fs::write(&there, "precious").unwrap();
    fs::write(&scene, on_recording("replay REC --json").out).unwrap();
    let (out, scene) = (there.display().to_string(), scene.display().to_string());
    let recording = golden("every_rejection").display().to_string();
    for args in [
        vec!["recover", &recording, "-o", &out],
        vec!["reprocess", &recording, "-o", &out],
        vec!["export", &recording, "--format", "dot", "-o", &out],
        vec!["import", "scene", &scene, "-o", &out],
        vec!["ingest", "-o", &out],
    ] {
        run(&args).expect(1).says(&["choose another name", "there.mcap"]);
        assert_eq!(fs::read_to_string(&there).unwrap(), "precious", "{args:?}");
    }
    let segments = folder.path().join("segments/").display().to_string();
    run(&["import", "scene", &scene, "-o", &segments]).expect(0);
    run(&["import", "scene", &scene, "-o", &segments]).expect(1).says(&["already", "choose"]);
    assert_eq!(fs::read_dir(&segments).unwrap().count(), 1);
}

#[test]
fn errors_name_the_value_and_what_would_do() {
    on_recording("replay REC --at noon").says(&["noon", "36h", "#42", "c7"]);
    on_recording("replay REC --at #900").says(&["every_rejection.mcap", "#900", "#64"]);
    on_recording("replay REC --at c900").says(&["c900", "c22"]);
    on_recording("replay REC --at 1999-01-01T00:00:00Z").says(&["before", "2026-01-05T00:00:01Z"]);
    on_recording("why REC mgu").says(&["mgu", "did you mean", "mug"]);
    on_recording("why REC mug").says(&["O4", "O5", "give an id"]);
    on_recording("bisect REC --when absent(mug").says(&["--when", "column", "`)`"]);
    on_recording("bisect REC --when flies(mug)").says(&["flies"]);
    on_recording("export REC --format svg").says(&["svg", "spark-dsg"]);
    on_recording("snapshot REC REC").says(&["every_rejection.snap", "rename one"]);
}

#[test]
fn a_recording_goes_through_a_scene_and_comes_back_with_its_hash() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("again.mcap").display().to_string();
    for name in ["every_rejection", "every_primitive", "household_day", "hydra_apartment"] {
        let recording = golden(name).display().to_string();
        let scene = run(&["replay", &recording, "--json"]).expect(0);
        let mut import = program();
        import.args(["import", "scene", "-", "--json", "-o", &path]).write_stdin(scene.out.clone());
        let imported = super::Ran::of(&import.output().unwrap()).expect(0).json();
        assert_eq!(imported["hash"], scene.json()["hash"], "{name}");
        let again = run(&["replay", &path, "--json"]).expect(0).json();
        assert_eq!(again["objects"], scene.json()["objects"], "{name}");
        fs::remove_file(&path).unwrap();
    }
}

#[test]
fn what_snapshot_accepts_passes_until_it_differs() {
    let folder = tempfile::tempdir().unwrap();
    let dir = folder.path().join("golden").display().to_string();
    let recording = golden("every_rejection").display().to_string();
    let args = ["snapshot", &recording, "--dir", &dir];
    run(&args).expect(3);
    let accept = [&args[..], &["--at", "#20", "--at", "end", "--accept"]].concat();
    run(&accept).expect(0);
    assert!(run(&args).expect(0).out.contains("1 passed"));
    let file = folder.path().join("golden/every_rejection.snap");
    let text = fs::read_to_string(&file).unwrap().replace("O7 vase", "O7 urn");
    fs::write(&file, text).unwrap();
    let failed = run(&args).expect(3);
    assert!(failed.out.contains("-O7 urn") && failed.out.contains("+O7 vase"), "{}", failed.out);
}
