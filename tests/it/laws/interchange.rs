//! A graph goes into a recording, comes out as text, and goes in again unchanged.

use proptest::prelude::*;
use scenefold::event::Event;
use scenefold::interchange::scene::{self, SceneDocument};
use scenefold::recording::{Recorder, RecorderOptions, Recording};
use scenefold::time::At;
use scenefold::updater::Config;

use super::cases;
use crate::house::{START, inputs, record};
use crate::testing;

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn recording_to_scene_to_recording_is_the_identity(graph in testing::graph()) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.mcap");
        let options = RecorderOptions::default();
        let mut recorder = Recorder::create(&path, Config::default(), &options).unwrap();
        recorder.record(START, Event::InitialGraph(graph.clone())).unwrap();
        recorder.finish().unwrap();
        let state = Recording::open(&path).unwrap().state_at(At::End, 1).unwrap();
        prop_assert_eq!(state.graph(), &graph);
        let text = serde_json::to_string(&SceneDocument::of(state.graph(), state.at)).unwrap();
        let again = scene::import(&text).unwrap();
        prop_assert_eq!(again.graph.hash(), graph.hash());
        prop_assert_eq!(again.graph.to_bytes(), graph.to_bytes());
    }

    #[test]
    fn what_happened_to_a_house_survives_the_way_through_a_scene(inputs in inputs(1..40)) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.mcap");
        let (_, seal) = record(&path, &inputs, &RecorderOptions::default(), 1000);
        let state = Recording::open(&path).unwrap().state_at(At::End, 1).unwrap();
        let text = serde_json::to_string(&SceneDocument::of(state.graph(), state.at)).unwrap();
        prop_assert_eq!(scene::import(&text).unwrap().graph.hash(), seal.state_hash);
    }
}
