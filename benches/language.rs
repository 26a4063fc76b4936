//! What the built-in interpreter takes for a sentence, against reading the same sentence as JSON.
//!
//! `cargo bench --bench language`.

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use scenefold::event::{Event, Utterance};
use scenefold::interchange::scene;
use scenefold::modality::human;
use scenefold::time::Stamp;
use scenefold::updater::{Config, Updater};

const SENTENCES: [&str; 6] = [
    "I ate the banana",
    "I took the mug and put it on the desk",
    "Mom put the vase on the dining table and threw out the old newspaper this morning",
    "Did you move the keys to the kitchen?",
    "The cup that was on the kitchen counter is now in the sink",
    "Just so you know, yesterday evening we carried the sofa, the lamp and both chairs into the bedroom",
];

const NOW: Stamp = Stamp::from_nanos(1_767_798_000_000_000_000);

/// The mean per sentence.
fn sentences(c: &mut Criterion) {
    let mut group = c.benchmark_group("a sentence");
    group.throughput(Throughput::Elements(SENTENCES.len() as u64));
    let quoted: Vec<String> = SENTENCES
        .iter()
        .map(|text| serde_json::to_string(&text.split(' ').collect::<Vec<_>>()))
        .map(|it| it.expect("texts have a JSON form"))
        .collect();
    group.bench_function("its words as JSON (baseline)", |b| {
        b.iter(|| {
            for text in &quoted {
                std::hint::black_box(serde_json::from_str::<Vec<String>>(text))
                    .expect("it is JSON");
            }
        });
    });
    group.bench_function("read", |b| {
        b.iter(|| {
            for text in SENTENCES {
                std::hint::black_box(human::interpret(text, NOW));
            }
        });
    });
    group.bench_function("read and grounded in a home of 31 things", |b| {
        let home = home();
        b.iter_batched(
            || home.clone(),
            |mut home| {
                for text in SENTENCES {
                    let said = Utterance { speaker: String::new(), text: text.to_owned() };
                    home.update(NOW, Event::Utterance(said)).expect("it is an input");
                }
            },
            BatchSize::SmallInput,
        );
    });
    group.finish();
}

fn home() -> Updater {
    let text = include_str!("../tests/data/language/family_home.json");
    let import = scene::import(text).expect("it is a scene");
    let mut updater = Updater::new(Config::default());
    updater.update(NOW, Event::InitialGraph(import.graph)).expect("it is an input");
    updater
}

/// A megabyte of sentences, and one sentence of a megabyte.
fn long(c: &mut Criterion) {
    let mut group = c.benchmark_group("a megabyte");
    group.throughput(Throughput::Bytes(1 << 20));
    group.sample_size(10);
    for (name, piece) in [("sentences", "Did you see it? "), ("one sentence", "and the mug ")] {
        let text = piece.repeat((1 << 20) / piece.len());
        group.bench_function(name, |b| b.iter(|| human::interpret(&text, NOW)));
    }
    group.finish();
}

criterion_group! {
    name = language;
    config = Criterion::default().sample_size(30).without_plots();
    targets = sentences, long
}
criterion_main!(language);
