//! Recording as it happens (detectors, planner, encoding, hash chain, chunks, checkpoints;
//! nothing synced), against a bare `mcap::Writer` given the same bytes.
//!
//! `cargo bench --bench record`; `SCENEFOLD_BENCH_SMALL=1` for a smoke run.

mod common;

use std::collections::BTreeMap;
use std::fs::{File, remove_file};
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use common::household::{PRIMITIVES_PER_UPDATE, inputs};
use common::measure::{best_cpu_of, best_of, over, tell_at_least, tell_time};
use common::{chunks, scaled};
use mcap::records::MessageHeader;
use scenefold::container::{LogFile, MessageFilter};
use scenefold::event::Event;
use scenefold::recording::{Recorder, RecorderOptions};
use scenefold::time::Stamp;
use scenefold::updater::Config;

fn main() {
    let updates = scaled(500_000) / PRIMITIVES_PER_UPDATE;
    let inputs: Vec<(Stamp, Event)> = inputs(updates).collect();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let (ours, theirs) = (folder.join("record-ours.mcap"), folder.join("record-theirs.mcap"));
    record(&inputs, &ours);
    let log = chunks::open(&ours);
    let messages = Messages::of(&log);
    let count = messages.headers.len() as u64;
    let mut record_ours = || record(&inputs, &ours);
    let [bare, recorder] = best_cpu_of(5, [&mut || messages.write(&theirs, 0), &mut record_ours]);
    let [threaded, clock] = best_of(5, [&mut || messages.write(&theirs, 1), &mut record_ours]);
    for path in [&ours, &theirs] {
        let _ = remove_file(path);
    }
    tell_time("mcap::Writer, compressing as it writes", bare, count, "message");
    tell_time("mcap::Writer, compressing on a thread, by the clock", threaded, count, "message");
    tell_time("Recorder", recorder, count, "message");
    tell_at_least("speed of Recorder/mcap::Writer", over(bare, recorder), 0.5);
    let beside = over(threaded, clock);
    println!("ratio speed of Recorder/mcap::Writer with a compression thread = {beside:.3}");
}

fn record(inputs: &[(Stamp, Event)], path: &PathBuf) {
    let _ = remove_file(path);
    let mut recorder = Recorder::create(path, Config::default(), &RecorderOptions::default())
        .expect("the file is new");
    for (at, input) in inputs {
        recorder.record(*at, input.clone()).expect("the input is valid");
    }
    recorder.finish().expect("the disk has room");
}

/// The messages of a recording, and its channels.
struct Messages<'l> {
    log: &'l LogFile,
    headers: Vec<(MessageHeader, std::ops::Range<usize>)>,
    data: Vec<u8>,
}

impl<'l> Messages<'l> {
    fn of(log: &'l LogFile) -> Self {
        let (mut headers, mut data) = (Vec::new(), Vec::new());
        let mut cursor = log.messages(MessageFilter::default());
        while let Some(message) = cursor.next_message().expect("the log is in order") {
            let start = data.len();
            data.extend_from_slice(message.data);
            let header = MessageHeader {
                channel_id: message.channel,
                sequence: message.sequence,
                log_time: message.log_time,
                publish_time: message.publish_time,
            };
            headers.push((header, start..data.len()));
        }
        Self { log, headers, data }
    }

    /// Writes them at the level and chunk size of our recorder.
    fn write(&self, path: &Path, compression_threads: u32) {
        let file = BufWriter::new(File::create(path).expect("the folder is there"));
        let options = mcap::WriteOptions::new()
            .compression_level(RecorderOptions::default().zstd_level as u32)
            .compression_threads(compression_threads)
            .chunk_size(Some(256 << 10));
        let mut writer = options.create(file).expect("the disk has room");
        for schema in self.log.schemas().values() {
            let (name, encoding) = (&schema.name, &schema.encoding);
            writer.add_schema_with_id(schema.id, name, encoding, &schema.data).expect("new id");
        }
        for channel in self.log.channels().values() {
            let (id, schema, encoding) = (channel.id, channel.schema_id, &channel.message_encoding);
            let metadata: &BTreeMap<String, String> = &channel.metadata;
            writer
                .add_channel_with_id(id, schema, &channel.topic, encoding, metadata)
                .expect("new id");
        }
        for (header, range) in &self.headers {
            writer.write_to_known_channel(header, &self.data[range.clone()]).expect("known");
        }
        writer.finish().expect("the disk has room");
    }
}
