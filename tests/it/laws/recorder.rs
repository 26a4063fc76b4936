//! Laws of the recorder: same inputs, same bytes; stops change nothing; a torn file is a prefix.

use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;
use scenefold::container::{Compression, Limits, LogFile, Source};
use scenefold::event::{Event, Logged};
use scenefold::recording::{
    LostEvents, Recorder, RecorderOptions, Recording, Status, Walk, recover, verify,
};
use scenefold::time::At;
use scenefold::updater::Config;

use super::cases;
use crate::house::{MANY_CHECKPOINTS, START, at, events, feed, house, inputs, record, sensor};

proptest! {
    #![proptest_config(cases(40))]

    #[test]
    fn equal_inputs_give_equal_bytes(inputs in inputs(5..80), chunk_after in 1..20_usize) {
        let folder = tempfile::tempdir().unwrap();
        let (a, b) = (folder.path().join("a.mcap"), folder.path().join("b.mcap"));
        record(&a, &inputs, &MANY_CHECKPOINTS, chunk_after);
        record(&b, &inputs, &MANY_CHECKPOINTS, chunk_after);
        prop_assert_eq!(std::fs::read(a).unwrap(), std::fs::read(b).unwrap());
    }

    #[test]
    fn segments_hold_what_one_file_would(
        inputs in inputs(10..80),
        cuts in prop::collection::vec(1..80_usize, 1..4),
        finish: bool,
    ) {
        let folder = tempfile::tempdir().unwrap();
        let (written, seal) =
            record(&folder.path().join("a.mcap"), &inputs, &RecorderOptions::default(), 1000);
        let segments = folder.path().join("segments/");
        let mut cuts: Vec<usize> = cuts.into_iter().map(|cut| cut % inputs.len()).collect();
        cuts.sort_unstable();
        let mut recorder =
            Recorder::create(&segments, Config::default(), &MANY_CHECKPOINTS).unwrap();
        let (mut found, mut from) = (Vec::new(), 0);
        for cut in cuts {
            found.extend(feed(&mut recorder, &inputs[from..cut.max(from)], 3));
            from = from.max(cut);
            if finish {
                recorder.finish().unwrap();
            } else {
                // As a crash would leave it, right after an acknowledgement.
                recorder.sync().unwrap();
                drop(recorder);
            }
            recorder = Recorder::append(&segments, &MANY_CHECKPOINTS).unwrap();
        }
        found.extend(feed(&mut recorder, &inputs[from..], 3));
        prop_assert_eq!(&found, &written);
        let last = recorder.finish().unwrap();
        prop_assert_eq!((last.events, last.changes), (seal.events, seal.changes));
        prop_assert_eq!(last.state_hash, seal.state_hash);
        let recording = Recording::open(&segments).unwrap();
        prop_assert_eq!(events(&recording, Walk::Everything), written);
        let expected = if finish { Status::Intact } else { Status::Truncated };
        let verified = verify(&segments, &mut |_| ()).unwrap();
        prop_assert_eq!(verified.status, expected, "{:?}", verified.findings);
        prop_assert_eq!(verified.hash, seal.state_hash);
    }

    #[test]
    fn a_torn_segment_is_gone_on_with(
        inputs in inputs(20..50),
        chunk_after in 1..6_usize,
        cuts in prop::collection::vec(0.0..1.0_f64, 8),
    ) {
        for cut in cuts {
            let scratch = tempfile::tempdir().unwrap();
            let folder = scratch.path().join("segments/");
            let mut recorder =
                Recorder::create(&folder, Config::default(), &MANY_CHECKPOINTS).unwrap();
            let written = feed(&mut recorder, &inputs[..10], chunk_after);
            recorder.finish().unwrap();
            let mut recorder = Recorder::append(&folder, &MANY_CHECKPOINTS).unwrap();
            let all: Vec<Logged> =
                [written, feed(&mut recorder, &inputs[10..], chunk_after)].concat();
            recorder.finish().unwrap();
            let torn = folder.join("segment-000002.mcap");
            let bytes = std::fs::read(&torn).unwrap();
            std::fs::write(&torn, &bytes[..(cut * bytes.len() as f64) as usize]).unwrap();
            let verified = verify(&folder, &mut |_| ()).unwrap();
            let fine = matches!(verified.status, Status::Intact | Status::Truncated);
            prop_assert!(fine, "{:?} {:?}", verified.status, verified.findings);
            // What the crash took is sent again.
            let left = events(&Recording::open(&folder).unwrap(), Walk::Everything);
            prop_assert_eq!(&left[..], &all[..left.len()]);
            let kept = left.iter().filter(|logged| logged.event.is_input()).count();
            let mut recorder = Recorder::append(&folder, &MANY_CHECKPOINTS).unwrap();
            feed(&mut recorder, &inputs[kept..], chunk_after);
            recorder.finish().unwrap();
            let whole = Recording::open(&folder).unwrap();
            prop_assert_eq!(events(&whole, Walk::Everything), all);
            let saved = scratch.path().join("saved.mcap");
            recover(&Recording::scan(&folder).unwrap(), &saved, &mut |_| ()).unwrap();
            let intact = verify(&saved, &mut |_| ()).unwrap();
            prop_assert_eq!(intact.status, Status::Intact, "{:?}", intact.findings);
        }
    }

    #[test]
    fn a_truncated_recording_gives_a_prefix(
        inputs in inputs(10..60),
        chunk_after in 1..10_usize,
        cuts in prop::collection::vec(0.0..1.0_f64, 40),
    ) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.mcap");
        record(&path, &inputs, &MANY_CHECKPOINTS, chunk_after);
        let bytes = std::fs::read(&path).unwrap();
        let whole = Recording::open(&path).unwrap();
        let (all, everything) = (events(&whole, Walk::Events), events(&whole, Walk::Everything));
        for cut in cuts {
            let cut = (cut * bytes.len() as f64) as usize;
            let Ok(torn) = Recording::from_bytes("torn", bytes[..cut].to_vec()) else {
                prop_assert!(cut < 200, "cut at {} of {}", cut, bytes.len());
                continue;
            };
            let found = events(&torn, Walk::Events);
            prop_assert_eq!(&found[..], &all[..found.len()]);
            // Images leave for the disk ahead of the events around them.
            for logged in events(&torn, Walk::Everything) {
                prop_assert_eq!(&logged, &everything[logged.order as usize - 1]);
            }
            let Some(last) = found.last() else { continue };
            let state = torn.state_at(At::End, 1).unwrap();
            let expected = whole.state_at(At::Event(last.order), 1).unwrap();
            prop_assert_eq!(state.world, expected.world);
        }
    }
}

#[test]
fn a_recording_that_is_being_written_is_not_gone_on_with() {
    let scratch = tempfile::tempdir().unwrap();
    let folder = scratch.path().join("segments/");
    let mut recorder = Recorder::create(&folder, Config::default(), &MANY_CHECKPOINTS).unwrap();
    recorder.record(START, Event::InitialGraph(house())).unwrap();
    let refused = Recorder::append(&folder, &MANY_CHECKPOINTS).err().unwrap().to_string();
    assert!(refused.contains("another recorder"), "{refused}");
    recorder.finish().unwrap();
    assert_eq!(Recorder::append(&folder, &MANY_CHECKPOINTS).unwrap().updater().order(), 1);
}

#[test]
fn pictures_after_a_checkpoint_on_a_picture_survive_a_stopped_writer() {
    let scratch = tempfile::tempdir().unwrap();
    let folder = scratch.path().join("segments/");
    let mut recorder = Recorder::create(&folder, Config::default(), &MANY_CHECKPOINTS).unwrap();
    recorder.record(START, Event::InitialGraph(house())).unwrap();
    let picture = || sensor("/camera/depth/image", "sensor_msgs/msg/Image", vec![7; 5000]);
    for second in 1..4 {
        recorder.record(at(second), picture()).unwrap();
        recorder.sync().unwrap();
    }
    drop(recorder);
    let before = events(&Recording::open(&folder).unwrap(), Walk::Everything);
    assert_eq!(before.len(), 4);
    let mut recorder = Recorder::append(&folder, &MANY_CHECKPOINTS).unwrap();
    assert_eq!(recorder.updater().order(), 4);
    recorder.record(at(9), picture()).unwrap();
    recorder.sync().unwrap();
    drop(recorder);
    // A segment that holds nothing but pictures is read as well.
    assert_eq!(events(&Recording::open(&folder).unwrap(), Walk::Everything).len(), 5);
    assert_eq!(Recorder::append(&folder, &MANY_CHECKPOINTS).unwrap().updater().order(), 5);
}

/// Flips a byte in the middle of the chunk in the middle of the events.
fn damage_the_middle(path: &std::path::Path) {
    let mut bytes = std::fs::read(path).unwrap();
    let source: std::sync::Arc<dyn Source> = std::sync::Arc::new(bytes.clone());
    let log = LogFile::open(source, Limits::default()).unwrap();
    let events: Vec<_> =
        log.chunks().iter().filter(|entry| entry.compression == Compression::Zstd).collect();
    let entry = events[events.len() / 2];
    bytes[(entry.offset + entry.length * 2 / 3) as usize] ^= 0x55;
    std::fs::write(path, bytes).unwrap();
}

#[test]
fn a_recovered_recording_is_in_doubt_only_between_a_gap_and_the_next_checkpoint() {
    let scratch = tempfile::tempdir().unwrap();
    let (path, saved) = (scratch.path().join("a.mcap"), scratch.path().join("b.mcap"));
    let mut runner = TestRunner::deterministic();
    let inputs: Vec<_> = inputs(80..81)
        .new_tree(&mut runner)
        .unwrap()
        .current()
        .into_iter()
        .filter(|(_, event)| !matches!(event, Event::Sensor(_)))
        .collect();
    record(&path, &inputs, &MANY_CHECKPOINTS, 5);
    damage_the_middle(&path);
    let lost = recover(&Recording::scan(&path).unwrap(), &saved, &mut |_| ()).unwrap().events;
    let [LostEvents { first, last: Some(last) }] = lost[..] else { panic!("{lost:?}") };
    let saved = Recording::open(&saved).unwrap();
    let doubt = |order| saved.state_at(At::Event(order), 1).map(|state| state.uncertain);
    assert_eq!(doubt(first - 1).unwrap(), None);
    assert!(doubt(first).is_err());
    assert_eq!(saved.state_at(At::End, 1).unwrap().uncertain, None);
    let whole = Recording::open(&path).unwrap();
    assert_eq!(whole.state_at(At::End, 1).unwrap().uncertain, None);
    // The checkpoint after the lost chunk stands right after it.
    assert_eq!(doubt(last + 1).unwrap(), None);
}
