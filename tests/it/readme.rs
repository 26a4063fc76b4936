//! The front door tells the truth: every `$` line of the README runs and, where the README shows
//! what comes of it, that comes of it. `…` stands for whatever comes.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

struct Example {
    command: String,
    shown: Vec<String>,
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The `$` lines of all `console` blocks, in order.
fn examples(readme: &str) -> Vec<Example> {
    let mut examples: Vec<Example> = Vec::new();
    let mut inside = false;
    for line in readme.lines() {
        match line {
            "```console" => inside = true,
            "```" => inside = false,
            _ if !inside => {}
            _ => match (line.strip_prefix("$ "), examples.last_mut()) {
                (Some(command), _) => {
                    examples.push(Example { command: command.to_owned(), shown: Vec::new() });
                }
                (None, Some(example)) => example.shown.push(line.to_owned()),
                (None, None) => panic!("a block begins without a command: {line}"),
            },
        }
    }
    examples
}

/// A folder as a reader of the README has it, with the recordings.
fn home() -> tempfile::TempDir {
    let home = tempfile::tempdir().unwrap();
    let recordings = home.path().join("recordings");
    fs::create_dir(&recordings).unwrap();
    for entry in fs::read_dir(root().join("recordings")).unwrap() {
        let path = entry.unwrap().path();
        fs::copy(&path, recordings.join(path.file_name().unwrap())).unwrap();
    }
    home
}

fn run(home: &Path, example: &Example) -> String {
    let program = Path::new(env!("CARGO_BIN_EXE_scenefold")).parent().unwrap();
    let path = format!("{}:{}", program.display(), std::env::var("PATH").unwrap());
    let mut shell = Command::new("sh");
    shell.args(["-c", &example.command]).current_dir(home).env("PATH", path);
    let output = shell.output().unwrap();
    let (out, err) = (String::from_utf8(output.stdout).unwrap(), output.stderr);
    let code = output.status.code();
    assert!(
        matches!(code, Some(0 | 3)),
        "{}: {code:?}\n{out}\n{}",
        example.command,
        String::from_utf8_lossy(&err)
    );
    out
}

/// Whether `shown` is what came, `…` matching any number of lines.
fn agrees(shown: &[String], came: &[&str]) -> bool {
    match (shown.split_first(), came.split_first()) {
        (None, None) => true,
        (Some((first, rest)), _) if first == "…" => {
            (0..=came.len()).any(|skipped| agrees(rest, &came[skipped..]))
        }
        (Some((first, shown)), Some((line, came))) => first == line && agrees(shown, came),
        _ => false,
    }
}

#[test]
fn every_command_of_the_readme_runs_and_gives_what_is_shown() {
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    let (examples, home) = (examples(&readme), home());
    assert!(examples.len() >= 15);
    for example in &examples {
        let came = run(home.path(), example);
        let lines: Vec<&str> = came.lines().collect();
        assert!(
            agrees(&example.shown, &lines),
            "{}\nshown:\n{}\ncame:\n{came}",
            example.command,
            example.shown.join("\n")
        );
    }
}

#[test]
fn the_table_of_imports_names_commands_that_exist() {
    let readme = fs::read_to_string(root().join("README.md")).unwrap();
    for format in ["spark-dsg", "virtualhome", "actions", "scene"] {
        assert!(readme.contains(&format!("`scenefold import {format} ")), "{format}");
        let mut help = Command::new(env!("CARGO_BIN_EXE_scenefold"));
        assert!(help.args(["import", format, "--help"]).output().unwrap().status.success());
    }
}

#[test]
fn the_tour_ends_well() {
    let tour = Command::new(env!("CARGO_BIN_EXE_scenefold")).output().unwrap();
    assert_eq!(tour.status.code(), Some(0));
    let text = String::from_utf8(tour.stdout).unwrap();
    assert!(text.contains("mug O1148") && text.ends_with("--help\n"), "{text}");
}
