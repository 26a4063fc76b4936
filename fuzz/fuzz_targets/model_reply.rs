//! Any text as what a model answers: refused with a reason, or valid and about the sentence.
#![no_main]

use libfuzzer_sys::fuzz_target;
use scenefold::event::{Event, Utterance};
use scenefold::graph::Label;
use scenefold::interchange::scene;
use scenefold::modality::human::{MAX_CHANGES, Nearest, parse_reading, parse_task};
use scenefold::time::Stamp;
use scenefold::updater::{Config, Updater};

const HOUSE: &str = r#"{"rooms":[{"id":"R1","label":"kitchen"},{"id":"R2","label":"bedroom"}],
    "objects":[{"id":"O1","label":"table","room":"R1"},{"id":"O2","label":"red mug","room":"R1"},
    {"id":"O3","label":"mug","room":"R2"}]}"#;

fuzz_target!(|bytes: &[u8]| {
    // A sentence, a zero byte, an answer.
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let Some((sentence, answer)) = text.split_once('\0') else { return };
    for reading in [parse_reading(sentence, answer), parse_task(sentence, answer)] {
        let Ok(reading) = reading else { continue };
        assert!(reading.statements.len() <= MAX_CHANGES);
        for statement in &reading.statements {
            let (start, end) = statement.object.span.expect("a model's words are in the sentence");
            assert!(sentence.get(start..end).is_some_and(|words| !words.is_empty()));
            assert!(Label::new(&statement.object.noun).is_ok());
            assert!((0.0..=1.0).contains(&statement.confidence));
        }
    }
    let _ = Nearest::parse(answer, 0.5);
    update(sentence, answer);
});

/// The whole way: whatever the answer, the update is recorded, and the graph stays a graph.
fn update(sentence: &str, answer: &str) {
    let config = Config::from_json(r#"{"language":"server"}"#).expect("a configuration");
    let mut updater = Updater::new(config);
    let house = scene::import(HOUSE).expect("a scene");
    updater.update(house.start, Event::InitialGraph(house.graph)).expect("the first event");
    let said = Event::Utterance(Utterance { speaker: String::new(), text: sentence.to_owned() });
    let mut parrot = Parrot(answer);
    let outputs = updater.ask(&said, Some(&mut parrot));
    let before = updater.order();
    if let Ok(records) = updater.update_with(Stamp::EPOCH, said, outputs) {
        assert_eq!(updater.order(), before + records.len() as u64);
    }
    let bytes = updater.graph().to_bytes();
    assert_eq!(scenefold::graph::SceneGraph::from_bytes(&bytes).as_ref(), Ok(updater.graph()));
}

struct Parrot<'a>(&'a str);

impl scenefold::modality::human::LanguageModel for Parrot<'_> {
    fn answer(
        &mut self,
        request: &scenefold::modality::human::LanguageRequest,
    ) -> scenefold::event::LanguageReply {
        let nobody = scenefold::event::LanguageReply::nobody(request);
        scenefold::event::LanguageReply { answer: Ok(self.0.to_owned()), ..nobody }
    }
}
