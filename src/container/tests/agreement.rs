//! The `mcap` crate reads what we write, and we read what it writes.

use std::io::Cursor;

use mcap::sans_io::indexed_reader::{IndexedReadEvent, IndexedReader};
use mcap::sans_io::linear_reader::{LinearReadEvent, LinearReader, LinearReaderOptions};

use super::*;

#[test]
fn the_crates_message_stream_delivers_the_same_messages() {
    let (bytes, sent) = mixed(300);
    let mut read: Vec<_> = mcap::MessageStream::new(&bytes)
        .unwrap()
        .map(|message| {
            let message = message.unwrap();
            assert_eq!(message.channel.metadata["unit"], "metre");
            assert!(message.channel.schema.is_some());
            Sent {
                topic: message.channel.topic.clone(),
                sequence: message.sequence,
                log_time: message.log_time,
                data: message.data.to_vec(),
            }
        })
        .collect();
    // A stream gives file order; sorted by time alone it must be the order of arrival.
    read.sort_by_key(|message| message.log_time);
    assert_eq!(read, sent);
}

#[test]
fn the_crates_linear_reader_finds_every_checksum_right() {
    let (bytes, sent) = mixed(300);
    let options = LinearReaderOptions::default()
        .with_validate_chunk_crcs(true)
        .with_prevalidate_chunk_crcs(true)
        .with_validate_data_section_crc(true)
        .with_validate_summary_section_crc(true);
    let mut reader = LinearReader::new_with_options(options);
    let (mut rest, mut messages) = (bytes.as_slice(), 0);
    while let Some(event) = reader.next_event() {
        match event.unwrap() {
            LinearReadEvent::ReadRequest(n) => {
                let n = n.min(rest.len());
                reader.insert(n).copy_from_slice(&rest[..n]);
                reader.notify_read(n);
                rest = &rest[n..];
            }
            LinearReadEvent::Record { opcode, .. } => {
                messages += usize::from(opcode == mcap::records::op::MESSAGE);
            }
        }
    }
    assert_eq!(messages, sent.len());
}

#[test]
fn the_crates_indexed_reader_gives_the_same_order() {
    let (bytes, sent) = mixed(300);
    let summary = mcap::Summary::read(&bytes).unwrap().unwrap();
    assert_eq!(summary.stats.as_ref().unwrap().message_count, 300);
    assert_eq!(summary.metadata_indexes.len(), 1);
    for index in &summary.chunk_indexes {
        assert!(!summary.read_message_indexes(&bytes, index).unwrap().is_empty());
    }
    let index = &summary.metadata_indexes[0];
    assert_eq!(mcap::read::metadata(&bytes, index).unwrap().metadata["seed"], "7");
    let mut reader = IndexedReader::new(&summary).unwrap();
    let mut order = Vec::new();
    while let Some(event) = reader.next_event() {
        match event.unwrap() {
            IndexedReadEvent::ReadChunkRequest { offset, length } => {
                let chunk = &bytes[offset as usize..offset as usize + length];
                reader.insert_chunk_record_data(offset, chunk).unwrap();
            }
            IndexedReadEvent::Message { header, .. } => order.push(header.sequence),
        }
    }
    assert_eq!(order, sent.iter().map(|message| message.sequence).collect::<Vec<_>>());
}

/// Writes with the crate, with times that go back within and across chunks.
fn by_the_crate(options: mcap::WriteOptions) -> (Vec<u8>, Vec<Sent>) {
    let mut out = Cursor::new(Vec::new());
    let mut writer = mcap::Writer::with_options(&mut out, options).unwrap();
    let mut sent = Vec::new();
    for sequence in 0..300_u32 {
        let topic = format!("/topic{}", sequence % 3);
        let schema = writer.add_schema("S", "jsonschema", b"{}").unwrap();
        let channel = writer.add_channel(schema, &topic, "json", &BTreeMap::new()).unwrap();
        let log_time = u64::from(sequence * 10 + (sequence * 37) % 200);
        let data = format!("{sequence:>50}").into_bytes();
        let header = mcap::records::MessageHeader {
            channel_id: channel,
            sequence,
            log_time,
            publish_time: log_time,
        };
        writer.write_to_known_channel(&header, &data).unwrap();
        sent.push(Sent { topic, sequence, log_time, data });
    }
    let metadata = Metadata { name: "m".to_owned(), metadata: BTreeMap::new() };
    writer.write_metadata(&metadata).unwrap();
    let attachment = mcap::Attachment {
        log_time: 1,
        create_time: 1,
        name: "a".to_owned(),
        media_type: "text/plain".to_owned(),
        data: std::borrow::Cow::Borrowed(b"hello"),
    };
    writer.attach(&attachment).unwrap();
    writer.finish().unwrap();
    drop(writer);
    sent.sort_by_key(|message| message.log_time);
    (out.into_inner(), sent)
}

#[track_caller]
fn check_crate_file(options: mcap::WriteOptions) {
    let shown = format!("{options:?}");
    let (bytes, sent) = by_the_crate(options);
    let log = open(&bytes);
    let (messages, damage) = read(&log);
    assert_eq!(messages, sent);
    assert_eq!((damage, log.damage().items().to_vec()), (vec![], vec![]));
    assert!(log.is_finished());
    assert_eq!(log.metadata().len(), 1);
    assert_eq!(log.attachments(), 1);
    assert_ne!(log.check_data_section().unwrap(), Some(false), "{shown}");
    let (id, _) = log.channels().iter().find(|(_, c)| c.topic == "/topic1").unwrap();
    let one = read_filtered(&log, MessageFilter::on_channels([*id])).0;
    assert_eq!(one.len(), 100);
}

fn options() -> mcap::WriteOptions {
    mcap::WriteOptions::new().chunk_size(Some(700))
}

#[test]
fn chunked_zstd_lz4_and_stored_files_are_read() {
    for compression in [Some(mcap::Compression::Zstd), Some(mcap::Compression::Lz4), None] {
        check_crate_file(options().compression(compression));
    }
}

#[test]
fn unchunked_files_are_read() {
    check_crate_file(options().use_chunks(false));
}

#[test]
fn files_with_less_in_them_are_read() {
    check_crate_file(options().emit_message_indexes(false));
    check_crate_file(options().emit_chunk_indexes(false));
    check_crate_file(options().repeat_channels(false).repeat_schemas(false));
    check_crate_file(options().emit_statistics(false).emit_summary_offsets(false));
    // Without chunk checksums the crate's checksum of the data section comes out wrong.
    check_crate_file(
        options()
            .calculate_chunk_crcs(false)
            .calculate_data_section_crc(false)
            .calculate_summary_section_crc(false),
    );
    check_crate_file(
        options()
            .emit_chunk_indexes(false)
            .emit_message_indexes(false)
            .repeat_channels(false)
            .repeat_schemas(false)
            .emit_statistics(false)
            .emit_attachment_indexes(false)
            .emit_metadata_indexes(false)
            .emit_summary_offsets(false),
    );
}

#[test]
fn other_programs_files_are_read_without_damage() {
    let Ok(dir) = std::env::var("SCENEFOLD_SHARED_DATA") else { return };
    for entry in std::fs::read_dir(std::path::Path::new(&dir).join("mcap")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "mcap") {
            continue;
        }
        let log = LogFile::open(Arc::new(FileSource::open(&path).unwrap()), Limits::default());
        let log = log.unwrap();
        let (messages, damage) = read(&log);
        assert!(damage.is_empty() && log.damage().is_empty(), "{}", path.display());
        let mut counts = BTreeMap::new();
        for message in &messages {
            *counts.entry(message.topic.clone()).or_insert(0) += 1;
        }
        println!("{} {counts:?}", path.file_name().unwrap().display());
        if let Some(statistics) = log.statistics() {
            assert_eq!(statistics.message_count, messages.len() as u64, "{}", path.display());
        }
    }
}
