//! Time against a look at every object at every event.

use std::collections::BTreeMap;

use proptest::collection::vec;
use proptest::prelude::*;

use super::*;
use crate::change::{Cause, NodeRef, Primitive};
use crate::event::{Event, Logged, Status, TaskStatus};
use crate::geometry::{Pose, Size};
use crate::graph::{Label, Layer, NodeId, Object, PoseSource, Region, SceneGraph};
use crate::time::Stamp;
use crate::updater::{Config, Updater};

const HOUR: u64 = 3_600_000_000_000;
const START: u64 = 490_000 * HOUR;

fn id(layer: Layer, index: usize) -> NodeId {
    NodeId::new(layer, index as u32).unwrap()
}

/// A room of things with these half-lives in hours; 0 is for ever.
fn graph(half_lives_h: &[f64]) -> SceneGraph {
    let mut graph = SceneGraph::new();
    let room = id(Layer::Room, 1);
    let label = |text: &str| Label::new(text).unwrap();
    graph.insert_region(room, Region { label: label("hall"), extent: None, parent: None }).unwrap();
    for (n, half_life) in half_lives_h.iter().enumerate() {
        let decay_rate = if *half_life > 0.0 { LN_3 / (half_life * 3600.0) } else { 0.0 };
        let object = Object {
            label: label(&format!("thing{n}")),
            pose: Pose::IDENTITY,
            size: Size::new(0.1, 0.1, 0.1).unwrap(),
            decay_rate,
            last_observed: Stamp::from_nanos(START),
            pose_source: PoseSource::Measured,
            room,
            support: None,
        };
        graph.insert_object(id(Layer::Object, n), object).unwrap();
    }
    graph
}

fn config(json: &str) -> Config {
    Config::from_json(json).unwrap()
}

fn at(hours: f64) -> Stamp {
    Stamp::from_nanos(START + (hours * HOUR as f64) as u64)
}

fn status(object: usize, status: Status) -> Event {
    let named = NodeRef::id(id(Layer::Object, object));
    let room = (status == Status::Placed).then(|| NodeRef::id(id(Layer::Room, 1)));
    let bare = TaskStatus::bare(format!("t{object}"), status);
    Event::TaskStatus(TaskStatus { object: Some(named), room, ..bare })
}

/// Who is reported, and with what probability.
fn stale(events: &[Logged]) -> Vec<(NodeId, f64)> {
    let targets = |logged: &Logged| match &logged.event {
        Event::Staleness(it) => {
            it.targets.iter().map(|it| (it.object.id.unwrap(), it.probability)).collect()
        }
        _ => Vec::new(),
    };
    events.iter().flat_map(targets).collect()
}

#[test]
fn what_becomes_improbable_is_reported_once_and_again_after_it_was_moved() {
    let mut updater = Updater::new(config(r#"{"stale_below": 0.5}"#));
    let mut say = |hours: f64, event: Event| stale(&updater.update(at(hours), event).unwrap());
    let ids = |found: Vec<(NodeId, f64)>| found.iter().map(|it| it.0.index()).collect::<Vec<_>>();
    assert_eq!(ids(say(0.0, Event::InitialGraph(graph(&[2.0, 6.0, 0.0])))), [0; 0]);
    assert_eq!(ids(say(1.9, Event::Tick)), [0; 0]);
    assert_eq!(ids(say(2.1, Event::Tick)), [0]);
    assert_eq!(ids(say(3.0, Event::Tick)), [0; 0]);
    assert_eq!(ids(say(3.5, status(0, Status::Picked))), [0; 0]);
    assert_eq!(ids(say(5.9, Event::Tick)), [0; 0], "held things are no targets");
    assert_eq!(ids(say(6.5, status(0, Status::Placed))), [1], "any event tells the time");
    assert_eq!(ids(say(8.6, Event::Tick)), [0]);
    assert_eq!(ids(say(999.0, Event::Tick)), [0; 0]);
}

#[test]
fn time_alone_changes_nothing() {
    let mut updater = Updater::new(config(r#"{"stale_below": 0.9}"#));
    updater.update(at(0.0), Event::InitialGraph(graph(&[1.0, 2.0]))).unwrap();
    let before = updater.graph().hash();
    for hours in 1..50 {
        for logged in updater.update(at(f64::from(hours)), Event::Tick).unwrap() {
            assert!(matches!(logged.event, Event::Tick | Event::Staleness(_)), "{logged:?}");
        }
    }
    assert_eq!(updater.graph().hash(), before);
}

#[test]
fn without_a_threshold_nothing_is_watched_and_the_bytes_are_those_of_old() {
    let mut updater = Updater::new(Config::default());
    updater.update(at(0.0), Event::InitialGraph(graph(&[1.0]))).unwrap();
    assert_eq!(updater.update(at(99.0), Event::Tick).unwrap().len(), 1);
    assert_eq!(updater.to_bytes()[0], 1);
    assert_eq!(Config::default().to_json().matches("decay\"").count(), 0);
}

#[test]
fn a_graph_gets_its_rates_from_the_table_and_says_so() {
    let table = r#"{"decay": {"name": "home.json", "classes": {"thing0": {"half_life": "2 hours"},
        "thing2": {"half_life": "1 day"}}, "default": {"half_life": "5 days"}}}"#;
    let mut updater = Updater::new(config(table));
    let events = updater.update(at(0.0), Event::InitialGraph(graph(&[9.0, 9.0, 0.0, 0.0]))).unwrap();
    let Event::Transaction(transaction) = &events[1].event else { panic!("{events:?}") };
    let said: Vec<String> = transaction
        .steps
        .iter()
        .map(|step| match (&step.primitive, &step.cause) {
            (Primitive::SetDecay { id, origin, .. }, Cause::Evidence(because)) => {
                format!("{id} {origin} ({} #{})", because.topic, because.order)
            }
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!(
        said,
        [
            "O0 home.json: class \"thing0\", half-life 2 hours (/graph/initial #1)",
            "O1 home.json: nearest is \"thing0\" (spelt alike), half-life 2 hours (/graph/initial #1)",
            "O2 home.json: class \"thing2\", half-life 1 day (/graph/initial #1)",
        ]
    );
    let rate = |n| updater.graph().object(id(Layer::Object, n)).unwrap().decay_rate;
    assert!((rate(2) - LN_3 / 86_400.0).abs() < 1e-18, "the table names its class");
    assert!(rate(3).abs() < f64::EPSILON, "immovable, and not named");
}

#[test]
fn the_rates_of_a_huge_graph_are_written_so_that_they_can_be_read() {
    let table = r#"{"decay": {"classes": {}, "default": {"half_life": "5 days"}}}"#;
    let mut updater = Updater::new(config(table));
    let graph = graph(&vec![1.0; 70_000]);
    let events = updater.update(at(0.0), Event::InitialGraph(graph)).unwrap();
    let steps = |logged: &Logged| match &logged.event {
        Event::Transaction(it) => it.steps.len(),
        _ => 0,
    };
    assert_eq!(events.iter().map(steps).collect::<Vec<_>>(), [0, 65_536, 4_464]);
}

#[test]
fn what_is_added_later_gets_its_rate_too() {
    let table = r#"{"decay": {"classes": {"mug": {"half_life": "2 hours"}}}}"#;
    let mut updater = Updater::new(config(table));
    updater.update(at(0.0), Event::InitialGraph(graph(&[]))).unwrap();
    let mut placed = TaskStatus::bare("t", Status::Placed);
    placed.object = Some(NodeRef::label(Label::new("mug").unwrap()));
    placed.room = Some(NodeRef::id(id(Layer::Room, 1)));
    let events = updater.update(at(1.0), Event::TaskStatus(placed)).unwrap();
    let (_, mug) = updater.graph().objects().next().unwrap();
    assert!((mug.decay_rate - LN_3 / 7200.0).abs() < 1e-18, "{events:?}");
}

proptest! {
    #[test]
    fn the_queue_finds_what_a_look_at_everything_finds(
        half_lives in vec(prop_oneof![Just(0.0), 0.01..50.0_f64], 1..8),
        acts in vec((0..3_usize, 0..8_usize, 0.0..6.0_f64), 1..40),
        threshold in 0.05..0.95_f64,
        stop in any::<prop::sample::Index>(),
    ) {
        let config = config(&format!(r#"{{"stale_below": {threshold}}}"#));
        let mut updater = Updater::new(config.clone());
        updater.update(at(0.0), Event::InitialGraph(graph(&half_lives))).unwrap();
        let mut reported: BTreeMap<NodeId, Stamp> = BTreeMap::new();
        let mut hours = 0.0;
        for (n, (act, object, later)) in acts.iter().enumerate() {
            hours += later;
            let object = object % half_lives.len();
            let event = match act {
                0 => Event::Tick,
                1 => status(object, Status::Picked),
                _ => status(object, Status::Placed),
            };
            if n == stop.index(acts.len()) {
                updater = Updater::from_bytes(config.clone(), &updater.to_bytes()).unwrap();
            }
            let mut found: Vec<NodeId> =
                stale(&updater.update(at(hours), event).unwrap()).into_iter().map(|it| it.0).collect();
            found.sort();
            let mut expected = Vec::new();
            for (id, object) in updater.graph().objects() {
                let below = object.probability_static(at(hours)) < threshold;
                if below && reported.get(&id) != Some(&object.last_observed) {
                    reported.insert(id, object.last_observed);
                    expected.push(id);
                }
            }
            prop_assert_eq!(found, expected);
        }
    }
}

#[test]
fn the_decay_is_that_of_the_paper() {
    assert!((probability_static(1e-4, 0.0) - 1.0).abs() < f64::EPSILON);
    let expected = 2.0 / (1.0 + libm::exp(0.36));
    assert!((probability_static(1e-4, 3600.0) - expected).abs() < f64::EPSILON);
    assert!((probability_static(LN_3 / 60.0, 60.0) - 0.5).abs() < 1e-12);
    assert!((probability_static(0.0, 1e12) - 1.0).abs() < f64::EPSILON);
    assert!(probability_static(1.0, 1e9).abs() < f64::EPSILON);
}

#[test]
fn what_never_moves_never_crosses() {
    assert_eq!(age_at(0.0, 0.5), None);
    assert_eq!(age_at(1e-4, 0.0), None);
    assert_eq!(half_life_s(0.0), None);
}

proptest! {
    #[test]
    fn the_age_of_a_probability_gives_it_back(rate in 1e-8..1.0_f64, p in 0.001..0.999_f64) {
        let age = age_at(rate, p).expect("it crosses");
        prop_assert!((probability_static(rate, age) - p).abs() < 1e-9);
    }
}
