//! Any bytes as a recording: opened, summed up, walked over and folded.
#![no_main]

use std::ops::ControlFlow;

use libfuzzer_sys::fuzz_target;
use scenefold::recording::{Recording, Walk};
use scenefold::time::At;

fuzz_target!(|bytes: &[u8]| {
    let Ok(recording) = Recording::from_bytes("fuzz.mcap", bytes.to_vec()) else { return };
    let _ = recording.summary();
    let mut each = |_: &_| ControlFlow::Continue(());
    let _ = recording.visit_events(Walk::Everything, (0, u64::MAX), &mut each);
    let one = recording.state_at(At::End, 1);
    let two = recording.state_at(At::End, 2);
    assert_eq!(one.is_ok(), two.is_ok());
    if let (Ok(one), Ok(two)) = (one, two) {
        assert_eq!(one, two, "threads change nothing");
    }
    let _ = recording.state_at(At::Change(1), 1);
    let _ = recording.trouble();
});
