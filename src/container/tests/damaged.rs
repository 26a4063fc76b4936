//! Damage is local: what it does not touch is delivered.

use std::collections::BTreeSet;

use super::*;

/// Deterministic noise, so that a failure can be repeated.
struct Noise(u64);

impl Noise {
    fn next(&mut self, below: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 % below.max(1) as u64) as usize
    }
}

/// Reads whatever can be read, by both ways in; must not panic.
fn survive(bytes: &[u8]) -> Option<(LogFile, Vec<Sent>, Vec<Damage>)> {
    let _ = LogFile::scan(Arc::new(bytes.to_vec()), Limits::default()).map(|log| read(&log));
    let log = LogFile::open(Arc::new(bytes.to_vec()), Limits::default()).ok()?;
    let (messages, damage) = read(&log);
    let _ = log.check_data_section().unwrap();
    Some((log, messages, damage))
}

fn events(messages: &[Sent]) -> Vec<&Sent> {
    messages.iter().filter(|message| message.topic == "/change").collect()
}

#[test]
fn truncation_anywhere_delivers_a_prefix_of_the_events() {
    let (bytes, sent) = mixed(40);
    let all = events(&sent);
    let mut most = 0;
    for cut in 0..bytes.len() {
        let (log, messages, damage) = survive(&bytes[..cut]).unwrap();
        assert!(!log.is_finished());
        assert!(damage.is_empty(), "cut at {cut}: {damage:?}");
        assert!(log.damage().items().len() <= 2, "cut at {cut}: {:?}", log.damage());
        let events = events(&messages);
        assert!(all.starts_with(&events), "cut at {cut}");
        assert!(events.len() >= most, "cut at {cut}: a longer file gives less");
        most = events.len();
        assert!(messages.iter().all(|message| sent.contains(message)));
    }
    assert_eq!(most, all.len());
}

#[test]
fn truncation_of_a_loose_log_delivers_a_prefix() {
    let mut out = std::io::Cursor::new(Vec::new());
    let options = mcap::WriteOptions::new().use_chunks(false);
    let mut writer = mcap::Writer::with_options(&mut out, options).unwrap();
    let schema = writer.add_schema("S", "jsonschema", b"{}").unwrap();
    let channel_id = writer.add_channel(schema, "/change", "json", &BTreeMap::new()).unwrap();
    for sequence in 0..20 {
        let log_time = u64::from(sequence);
        let header =
            mcap::records::MessageHeader { channel_id, sequence, log_time, publish_time: 0 };
        writer.write_to_known_channel(&header, b"payload").unwrap();
    }
    writer.finish().unwrap();
    drop(writer);
    let bytes = out.into_inner();
    let whole = survive(&bytes).unwrap().1;
    assert_eq!(whole.len(), 20);
    for cut in 0..bytes.len() {
        let (_, messages, _) = survive(&bytes[..cut]).unwrap();
        assert!(whole.starts_with(&messages), "cut at {cut}");
    }
}

#[test]
fn a_flipped_bit_costs_at_most_the_chunk_it_hits() {
    let (bytes, _) = mixed(200);
    let intact = open(&bytes);
    let chunks = intact.chunks().to_vec();
    let mut noise = Noise(11);
    for round in 0..1000 {
        let at = noise.next(bytes.len());
        let mut damaged = bytes.clone();
        damaged[at] ^= 1 << noise.next(8);
        // Every third time the summary is gone as well, so that only the scan can help.
        if round % 3 == 0 {
            damaged.truncate(intact_data_end(&intact));
        }
        let (log, messages, found) = survive(&damaged).unwrap();
        let numbers: BTreeSet<_> = messages.iter().map(|message| message.sequence).collect();
        for chunk in &chunks {
            if (chunk.offset..chunk.end()).contains(&(at as u64)) {
                continue;
            }
            let mut buffer = ChunkBuffer::new();
            intact.read_chunk_into(chunk, &mut buffer).unwrap();
            for message in buffer.messages() {
                assert!(
                    numbers.contains(&message.sequence),
                    "round {round}: flip at {at} lost a message of the chunk at {}: {:?} {found:?}",
                    chunk.offset,
                    log.damage(),
                );
            }
        }
    }
}

fn intact_data_end(log: &LogFile) -> usize {
    let last = log.chunks().last().unwrap();
    // The message index of the last chunk of one checkpoint follows it.
    (last.end() + 31) as usize
}

#[test]
fn a_flip_in_a_chunk_is_never_delivered() {
    let (bytes, sent) = mixed(200);
    let chunks = open(&bytes).chunks().to_vec();
    let mut noise = Noise(5);
    for _ in 0..1000 {
        let chunk = &chunks[noise.next(chunks.len())];
        let at = chunk.offset as usize + noise.next(chunk.length as usize);
        let mut damaged = bytes.clone();
        damaged[at] ^= 1 << noise.next(8);
        let (_, messages, damage) = survive(&damaged).unwrap();
        if damage.is_empty() {
            // A few bits of a zstd frame mean nothing: then the content is whole.
            assert_eq!(messages, sent, "flip at {at} of {chunk:?}");
            continue;
        }
        assert!(messages.iter().all(|message| sent.contains(message)));
        assert_eq!((damage[0].offset, damage[0].length), (chunk.offset, chunk.length));
    }
}

#[test]
fn garbage_between_records_is_skipped_and_reported_exactly() {
    let (bytes, sent) = mixed(100);
    let log = open(&bytes);
    let at = log.chunks()[3].offset as usize;
    let mut damaged = bytes[..at].to_vec();
    damaged.extend_from_slice(&[0xAB; 77]);
    damaged.extend_from_slice(&bytes[at..]);
    let (log, messages, _) = survive(&damaged).unwrap();
    assert_eq!(messages, sent);
    let garbage = &log.damage().items()[0];
    assert_eq!((garbage.offset, garbage.length), (at as u64, 77));
}

#[test]
fn a_wrong_start_is_reported_and_read_over() {
    let (mut bytes, sent) = mixed(100);
    bytes[3] = b'X';
    let (log, messages, _) = survive(&bytes).unwrap();
    assert_eq!(messages, sent);
    assert_eq!(log.damage().items()[0].kind, DamageKind::BadMagic);
    bytes.pop();
    assert_eq!(survive(&bytes).unwrap().1, sent);
}

#[test]
fn random_mutations_never_panic() {
    let (ours, _) = mixed(80);
    let mut noise = Noise(3);
    for _ in 0..3000 {
        let mut bytes = ours.clone();
        for _ in 0..=noise.next(4) {
            let at = noise.next(bytes.len());
            let n = noise.next(200).min(bytes.len() - at);
            match noise.next(6) {
                0 => bytes[at] = noise.next(256) as u8,
                1 => drop(bytes.drain(at..at + n)),
                2 => {
                    let copy = bytes[at..at + n].to_vec();
                    let to = noise.next(bytes.len());
                    bytes.splice(to..to, copy);
                }
                3 => bytes[at..at + n].fill(0),
                4 => bytes[at..at + n.min(8)].fill(0xff),
                _ => bytes.truncate(at.max(1)),
            }
        }
        survive(&bytes);
    }
}
