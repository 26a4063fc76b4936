//! Integrity and determinism: is the recording what it was, and does it give what it gave?

use std::ops::ControlFlow;
use std::path::Path;

use super::chain::{Chain, GENESIS, Link};
use super::checkpoint::Checkpoint;
use super::events::{Walk, WalkError, decode};
use super::open::{OpenError, Recording, Segment};
use super::reprocess::{Again, ReprocessError};
use crate::change::World;
use crate::container::{DamageKind, DamageList};
use crate::event::{Event, Topic};
use crate::graph::StateHash;
use crate::updater::{Config, Updater};

/// The verdict, the worst that was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// Nothing is wrong.
    Intact,
    /// The detectors derive something else from the inputs than was recorded, or the recorded
    /// primitives do not give the recorded states.
    Nondeterministic,
    /// The end is missing, as after a crash; everything before it is whole.
    Truncated,
    /// All checksums hold, but the events are not those that were recorded.
    Tampered,
    /// Bytes were lost or changed.
    Corrupt,
}

impl Status {
    /// The word for it in JSON.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Intact => "intact",
            Self::Nondeterministic => "nondeterministic",
            Self::Truncated => "truncated",
            Self::Tampered => "tampered",
            Self::Corrupt => "corrupt",
        }
    }
}

/// One thing that is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// What kind it is.
    pub status: Status,
    /// File name of the segment.
    pub segment: String,
    /// In words, with the place.
    pub what: String,
}

/// What came of verifying.
#[derive(Clone, Debug, PartialEq)]
pub struct Verified {
    /// The verdict.
    pub status: Status,
    /// Hash of the graph after the last intact event.
    pub hash: StateHash,
    /// Link of the chain after the last intact event; compare it with one kept elsewhere.
    pub chain: Link,
    /// How many events were read.
    pub events: u64,
    /// How many checkpoints were found to be right.
    pub checkpoints: u64,
    /// How many inputs gave again what was recorded.
    pub reprocessed: u64,
    /// What is wrong.
    pub findings: Vec<Finding>,
    /// Event numbers after which events are missing, if it was recovered from a damaged one.
    pub gaps: Vec<u64>,
}

/// Reads all of the recording at `path` and checks everything that can be checked: structure
/// and checksums, the hash chain, the states at checkpoints and at the end by folding, and the
/// derived records by running the detectors again. `progress` is told the events read so far.
pub fn verify(path: &Path, progress: &mut dyn FnMut(u64)) -> Result<Verified, OpenError> {
    let recording = Recording::scan(path)?;
    let mut check = Check::new(&recording);
    check.structure();
    // A scan does not look at the indexes; opening does.
    for segment in &Recording::open(path)?.segments {
        check.damages(segment, segment.log.damage());
    }
    let walked = check.contents(progress);
    if let Err(error) = walked {
        check.find(Status::Corrupt, &recording.segments[0], error.to_string());
    }
    Ok(check.verdict())
}

struct Check<'r> {
    recording: &'r Recording,
    findings: Vec<Finding>,
    chain: Chain,
    world: World,
    again: Option<Again>,
    order: u64,
    events: u64,
    checkpoints: u64,
    /// Something before here is lost: the chain and the states cannot be compared until a
    /// checkpoint.
    broken: bool,
    segment: usize,
    gaps: Vec<u64>,
}

impl<'r> Check<'r> {
    fn new(recording: &'r Recording) -> Self {
        let config = recording.meta().map_or_else(Config::default, |meta| meta.config.clone());
        let first = recording.meta().map_or(GENESIS, |meta| meta.chain);
        let gaps = recording.segments.iter().filter_map(|segment| segment.meta.as_ref());
        Self {
            recording,
            findings: Vec::new(),
            chain: Chain::after(first),
            world: World::default(),
            again: Some(Again::new(Updater::new(config))),
            order: 0,
            events: 0,
            checkpoints: 0,
            broken: false,
            segment: 0,
            gaps: gaps.flat_map(|meta| meta.gaps.clone()).collect(),
        }
    }

    fn find(&mut self, status: Status, segment: &Segment, what: String) {
        let segment = segment.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let finding = Finding { status, segment, what };
        if self.findings.len() < 1000 && !self.findings.contains(&finding) {
            self.findings.push(finding);
        }
    }

    fn structure(&mut self) {
        for segment in &self.recording.segments {
            self.damages(segment, segment.log.damage());
            if !segment.log.is_finished() {
                let what = "the file was never ended: its writer was stopped".to_owned();
                self.find(Status::Truncated, segment, what);
            }
            match segment.log.check_data_section() {
                Ok(Some(false)) => {
                    let what = "the checksum of the data section does not hold".to_owned();
                    self.find(Status::Corrupt, segment, what);
                }
                Err(error) => self.find(Status::Corrupt, segment, error.to_string()),
                Ok(_) => {}
            }
        }
    }

    fn damages(&mut self, segment: &Segment, damages: &DamageList) {
        for damage in damages.items() {
            let status = match damage.kind {
                DamageKind::TornTail | DamageKind::OpenChunk | DamageKind::Empty => {
                    Status::Truncated
                }
                _ => Status::Corrupt,
            };
            self.find(status, segment, damage.to_string());
        }
    }

    fn contents(&mut self, progress: &mut dyn FnMut(u64)) -> Result<(), WalkError> {
        for (n, segment) in self.recording.segments.iter().enumerate() {
            self.segment = n;
            self.begin(n, segment);
            let filter = crate::container::MessageFilter::default();
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
        Ok(())
    }

    fn begin(&mut self, n: usize, segment: &Segment) {
        let (Some(meta), true) = (&segment.meta, n > 0) else { return };
        if meta.chain != self.chain.link() && !self.broken {
            let what = format!(
                "its chain goes on from {}, the segment before ends with {}",
                meta.chain,
                self.chain.link()
            );
            // After a crash the segment before may lack what was never acknowledged.
            let torn = !self.recording.segments[n - 1].log.is_finished();
            let status = if torn { Status::Truncated } else { Status::Tampered };
            self.find(status, segment, what);
        }
        self.chain = Chain::after(meta.chain);
    }

    fn message(
        &mut self,
        segment: &Segment,
        topic: &Topic,
        message: &crate::container::RawMessage<'_>,
    ) {
        if *topic == Topic::Checkpoint {
            return self.checkpoint(segment, message.data);
        }
        let (event, sensor) =
            (segment.events.contains(&message.channel), segment.sensors.contains(&message.channel));
        if !event && !sensor {
            return;
        }
        self.events += 1;
        let numbered = segment.meta.is_some();
        let order = if numbered { u64::from(message.sequence) } else { self.order + 1 };
        self.number(segment, order);
        if event {
            let (at, published) = (message.log_time, message.publish_time);
            self.chain.add(&topic.name(), order, at, published, message.data);
        }
        let raw = super::events::RawEvent {
            order,
            topic,
            channel: message.channel,
            log_time: message.log_time,
            publish_time: message.publish_time,
            data: message.data,
        };
        match decode(segment, raw) {
            Ok(logged) => self.event(segment, &logged),
            Err(error) => {
                self.broken = true;
                self.find(Status::Corrupt, segment, format!("event #{order}: {error}"));
            }
        }
    }

    /// Event numbers go up by one; where they do not, something is missing.
    fn number(&mut self, segment: &Segment, order: u64) {
        let expected = self.order + 1;
        if order != expected {
            self.broken = true;
            self.again = None;
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
        if self.gaps.contains(&self.order) {
            return;
        }
        let damaged = self.findings.iter().any(|f| f.status == Status::Corrupt)
            || !self.recording.trouble().is_empty();
        // Missing events without any damage were cut out on purpose.
        let status = if damaged { Status::Corrupt } else { Status::Tampered };
        self.find(status, segment, what);
    }

    fn event(&mut self, segment: &Segment, logged: &crate::event::Logged) {
        match &logged.event {
            Event::InitialGraph(graph) => self.world = World::from_graph(graph.clone()),
            Event::Transaction(transaction) => {
                if let Err(error) = transaction.apply(&mut self.world)
                    && !self.broken
                {
                    let what = format!("event #{}: {error}", logged.order);
                    self.find(Status::Nondeterministic, segment, what);
                }
            }
            _ => {}
        }
        let Some(again) = &mut self.again else { return };
        let mut nowhere = |_: &_, _: &[_]| Ok::<_, std::convert::Infallible>(());
        if let Err(ReprocessError::Update { order, error }) = again.take(logged, &mut nowhere) {
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
        if self.broken || checkpoint.order != self.order {
            return self.mend(segment, &checkpoint);
        }
        self.compare_state(segment, &checkpoint);
        if self.chain.close() == checkpoint.chain {
            self.checkpoints += 1;
        } else {
            let what = format!("the hash chain does not hold up to event #{}", self.order);
            self.find(Status::Tampered, segment, what);
            self.chain = Chain::after(checkpoint.chain);
        }
    }

    fn compare_state(&mut self, segment: &Segment, checkpoint: &Checkpoint) {
        let order = checkpoint.order;
        if self.world.graph().hash() != checkpoint.state_hash {
            let what = format!("the fold does not give the state of the checkpoint after #{order}");
            self.find(Status::Nondeterministic, segment, what);
        }
        let again = self.again.as_ref().filter(|again| again.different() == 0);
        if again.is_some_and(|again| again.updater().to_bytes() != checkpoint.state) {
            let what = format!("the detectors do not come to the state they had after #{order}");
            self.find(Status::Nondeterministic, segment, what);
        }
    }

    /// After a gap, everything goes on from what the checkpoint says.
    fn mend(&mut self, segment: &Segment, checkpoint: &Checkpoint) {
        if checkpoint.order > self.order {
            let (first, last) = (self.order + 1, checkpoint.order);
            self.gap(segment, format!("events #{first} to #{last} are missing"));
            self.order = last;
        }
        let config = segment.meta.as_ref().map_or_else(Config::default, |m| m.config.clone());
        match (checkpoint.world(), checkpoint.updater(config)) {
            (Ok(world), Ok(updater)) => {
                self.world = world;
                self.again = Some(Again::new(updater));
                self.chain = Chain::after(checkpoint.chain);
                self.broken = false;
                self.checkpoints += 1;
            }
            (world, _) => {
                let why = world.err().map_or(String::new(), |error| error.to_string());
                let what = format!("checkpoint after event #{}: {why}", checkpoint.order);
                self.find(Status::Corrupt, segment, what);
            }
        }
    }

    fn end(&mut self, segment: &Segment, lost: bool) {
        self.broken |= lost && segment.seal.is_none();
        let Some(seal) = segment.seal else {
            // A recorder seals what it ends; whoever cut the end off may have cut that too.
            if segment.meta.is_some() && segment.log.is_finished() {
                let what = "the file was ended, but not sealed".to_owned();
                self.find(Status::Tampered, segment, what);
            }
            return;
        };
        if seal.events != self.order {
            let what =
                format!("it should end with event #{}, but ends with #{}", seal.events, self.order);
            self.find(Status::Tampered, segment, what);
            return;
        }
        if self.broken {
            return;
        }
        if seal.chain != self.chain.link() {
            let what = "the hash chain does not hold up to the end".to_owned();
            self.find(Status::Tampered, segment, what);
        }
        if seal.state_hash != self.world.graph().hash() {
            let what = "the fold does not give the state the recording ended with".to_owned();
            self.find(Status::Nondeterministic, segment, what);
        }
    }

    fn verdict(mut self) -> Verified {
        let mut reprocessed = 0;
        if let Some(again) = self.again.take() {
            let result = again.finish();
            reprocessed = result.inputs - result.different;
            for difference in result.differences.iter().take(20) {
                let what = format!(
                    "the detectors derive something else now from event #{}",
                    difference.order
                );
                let segment = &self.recording.segments[self.segment];
                self.find(Status::Nondeterministic, segment, what);
            }
        }
        let worst = self.findings.iter().map(|finding| finding.status).max();
        Verified {
            status: worst.unwrap_or(Status::Intact),
            hash: self.world.graph().hash(),
            chain: self.chain.link(),
            events: self.events,
            checkpoints: self.checkpoints,
            reprocessed,
            findings: self.findings,
            gaps: self.gaps,
        }
    }
}
