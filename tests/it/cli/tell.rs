//! `scenefold tell`.

use super::{program, run};

fn home() -> String {
    format!("{}/tests/data/language/family_home.json", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn a_sentence_is_told_with_what_it_changes() {
    let told = run(&["tell", &home(), "I ate the banana", "--json"]).expect(0).json();
    assert_eq!(told["text"], "I ate the banana");
    assert_eq!(told["changes"][0]["action"], "removed");
    assert_eq!(told["changes"][0]["object"]["id"], "O11");
    assert_eq!(told["changes"][0]["source_room"]["label"], "living room");
    run(&["tell", &home(), "I ate the apple"]).expect(3);
    let nothing = run(&["tell", &home(), "Where is the mug?"]).expect(0);
    assert_eq!(nothing.out, "changes nothing: a question\n");
}

#[test]
fn each_line_is_told_by_itself() {
    let mut command = program();
    command.args(["tell", &home(), "--lines", "-", "--json"]);
    command.write_stdin("I ate the banana\n\nI ate the banana\nput it back\n");
    let ran = super::Ran::of(&command.output().unwrap()).expect(0);
    let changes: Vec<usize> =
        ran.json_lines().iter().map(|line| line["changes"].as_array().unwrap().len()).collect();
    assert_eq!(changes, [1, 0, 1, 0]);
}

#[test]
fn a_task_is_told_as_nodes() {
    let text = "Bring the mug to the couch in the living room";
    let told = run(&["tell", &home(), "--task", text, "--json"]).expect(0).json();
    let task = &told["tasks"][0];
    assert_eq!(task["object"]["id"], "O10");
    assert_eq!(task["support"]["id"], "O3");
    assert_eq!(task["target_room"]["id"], "R1");
    assert_eq!(task["source_room"], serde_json::Value::Null);
}

#[test]
fn what_was_told_is_recorded_and_traced_to_its_words() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("day.mcap").display().to_string();
    run(&["tell", &home(), "I put the mug on the desk", "-o", &path]).expect(0);
    let why = run(&["why", &path, "mug"]).expect(0);
    assert!(why.out.contains("I put the mug on the desk"), "{}", why.out);
    run(&["reprocess", &path]).expect(0);
    run(&["verify", &path]).expect(0);
}

#[test]
fn wrong_use_is_said() {
    run(&["tell", &home()]).expect(2);
    let early = run(&["tell", &home(), "I ate the banana", "--at", "2020-01-01T00:00:00Z"]);
    early.expect(2).says(&["--at", "2026-01-07T15:00:00Z"]);
}
