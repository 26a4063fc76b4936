//! Attacks by somebody who can write MCAP files: all checksums of the container hold.

use std::fs;
use std::path::Path;
use std::sync::Arc;

use scenefold::change::World;
use scenefold::container::{
    Channel, ChannelSpec, ChunkClass, Limits, LogFile, LogOptions, LogWriter, MessageFilter,
    SchemaSpec,
};
use scenefold::event::Event;
use scenefold::graph::{NodeId, StateHash};
use scenefold::recording::{Recorder, RecorderOptions, Recording, Status, Verified, verify};
use scenefold::time::At;
use scenefold::updater::{Config, Updater};
use scenefold::wire::{self, CheckpointHead, decode_checkpoint, encode_checkpoint};

use crate::house::{Input, MANY_CHECKPOINTS, apply, at, house, id, label, record, status};

/// A message of a log, to be written again.
#[derive(Clone, Debug)]
struct Message {
    topic: String,
    sequence: u32,
    time: u64,
    published: u64,
    data: Vec<u8>,
}

/// Fifty times the mug is taken and put.
fn inputs() -> Vec<Input> {
    use scenefold::event::Status::{Done, Picked, Placed};
    use scenefold::event::TaskStatus;
    let mut inputs = vec![(at(0), Event::InitialGraph(house()))];
    for n in 0..50 {
        let room = label(if n % 2 == 0 { "bedroom" } else { "kitchen" });
        let object = Some(scenefold::change::NodeRef::id(id("O4")));
        for report in [
            TaskStatus { object, ..status("t", Picked) },
            TaskStatus { room: Some(room), ..status("t", Placed) },
            status("t", Done),
        ] {
            inputs.push((at(inputs.len() as u64), Event::TaskStatus(report)));
        }
    }
    inputs
}

/// The recording, opened as raw messages.
fn open(path: &Path) -> LogFile {
    LogFile::open(Arc::new(fs::read(path).unwrap()), Limits::default()).unwrap()
}

fn messages(log: &LogFile) -> Vec<Message> {
    let mut messages = Vec::new();
    let mut cursor = log.messages(MessageFilter::default());
    while let Some(message) = cursor.next_message().unwrap() {
        messages.push(Message {
            topic: log.channels()[&message.channel].topic.clone(),
            sequence: message.sequence,
            time: message.log_time,
            published: message.publish_time,
            data: message.data.to_vec(),
        });
    }
    messages
}

fn spec(log: &LogFile, channel: &Channel) -> ChannelSpec {
    let schema = log.schemas().get(&channel.schema_id).map(|schema| SchemaSpec {
        name: schema.name.clone(),
        encoding: schema.encoding.clone(),
        data: schema.data.to_vec(),
    });
    let class = match channel.topic.as_str() {
        "/checkpoint" => ChunkClass::Checkpoint,
        _ => ChunkClass::Event,
    };
    let (topic, message_encoding) = (channel.topic.clone(), channel.message_encoding.clone());
    ChannelSpec { topic, message_encoding, metadata: channel.metadata.clone(), schema, class }
}

/// Writes `messages` as a file of which every checksum holds, with the metadata of `log`.
fn write(log: &LogFile, messages: &[Message], path: &Path) {
    let mut writer = LogWriter::new(Vec::new(), LogOptions::default()).unwrap();
    let (last, first) = log.metadata().split_last().unwrap();
    for record in first {
        writer.write_metadata(&record.name, record.metadata.clone()).unwrap();
    }
    for message in messages {
        let channel = log.channels().values().find(|c| c.topic == message.topic).unwrap();
        let handle = writer.register(spec(log, channel)).unwrap();
        let Message { sequence, time, published, data, .. } = message;
        if message.topic == "/checkpoint" {
            writer.flush().unwrap();
        }
        writer.write(handle, *sequence, *time, *published, data).unwrap();
    }
    writer.flush().unwrap();
    writer.write_metadata(&last.name, last.metadata.clone()).unwrap();
    fs::write(path, writer.finish().unwrap()).unwrap();
}

#[test]
fn an_end_that_was_cut_off_with_its_seal_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let (genuine, path) = (folder.path().join("a.mcap"), folder.path().join("b.mcap"));
    record(&genuine, &inputs(), &MANY_CHECKPOINTS, 20);
    let log = open(&genuine);
    let mut writer = LogWriter::new(Vec::new(), LogOptions::default()).unwrap();
    let meta = &log.metadata()[0];
    writer.write_metadata(&meta.name, meta.metadata.clone()).unwrap();
    for message in messages(&log).into_iter().take(100) {
        let channel = log.channels().values().find(|c| c.topic == message.topic).unwrap();
        let handle = writer.register(spec(&log, channel)).unwrap();
        let Message { sequence, time, published, data, .. } = message;
        writer.write(handle, sequence, time, published, &data).unwrap();
    }
    fs::write(&path, writer.finish().unwrap()).unwrap();
    assert_tampered(&verify(&path, &mut |_| ()).unwrap());
}

/// What verify says of a recording whose messages were edited.
fn forged(edit: impl FnOnce(&mut Vec<Message>)) -> Verified {
    with_forged(edit, |path| verify(path, &mut |_| ()).unwrap())
}

fn with_forged<T>(edit: impl FnOnce(&mut Vec<Message>), look: impl FnOnce(&Path) -> T) -> T {
    let folder = tempfile::tempdir().unwrap();
    let (genuine, path) = (folder.path().join("a.mcap"), folder.path().join("b.mcap"));
    record(&genuine, &inputs(), &MANY_CHECKPOINTS, 20);
    let log = open(&genuine);
    let mut messages = messages(&log);
    edit(&mut messages);
    write(&log, &messages, &path);
    look(&path)
}

fn nth(messages: &[Message], topic: &str, n: usize) -> usize {
    let places = messages.iter().enumerate().filter(|(_, message)| message.topic == topic);
    places.map(|(place, _)| place).nth(n).unwrap()
}

#[track_caller]
fn assert_tampered(verified: &Verified) {
    assert_eq!(verified.status, Status::Tampered, "{:?}", verified.findings);
}

#[test]
fn a_recording_that_is_packed_anew_is_still_intact() {
    let verified = forged(|_| ());
    assert_eq!(verified.status, Status::Intact, "{:?}", verified.findings);
    assert!(verified.checkpoints > 3);
}

#[test]
fn an_edited_event_is_told() {
    for (topic, n) in [("/primitive", 3), ("/primitive", 60), ("/change", 5)] {
        let verified = forged(|messages| {
            let (from, to) = (nth(messages, topic, n), nth(messages, topic, n + 2));
            messages[to].data = messages[from].data.clone();
        });
        assert_tampered(&verified);
    }
    let verified = forged(|messages| {
        let place = nth(messages, "/robot/task_status", 2);
        let report = status("another", scenefold::event::Status::Done);
        messages[place].data = wire::encode(&Event::TaskStatus(report));
    });
    assert_tampered(&verified);
}

#[test]
fn an_edited_time_is_told() {
    assert_tampered(&forged(|messages| messages[7].published += 1));
    assert_tampered(&forged(|messages| {
        let last = messages.len() - 1;
        messages[last].time += 1;
    }));
}

#[test]
fn a_dropped_event_is_told() {
    for place in [1, 40, 100] {
        assert_tampered(&forged(|messages| drop(messages.remove(place))));
    }
    assert_tampered(&forged(|messages| drop(messages.pop())));
    assert_tampered(&forged(|messages| messages.truncate(100)));
}

#[test]
fn a_dropped_event_is_told_if_all_are_numbered_anew() {
    let verified = forged(|messages| {
        messages.remove(100);
        for message in &mut messages[100..] {
            message.sequence -= 1;
        }
    });
    assert_tampered(&verified);
}

#[test]
fn an_event_that_is_put_in_is_told() {
    let verified = forged(|messages| {
        let again = messages[50].clone();
        messages.insert(51, again);
    });
    assert_tampered(&verified);
}

#[test]
fn reordered_events_are_told() {
    let verified = forged(|messages| {
        let (a, b) = (nth(messages, "/change", 10), nth(messages, "/primitive", 10));
        let (first, second) = (messages[a].data.clone(), messages[b].data.clone());
        (messages[a].topic, messages[b].topic) =
            (messages[b].topic.clone(), messages[a].topic.clone());
        (messages[a].data, messages[b].data) = (second, first);
    });
    assert_tampered(&verified);
}

#[test]
fn the_true_state_is_shown_whatever_a_damaged_checkpoint_says() {
    let folder = tempfile::tempdir().unwrap();
    let genuine = folder.path().join("a.mcap");
    let (events, seal) = record(&genuine, &inputs(), &MANY_CHECKPOINTS, 20);
    let states = |messages: &mut Vec<Message>| {
        for message in messages.iter_mut().filter(|message| message.topic == "/checkpoint") {
            let mut found = decode_checkpoint(&message.data).unwrap();
            let place = found.state.len() / 2;
            found.state[place] ^= 1;
            message.data = encode_checkpoint(&found.head, &found.state);
        }
    };
    with_forged(states, |path| {
        let recording = Recording::open(path).unwrap();
        let mut world = World::default();
        for logged in &events {
            apply(&mut world, &logged.event);
            if logged.order % 20 == 0 {
                let state = recording.state_at(At::Event(logged.order), 1).unwrap();
                assert_eq!(state.world, world);
            }
        }
        let last = recording.state_at(At::End, 1).unwrap();
        assert_eq!(last.graph().hash(), seal.state_hash);
        assert!(recording.trouble()[0].contains("is not used"), "{:?}", recording.trouble());
        assert_eq!(verify(path, &mut |_| ()).unwrap().status, Status::Corrupt);
    });
}

/// A checkpoint of a world without the mug, of which every hash holds.
fn without_the_mug(message: &Message) -> Vec<u8> {
    let found = decode_checkpoint(&message.data).unwrap();
    let mug: NodeId = id("O4");
    let mut graph = house();
    graph.remove_object(mug).unwrap();
    let mut updater = Updater::new(Config::default());
    updater.update(at(0), Event::InitialGraph(graph)).unwrap();
    while updater.order() < found.head.order {
        updater.update(found.head.at, Event::Tick).unwrap();
    }
    let state = updater.to_bytes();
    let head = CheckpointHead {
        changes: updater.changes(),
        state_hash: updater.graph().hash().0,
        memory_hash: StateHash::of(&state).0,
        ..found.head
    };
    encode_checkpoint(&head, &state)
}

#[test]
fn a_forged_checkpoint_is_told_however_well_it_is_made() {
    let verified = forged(|messages| {
        let place = nth(messages, "/checkpoint", 2);
        messages[place].data = without_the_mug(&messages[place]);
    });
    assert_eq!(verified.status, Status::Nondeterministic, "{:?}", verified.findings);
    assert!(verified.findings[0].what.contains("the fold does not give the state"));
}

#[test]
fn a_chain_that_was_noted_elsewhere_tells_a_recording_that_was_made_anew() {
    let folder = tempfile::tempdir().unwrap();
    let (genuine, other) = (folder.path().join("a.mcap"), folder.path().join("b.mcap"));
    let (_, seal) = record(&genuine, &inputs(), &RecorderOptions::default(), 20);
    let mut recorder =
        Recorder::create(&other, Config::default(), &RecorderOptions::default()).unwrap();
    for (at, input) in inputs().into_iter().take(100) {
        recorder.record(at, input).unwrap();
    }
    recorder.finish().unwrap();
    let verified = verify(&other, &mut |_| ()).unwrap();
    assert_eq!(verified.status, Status::Intact);
    assert_ne!(verified.chain, Some(seal.chain));
    for (path, code) in [(&genuine, 0), (&other, 1)] {
        let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_scenefold"));
        command.arg("verify").arg(path).args(["--chain", &seal.chain.to_string()]);
        assert_eq!(command.output().unwrap().status.code(), Some(code));
    }
}
