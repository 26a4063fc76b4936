//! Laws of learning: what was put in comes out, as often as it should.

use std::collections::BTreeMap;

use super::*;
use crate::change::{
    Action, Cause, ChangeRecord, Claim, EvidenceRef, Modality, NodeRef, Occurred, Outcome,
    Primitive, Sighting, Step, Transaction,
};
use crate::event::{Event, Logged};
use crate::geometry::{Pose, Size};
use crate::graph::{Label, NodeId, Object, Placement, PoseSource, Region, SceneGraph};
use crate::history::Slice;
use crate::modality::time::LN_3;
use crate::time::Stamp;

/// Numbers that look random, the same ones every time (Steele, Lea and Flood, "Fast splittable
/// pseudorandom number generators", 2014).
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// In (0, 1).
    fn unit(&mut self) -> f64 {
        ((self.next() >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }

    /// Standard normal (Box and Muller, 1958).
    fn normal(&mut self) -> f64 {
        let (a, b) = (self.unit(), self.unit());
        libm::sqrt(-2.0 * libm::log(a)) * libm::cos(std::f64::consts::TAU * b)
    }

    /// How long a thing with this λ stays: the inverse of S(t) = 2/(1 + e^{λt}).
    fn dwell(&mut self, rate: f64) -> f64 {
        libm::log(2.0 / self.unit() - 1.0) / rate
    }
}

/// What a robot that looks every `step_s`, `looks` times, learns of a thing with this λ.
fn watched(dice: &mut Dice, rate: f64, step_s: f64, looks: u32) -> Dwell {
    let left_s = dice.dwell(rate);
    let before = (left_s / step_s).min(f64::from(looks)) as u32;
    let from_s = f64::from(before) * step_s;
    if before == looks { Dwell::at_least(from_s) } else { Dwell::between(from_s, from_s + step_s) }
        .unwrap()
}

#[test]
fn the_true_rate_lies_in_the_interval_as_often_as_it_says() {
    let mut dice = Dice(6);
    let mut hits = 0;
    for _ in 0..1000 {
        let rate = libm::exp(-9.0 + dice.normal());
        let mut data = DwellData::default();
        let step_s = 600.0 + 7200.0 * dice.unit();
        (0..40).for_each(|_| data.add(watched(&mut dice, rate, step_s, 12)));
        let (fits, family) = fit_dwells(&BTreeMap::from([("mug".to_owned(), data)]));
        assert_eq!(family, None, "one class has no family");
        hits += u32::from((fits["mug"].low_per_s..=fits["mug"].high_per_s).contains(&rate));
    }
    assert!((930..=970).contains(&hits), "{hits} of 1000");
}

#[test]
fn in_houses_of_many_classes_with_few_looks_it_does_too() {
    let mut dice = Dice(60);
    let (mut hits, mut shrunk, mut alone_error, mut error) = (0, 0.0, 0.0, 0.0);
    for _ in 0..50 {
        let (mut classes, mut truth) = (BTreeMap::new(), BTreeMap::new());
        for class in 0..20 {
            let rate = libm::exp(-9.5 + 0.8 * dice.normal());
            let mut data = DwellData::default();
            (0..2 + class).for_each(|_| data.add(watched(&mut dice, rate, 3600.0, 8)));
            truth.insert(class.to_string(), rate);
            classes.insert(class.to_string(), data);
        }
        let (fits, family) = fit_dwells(&classes);
        assert!(family.is_some());
        for (class, fit) in &fits {
            let rate = truth[class];
            hits += u32::from((fit.low_per_s..=fit.high_per_s).contains(&rate));
            shrunk += fit.pooled / 1000.0;
            let only = BTreeMap::from([(class.clone(), classes[class].clone())]);
            let off = |fit: f64| libm::fabs(libm::log(fit.max(1e-9) / rate)).min(5.0);
            alone_error += off(fit_dwells(&only).0[class].rate_per_s);
            error += off(fit.rate_per_s);
        }
    }
    assert!((930..=970).contains(&hits), "{hits} of 1000");
    assert!(error < 0.8 * alone_error, "pooling helps: {error} against {alone_error}");
    assert!((0.05..0.8).contains(&shrunk), "{shrunk}");
}

#[test]
fn a_class_without_data_has_the_rate_of_the_family() {
    let mut dice = Dice(7);
    let mut classes: BTreeMap<String, DwellData> = BTreeMap::new();
    for class in ["cup", "mug"] {
        let data = classes.entry(class.to_owned()).or_default();
        (0..200).for_each(|_| data.add(watched(&mut dice, 1e-4, 3600.0, 8)));
    }
    classes.insert("vase".to_owned(), DwellData::default());
    let (fits, _) = fit_dwells(&classes);
    let vase = fits["vase"];
    assert!((vase.rate_per_s / 1e-4 - 1.0).abs() < 0.2 && vase.pooled > 0.99, "{vase:?}");
    assert!(vase.low_per_s < 0.5e-4 && vase.high_per_s > 2e-4, "little is known of it: {vase:?}");
    let none = BTreeMap::from([("vase".to_owned(), DwellData::default())]);
    assert!(fit_dwells(&none).0.is_empty());
}

#[test]
fn what_never_left_has_an_interval_that_begins_at_nothing() {
    let mut data = DwellData::default();
    (0..30).for_each(|_| data.add(Dwell::at_least(86_400.0).unwrap()));
    let fit = fit_dwells(&BTreeMap::from([("oven".to_owned(), data)])).0["oven"];
    assert!(fit.low_per_s.abs() < 1e-15 && fit.high_per_s < 1e-5, "{fit:?}");
}

const HOUR: u64 = 3_600_000_000_000;
const START: u64 = 490_008 * HOUR;

fn id(text: &str) -> NodeId {
    text.parse().unwrap()
}

fn at(hours: u64) -> Stamp {
    Stamp::from_nanos(START + hours * HOUR)
}

fn house() -> SceneGraph {
    let label = |text: &str| Label::new(text).unwrap();
    let mut graph = SceneGraph::new();
    for (room, name) in [("R1", "kitchen"), ("R2", "hall")] {
        let region = Region { label: label(name), extent: None, parent: None };
        graph.insert_region(id(room), region).unwrap();
    }
    let mug = Object {
        label: label("mug"),
        pose: Pose::IDENTITY,
        size: Size::new(0.1, 0.1, 0.1).unwrap(),
        decay_rate: 1e-4,
        last_observed: at(0),
        pose_source: PoseSource::Measured,
        room: id("R1"),
        support: None,
    };
    graph.insert_object(id("O1"), mug).unwrap();
    graph
}

fn placed(room: &str, hours: u64) -> Placement {
    let (pose, pose_source) = (Pose::IDENTITY, PoseSource::Measured);
    Placement { room: id(room), support: None, pose, pose_source, at: at(hours) }
}

/// A log of the mug: `(hour, "R2")` moves it there, `(hour, "")` sees it where it is.
fn log(acts: &[(u64, &str)], not_before: Option<u64>) -> Vec<Logged> {
    let logged = |order: usize, hours, event| {
        Logged { order: order as u64, at: at(hours), published: at(hours), event }
    };
    let mut out = vec![logged(1, 0, Event::InitialGraph(house()))];
    for (hours, room) in acts {
        let seen = vec![Sighting { id: id("O1"), pose: None, size: None }];
        let evidence = EvidenceRef { topic: "/camera".into(), order: 1 };
        let (cause, primitive) = if room.is_empty() {
            (Cause::Evidence(evidence), Primitive::Observe { at: at(*hours), seen })
        } else {
            let seq = out.len() as u64;
            let record = moved(seq, *hours, not_before);
            out.push(logged(out.len() + 1, *hours, Event::Change(record)));
            (Cause::Change(seq), Primitive::Move { id: id("O1"), to: placed(room, *hours) })
        };
        let steps = vec![Step { cause, primitive }];
        let event = Event::Transaction(Transaction { at: at(*hours), steps });
        out.push(logged(out.len() + 1, *hours, event));
    }
    out
}

fn moved(seq: u64, hours: u64, not_before: Option<u64>) -> ChangeRecord {
    let claim = Claim {
        modality: Modality::Human,
        detector: "test/1".into(),
        action: Action::Moved,
        object: NodeRef::id(id("O1")),
        source_room: None,
        target_room: None,
        support: None,
        pose: None,
        size: None,
        confidence: 1.0,
        occurred: Occurred { not_before: not_before.map(at), not_after: Some(at(hours)) },
        held: false,
        evidence: Vec::new(),
    };
    ChangeRecord { seq, at: at(hours), claim, outcome: Outcome::Applied }
}

#[track_caller]
fn check_dwells(acts: &[(u64, &str)], not_before: Option<u64>, expected: &[(f64, f64)]) {
    let log = log(acts, not_before);
    let histories = histories(&Slice(&log), 0).unwrap();
    let mug = &histories.objects[&id("O1")];
    let dwells = mug.dwells(histories.complete, at(10)).unwrap();
    let hours: Vec<(f64, f64)> =
        dwells.iter().map(|it| (it.from_s / 3600.0, it.until_s / 3600.0)).collect();
    assert_eq!(hours, expected);
}

#[test]
fn a_dwell_ends_between_two_looks_or_has_not_ended() {
    let never = f64::INFINITY;
    // Told of as it happens: exact, and what is told of no more has stayed.
    check_dwells(&[(3, "R2")], Some(3), &[(3.0, 3.0), (7.0, never)]);
    // Told of later: somewhere in between.
    check_dwells(&[(3, "R2")], Some(1), &[(1.0, 3.0), (7.0, never)]);
    check_dwells(&[(3, "R2")], None, &[(0.0, 3.0), (7.0, never)]);
    // Seen by a camera: nothing is known between looks and after the last, and each begins anew.
    check_dwells(&[(2, ""), (5, "R2"), (6, "")], None, &[(2.0, never), (0.0, 3.0), (1.0, never), (0.0, never)]);
}

#[test]
fn a_move_within_epsilon_is_none() {
    let log = log(&[(3, "R1"), (4, "R1"), (5, "R2")], Some(5));
    let histories = histories(&Slice(&log), 0).unwrap();
    assert_eq!(histories.objects[&id("O1")].stays.len(), 2, "{histories:?}");
}

#[test]
fn nothing_to_learn_from_is_told() {
    let empty = histories(&Slice(&[]), 0).unwrap();
    let error = learn(&[empty], &LearnOptions::default()).unwrap_err();
    assert_eq!(error, LearnError::Nothing);
    assert!(error.to_string().contains("give recordings"), "{error}");
    assert!(learn(&[], &LearnOptions::default()).is_err());
}

#[test]
fn what_was_learned_reads_back_from_its_file() {
    let acts: Vec<(u64, &str)> =
        (1..40).map(|n| (6 * n, if n % 2 == 0 { "R1" } else { "R2" })).collect();
    let log = log(&acts, None);
    let learned = learn(&[histories(&Slice(&log), 0).unwrap()], &LearnOptions::default()).unwrap();
    let mug = &learned.classes["mug"];
    assert_eq!((mug.decay.unwrap().ended, mug.places.len()), (39, 2), "{learned:?}");
    let read = Learned::from_json(&learned.to_json()).unwrap();
    assert_eq!(read.table, learned.table);
    assert_eq!(read.by_hour, learned.by_hour);
    assert_eq!(read.classes["mug"].decay, mug.decay);
    assert_eq!(read.classes["mug"].birth_death, mug.birth_death);
    assert_eq!(read.to_json(), learned.to_json());
}

#[test]
fn a_table_written_by_hand_is_a_file_too() {
    let json = r#"{"classes": {"mug": {"half_life": "2 hours"}}, "default": {"half_life": "1 day"}}"#;
    let learned = Learned::from_json(json).unwrap();
    assert!((learned.sigmoid("mug", 7200.0).unwrap() - 0.5).abs() < 1e-9);
    assert!((learned.sigmoid("umbrella", 86_400.0).unwrap() - 0.5).abs() < 1e-9);
    assert_eq!(learned.birth_death("mug", 60.0), None);
    for (json, words) in [
        (r#"{"format": "scenefold.decay/9"}"#, "scenefold.decay/9"),
        (r#"{"classes": {"mug": {"half_life": "-1 hour"}}}"#, "mug"),
        (r#"{"classes": {"mug": {"birth_death": {"leaves_after": "1 h", "returns_after": "1 h",
            "leave_per_s": -1, "return_per_s": 1}}}}"#, "mug: birth_death: rate_per_s is -1"),
        (r#"{"by_hour": {"gaps": ["2 hours", "1 hour"], "stays": {}, "found": {}}}"#, "rise"),
        (r#"{"by_hour": {"gaps": ["1 hour"], "found": {}, "stays":
            {"mug": {"sink": {"1 hour": [[25, 1, 1]]}}}}}"#, "[hour, stays, looks]"),
    ] {
        let error = Learned::from_json(json).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
}

#[test]
fn beliefs_follow_the_model_and_fall_back_to_the_node() {
    let json = format!(
        r#"{{"classes": {{"mug": {{"rate_per_s": {}, "birth_death": {{"leaves_after": "1 hour",
        "returns_after": "1 hour", "leave_per_s": 0.01, "return_per_s": 0.01}}}}}}}}"#,
        LN_3 / 3600.0
    );
    let (graph, learned) = (house(), Learned::from_json(&json).unwrap());
    let mug = graph.object(id("O1")).unwrap();
    let say = |model, learned| Beliefs { model, learned }.probability(&graph, mug, at(1));
    assert!((say(TimeModel::Sigmoid, Some(&learned)) - 0.5).abs() < 1e-9);
    assert!((say(TimeModel::BirthDeath, Some(&learned)) - 0.5).abs() < 1e-9);
    assert!((say(TimeModel::Places, Some(&learned)) - 0.5).abs() < 1e-9, "nothing was counted");
    let node = mug.probability_static(at(1));
    assert!((say(TimeModel::Sigmoid, None) - node).abs() < 1e-12);
}

#[test]
fn what_comes_after_the_cut_is_not_learned_from() {
    // Until hour 240 every six hours, then never again.
    let acts: Vec<(u64, &str)> =
        (1..40).map(|n| (6 * n, if n % 2 == 0 { "R1" } else { "R2" })).collect();
    let whole = histories(&Slice(&log(&acts, None)), 0).unwrap();
    let part = histories(&Slice(&log(&acts[..20], None)), 0).unwrap();
    let options = |until| LearnOptions { until: vec![until], ..LearnOptions::default() };
    let cut = learn(&[whole], &options(Some(at(120)))).unwrap();
    let short = learn(&[part], &options(Some(at(120)))).unwrap();
    assert_eq!(cut.classes["mug"].decay, short.classes["mug"].decay);
    assert_eq!(cut.by_hour, short.by_hour);
}
