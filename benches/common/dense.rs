//! A log of nothing but transactions of many small edits, as perception at full rate would
//! leave it: the hardest case for decoding, since almost all bytes matter to the fold.

use std::fs::File;
use std::path::{Path, PathBuf};

use scenefold::change::{Cause, EvidenceRef, Primitive, Sighting, Step, Transaction};
use scenefold::container::{ChannelSpec, ChunkClass, LogFile, LogOptions, LogWriter, SchemaSpec};
use scenefold::event::{Event, Topic};
use scenefold::graph::{Layer, Placement, PoseSource};
use scenefold::time::Stamp;
use scenefold::wire;

use super::chunks;
use super::household::{Dice, OBJECTS, house, node};
use super::logs::{Log, made};

/// Moves in one transaction.
pub const MOVES: u64 = 16;
/// Sightings in one transaction.
pub const SIGHTINGS: u64 = 16;
const START: u64 = 1_767_571_200_000_000_000;

/// A log of `primitives` moves, and as many sightings.
pub fn path(primitives: u64) -> PathBuf {
    made(&format!("dense-{primitives}.mcap"), |path| write(path, primitives))
}

fn write(path: &Path, primitives: u64) {
    // The metadata that makes it one of ours is that of a recorded log.
    let model = Log { primitives: 1_000, checkpoints: false, sensor_bytes: 0 }.path();
    let file = File::create(path).expect("the folder is there");
    let mut log = LogWriter::new(file, LogOptions::default()).expect("the disk has room");
    let own: Box<LogFile> = Box::new(chunks::open(&model));
    for record in own.metadata().iter().filter(|record| record.name == "scenefold") {
        log.write_metadata(&record.name, record.metadata.clone()).expect("the disk has room");
    }
    let mut order = 0;
    let mut put = |at: u64, event: &Event| {
        order += 1;
        let handle = log.register(spec(&event.topic())).expect("few channels");
        log.write(handle, order, at, at, &wire::encode(event)).expect("the disk has room");
    };
    put(START, &Event::InitialGraph(house()));
    let mut dice = Dice::new();
    for n in 0..primitives / (MOVES + 1) {
        let at = START + n * 100_000_000;
        put(at, &Event::Transaction(transaction(Stamp::from_nanos(at), &mut dice)));
    }
    log.finish().expect("the disk has room");
}

/// Sixteen moves and a frame that confirms sixteen objects.
pub fn transaction(at: Stamp, dice: &mut Dice) -> Transaction {
    let cause = Cause::Evidence(EvidenceRef { topic: "/evidence/association".into(), order: 1 });
    let moves = (0..MOVES).map(|_| Primitive::Move {
        id: node(Layer::Object, dice.below(OBJECTS)),
        to: Placement {
            room: node(Layer::Room, dice.below(20)),
            support: None,
            pose: dice.pose(),
            pose_source: PoseSource::Measured,
            at,
        },
    });
    let mut primitives: Vec<Primitive> = moves.collect();
    let seen = (0..SIGHTINGS).map(|_| {
        let id = node(Layer::Object, dice.below(OBJECTS));
        Sighting { id, pose: Some(dice.pose()), size: None }
    });
    primitives.push(Primitive::Observe { at, seen: seen.collect() });
    let step = |primitive| Step { cause: cause.clone(), primitive };
    Transaction { at, steps: primitives.into_iter().map(step).collect() }
}

fn spec(topic: &Topic) -> ChannelSpec {
    let schema = wire::schema_of(topic).expect("a topic of our own");
    ChannelSpec {
        topic: topic.name().into_owned(),
        message_encoding: schema.message_encoding.to_owned(),
        metadata: [("scenefold.class".to_owned(), "event".to_owned())].into(),
        schema: Some(SchemaSpec {
            name: schema.name.to_owned(),
            encoding: schema.encoding.to_owned(),
            data: schema.data.to_vec(),
        }),
        class: ChunkClass::Event,
    }
}
