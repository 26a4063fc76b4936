//! The inputs that fuzzing starts from: recordings, payloads, states and texts that are valid.
//! `SCENEFOLD_FUZZ_SEEDS=fuzz/corpus cargo test --test it fuzz_seeds` writes them.

use std::error::Error;
use std::fs;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use scenefold::event::{Event, Topic};
use scenefold::recording::{Recording, Walk};
use scenefold::time::At;
use scenefold::updater::{Config, Updater};
use scenefold::wire;

use crate::golden;

/// Larger seeds slow fuzzing down more than they help.
const LARGEST: usize = 48 << 10;
const PAYLOADS_PER_RECORDING: usize = 60;

const TEXTS: [&str; 16] = [
    "start",
    "end",
    "12.5s",
    "1h30m",
    "65d",
    "#42",
    "c7",
    "1767571200000000000",
    "2026-01-05T08:00:00Z",
    "absent(mug)",
    "in(mug, kitchen) and not held(O17)",
    "on(mug, table) or count(cup) > 2",
    "O17",
    "mug",
    r#"{"at":"2026-01-05T08:00:00Z","topic":"/robot/task_status","message":{"task_id":"t","status":"placed","object":{"id":"O1","label":"mug"},"room":{"id":"R1"},"pose":{"position":[1,2,3]}}}"#,
    r#"{"at":"2026-01-05T08:00:00Z","topic":"/human/utterance","message":{"speaker":"a","text":"b"}}"#,
];

const IMPORTS: [(u8, &str); 4] = [
    (
        0,
        r#"{"rooms":[{"id":"R0","label":"hall"}],"objects":[{"id":"O0","label":"cup","room":"R0","support":null,"pose":{"position":[0,0,0],"orientation":{"w":1,"x":0,"y":0,"z":0}},"size":[1,1,1]}]}"#,
    ),
    (
        1,
        r#"{"SPARK_ORIGIN":{"version":"1.1.0"},"nodes":[{"id":5692549928996306944,"layer":2,"attributes":{"type":"ObjectNodeAttributes","position":[0,0,0],"name":"","semantic_label":1}}],"edges":[],"layer_ids":[2,3,4,5]}"#,
    ),
    (
        2,
        r#"{"nodes":[{"id":1,"class_name":"kitchen","category":"Rooms","bounding_box":{"center":[0,0,0],"size":[1,1,1]}}],"edges":[{"from_id":2,"to_id":1,"relation_type":"INSIDE"}]}"#,
    ),
    (
        3,
        "split,day,minute,action,object,object_id,destination,destination_id\n\
         train,0,1.5,grab,cup,2,,\ntrain,0,2,putback,cup,2,sink,4\n",
    ),
];

const ANSWERS: [&str; 3] = [
    r#"{"kind":"report","changes":[{"action":"moved","object":{"words":"the mug","name":"mug","adjectives":[],"id":"O3","count":1},"support":null,"source_room":null,"target_room":{"words":"bedroom","name":"bedroom","adjectives":[],"id":null,"count":1},"when":{"earliest":2,"latest":0},"confidence":0.9}]}"#,
    r#"{"kind":"question","changes":[]}"#,
    r#"{"nearest":[{"name":"cup","label":"mug","similarity":0.7}]}"#,
];

#[test]
fn what_fuzzing_starts_from_can_be_made() {
    let scratch = tempfile::tempdir().unwrap();
    let asked = std::env::var_os("SCENEFOLD_FUZZ_SEEDS").map(PathBuf::from);
    let corpus = asked.unwrap_or(scratch.path().to_owned());
    for golden in golden::all() {
        of_recording(&golden.path, &corpus).unwrap();
    }
    for (n, text) in TEXTS.iter().enumerate() {
        put(&corpus, "expr_at", &n.to_string(), text.as_bytes()).unwrap();
    }
    for (format, text) in IMPORTS {
        let bytes = [&[format], text.as_bytes()].concat();
        put(&corpus, "importers", &format.to_string(), &bytes).unwrap();
    }
    for (n, answer) in ANSWERS.iter().enumerate() {
        let bytes = ["the mug is in the bedroom now\0", answer].concat();
        put(&corpus, "model_reply", &n.to_string(), bytes.as_bytes()).unwrap();
    }
    for target in ["reader", "wire", "importers", "updater_bytes", "expr_at", "model_reply"] {
        assert!(fs::read_dir(corpus.join(target)).unwrap().next().is_some(), "{target}");
    }
}

fn of_recording(path: &Path, corpus: &Path) -> Result<(), Box<dyn Error>> {
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    put(corpus, "reader", &name, &fs::read(path)?)?;
    let recording = Recording::open(path)?;
    let mut updater = Updater::new(Config::default());
    let mut count = 0;
    let mut failed = None;
    recording.visit_events(Walk::Events, (1, u64::MAX), &mut |logged| {
        let written = payload(corpus, &name, count, &logged.event).and_then(|()| {
            if logged.event.is_input() {
                updater.update(logged.published, logged.event.clone())?;
                put(corpus, "updater_bytes", &format!("{name}-{count}"), &updater.to_bytes())?;
            }
            Ok(())
        });
        failed = written.err();
        count += 1;
        match failed.is_some() || count >= PAYLOADS_PER_RECORDING {
            true => ControlFlow::Break(()),
            false => ControlFlow::Continue(()),
        }
    })?;
    let graph = recording.state_at(At::End, 1)?.world;
    put(corpus, "updater_bytes", &format!("{name}-graph"), &graph.graph().to_bytes())?;
    failed.map_or(Ok(()), Err)
}

fn payload(corpus: &Path, name: &str, n: usize, event: &Event) -> Result<(), Box<dyn Error>> {
    let topic = event.topic();
    let place = Topic::OWN.iter().position(|own| *own == topic).unwrap_or(Topic::OWN.len());
    let bytes = [vec![place as u8], wire::encode(event)].concat();
    put(corpus, "wire", &format!("{name}-{n}"), &bytes)
}

fn put(corpus: &Path, target: &str, name: &str, bytes: &[u8]) -> Result<(), Box<dyn Error>> {
    let folder = corpus.join(target);
    fs::create_dir_all(&folder)?;
    if bytes.len() <= LARGEST {
        fs::write(folder.join(name), bytes)?;
    }
    Ok(())
}
