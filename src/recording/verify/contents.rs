//! What the messages say: numbers, the chain, the fold, the detectors.

use std::convert::Infallible;

use super::{Check, Status};
use crate::change::World;
use crate::container::{MessageFilter, RawMessage};
use crate::event::{Event, Logged, Topic};
use crate::recording::chain::Chain;
use crate::recording::checkpoint::Checkpoint;
use crate::recording::events::{RawEvent, decode};
use crate::recording::meta::{Ending, Meta, Seal};
use crate::recording::open::Segment;
use crate::recording::orphans::Orphans;
use crate::recording::reprocess::{Again, ReprocessError};
use crate::updater::Config;

/// Where what follows goes when it is only compared.
#[allow(clippy::unnecessary_wraps)]
fn nowhere(_: &Logged, _: &[Logged]) -> Result<(), Infallible> {
    Ok(())
}

impl Check<'_> {
    pub(super) fn contents(&mut self, progress: &mut dyn FnMut(u64)) {
        for (n, segment) in self.recording.segments.iter().enumerate() {
            self.begin(n, segment);
            let filter = MessageFilter::default();
            let mut cursor = segment.log.messages(filter);
            loop {
                let message = match cursor.next_message() {
                    Ok(Some(message)) => message,
                    Ok(None) => break,
                    Err(error) => {
                        self.find(Status::Corrupt, segment, error.to_string());
                        break;
                    }
                };
                let Some(topic) = segment.topics.get(&message.channel) else { continue };
                self.message(segment, topic, &message);
                if self.events.is_multiple_of(4096) {
                    progress(self.events);
                }
            }
            let damage = cursor.damage().clone();
            let lost = !damage.is_empty();
            drop(cursor);
            self.damages(segment, &damage);
            self.end(segment, lost);
        }
    }

    fn begin(&mut self, n: usize, segment: &Segment) {
        self.primitives = 0;
        self.orphans = Orphans::of(self.recording, n);
        if let Some(order) = segment.meta.as_ref().and_then(|meta| meta.edited) {
            let what = format!("it was recovered from one that was edited before event #{order}");
            self.find(Status::Tampered, segment, what);
        }
        let Some(meta) = segment.meta.as_ref().filter(|_| n > 0) else { return };
        if self.ended.is_some_and(|ended| ended != meta.chain) && !self.lost {
            let what = "it does not go on where the segment before it ends".to_owned();
            self.find(Status::Tampered, segment, what);
        }
        self.chain = Chain::after(segment.first_link());
    }

    fn message(&mut self, segment: &Segment, topic: &Topic, message: &RawMessage<'_>) {
        if *topic == Topic::Checkpoint {
            return self.checkpoint(segment, message.data);
        }
        let (event, sensor) =
            (segment.events.contains(&message.channel), segment.sensors.contains(&message.channel));
        if !event && !sensor {
            return;
        }
        let numbered = segment.is_numbered();
        let order = if numbered { u64::from(message.sequence) } else { self.order + 1 };
        if numbered && !self.orphans.takes(order) {
            return;
        }
        self.events += 1;
        self.number(segment, order);
        let (at, published) = (message.log_time, message.publish_time);
        self.chain.add(&topic.name(), order, at, published, message.data);
        match decode(segment, RawEvent::of(order, topic, message)) {
            Ok(logged) => self.event(segment, &logged),
            Err(error) => {
                self.miss();
                self.find(Status::Corrupt, segment, format!("event #{order}: {error}"));
            }
        }
    }

    /// Event numbers go up by one; where they do not, something is missing.
    fn number(&mut self, segment: &Segment, order: u64) {
        let expected = self.order + 1;
        if order != expected {
            let what = match order > expected {
                true => format!("events #{expected} to #{} are missing", order - 1),
                false => format!("event #{order} stands after #{}", self.order),
            };
            self.gap(segment, what);
        }
        self.order = order;
    }

    /// Something is missing after the last event; a recovered recording may have told so.
    fn gap(&mut self, segment: &Segment, what: String) {
        self.broken = true;
        self.settle(segment);
        if let Some(again) = &mut self.again {
            again.forget_unfinished();
        }
        self.compare_derived(segment);
        if self.gaps.contains(&self.order) {
            return;
        }
        self.miss();
        self.find(self.blame(), segment, what);
    }

    /// Missing events without any damage were cut out on purpose.
    fn blame(&self) -> Status {
        let damaged = self.findings.iter().any(|finding| finding.status == Status::Corrupt)
            || !self.recording.trouble().is_empty();
        if damaged { Status::Corrupt } else { Status::Tampered }
    }

    fn miss(&mut self) {
        (self.broken, self.lost, self.ever_lost) = (true, true, true);
    }

    fn event(&mut self, segment: &Segment, logged: &Logged) {
        match &logged.event {
            Event::InitialGraph(graph) => self.world = World::from_graph(graph.clone()),
            Event::Change(record) => self.changes = record.seq,
            Event::Transaction(transaction) => {
                self.primitives += transaction.steps.len() as u64;
                if let Err(error) = transaction.apply(&mut self.world)
                    && !self.broken
                {
                    let what = format!("event #{}: {error}", logged.order);
                    self.find(Status::Nondeterministic, segment, what);
                }
            }
            _ => {}
        }
        self.run_again(segment, |again| again.take(logged, &mut nowhere));
    }

    /// Runs the detectors over the last input, whose last model output was read.
    pub(super) fn settle(&mut self, segment: &Segment) {
        self.run_again(segment, |again| again.settle(&mut nowhere));
    }

    fn run_again(
        &mut self,
        segment: &Segment,
        run: impl FnOnce(&mut Again) -> Result<(), ReprocessError<Infallible>>,
    ) {
        let Some(again) = &mut self.again else { return };
        if let Err(ReprocessError::Update { order, error }) = run(again) {
            self.again = None;
            let what = format!("event #{order} is refused when the detectors run again: {error}");
            self.find(Status::Nondeterministic, segment, what);
        }
    }

    fn checkpoint(&mut self, segment: &Segment, payload: &[u8]) {
        let checkpoint = match Checkpoint::decode(payload) {
            Ok(checkpoint) => checkpoint,
            Err(why) => {
                let what = format!("the checkpoint after event #{} is no use: {why}", self.order);
                return self.find(Status::Corrupt, segment, what);
            }
        };
        if self.broken || checkpoint.order > self.order {
            return self.mend(segment, &checkpoint);
        }
        if checkpoint.order < self.order {
            let (says, stands) = (checkpoint.order, self.order);
            let what = format!("a checkpoint after event #{stands} says it stands after #{says}");
            return self.find(Status::Tampered, segment, what);
        }
        self.compare_state(segment, &checkpoint);
        self.compare_link(segment, &checkpoint);
    }

    fn compare_link(&mut self, segment: &Segment, checkpoint: &Checkpoint) {
        if self.chain.close() == checkpoint.chain {
            self.checkpoints += 1;
        } else if self.blame() == Status::Corrupt {
            // A link was made at a checkpoint that cannot be read.
            self.ever_lost = true;
            self.chain = Chain::after(checkpoint.chain);
        } else {
            let what = format!("the hash chain does not hold up to event #{}", self.order);
            self.find(Status::Tampered, segment, what);
            self.chain = Chain::after(checkpoint.chain);
        }
    }

    fn compare_state(&mut self, segment: &Segment, checkpoint: &Checkpoint) {
        self.settle(segment);
        let order = checkpoint.order;
        if self.world.graph().hash() != checkpoint.state_hash {
            let what = format!("the fold does not give the state of the checkpoint after #{order}");
            self.find(Status::Nondeterministic, segment, what);
        }
        if checkpoint.changes != self.changes {
            let what = format!("the checkpoint after #{order} counts other changes");
            self.find(Status::Nondeterministic, segment, what);
        }
        let again = self.again.as_ref().filter(|again| again.different() == 0);
        if again.is_some_and(|again| again.updater().to_bytes() != checkpoint.state) {
            let what = format!("the detectors do not come to the state they had after #{order}");
            self.find(Status::Nondeterministic, segment, what);
        }
    }

    /// After a gap, the states go on from what the checkpoint says. The chain goes on by itself
    /// if the recording knows of the gap, for then its links were made over it.
    fn mend(&mut self, segment: &Segment, checkpoint: &Checkpoint) {
        if checkpoint.order > self.order {
            let (first, last) = (self.order + 1, checkpoint.order);
            self.gap(segment, format!("events #{first} to #{last} are missing"));
            (self.order, self.changes) = (last, checkpoint.changes);
        }
        let config = segment.meta.as_ref().map_or_else(Config::default, |m| m.config.clone());
        match (checkpoint.world(), checkpoint.updater(config)) {
            (Ok(world), Ok(updater)) => {
                self.world = world;
                self.again = Some(Again::new(updater));
                self.broken = false;
            }
            (world, _) => {
                let why = world.err().map_or(String::new(), |error| error.to_string());
                let what = format!("checkpoint after event #{}: {why}", checkpoint.order);
                self.find(Status::Corrupt, segment, what);
            }
        }
        if self.lost {
            self.lost = false;
            self.checkpoints += 1;
            self.chain = Chain::after(checkpoint.chain);
        } else {
            self.compare_link(segment, checkpoint);
        }
    }

    fn end(&mut self, segment: &Segment, lost: bool) {
        if lost {
            self.miss();
        }
        self.ended = Some(self.chain.link());
        let Some(stored) = segment.seal else {
            if segment.meta.is_some() && segment.log.is_finished() {
                let what = "the seal it was ended with is missing".to_owned();
                self.find(Status::Tampered, segment, what);
            }
            return;
        };
        let found = Ending {
            events: self.order,
            changes: self.changes,
            primitives: self.primitives,
            link: self.chain.link(),
            state_hash: self.world.graph().hash(),
            meta: segment.meta.as_ref().unwrap_or(&Meta::default()),
        }
        .seal();
        self.ended = Some(found.chain);
        self.compare_seal(segment, &stored, &found);
    }

    fn compare_seal(&mut self, segment: &Segment, stored: &Seal, found: &Seal) {
        if stored.events != found.events {
            let (should, does) = (stored.events, found.events);
            let what = format!("it should end with event #{should}, but ends with #{does}");
            let status = self.blame();
            return self.find(status, segment, what);
        }
        if self.lost || self.ever_lost {
            return;
        }
        if stored.state_hash != found.state_hash {
            let what = "the fold does not give the state the recording ended with".to_owned();
            self.find(Status::Nondeterministic, segment, what);
        } else if stored != found {
            let what = "the hash chain does not hold up to the end".to_owned();
            self.find(Status::Tampered, segment, what);
        }
    }
}
