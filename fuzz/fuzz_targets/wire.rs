//! Any payload on any topic of ours: what is read is written and read back as it is, and replay
//! takes what a reader of transactions takes.
#![no_main]

use libfuzzer_sys::fuzz_target;
use scenefold::change::{Edit, Primitive, Transaction};
use scenefold::event::{Event, Topic};
use scenefold::time::Stamp;
use scenefold::wire::{self, Labels, ros2};

const AT: Stamp = Stamp::from_nanos(1_767_571_200_000_000_000);

fuzz_target!(|bytes: &[u8]| {
    let Some((first, payload)) = bytes.split_first() else { return };
    match Topic::OWN.get(usize::from(*first)) {
        Some(Topic::Checkpoint) => {
            let _ = (wire::decode_checkpoint(payload), wire::peek_checkpoint(payload));
        }
        Some(topic) => own(topic, payload),
        None => {
            let _ = (ros2::decode_image(payload), ros2::decode_compressed_image(payload));
            let _ = (ros2::decode_camera_info(payload), ros2::decode_tf(payload));
        }
    }
});

fn own(topic: &Topic, payload: &[u8]) {
    let read = wire::decode(topic, AT, payload);
    if *topic == Topic::Primitive {
        replay(payload, read.as_ref().ok());
    }
    if let Ok(event) = read {
        let again = wire::decode(topic, AT, &wire::encode(&event));
        assert_eq!(again.as_ref(), Ok(&event));
    }
}

fn replay(payload: &[u8], event: Option<&Event>) {
    let mut edits = Vec::new();
    let read = wire::decode_edits(AT, payload, &mut Labels::default(), &mut edits);
    assert_eq!(read.is_ok(), event.is_some());
    if let Some(Event::Transaction(transaction)) = event {
        assert_eq!(edits, edits_of(transaction));
    }
}

fn edits_of(transaction: &Transaction) -> Vec<Edit> {
    let steps = transaction.steps.iter().map(|step| step.primitive.clone()).enumerate();
    let explains = |primitive: &Primitive| match primitive {
        Primitive::Find { candidates, chosen, .. } => {
            chosen.is_none_or(|chosen| candidates.contains(&chosen))
        }
        _ => false,
    };
    let edits = steps.filter(|(_, primitive)| !explains(primitive));
    edits.map(|(step, primitive)| Edit { step, primitive }).collect()
}
