//! Time on the command line: tables, learning, calibration, patrols, targets to look at.

use std::path::Path;

use serde_json::Value;

use super::{Ran, golden, keys, program, run};

const SCENE: &str = r#"{"rooms": [{"label": "kitchen", "access_to": ["hall"]}, {"label": "hall"}],
    "objects": [{"label": "mug", "room": "kitchen", "decay_rate": 0.0001},
                {"label": "oven", "room": "kitchen", "decay_rate": 0}]}"#;
const TABLE: &str = r#"{"classes": {"mug": {"half_life": "2 hours"}}}"#;

fn day() -> String {
    golden("household_day").display().to_string()
}

fn file(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path.display().to_string()
}

/// A recording of a scene under a table and a threshold, with a tick every hour.
fn ticking(folder: &Path) -> String {
    let (scene, table) = (file(folder, "scene.json", SCENE), file(folder, "table.json", TABLE));
    let out = folder.join("ticks.mcap").display().to_string();
    let tick =
        |hour: u32| format!("{{\"at\":\"2026-01-05T{hour:02}:00:00Z\",\"topic\":\"/clock\"}}\n");
    let lines: String = (1..8).map(tick).collect();
    let args = ["ingest", "--graph", &scene, "--decay", &table, "--stale-below", "0.5", "-o", &out];
    Ran::of(&program().args(args).write_stdin(lines).output().unwrap()).expect(0);
    out
}

#[test]
fn a_table_and_a_threshold_are_recorded_and_hold_when_run_again() {
    let folder = tempfile::tempdir().unwrap();
    let recording = ticking(folder.path());
    let why = run(&["why", &recording, "mug"]).expect(0).out;
    for words in [
        "a target to look at",
        "table.json: class \"mug\", half-life 2 hours",
        "probably no longer",
    ] {
        assert!(why.contains(words), "{words}: {why}");
    }
    let json = run(&["why", &recording, "mug", "--json"]).expect(0).json();
    assert_eq!(json["stale"].as_array().unwrap().len(), 1, "once: {json}");
    assert!(json["state"]["probability"].as_f64().unwrap() < 0.5);
    let oven = run(&["why", &recording, "oven", "--json"]).expect(0).json();
    assert_eq!((&oven["state"]["probability"], &oven["stale"]), (&Value::from(1.0), &Value::Null));
    assert_eq!(run(&["verify", &recording, "--json"]).expect(0).json()["status"], "intact");
    run(&["reprocess", &recording]).expect(0);
}

#[test]
fn a_table_changes_what_replay_believes() {
    let folder = tempfile::tempdir().unwrap();
    let table =
        file(folder.path(), "t.json", r#"{"classes": {}, "default": {"half_life": "1 minute"}}"#);
    let believed = |args: &[&str]| -> f64 {
        let day = day();
        let json = run(&[&["replay", &day, "--json"], args].concat()).expect(0).json();
        let objects = json["objects"].as_array().unwrap().clone();
        objects.iter().map(|it| it["probability"].as_f64().unwrap()).sum()
    };
    assert!(believed(&["--decay", &table]) < believed(&[]));
}

#[test]
fn what_is_learned_from_a_day_is_used_by_the_other_commands() {
    let folder = tempfile::tempdir().unwrap();
    let decay = folder.path().join("decay.json").display().to_string();
    let learned = run(&["learn-decay", &day(), "--same-day", "-o", &decay]).expect(0).out;
    assert!(learned.contains("toothbrush") && learned.contains("returns after"), "{learned}");
    let json: Value = serde_json::from_str(&std::fs::read_to_string(&decay).unwrap()).unwrap();
    assert_eq!(json["format"], "scenefold.decay/1");
    let toothbrush = &json["classes"]["toothbrush"];
    assert!(
        toothbrush["half_life"].is_string() && toothbrush["rate_95_per_s"].is_array(),
        "{toothbrush}"
    );
    for model in ["sigmoid", "birth-death", "places"] {
        run(&["replay", &day(), "--decay", &decay, "--time-model", model]).expect(0);
        run(&["patrol", &day(), "--from", "kitchen", "--decay", &decay, "--time-model", model])
            .expect(0);
    }
    let scores =
        run(&["calibrate", &day(), "--decay", &decay, "--same-day", "--json"]).expect(0).json();
    assert_eq!(keys(&scores), "given-birth-death given-places given-sigmoid graph never-changes");
}

#[test]
fn calibration_gives_a_score_for_each_model() {
    let folder = tempfile::tempdir().unwrap();
    let plot = folder.path().join("plot.svg").display().to_string();
    let line = ["calibrate", &day(), "--train-until", "14h", "--looks", "1h", "--gaps", "1h,2h"];
    let ran =
        run(&[&line[..], &["--same-day", "--json", "--plot", &plot]].concat()).expect(0).json();
    assert_eq!(
        keys(&ran),
        "birth-death graph most-frequent-place never-changes places sigmoid sigmoid-one training-mean"
    );
    let n = ran["sigmoid"]["n"].as_u64().unwrap();
    for (model, it) in ran.as_object().unwrap() {
        assert_eq!(it["n"], n, "{model}");
        assert!(it["log_loss"].as_f64().unwrap() >= 0.0 && it["brier"].as_f64().unwrap() <= 1.0);
        let by_age: u64 =
            it["by_age"].as_object().unwrap().values().map(|it| it["n"].as_u64().unwrap()).sum();
        assert_eq!(by_age, n, "{model}");
    }
    assert!(std::fs::read_to_string(&plot).unwrap().starts_with("<svg"));
}

#[test]
fn a_patrol_goes_from_room_to_room_within_its_budget() {
    let folder = tempfile::tempdir().unwrap();
    let plan = folder.path().join("plan.png").display().to_string();
    let ran =
        run(&["patrol", &day(), "--from", "kitchen", "--budget", "25", "--json", "-o", &plan]);
    let json = ran.expect(0).json();
    assert!(json["metres"].as_f64().unwrap() <= 25.0 && json["exact"] == true, "{json}");
    let stops = json["stops"].as_array().unwrap();
    assert_eq!(stops[0]["room"]["label"], "kitchen");
    let gains: f64 = stops.iter().map(|it| it["gain"].as_f64().unwrap()).sum();
    assert!((gains - json["gain"].as_f64().unwrap()).abs() < 1e-9);
    assert!(std::fs::metadata(&plan).unwrap().len() > 1000);
    let nowhere =
        run(&["patrol", &day(), "--from", "kitchen", "--budget", "0", "--json"]).expect(0).json();
    assert_eq!(nowhere["stops"].as_array().unwrap().len(), 1);
}

#[test]
fn presence_is_scored_from_a_table() {
    let folder = tempfile::tempdir().unwrap();
    let mut rows = String::from("landmark,kind,time_s,present\ncup,truth,0,1\ncup,truth,4000,1\n");
    (0..4000).for_each(|n| rows += &format!("cup,detection,{n},1\n"));
    let csv = file(folder.path(), "room.csv", &rows);
    let line = [
        "calibrate",
        "--presence",
        &csv,
        "--split",
        "30m",
        "--visit",
        "20s",
        "--every",
        "5m",
        "--json",
    ];
    let json = run(&line).expect(0).json();
    assert_eq!(keys(&json), "birth-death sigmoid training-mean");
    assert!(json["birth-death"]["brier"].as_f64().unwrap() < 0.01, "{json}");
}

#[test]
fn wrong_use_is_told_with_the_mend() {
    let folder = tempfile::tempdir().unwrap();
    let bad = file(folder.path(), "bad.json", r#"{"classes": {"mug": {"rate_per_s": -1}}}"#);
    let empty = folder.path().join("empty.mcap").display().to_string();
    let scene = file(folder.path(), "scene.json", SCENE);
    run(&["import", "scene", &scene, "-o", &empty]).expect(0);
    let day = day();
    let check = |args: &[&str], code: i32, words: &[&str]| drop(run(args).expect(code).says(words));
    check(&["replay", &day, "--decay", &bad], 1, &["bad.json", "mug", "-1", "≥ 0"]);
    check(&["replay", &day, "--time-model", "birth-death"], 2, &["--decay", "learn-decay"]);
    check(&["replay", &day, "--time-model", "magic"], 2, &["sigmoid, birth-death"]);
    check(&["learn-decay", &empty], 1, &["nothing to learn from"]);
    check(&["calibrate", &empty], 1, &["nothing to predict"]);
    check(&["calibrate", &day, "--train-until", "30d"], 1, &["nothing to predict", "after"]);
    check(&["calibrate", &day, "--gaps", "2h,1h"], 2, &["rise"]);
    check(&["calibrate", &day, "--looks", "0s"], 2, &["--looks"]);
    check(&["patrol", &day, "--from", "garage"], 2, &["no room is called \"garage\"", "kitchen"]);
    check(&["patrol", &day, "--from", "kitchen", "--budget", "NaN"], 2, &["--budget"]);
    check(
        &["import", "scene", &scene, "--stale-below", "1.5", "-o", "x.mcap"],
        2,
        &["stale_below"],
    );
}
