//! Pipes: standard input, closed outputs, colour.

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Stdio};

use super::{Ran, golden, on_recording, program};

#[test]
fn a_recording_is_read_from_standard_input() {
    let bytes = fs::read(golden("every_rejection")).unwrap();
    for line in [
        "info REC --json",
        "replay REC --at 20s",
        "why REC O4",
        "log REC",
        "diff REC --from #20",
        "bisect REC --when absent(O4)",
        "export REC --format dot",
        "reprocess REC",
        "verify REC",
    ] {
        let from_file = on_recording(line);
        let mut piped = program();
        piped.args(line.split(' ').map(|word| if word == "REC" { "-" } else { word }));
        let piped = Ran::of(&piped.write_stdin(bytes.clone()).output().unwrap());
        assert_eq!(piped.out, from_file.out, "{line}");
        assert_eq!(piped.code, from_file.code, "{line}");
    }
}

#[test]
fn noise_on_standard_input_is_said_to_be_no_recording() {
    let mut piped = program();
    let ran = Ran::of(&piped.args(["info", "-"]).write_stdin("hello").output().unwrap());
    ran.expect(1).says(&["not an MCAP file", "standard input"]);
}

#[test]
fn a_broken_pipe_ends_quietly() {
    for args in [&["log", "--json"][..], &["replay", "--json"], &["log"], &["replay"]] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_scenefold"));
        command.args(args).arg(golden("household_day"));
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        // Read one line, as `head -1` does, and hang up.
        let mut line = String::new();
        BufReader::with_capacity(16, child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        assert!(!line.is_empty());
        let mut errors = String::new();
        child.stderr.take().unwrap().read_to_string(&mut errors).unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(0), "{args:?}: {errors}");
        assert_eq!(errors, "");
    }
}

#[test]
fn there_is_no_colour_where_there_is_no_terminal() {
    for line in ["replay REC", "log REC", "diff REC", "info REC", "verify REC"] {
        assert!(!on_recording(line).out.contains('\x1b'), "{line}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn colour_is_for_terminals_and_no_color_is_respected() {
    // `script` runs its command on a terminal of its own.
    let on_terminal = |no_color: &str| {
        let line = format!(
            "{} replay {}",
            env!("CARGO_BIN_EXE_scenefold"),
            golden("every_rejection").display()
        );
        let mut script = Command::new("script");
        script.args(["-qec", &line, "/dev/null"]).env("NO_COLOR", no_color).stdin(Stdio::null());
        script.output().ok().filter(|output| output.status.success())
    };
    let (Some(plain), Some(coloured)) = (on_terminal("1"), on_terminal("")) else {
        eprintln!("no `script` here: colour is not tested");
        return;
    };
    assert!(!plain.stdout.contains(&b'\x1b'));
    assert!(coloured.stdout.contains(&b'\x1b'));
}
