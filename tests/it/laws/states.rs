//! Any way to a state gives the state of the plain fold.

use std::convert::Infallible;

use proptest::prelude::*;
use scenefold::change::World;
use scenefold::event::{Event, Logged};
use scenefold::recording::{RecorderOptions, Recording, Status, Walk, reprocess, verify};
use scenefold::time::At;
use scenefold::updater::{Config, Updater};

use super::cases;
use crate::house::{MANY_CHECKPOINTS, apply, events, inputs, record};

proptest! {
    #![proptest_config(cases(40))]

    #[test]
    fn the_state_at_any_event_is_the_fold_of_the_prefix(inputs in inputs(30..110)) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.mcap");
        let (events, _) = record(&path, &inputs, &MANY_CHECKPOINTS, 7);
        let recording = Recording::open(&path).unwrap();
        prop_assert!(inputs.len() < 60 || recording.summary().checkpoints > 1);
        let mut world = World::default();
        for logged in &events {
            apply(&mut world, &logged.event);
            let state = recording.state_at(At::Event(logged.order), 1);
            let state = state.map_err(|error| TestCaseError::fail(error.to_string()))?;
            prop_assert_eq!(&state.world, &world, "after event #{}", logged.order);
            prop_assert_eq!(state.uncertain, None);
        }
        prop_assert!(recording.trouble().is_empty());
    }

    #[test]
    fn the_state_at_any_instant_is_the_fold_of_all_up_to_it(inputs in inputs(30..80)) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.mcap");
        let (events, _) = record(&path, &inputs, &MANY_CHECKPOINTS, 5);
        let recording = Recording::open(&path).unwrap();
        let mut world = World::default();
        for (n, logged) in events.iter().enumerate() {
            apply(&mut world, &logged.event);
            if events.get(n + 1).is_none_or(|next| next.at > logged.at) {
                let state = recording.state_at(At::Instant(logged.at), 1).unwrap();
                prop_assert_eq!(&state.world, &world, "at {}", logged.at);
            }
        }
    }

    #[test]
    fn threads_give_the_state_that_one_gives(inputs in inputs(20..60)) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.mcap");
        let (events, seal) = record(&path, &inputs, &RecorderOptions::default(), 2);
        let recording = Recording::open(&path).unwrap();
        prop_assert_eq!(recording.summary().checkpoints, 0);
        for order in [1, events.len() as u64 / 2 + 1, events.len() as u64] {
            let one = recording.state_at(At::Event(order), 1).unwrap();
            for threads in [2, 3, 8] {
                prop_assert_eq!(&recording.state_at(At::Event(order), threads).unwrap(), &one);
            }
        }
        let last = recording.state_at(At::End, 2).unwrap();
        prop_assert_eq!(last.graph().hash(), seal.state_hash);
    }

    #[test]
    fn what_is_recorded_is_intact_and_derived_again(inputs in inputs(5..80)) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.mcap");
        let (written, seal) = record(&path, &inputs, &MANY_CHECKPOINTS, 9);
        let verified = verify(&path, &mut |_| ()).unwrap();
        prop_assert_eq!(verified.status, Status::Intact, "{:?}", verified.findings);
        prop_assert_eq!(verified.hash, seal.state_hash);
        prop_assert_eq!(verified.chain, Some(seal.chain));
        prop_assert_eq!(verified.events, written.len() as u64);
        prop_assert_eq!(verified.reprocessed, inputs.len() as u64);
        let recording = Recording::open(&path).unwrap();
        prop_assert_eq!(events(&recording, Walk::Everything), written.clone());
        let mut again: Vec<Logged> = Vec::new();
        let result = reprocess(&recording, &Config::default(), &mut |_, events: &[Logged]| {
            again.extend_from_slice(events);
            Ok::<_, Infallible>(())
        });
        prop_assert_eq!(result.unwrap().different, 0);
        prop_assert_eq!(again, written);
    }

    #[test]
    fn an_updater_goes_on_from_its_bytes_as_if_it_had_not_stopped(inputs in inputs(5..60)) {
        let mut whole = Updater::new(Config::default());
        let mut stopped = Updater::new(Config::default());
        for (at, input) in &inputs {
            stopped = Updater::from_bytes(Config::default(), &stopped.to_bytes()).unwrap();
            let expected = whole.update(*at, input.clone()).unwrap();
            prop_assert_eq!(stopped.update(*at, input.clone()).unwrap(), expected);
            prop_assert_eq!(&stopped, &whole);
        }
    }

    #[test]
    fn what_is_no_input_is_refused_and_changes_nothing(inputs in inputs(5..40)) {
        let mut updater = Updater::new(Config::default());
        let mut derived: Vec<Event> = Vec::new();
        for (at, input) in inputs {
            let records = updater.update(at, input).unwrap();
            derived.extend(records.into_iter().skip(1).map(|logged| logged.event));
        }
        derived.push(Event::InitialGraph(crate::house::house()));
        for event in derived {
            let before = updater.clone();
            prop_assert!(updater.update(before.at(), event).is_err());
            prop_assert_eq!(&updater, &before);
        }
    }
}
