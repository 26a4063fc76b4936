//! What is written reads back; what generated code reads of it is what was meant.

use proptest::prelude::*;
use prost::Message;

use crate::change::{Edit, Primitive};
use crate::event::{Event, Topic};
use crate::testing;
use crate::time::Stamp;
use crate::wire::{
    CHECKPOINT_PEEK, CheckpointHead, Labels, WireError, decode, decode_checkpoint, decode_edits,
    decode_transaction, encode,
    encode_checkpoint, peek_checkpoint, proto, transaction,
};

#[track_caller]
fn check(at: Stamp, event: &Event) -> Result<(), TestCaseError> {
    let payload = encode(event);
    let read = decode(&event.topic(), at, &payload);
    prop_assert_eq!(read.as_ref(), Ok(event));
    // One value, one byte form.
    prop_assert_eq!(encode(&read.unwrap()), payload);
    Ok(())
}

proptest! {
    #[test]
    fn a_graph_reads_back(at in testing::stamp(), graph in testing::graph()) {
        let hash = graph.hash();
        let event = Event::InitialGraph(graph);
        check(at, &event)?;
        let Ok(Event::InitialGraph(read)) = decode(&event.topic(), at, &encode(&event)) else {
            return Err(TestCaseError::fail("not a graph"));
        };
        prop_assert_eq!(read.hash(), hash);
    }

    #[test]
    fn inputs_read_back(
        utterance in testing::utterance(),
        task in testing::task(),
        status in testing::task_status(),
        interpretation in testing::interpretation(),
        reply in testing::language_reply(),
        staleness in testing::staleness(),
    ) {
        check(Stamp::EPOCH, &Event::LanguageReply(reply))?;
        check(Stamp::EPOCH, &Event::Utterance(utterance))?;
        check(Stamp::EPOCH, &Event::Task(task))?;
        check(Stamp::EPOCH, &Event::TaskStatus(status))?;
        check(Stamp::EPOCH, &Event::Interpretation(interpretation))?;
        check(Stamp::EPOCH, &Event::Staleness(staleness))?;
        check(Stamp::EPOCH, &Event::Tick)?;
    }

    #[test]
    fn a_change_record_reads_back(record in testing::change_record()) {
        check(Stamp::EPOCH, &Event::Change(record.clone()))?;
        check(Stamp::EPOCH, &Event::TrueChange(record))?;
    }

    #[test]
    fn a_transaction_reads_back_with_its_log_time(it in testing::transaction()) {
        check(it.at, &Event::Transaction(it))?;
    }

    #[test]
    fn generated_code_reads_of_a_transaction_what_was_written(it in testing::transaction()) {
        let at = it.at;
        let payload = encode(&Event::Transaction(it.clone()));
        let generated = proto::Transaction::decode(&*payload).unwrap();
        prop_assert_eq!(&generated, &transaction::transaction(&it));
        prop_assert_eq!(&generated.encode_to_vec(), &payload);
        prop_assert_eq!(decode_transaction(at, &generated.encode_to_vec()), Ok(it));
    }

    #[test]
    fn a_change_record_is_written_as_generated_code_writes_it(it in testing::change_record()) {
        let payload = encode(&Event::Change(it));
        let generated = proto::ChangeRecord::decode(&*payload).unwrap();
        prop_assert_eq!(generated.encode_to_vec(), payload);
    }

    #[test]
    fn replay_reads_of_a_transaction_what_it_changes(it in testing::transaction()) {
        let mut edits = Vec::new();
        let payload = encode(&Event::Transaction(it.clone()));
        decode_edits(it.at, &payload, &mut Labels::default(), &mut edits).unwrap();
        let explains = |primitive: &Primitive| match primitive {
            Primitive::Find { candidates, chosen, .. } => {
                chosen.is_none_or(|chosen| candidates.contains(&chosen))
            }
            _ => false,
        };
        let steps = it.steps.into_iter().map(|step| step.primitive).enumerate();
        let changing = steps.filter(|(_, primitive)| !explains(primitive));
        let expected: Vec<Edit> =
            changing.map(|(step, primitive)| Edit { step, primitive }).collect();
        prop_assert_eq!(edits, expected);
    }

    #[test]
    fn a_checkpoint_reads_back_whole_and_from_its_first_bytes(
        version: u32, order: u64, changes: u64, at in testing::stamp(),
        chain: [u8; 32], state_hash: [u8; 32], memory_hash: [u8; 32],
        state in proptest::collection::vec(any::<u8>(), 0..2000),
    ) {
        let state_size = state.len() as u64;
        let head = CheckpointHead {
            version, order, changes, at, chain, state_hash, memory_hash, state_size,
        };
        let payload = encode_checkpoint(&head, &state);
        let whole = decode_checkpoint(&payload).unwrap();
        prop_assert_eq!((whole.head, whole.state), (head, state));
        let prefix = &payload[..payload.len().min(CHECKPOINT_PEEK)];
        prop_assert_eq!(peek_checkpoint(prefix), Ok(head));
        prop_assert_eq!(peek_checkpoint(&payload), Ok(head));
    }
}

/// Found by fuzzing: an empty topic was read and, written again, missing.
#[test]
fn a_reference_to_an_empty_topic_is_a_missing_one() {
    let payload = [0x0a, 4, 0x0a, 0, 0x10, 6];
    let missing = WireError::Missing { message: "EvidenceRef", field: "topic" };
    assert_eq!(decode(&Topic::Interpretation, Stamp::EPOCH, &payload), Err(missing));
}
