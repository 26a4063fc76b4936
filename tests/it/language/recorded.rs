//! What models say is recorded with the input, and every later run takes it from there.

use std::path::Path;

use proptest::prelude::*;
use scenefold::change::EvidenceRef;
use scenefold::event::{Event, LanguageReply, Logged, Topic, Utterance};
use scenefold::modality::human::{LanguageModel, LanguageRequest};
use scenefold::recording::{
    Recorder, RecorderOptions, Recording, Status, Walk, recover, reprocess, verify,
};
use scenefold::updater::{Config, Language, Updater};

use crate::house::{MANY_CHECKPOINTS, START, at, events, house};
use crate::laws::cases;

/// Answers with one text after the other, or with errors.
pub struct Parrot {
    answers: std::collections::VecDeque<Result<String, String>>,
}

impl Parrot {
    pub fn new(answers: &[Result<String, String>]) -> Self {
        Self { answers: answers.iter().cloned().collect() }
    }
}

impl LanguageModel for Parrot {
    fn answer(&mut self, request: &LanguageRequest) -> LanguageReply {
        let answer = self.answers.pop_front().unwrap_or_else(|| Err("out of words".to_owned()));
        LanguageReply {
            of: EvidenceRef { topic: "/nowhere".into(), order: 99 },
            back_end: "parrot/1".into(),
            model: "parrot".to_owned(),
            prompt: "of another version".into(),
            request: format!("{:?}", request.question),
            answer,
            attempts: 2,
            latency_nanos: 5,
        }
    }
}

pub fn server_config() -> Config {
    let mut config = Config::default();
    config.language = Language::Server;
    config
}

fn said(text: &str) -> Event {
    Event::Utterance(Utterance { speaker: "Ann".to_owned(), text: text.to_owned() })
}

/// Says `answers.len()` sentences, each answered by one of `answers`.
fn feed(recorder: &mut Recorder, answers: &[Result<String, String>]) -> Vec<Logged> {
    let parrot = Parrot::new(answers);
    recorder.set_language(Box::new(parrot));
    let mut all = Vec::new();
    for n in 0..answers.len() as u64 {
        all.extend(recorder.record(at(n), said("The mug is in the bedroom.")).unwrap().events);
        all.extend(recorder.record(at(n), Event::Tick).unwrap().events);
    }
    all
}

fn record(path: &Path, answers: &[Result<String, String>]) -> Vec<Logged> {
    let mut recorder = Recorder::create(path, server_config(), &MANY_CHECKPOINTS).unwrap();
    let mut all = recorder.record(START, Event::InitialGraph(house())).unwrap().events;
    all.extend(feed(&mut recorder, answers));
    recorder.finish().unwrap();
    all
}

pub fn moved() -> String {
    let named = |words: &str, name: &str| {
        format!(r#"{{"words":"{words}","name":"{name}","adjectives":[],"id":null,"count":1}}"#)
    };
    format!(
        r#"{{"kind":"report","changes":[{{"action":"moved","object":{},"support":null,"source_room":null,"target_room":{},"when":null,"confidence":0.9}}]}}"#,
        named("mug", "mug"),
        named("the bedroom", "bedroom")
    )
}

fn replies(log: &[Logged]) -> Vec<(u64, &LanguageReply)> {
    log.iter()
        .filter_map(|logged| match &logged.event {
            Event::LanguageReply(reply) => Some((logged.order, reply)),
            _ => None,
        })
        .collect()
}

#[test]
fn a_reply_stands_right_after_its_input_and_points_to_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.mcap");
    let all = record(&path, &[Ok(moved()), Err("the server is away".to_owned())]);
    let replies = replies(&all);
    assert_eq!(replies.len(), 2);
    for (order, reply) in replies {
        let before = &all[order as usize - 2];
        assert!(matches!(before.event, Event::Utterance(_)));
        assert_eq!(reply.of, before.reference());
        assert_eq!(reply.prompt, "reading/1");
    }
    assert_eq!(events(&Recording::open(&path).unwrap(), Walk::Everything), all);
}

#[test]
fn nobody_to_ask_is_recorded_as_such() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.mcap");
    let mut recorder =
        Recorder::create(&path, server_config(), &RecorderOptions::default()).unwrap();
    let recorded = recorder.record(START, said("The mug is gone.")).unwrap();
    let [(_, reply)] = *replies(&recorded.events) else { panic!("{recorded:?}") };
    assert_eq!(reply.answer.as_deref(), Err(&"no back end is connected".to_owned()));
}

#[test]
fn nobody_is_asked_unless_the_configuration_says_so() {
    let updater = Updater::new(Config::default());
    assert_eq!(updater.request(&said("The mug is gone."), &[]), None);
    let updater = Updater::new(server_config());
    assert!(updater.request(&said("The mug is gone."), &[]).is_some());
    assert_eq!(updater.request(&Event::Tick, &[]), None);
    assert_eq!(updater.request(&said(&"a".repeat(1 << 20)), &[]), None);
}

#[test]
fn only_models_say_what_models_say() {
    let mut updater = Updater::new(Config::default());
    let error = updater.update_with(START, Event::Tick, vec![said("x")]).unwrap_err();
    assert!(error.to_string().contains("/human/utterance"), "{error}");
    let error = updater.update(START, Event::LanguageReply(huge())).unwrap_err();
    assert!(error.to_string().contains("/model/language"), "{error}");
    assert_eq!(updater.order(), 0);
}

fn huge() -> LanguageReply {
    let mut parrot = Parrot::new(&[Ok("x".repeat(70_000))]);
    let updater = Updater::new(server_config());
    parrot.answer(&updater.request(&said("The mug is gone."), &[]).unwrap())
}

#[test]
fn a_reply_too_long_to_record_is_recorded_as_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let all = record(&folder.path().join("a.mcap"), &[Ok("x".repeat(70_000))]);
    let error = replies(&all)[0].1.answer.clone().unwrap_err();
    assert!(error.contains("answer has 70000 bytes"), "{error}");
}

fn answer() -> impl Strategy<Value = Result<String, String>> {
    prop_oneof![
        2 => Just(Ok(moved())),
        1 => ".{0,30}".prop_map(Ok),
        1 => ".{0,30}".prop_map(Err),
        1 => Just(Ok("y".repeat(1 << 17))),
    ]
}

/// Reprocessing gives again what was recorded, and writes the same file.
fn check_reprocess(path: &Path, scratch: &Path) {
    let recording = Recording::open(path).unwrap();
    let config = recording.meta().unwrap().config.clone();
    let copy = scratch.join("again.mcap");
    let mut recorder = Recorder::create(&copy, config.clone(), &MANY_CHECKPOINTS).unwrap();
    let result = reprocess(&recording, &config, &mut |input, now| {
        let outputs = now[1..].iter().map(|logged| logged.event.clone());
        let outputs = outputs.filter(Event::is_model_output).collect();
        recorder.record_with(input.published, input.event.clone(), outputs).map(drop)
    })
    .unwrap();
    recorder.finish().unwrap();
    assert_eq!(result.different, 0, "{:?}", result.differences);
    assert_eq!(std::fs::read(path).unwrap(), std::fs::read(copy).unwrap());
}

proptest! {
    #![proptest_config(cases(16))]

    #[test]
    fn replies_are_replayed_from_the_record(answers in prop::collection::vec(answer(), 1..12)) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.mcap");
        record(&path, &answers);
        let verified = verify(&path, &mut |_| ()).unwrap();
        prop_assert_eq!(verified.status, Status::Intact, "{:?}", verified.findings);
        check_reprocess(&path, folder.path());
    }

    #[test]
    fn a_torn_recording_with_replies_is_gone_on_with(
        answers in prop::collection::vec(answer(), 4..12), cut in 0.0..1.0_f64,
    ) {
        let scratch = tempfile::tempdir().unwrap();
        let folder = scratch.path().join("segments/");
        let all = record(&folder, &answers);
        let segment = folder.join("segment-000001.mcap");
        let bytes = std::fs::read(&segment).unwrap();
        std::fs::write(&segment, &bytes[..(cut * bytes.len() as f64) as usize]).unwrap();
        let left = events(&Recording::open(&folder).unwrap(), Walk::Everything);
        prop_assert_eq!(&left[..], &all[..left.len()]);
        // A reply is never without its input, nor an input without its reply.
        prop_assert!(!matches!(left.last().map(|last| &last.event), Some(Event::Utterance(_))));
        if !Recorder::can_append(&folder).unwrap() {
            return Ok(());
        }
        let mut recorder = Recorder::append(&folder, &MANY_CHECKPOINTS).unwrap();
        let asks = recorder.updater().config().language == Language::Server;
        feed(&mut recorder, &answers[..2]);
        recorder.finish().unwrap();
        let verified = verify(&folder, &mut |_| ()).unwrap();
        let fine = matches!(verified.status, Status::Intact | Status::Truncated);
        prop_assert!(fine, "{:?} {:?}", verified.status, verified.findings);
        let recording = Recording::open(&folder).unwrap();
        let found = events(&recording, Walk::Everything);
        let new = found[left.len()..].iter().filter(|it| it.event.topic() == Topic::Language);
        prop_assert_eq!(new.count(), if asks { 2 } else { 0 });
        let saved = scratch.path().join("saved.mcap");
        recover(&Recording::scan(&folder).unwrap(), &saved, &mut |_| ()).unwrap();
        let intact = verify(&saved, &mut |_| ()).unwrap();
        prop_assert_eq!(intact.status, Status::Intact, "{:?}", intact.findings);
    }
}
