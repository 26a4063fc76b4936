//! `--help` of every command: what it says is part of the contract.

use insta::assert_snapshot;

use super::{program, run};
use crate::golden::in_snapshots;

const COMMANDS: &[&str] = &[
    "info",
    "log",
    "replay",
    "diff",
    "why",
    "bisect",
    "reprocess",
    "verify",
    "recover",
    "snapshot",
    "import",
    "export",
    "ingest",
    "simulate",
    "house",
    "plan",
    "render",
    "tell",
    "learn-decay",
    "patrol",
    "calibrate",
    "demo",
];

fn help(args: &[&str]) -> String {
    let mut command = program();
    command.args(args).arg("--help").env("COLUMNS", "100");
    let output = command.output().unwrap();
    assert!(output.status.success());
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn the_help_of_every_command_is_as_it_was() {
    let mut text = help(&[]);
    for command in COMMANDS {
        text += &format!("\n=== {command}\n{}", help(&[command]));
    }
    for format in ["scene", "spark-dsg", "virtualhome", "actions"] {
        text += &format!("\n=== import {format}\n{}", help(&["import", format]));
    }
    in_snapshots(|| assert_snapshot!("help", text));
}

#[test]
fn every_command_shows_examples() {
    assert!(help(&[]).contains("Examples:"));
    for command in COMMANDS.iter().filter(|command| **command != "demo") {
        let text = help(&[command]);
        assert!(text.contains("Examples:"), "{command}");
        assert!(text.contains(&format!("scenefold {command}")), "{command}");
    }
}

#[test]
fn every_command_of_the_help_is_known_here() {
    let text = help(&[]);
    let listed = text.lines().skip_while(|line| *line != "Commands:").skip(1);
    let listed: Vec<&str> = listed
        .take_while(|line| !line.is_empty())
        .filter(|line| line.starts_with("  ") && !line.starts_with("   "))
        .filter_map(|line| line.split_whitespace().next())
        .filter(|command| *command != "help")
        .collect();
    assert_eq!(listed, COMMANDS);
    assert!(run(&["--version"]).expect(0).out.starts_with("scenefold "));
}
