//! `simulate`: what the robot gets, and the truth beside it.

use std::path::{Path, PathBuf};
use std::process::Command;

use scenefold::recording::{Recording, Status, verify};
use scenefold::time::At;
use serde_json::Value;

/// Small pictures, few of them: what is tested is not what they show.
const SMALL: [&str; 4] = ["--size", "48x36", "--rate", "0.5"];

fn program(args: &[&str]) -> std::process::Output {
    Command::new(env!("CARGO_BIN_EXE_scenefold")).args(args).output().unwrap()
}

fn text(args: &[&str]) -> String {
    let output = program(args);
    assert!(output.status.success(), "{args:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn json(args: &[&str]) -> Value {
    serde_json::from_str(&text(args)).unwrap()
}

/// Simulates with these arguments; the recording and its truth.
fn simulate(folder: &Path, name: &str, args: &[&str]) -> (PathBuf, PathBuf) {
    let path = folder.join(name);
    let out = ["simulate", "-o", path.to_str().unwrap()];
    text(&[&out[..], &SMALL[..], args].concat());
    (path.clone(), path.with_extension("truth.mcap"))
}

/// Where the truth or a belief has an object by its label: `room` or `room/support`.
fn place(state: &Value, label: &str) -> Vec<String> {
    let objects = state["objects"].as_array().unwrap();
    let by_id = |id: &Value| objects.iter().find(|object| object["id"] == *id);
    let room = |id: &Value| {
        let rooms = state["rooms"].as_array().unwrap();
        rooms.iter().find(|room| room["id"] == *id).unwrap()["label"].as_str().unwrap().to_owned()
    };
    let mut places: Vec<String> = objects
        .iter()
        .filter(|object| object["label"] == label)
        .map(|object| match by_id(&object["support"]) {
            Some(support) => {
                format!("{}/{}", room(&object["room"]), support["label"].as_str().unwrap())
            }
            None => room(&object["room"]),
        })
        .collect();
    places.sort();
    places
}

#[test]
fn the_papers_mission_really_changes_what_the_paper_says() {
    let folder = tempfile::tempdir().unwrap();
    let (path, truth) = simulate(folder.path(), "in.mcap", &["--seed", "1"]);
    let [path, truth] = [&path, &truth].map(|path| path.to_str().unwrap());
    let (before, after) =
        (json(&["replay", truth, "--at", "start", "--json"]), json(&["replay", truth, "--json"]));
    assert_eq!(place(&before, "towel").len(), place(&after, "towel").len() + 1);
    assert_eq!(place(&before, "banana").len(), place(&after, "banana").len() + 1);
    assert_eq!(place(&after, "tv remote"), ["living room/sofa"]);
    assert_eq!(place(&before, "mug"), ["kitchen/dining table"]);
    assert_eq!(place(&after, "mug"), ["bedroom/nightstand"]);
    assert!(place(&after, "book").contains(&"bedroom/bed".to_owned()));
    // What the robot did itself is noticed; what people did needs eyes and ears.
    let noticed = folder.path().join("noticed.mcap");
    text(&["reprocess", path, "-o", noticed.to_str().unwrap()]);
    let belief = json(&["replay", noticed.to_str().unwrap(), "--json"]);
    assert_eq!(place(&belief, "mug"), place(&after, "mug"));
}

#[test]
fn the_recording_holds_inputs_only_and_the_truth_is_apart() {
    let folder = tempfile::tempdir().unwrap();
    let (path, truth) = simulate(folder.path(), "in.mcap", &["--random", "2", "--seed", "4"]);
    for path in [&path, &truth] {
        let verified = verify(path, &mut |_| ()).unwrap();
        assert_eq!(verified.status, Status::Intact, "{:?}", verified.findings);
    }
    let info = json(&["info", "--json", path.to_str().unwrap()]);
    let topics: Vec<&str> = info["channels"]
        .as_array()
        .unwrap()
        .iter()
        .map(|channel| channel["topic"].as_str().unwrap())
        .collect();
    for topic in ["/tf", "/tf_static", "/camera/color/image/compressed", "/camera/depth/image"] {
        assert!(topics.contains(&topic), "{topic} is missing in {topics:?}");
    }
    let forbidden = ["/change", "/primitive", "/truth", "/evidence", "/model"];
    let leaked = |topic: &&str| forbidden.iter().any(|prefix| topic.starts_with(prefix));
    assert!(!topics.iter().any(leaked), "{topics:?}");
    // The graph that the robot starts from is that of the truth.
    let start =
        |path: &Path| Recording::open(path).unwrap().state_at(At::Start, 1).unwrap().graph().hash();
    assert_eq!(start(&path), start(&truth));
}

#[test]
fn same_seed_same_bytes_for_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let run = |name: &str, threads: &str, seed: &str| {
        let path = folder.path().join(name);
        let status = Command::new(env!("CARGO_BIN_EXE_scenefold"))
            .args(["simulate", "--random", "1", "--house", "cottage", "--seed", seed, "-o"])
            .arg(&path)
            .args(["--size", "64x48", "--rate", "0.2"])
            .env("RAYON_NUM_THREADS", threads)
            .status();
        assert!(status.unwrap().success());
        [path.clone(), path.with_extension("truth.mcap")].map(|path| std::fs::read(path).unwrap())
    };
    let one = run("one.mcap", "1", "9");
    assert!(one == run("two.mcap", "2", "9"), "the number of threads shows");
    assert!(one[0] != run("other.mcap", "2", "10")[0], "the seed does not show");
}

#[test]
fn a_printed_scenario_can_be_simulated() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("mine.json");
    std::fs::write(&file, text(&["simulate", "--random", "1", "--seed", "3", "--print"])).unwrap();
    let file = file.to_str().unwrap();
    let (path, _) = simulate(folder.path(), "mine.mcap", &["--scenario", file]);
    let (direct, _) = simulate(folder.path(), "direct.mcap", &["--random", "1", "--seed", "3"]);
    assert_eq!(std::fs::read(path).unwrap(), std::fs::read(direct).unwrap());
}

#[test]
fn what_cannot_be_simulated_says_what_and_where() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("bad.json");
    let out = folder.path().join("out.mcap");
    for (scenario, words) in [
        (r#"{"name": "x", "house": "castle"}"#, &["castle", "apartment"][..]),
        (
            r#"{"name": "x", "house": "apartment", "actions":
                [{"time": "1s", "action": "removed", "object": "unicorn"}]}"#,
            &["bad.json", "actions[0]", "unicorn"],
        ),
        (r#"{"name": "x"}"#, &["bad.json", "house"]),
    ] {
        std::fs::write(&file, scenario).unwrap();
        let [file, out] = [&file, &out].map(|path| path.to_str().unwrap());
        let output = program(&["simulate", "--scenario", file, "-o", out]);
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{error}");
        words.iter().for_each(|word| assert!(error.contains(word), "{error:?} lacks {word:?}"));
        assert!(!Path::new(out).exists(), "nothing is left behind");
    }
}

#[test]
fn the_way_of_the_robot_is_drawn_from_the_recording_and_ends_where_it_does() {
    let folder = tempfile::tempdir().unwrap();
    let (path, _) = simulate(folder.path(), "in.mcap", &["--random", "1", "--seed", "2"]);
    let recording = Recording::open(&path).unwrap();
    let way = recording.way_of("base_link", 1, u64::MAX).unwrap();
    assert!(way.len() > 50, "{} points", way.len());
    let inside = |at: &[f64; 2]| (0.2..9.2).contains(&at[0]) && (0.2..8.4).contains(&at[1]);
    assert!(way.iter().all(inside), "the apartment is 9.4 m by 8.6 m");
    assert_eq!(recording.way_of("nobody", 1, u64::MAX).unwrap(), Vec::<[f64; 2]>::new());
    let name = path.to_str().unwrap();
    let svg = text(&["plan", name, "--path"]);
    assert!(svg.len() > text(&["plan", name]).len() + 100, "nothing was drawn");
    let wrong = program(&["plan", name, "--path", "nobody"]);
    let error = String::from_utf8(wrong.stderr).unwrap();
    assert!(!wrong.status.success() && error.contains("nobody"), "{error}");
}

#[test]
fn a_truth_that_is_there_already_is_not_overwritten_and_nothing_is_left_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let (path, truth) = (folder.path().join("in.mcap"), folder.path().join("in.truth.mcap"));
    std::fs::write(&truth, "mine").unwrap();
    let output = program(&["simulate", "-o", path.to_str().unwrap()]);
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(!output.status.success() && error.contains("in.truth.mcap"), "{error}");
    assert_eq!(std::fs::read_to_string(truth).unwrap(), "mine");
    assert!(!path.exists(), "half a simulation is left");
}
