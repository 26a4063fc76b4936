//! What the parts of a replay take by themselves: decoding and applying one transaction, reading
//! and writing a state of ten thousand objects.
//!
//! `cargo bench --bench parts`.

mod common;

use common::dense;
use common::household::{Dice, house};
use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use scenefold::change::{Transaction, World};
use scenefold::event::Event;
use scenefold::graph::SceneGraph;
use scenefold::time::Stamp;
use scenefold::wire;

const NOW: Stamp = Stamp::from_nanos(1_767_571_200_000_000_000);

fn transactions() -> Vec<Transaction> {
    let mut dice = Dice::new();
    (0..64).map(|_| dense::transaction(NOW, &mut dice)).collect()
}

fn fold(c: &mut Criterion) {
    let transactions = transactions();
    let steps: usize = transactions.iter().map(|it| it.steps.len()).sum();
    let payloads: Vec<Vec<u8>> =
        transactions.iter().map(|it| wire::encode(&Event::Transaction(it.clone()))).collect();
    let mut group = c.benchmark_group("transactions");
    group.throughput(Throughput::Elements(steps as u64));
    group.bench_function("decode", |b| {
        b.iter(|| {
            for payload in &payloads {
                std::hint::black_box(wire::decode_transaction(NOW, payload)).expect("it is valid");
            }
        });
    });
    let mut world = World::from_graph(house());
    group.bench_function("apply", |b| {
        b.iter(|| {
            for transaction in &transactions {
                transaction.apply(&mut world).expect("it is valid");
            }
        });
    });
    group.finish();
}

fn state(c: &mut Criterion) {
    let graph = house();
    let bytes = graph.to_bytes();
    let mut group = c.benchmark_group("state of 10 000 objects");
    group.throughput(Throughput::Bytes(bytes.len() as u64));
    group.bench_function("to bytes", |b| b.iter(|| graph.to_bytes()));
    group.bench_function("from bytes", |b| b.iter(|| SceneGraph::from_bytes(&bytes)));
    group.bench_function("clone", |b| {
        b.iter_batched(|| (), |()| graph.clone(), BatchSize::LargeInput);
    });
    group.finish();
}

criterion_group! {
    name = parts;
    config = Criterion::default().sample_size(30).without_plots();
    targets = fold, state
}
criterion_main!(parts);
