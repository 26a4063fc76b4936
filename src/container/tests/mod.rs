//! Tests of reading and writing together, and against the `mcap` crate.

mod agreement;
mod damaged;
mod hostile;
mod ordering;

use std::collections::BTreeMap;
use std::sync::Arc;

use super::*;

/// A message with what identifies it, apart from its place in the file.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Sent {
    pub topic: String,
    pub sequence: u32,
    pub log_time: u64,
    pub data: Vec<u8>,
}

pub(crate) fn spec(topic: &str, class: ChunkClass) -> ChannelSpec {
    ChannelSpec {
        topic: topic.to_owned(),
        message_encoding: "protobuf".to_owned(),
        metadata: BTreeMap::from([("unit".to_owned(), "metre".to_owned())]),
        schema: Some(SchemaSpec {
            name: format!("pkg.{}", topic.trim_start_matches('/')),
            encoding: "protobuf".to_owned(),
            data: topic.as_bytes().repeat(9),
        }),
        class,
    }
}

pub(crate) const CLASSES: [(&str, ChunkClass); 4] = [
    ("/depth", ChunkClass::Sensor),
    ("/jpeg", ChunkClass::PackedSensor),
    ("/change", ChunkClass::Event),
    ("/checkpoint", ChunkClass::Checkpoint),
];

pub(crate) fn small_chunks() -> LogOptions {
    LogOptions { event_chunk_bytes: 300, sensor_chunk_bytes: 500, ..LogOptions::default() }
}

/// Writes one message per `(class index, log time)` in turn.
pub(crate) fn write_all(arrivals: &[(usize, u64)], options: LogOptions) -> (Vec<u8>, Vec<Sent>) {
    let mut writer = LogWriter::new(Vec::new(), options).unwrap();
    let handles = CLASSES.map(|(topic, class)| writer.register(spec(topic, class)).unwrap());
    let mut sent = Vec::new();
    for (sequence, (class, log_time)) in arrivals.iter().enumerate() {
        let data = format!("message {sequence} ").repeat(sequence % 5).into_bytes();
        let sequence = sequence as u32;
        let done = writer.write(handles[*class], sequence, *log_time, *log_time, &data).unwrap();
        assert_eq!(done.accepted, u64::from(sequence) + 1);
        let topic = CLASSES[*class].0.to_owned();
        sent.push(Sent { topic, sequence, log_time: *log_time, data });
    }
    let map = BTreeMap::from([("seed".to_owned(), "7".to_owned())]);
    writer.write_metadata("scenefold", map).unwrap();
    (writer.finish().unwrap(), sent)
}

/// A mixed log of `n` messages over all classes.
pub(crate) fn mixed(n: usize) -> (Vec<u8>, Vec<Sent>) {
    let arrivals: Vec<_> = (0..n).map(|i| ((i * 7 / 3) % 4, (i as u64 / 3) * 10)).collect();
    write_all(&arrivals, small_chunks())
}

pub(crate) fn open(bytes: &[u8]) -> LogFile {
    LogFile::open(Arc::new(bytes.to_vec()), Limits::default()).unwrap()
}

pub(crate) fn read_filtered(log: &LogFile, filter: MessageFilter) -> (Vec<Sent>, Vec<Damage>) {
    let mut cursor = log.messages(filter);
    let mut read = Vec::new();
    while let Some(message) = cursor.next_message().unwrap() {
        let topic = log.channels().get(&message.channel).map_or("?", |c| c.topic.as_str());
        read.push(Sent {
            topic: topic.to_owned(),
            sequence: message.sequence,
            log_time: message.log_time,
            data: message.data.to_vec(),
        });
    }
    (read, cursor.damage().items().to_vec())
}

pub(crate) fn read(log: &LogFile) -> (Vec<Sent>, Vec<Damage>) {
    read_filtered(log, MessageFilter::default())
}
