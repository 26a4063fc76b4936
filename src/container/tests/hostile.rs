//! Files that claim too much stay bounded, and files that are no logs are named.

use mcap::records::op;

use super::*;

fn with_records(records: &[u8]) -> Vec<u8> {
    [mcap::MAGIC, records].concat()
}

fn chunk(compression: &str, uncompressed: u64, data: &[u8]) -> Vec<u8> {
    let mut body = Vec::new();
    body.extend_from_slice(&0_u64.to_le_bytes());
    body.extend_from_slice(&9_u64.to_le_bytes());
    body.extend_from_slice(&uncompressed.to_le_bytes());
    body.extend_from_slice(&0_u32.to_le_bytes());
    body.extend_from_slice(&(compression.len() as u32).to_le_bytes());
    body.extend_from_slice(compression.as_bytes());
    body.extend_from_slice(&(data.len() as u64).to_le_bytes());
    body.extend_from_slice(data);
    let mut record = vec![op::CHUNK];
    record.extend_from_slice(&(body.len() as u64).to_le_bytes());
    record.extend_from_slice(&body);
    record
}

fn only_damage(bytes: &[u8]) -> DamageKind {
    let log = open(bytes);
    let (messages, damage) = read(&log);
    assert!(messages.is_empty());
    let damage = [damage, log.damage().items().to_vec()].concat();
    assert_eq!(damage.len(), 1, "{damage:?}");
    damage[0].kind.clone()
}

#[test]
fn a_bomb_is_not_unpacked() {
    let bomb = zstd::bulk::compress(&vec![0; 100 << 20], 3).unwrap();
    for claimed in [10, 20 << 20] {
        let kind = only_damage(&with_records(&chunk("zstd", claimed, &bomb)));
        assert!(matches!(kind, DamageKind::Decompress { .. }), "{kind}");
    }
    let kind = only_damage(&with_records(&chunk("zstd", u64::MAX, &bomb)));
    assert!(matches!(kind, DamageKind::ChunkTooLarge { .. }), "{kind}");
}

#[test]
fn claims_of_everything_are_disbelieved() {
    for opcode in 0..=255 {
        let mut record = vec![opcode];
        record.extend_from_slice(&u64::MAX.to_le_bytes());
        record.extend_from_slice(&[0xff; 80]);
        let _ = only_damage(&with_records(&record));
        // Lengths that fit, around fields that do not.
        let mut record = vec![opcode];
        record.extend_from_slice(&80_u64.to_le_bytes());
        record.extend_from_slice(&[0xff; 80]);
        let log = open(&with_records(&record));
        let _ = read(&log);
    }
}

#[test]
fn an_unknown_compression_is_named() {
    let kind = only_damage(&with_records(&chunk("brotli", 10, b"0123456789")));
    assert_eq!(kind, DamageKind::UnknownCompression { name: "brotli".to_owned() });
}

#[test]
fn a_chunk_inside_a_chunk_is_refused() {
    let inner = chunk("", 0, b"");
    let kind = only_damage(&with_records(&chunk("", inner.len() as u64, &inner)));
    assert_eq!(kind, DamageKind::Body { at: 0 });
}

#[test]
fn many_candidates_for_a_record_do_not_take_quadratic_time() {
    let metadata = [op::METADATA, 0, 0, 0x10, 0, 0, 0, 0, 0];
    let unknown = [0x7f, 0, 0, 0, 0, 0, 0, 0, 0];
    let private = [0x80, 0, 0, 0, 0, 0, 0, 0, 0];
    let message = [op::MESSAGE, 22, 0, 0, 0, 0, 0, 0, 0];
    let attachment = [op::ATTACHMENT, 0, 0, 0x10, 0, 0, 0, 0, 0];
    for pattern in [metadata, unknown, private, message, attachment] {
        let mut bytes = with_records(&pattern.repeat(200_000));
        bytes.push(0);
        let log = open(&bytes);
        let _ = read(&log);
    }
}

#[test]
fn chunks_that_all_overlap_are_merged_or_refused_within_the_limit() {
    let (bytes, sent) = mixed(200);
    let limits = Limits { held_bytes: 100, ..Limits::default() };
    let log = LogFile::open(Arc::new(bytes.clone()), limits).unwrap();
    let mut cursor = log.messages(MessageFilter::default());
    let mut count = 0;
    let error = loop {
        match cursor.next_message() {
            Ok(Some(_)) => count += 1,
            Ok(None) => panic!("the limit was not kept"),
            Err(error) => break error,
        }
    };
    assert!(count < sent.len());
    assert!(matches!(error, LogError::TooMuchOverlap { .. }));
}

#[test]
fn compressed_and_foreign_files_are_named() {
    let (bytes, _) = mixed(10);
    let packed = zstd::bulk::compress(&bytes, 3).unwrap();
    let error = LogFile::open(Arc::new(packed), Limits::default()).err().unwrap();
    assert!(error.to_string().contains("zstd -d"), "{error}");
    for text in ["hello", "a text that is longer than the magic bytes of a recording"] {
        let error = LogFile::open(Arc::new(text.as_bytes().to_vec()), Limits::default());
        assert!(matches!(error.err(), Some(LogError::NotMcap)));
    }
}

#[test]
fn an_empty_file_is_an_empty_log_with_a_reason() {
    assert_eq!(only_damage(b""), DamageKind::Empty);
    let log = open(mcap::MAGIC);
    assert!(log.damage().is_empty() && !log.is_finished());
}

#[test]
fn a_channel_defined_twice_in_different_ways_is_damage() {
    let (mut ours, _) = mixed(20);
    let (theirs, _) = write_all(&[(2, 1000), (2, 1001)], small_chunks());
    let theirs_log = open(&theirs);
    let chunk = &theirs_log.chunks()[0];
    // Channel 1 is another topic there; without its summary the file is scanned.
    ours.truncate(open(&ours).chunks().last().unwrap().end() as usize + 31);
    ours.extend_from_slice(&theirs[chunk.offset as usize..chunk.end() as usize]);
    let (_, damage) = read(&open(&ours));
    assert!(matches!(damage[0].kind, DamageKind::Redefined { .. }), "{damage:?}");
}

#[test]
fn a_chunk_the_crate_never_closed_is_a_torn_tail() {
    let mut record = vec![op::CHUNK];
    record.extend_from_slice(&u64::MAX.to_le_bytes());
    record.extend_from_slice(&[7; 500]);
    let (bytes, sent) = mixed(100);
    let end = open(&bytes).chunks().last().unwrap().end() as usize + 31;
    let torn = [&bytes[..end], &record].concat();
    let log = open(&torn);
    assert_eq!(read(&log).0, sent);
    assert_eq!(log.damage().items()[0].kind, DamageKind::OpenChunk);
    assert_eq!(log.damage().items()[0].length, 509);
}
