//! Any bytes as the state in a checkpoint, and as a graph: what is read is written and read back
//! as it is, and can be gone on with.
#![no_main]

use libfuzzer_sys::fuzz_target;
use scenefold::event::{Event, Status, TaskStatus};
use scenefold::graph::SceneGraph;
use scenefold::updater::{Config, Updater};

fuzz_target!(|bytes: &[u8]| {
    if let Ok(graph) = SceneGraph::from_bytes(bytes) {
        assert_eq!(SceneGraph::from_bytes(&graph.to_bytes()), Ok(graph));
    }
    let Ok(mut updater) = Updater::from_bytes(Config::default(), bytes) else { return };
    let again = Updater::from_bytes(Config::default(), &updater.to_bytes());
    assert_eq!(again.as_ref(), Ok(&updater));
    let at = updater.at();
    for status in Status::ALL {
        let input = Event::TaskStatus(TaskStatus::bare("t", status));
        let _ = updater.update(at, input);
    }
});
