//! Recording from standard input, a line at a time.

use super::{Ran, golden, keys, program, run};

fn ingest(args: &[&str], lines: &str) -> Ran {
    let mut command = program();
    command.arg("ingest").args(args).write_stdin(lines);
    Ran::of(&command.output().unwrap())
}

fn line(second: u32, message: &str) -> String {
    format!(
        "{{\"at\":\"2026-02-01T00:00:{second:02}Z\",\"topic\":\"/robot/task_status\",\
         \"message\":{message}}}\n"
    )
}

#[test]
fn lines_are_answered_and_recorded() {
    let folder = tempfile::tempdir().unwrap();
    let segments = folder.path().join("segments/").display().to_string();
    let graph = golden("every_rejection").display().to_string();
    let lines = line(1, r#"{"task_id":"t","status":"picked","object":{"id":"O4"}}"#)
        + &line(2, r#"{"task_id":"t","status":"placed","room":{"label":"bedroom"}}"#);
    let ran = ingest(&["-o", &segments, "--graph", &graph, "--sync", "every"], &lines).expect(0);
    let answers = ran.json_lines();
    assert_eq!(answers.len(), 3);
    for answer in &answers {
        assert_eq!(keys(answer), "acknowledged at changes order");
    }
    // Everything that a line derives is safe when it is answered.
    assert_eq!(answers[0]["acknowledged"].as_u64(), Some(4));
    assert_eq!(answers[1]["acknowledged"].as_u64(), Some(7));
    assert_eq!(answers[1]["changes"][0]["outcome"], "applied");

    let again = ingest(&["-o", &segments], &line(3, r#"{"task_id":"u","status":"picked"}"#));
    let answers = again.expect(3).json_lines();
    assert_eq!(answers[0]["changes"][0]["code"], "unknown_task");
    run(&["verify", &segments]).expect(0);
    let info = run(&["info", &segments, "--json"]).expect(0).json();
    assert_eq!((&info["segments"], &info["changes"]), (&2.into(), &3.into()));
    ingest(&["-o", &segments, "--graph", &graph], "").expect(2).says(&["leave out --graph"]);
}

#[test]
fn a_refused_line_is_answered_and_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.mcap").display().to_string();
    let lines = [
        "nonsense\n".to_owned(),
        "\n".to_owned(),
        line(1, r#"{"task_id":"t","status":"lifted"}"#),
        "{\"at\":\"2026-02-01T00:00:01Z\",\"topic\":\"/change\",\"message\":{}}\n".to_owned(),
        "{\"at\":\"2026-02-01T00:00:01Z\",\"topic\":\"/clock\"}".to_owned(),
    ]
    .concat();
    let answers = ingest(&["-o", &path], &lines).expect(3).json_lines();
    let refused: Vec<u64> = answers.iter().filter_map(|a| a["line"].as_u64()).collect();
    assert_eq!(refused, [1, 3, 4]);
    assert!(answers[1]["error"].as_str().unwrap().contains("lifted"));
    assert_eq!(run(&["info", &path, "--json"]).expect(0).json()["messages"], 1);
}

#[test]
fn a_file_is_not_gone_on_with() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.mcap").display().to_string();
    ingest(&["-o", &path], "").expect(0);
    ingest(&["-o", &path], "").expect(1).says(&["a.mcap"]);
}
