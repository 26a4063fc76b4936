//! Any bytes are read without panic, and never as something that generated code refuses.

use proptest::collection::vec;
use proptest::prelude::*;
use prost::Message;

use crate::event::{Event, Topic};
use crate::testing;
use crate::time::Stamp;
use crate::wire::{decode, decode_checkpoint, decode_transaction, encode, peek_checkpoint, proto};

/// Flips, cuts and repeats parts of a payload.
fn damaged(mut payload: Vec<u8>, damage: &[(prop::sample::Index, u8)]) -> Vec<u8> {
    for (place, byte) in damage {
        if payload.is_empty() {
            break;
        }
        let n = place.index(payload.len());
        match byte % 4 {
            0 => payload[n] ^= 1 << (byte >> 5),
            1 => payload[n] = *byte,
            2 => payload.truncate(n),
            _ => payload.extend_from_within(n..),
        }
    }
    payload
}

/// What is read of damaged bytes is valid: it is written and read again as the same.
fn check(
    event: &Event,
    at: Stamp,
    damage: &[(prop::sample::Index, u8)],
) -> Result<(), TestCaseError> {
    let payload = damaged(encode(event), damage);
    if let Ok(read) = decode(&event.topic(), at, &payload) {
        prop_assert_eq!(decode(&event.topic(), at, &encode(&read)), Ok(read));
    }
    Ok(())
}

proptest! {
    #[test]
    fn any_bytes_are_read_without_panic(bytes in vec(any::<u8>(), 0..300)) {
        for topic in Topic::OWN {
            let _ = decode(&topic, Stamp::EPOCH, &bytes);
        }
        let _ = (decode_checkpoint(&bytes), peek_checkpoint(&bytes));
    }

    #[test]
    fn damaged_events_are_refused_or_valid(
        it in testing::transaction(), record in testing::change_record(),
        graph in testing::graph(), task in testing::task(), status in testing::task_status(),
        damage in vec(any::<(prop::sample::Index, u8)>(), 1..4),
    ) {
        check(&Event::Task(task), it.at, &damage)?;
        check(&Event::TaskStatus(status), it.at, &damage)?;
        check(&Event::Change(record), it.at, &damage)?;
        check(&Event::InitialGraph(graph), it.at, &damage)?;
        check(&Event::Transaction(it.clone()), it.at, &damage)?;
    }

    #[test]
    fn what_is_read_as_a_transaction_generated_code_reads_the_same(
        it in testing::transaction(),
        damage in vec(any::<(prop::sample::Index, u8)>(), 0..4),
    ) {
        let payload = damaged(encode(&Event::Transaction(it.clone())), &damage);
        if let Ok(read) = decode_transaction(it.at, &payload) {
            let generated = proto::Transaction::decode(&*payload);
            let Ok(generated) = generated else {
                return Err(TestCaseError::fail("generated code refuses it"));
            };
            prop_assert_eq!(decode_transaction(it.at, &generated.encode_to_vec()), Ok(read));
        }
    }
}
