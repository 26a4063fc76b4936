//! `scenefold ingest` with a chat server: what it sends, records, prints and never tells.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Command, Output, Stdio};

use scenefold::event::Event;
use scenefold::recording::{Recording, Walk};
use scenefold::time::At;

use super::recorded::moved;
use super::server::{Reply, Server};
use crate::house::events;

const KEY: &str = "sk-live-abcdefghijklmnop-TOPSECRET";

fn ingest(args: &[&str], env: &[(&str, &str)], lines: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_scenefold"));
    command.arg("ingest").args(args);
    command.env_remove("OPENAI_API_KEY").env_remove("OPENAI_BASE_URL");
    command.envs(env.iter().copied());
    command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    // It may end without reading.
    let _ = child.stdin.take().unwrap().write_all(lines.as_bytes());
    child.wait_with_output().unwrap()
}

fn graph() -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("recordings");
    folder.join("every_rejection.mcap").display().to_string()
}

fn said(second: u32, text: &str) -> String {
    let text = serde_json::to_string(text).unwrap();
    format!(
        "{{\"at\":\"2026-02-01T00:00:{second:02}Z\",\"topic\":\"/human/utterance\",\
         \"message\":{{\"text\":{text}}}}}\n"
    )
}

fn replies(path: &Path) -> Vec<Result<String, String>> {
    let all = events(&Recording::open(path).unwrap(), Walk::Everything);
    let replies = all.into_iter().filter_map(|logged| match logged.event {
        Event::LanguageReply(reply) => Some(reply.answer),
        _ => None,
    });
    replies.collect()
}

#[test]
fn what_a_server_says_is_recorded_and_the_key_is_not() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.mcap");
    let denied = format!(r#"{{"error":{{"message":"bad key {KEY}"}}}}"#);
    let server = Server::start(vec![
        Reply::Content(moved()),
        Reply::Http(401, "", "application/json", denied),
    ]);
    let lines = said(1, "The mug is in the bedroom.") + &said(2, "It's \"here\"\u{7}\n{}");
    let file = path.display().to_string();
    let args = ["-o", &file, "--graph", &graph(), "--server", &server.base, "--model", "m"];
    let args = [&args[..], &["--key-env", "MY_KEY"]].concat();
    let output = ingest(&args, &[("MY_KEY", KEY)], &lines);
    let requests = server.requests();
    assert_eq!(requests[0].headers["authorization"], format!("Bearer {KEY}"));
    let replies = replies(&path);
    assert_eq!(replies[0], Ok(moved()));
    assert_eq!(replies[1], Err("the server answered with status 401: bad key [key]".to_owned()));
    let shown = [output.stdout, output.stderr].concat();
    assert!(!String::from_utf8_lossy(&shown).contains("TOPSECRET"));
    let all = events(&Recording::open(&path).unwrap(), Walk::Everything);
    assert!(!format!("{all:?}").contains("TOPSECRET"));
    let bytes = std::fs::read(&path).unwrap();
    assert!(!bytes.windows(9).any(|window| window == b"TOPSECRET"));
    let verify = Command::new(env!("CARGO_BIN_EXE_scenefold")).arg("verify").arg(&path).output();
    assert_eq!(verify.unwrap().status.code(), Some(0));
}

#[test]
fn a_recorder_killed_while_a_server_thinks_has_what_was_acknowledged() {
    let scratch = tempfile::tempdir().unwrap();
    let folder = scratch.path().join("segments");
    std::fs::create_dir(&folder).unwrap();
    let server = Server::start(vec![Reply::Content(moved()), Reply::Hang]);
    let mut child = Command::new(env!("CARGO_BIN_EXE_scenefold"))
        .args(["ingest", "--sync", "every", "--graph", &graph(), "--model", "m", "-o"])
        .arg(&folder)
        .args(["--server", &server.base])
        .env_remove("OPENAI_API_KEY")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let stdin = child.stdin.as_mut().unwrap();
    stdin.write_all(said(1, "The mug is in the bedroom.").as_bytes()).unwrap();
    let mut answers = BufReader::new(child.stdout.take().unwrap()).lines();
    let first: serde_json::Value = serde_json::from_str(&answers.next().unwrap().unwrap()).unwrap();
    stdin.write_all(said(2, "The bowl is gone.").as_bytes()).unwrap();
    // Joins the server: the second question has arrived, and is not answered.
    server.requests();
    child.kill().unwrap();
    child.wait().unwrap();
    let left = events(&Recording::open(&folder).unwrap(), Walk::Everything);
    assert!(left.len() as u64 >= first["acknowledged"].as_u64().unwrap());
    assert_eq!(left.iter().filter(|it| matches!(it.event, Event::Utterance(_))).count(), 1);
    // It is gone on with, and said again.
    let server = Server::start(vec![Reply::Content("{}".to_owned())]);
    let path = folder.display().to_string();
    let args = ["-o", &path, "--server", &server.base, "--model", "m"];
    let output = ingest(&args, &[], &said(2, "The bowl is gone."));
    assert!(matches!(output.status.code(), Some(0 | 3)), "{output:?}");
    assert_eq!(replies(&folder), [Ok(moved()), Ok("{}".to_owned())]);
    Recording::open(&folder).unwrap().state_at(At::End, 1).unwrap();
}

#[track_caller]
fn refused(args: &[&str], env: &[(&str, &str)], because: &str) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.mcap").display().to_string();
    let output = ingest(&[&["-o", &path], args].concat(), env, "");
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert!(error.contains(because), "{error}");
    assert!(!error.contains("TOPSECRET"), "{error}");
    assert!(!Path::new(&path).exists());
}

#[test]
fn wrong_use_is_told_and_leaves_nothing() {
    let here = "http://localhost:1/v1";
    refused(&["--server", here], &[], "--model");
    refused(&["--model", "m"], &[], "OPENAI_BASE_URL");
    refused(&["--model", "m"], &[("OPENAI_BASE_URL", "nowhere")], "OPENAI_BASE_URL: it must begin");
    refused(&["--model", "m", "--server", "http://u:TOPSECRET@h/v1"], &[], "--server: a user");
    let key = ["--model", "m", "--server", here, "--key-env", "MY_KEY"];
    refused(&key, &[], "MY_KEY is not set");
    refused(&key, &[("MY_KEY", "TOPSECRET two")], "the key in MY_KEY: it has characters");
}

#[test]
fn a_recording_keeps_to_who_reads_its_language() {
    let scratch = tempfile::tempdir().unwrap();
    let folder = scratch.path().join("segments/").display().to_string();
    assert_eq!(ingest(&["-o", &folder], &[], "").status.code(), Some(0));
    let server = ["-o", &folder, "--model", "m", "--server", "http://localhost:1/v1"];
    let output = ingest(&server, &[], "");
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    assert!(String::from_utf8_lossy(&output.stderr).contains("built-in interpreter"));
}
