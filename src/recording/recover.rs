//! Saving what is intact of a damaged recording into a clean one.

use std::collections::BTreeMap;
use std::fs::{File, OpenOptions};
use std::path::Path;

use super::chain::{Chain, GENESIS};
use super::checkpoint::Checkpoint;
use super::events::{RawEvent, decode};
use super::meta::{Ending, Meta, Seal};
use super::open::{Recording, Segment};
use super::recorder::RecordError;
use super::sink::{CLASS_KEY, class_of};
use crate::change::World;
use crate::container::{
    ChannelHandle, ChannelSpec, ChunkClass, LogOptions, LogWriter, MessageFilter, RawMessage,
    SchemaSpec,
};
use crate::event::{Event, Topic};

/// A stretch of events that are not in the recording any more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LostEvents {
    /// Number of the first one.
    pub first: u64,
    /// Number of the last one; `None` if that is not known, at the end of a recording.
    pub last: Option<u64>,
}

/// What came of recovering.
#[derive(Clone, Debug, PartialEq)]
pub struct Recovered {
    /// How many messages were saved.
    pub messages: u64,
    /// Stretches of events that are missing.
    pub events: Vec<LostEvents>,
    /// Number of an event up to which the hash chain does not hold: the recording was edited.
    /// The recovered one says so too.
    pub edited: Option<u64>,
    /// What was damaged, a line each, with file and bytes.
    pub damage: Vec<String>,
}

/// Copies every intact message of a recording, best one opened with [`Recording::scan`], to a new file `out`, in order, and
/// ends it properly. Messages keep their times, numbers and bytes; checkpoints are given the
/// chain of the new file. `progress` is told the messages copied so far.
pub fn recover(
    recording: &Recording,
    out: &Path,
    progress: &mut dyn FnMut(u64),
) -> Result<Recovered, RecordError> {
    let io = |error| RecordError::io(out, error);
    let file = OpenOptions::new().write(true).create_new(true).open(out).map_err(io)?;
    let mut copy = Copy::new(recording, file)?;
    for segment in &recording.segments {
        copy.segment(segment, progress)?;
    }
    let recovered = copy.finish()?;
    File::open(out).and_then(|file| file.sync_all()).map_err(io)?;
    Ok(recovered)
}

struct Copy<'r> {
    recording: &'r Recording,
    writer: LogWriter<File>,
    meta: Option<Meta>,
    channels: BTreeMap<(String, u16), ChannelHandle>,
    chain: Chain,
    /// The chain as the original has it, as long as nothing of it is lost.
    original: Chain,
    comparable: bool,
    world: World,
    order: u64,
    changes: u64,
    primitives: u64,
    messages: u64,
    lost: Vec<LostEvents>,
    /// After which event the last checkpoint of this segment stands.
    checkpointed: Option<u64>,
}

impl<'r> Copy<'r> {
    fn new(recording: &'r Recording, file: File) -> Result<Self, RecordError> {
        let mut writer = LogWriter::new(file, LogOptions::default())?;
        let known = || recording.segments.iter().filter_map(|segment| segment.meta.as_ref());
        let meta = known().next().cloned().or_else(|| made_up(recording)).map(|first| {
            let edited = known().find_map(|meta| meta.edited);
            let gaps = known().flat_map(|meta| meta.gaps.clone()).collect();
            Meta { edited, gaps, ..first }
        });
        if let Some(meta) = &meta {
            let (name, map) = meta.record();
            writer.write_metadata(name, map)?;
        }
        let first = meta.as_ref().map_or(1, |meta| meta.first_order);
        let chain = Chain::after(meta.as_ref().map_or(GENESIS, Meta::first_link));
        Ok(Self {
            recording,
            writer,
            meta,
            channels: BTreeMap::new(),
            original: chain.clone(),
            comparable: true,
            chain,
            world: World::default(),
            order: first - 1,
            changes: 0,
            primitives: 0,
            messages: 0,
            lost: Vec::new(),
            checkpointed: None,
        })
    }

    fn segment(
        &mut self,
        segment: &Segment,
        progress: &mut dyn FnMut(u64),
    ) -> Result<(), RecordError> {
        self.checkpointed = None;
        if let Ok(Some(false)) = segment.log.check_data_section() {
            self.recording.report(segment, "the checksum of the data section does not hold");
        }
        for record in segment.log.metadata() {
            // Metadata of other programs is kept; our own is written anew.
            if !record.name.starts_with("scenefold") {
                self.writer.write_metadata(&record.name, record.metadata.clone())?;
            }
        }
        self.original = Chain::after(segment.first_link());
        self.comparable = true;
        let mut cursor = segment.log.messages(MessageFilter::default());
        loop {
            match cursor.next_message() {
                Ok(Some(message)) => self.message(segment, &message)?,
                Ok(None) => break,
                Err(error) => {
                    self.recording.report(segment, error);
                    break;
                }
            }
            if self.messages.is_multiple_of(4096) {
                progress(self.messages);
            }
        }
        for damage in cursor.damage().items() {
            self.recording.report_damage(segment, damage);
        }
        self.compare_seal(segment, cursor.damage().is_empty());
        Ok(())
    }

    fn message(&mut self, segment: &Segment, message: &RawMessage<'_>) -> Result<(), RecordError> {
        let Some(topic) = segment.topics.get(&message.channel) else { return Ok(()) };
        let numbered = self.meta.is_some();
        if *topic == Topic::Checkpoint && numbered {
            return self.checkpoint(segment, message);
        }
        let is_event =
            segment.events.contains(&message.channel) || segment.sensors.contains(&message.channel);
        if is_event && numbered && !self.event(segment, topic, message) {
            return Ok(());
        }
        let handle = self.channel(segment, message)?;
        let (sequence, at) = (message.sequence, message.log_time);
        self.writer.write(handle, sequence, at, message.publish_time, message.data)?;
        self.messages += 1;
        Ok(())
    }

    /// Follows the fold and the chain; `false` if the event is no use and is left out.
    fn event(&mut self, segment: &Segment, topic: &Topic, message: &RawMessage<'_>) -> bool {
        let order = u64::from(message.sequence);
        let logged = match decode(segment, RawEvent::of(order, topic, message)) {
            Ok(logged) if order > self.order => logged,
            Ok(_) => {
                let what = format_args!("event #{order} stands after #{}: left out", self.order);
                self.recording.report(segment, what);
                return false;
            }
            Err(error) => {
                self.recording.report(segment, format_args!("event #{order}: {error}: left out"));
                return false;
            }
        };
        if order > self.order + 1 {
            self.lose(order - 1);
        }
        self.order = order;
        let (at, published) = (message.log_time, message.publish_time);
        self.chain.add(&topic.name(), order, at, published, message.data);
        self.original.add(&topic.name(), order, at, published, message.data);
        match logged.event {
            Event::InitialGraph(graph) => self.world = World::from_graph(graph),
            Event::Change(record) => self.changes = record.seq,
            Event::Transaction(transaction) => {
                self.primitives += transaction.steps.len() as u64;
                // After a gap a transaction may not apply; the next checkpoint mends that.
                let _ = transaction.apply(&mut self.world);
            }
            _ => {}
        }
        true
    }

    fn checkpoint(
        &mut self,
        segment: &Segment,
        message: &RawMessage<'_>,
    ) -> Result<(), RecordError> {
        let usable = Checkpoint::decode(message.data).and_then(|found| Ok((found.world()?, found)));
        let (world, checkpoint) = match usable {
            Ok(usable) => usable,
            Err(why) => {
                self.recording.report(segment, format_args!("a checkpoint is left out: {why}"));
                return Ok(());
            }
        };
        let doubled = self.checkpointed == Some(checkpoint.order);
        if checkpoint.order < self.order || doubled {
            let what = format_args!(
                "a checkpoint after #{} stands after #{}: left out",
                checkpoint.order, self.order
            );
            self.recording.report(segment, what);
            return Ok(());
        }
        if checkpoint.order > self.order {
            // What led up to it is lost, but not the state it led to.
            self.lose(checkpoint.order);
            self.order = checkpoint.order;
            self.changes = checkpoint.changes;
        }
        if !self.lost.is_empty() {
            self.world = world;
        }
        self.checkpointed = Some(checkpoint.order);
        self.compare_link(&checkpoint);
        let packed = checkpoint.packed();
        let payload = Checkpoint { chain: self.chain.close(), ..checkpoint }.encode(packed);
        let handle = self.channel(segment, message)?;
        let (sequence, at) = (message.sequence, message.log_time);
        self.writer.write(handle, sequence, at, message.publish_time, &payload)?;
        self.messages += 1;
        Ok(())
    }

    fn channel(
        &mut self,
        segment: &Segment,
        message: &RawMessage<'_>,
    ) -> Result<ChannelHandle, RecordError> {
        let key = (segment.path.to_string_lossy().into_owned(), message.channel);
        if let Some(handle) = self.channels.get(&key) {
            return Ok(*handle);
        }
        let channel = segment.log.channels().get(&message.channel).ok_or(RecordError::NoSchema)?;
        let schema = segment.log.schemas().get(&channel.schema_id);
        let spec = ChannelSpec {
            topic: channel.topic.clone(),
            message_encoding: channel.message_encoding.clone(),
            metadata: channel.metadata.clone(),
            schema: schema.map(|schema| SchemaSpec {
                name: schema.name.clone(),
                encoding: schema.encoding.clone(),
                data: schema.data.to_vec(),
            }),
            class: class(segment, channel, message),
        };
        let handle = self.writer.register(spec)?;
        self.channels.insert(key, handle);
        Ok(handle)
    }

    fn finish(mut self) -> Result<Recovered, RecordError> {
        self.writer.flush()?;
        if let Some(meta) = &mut self.meta {
            let sealed = self.recording.seal().map(|seal| seal.events);
            if sealed.is_none_or(|events| events > self.order) {
                self.lost.push(LostEvents { first: self.order + 1, last: sealed });
            }
            let found = self.lost.iter().filter(|lost| lost.first <= self.order);
            meta.gaps.extend(found.map(|lost| lost.first - 1));
            meta.gaps.sort_unstable();
            meta.gaps.dedup();
            // The last one of several counts.
            let (name, map) = meta.record();
            self.writer.write_metadata(name, map)?;
            let ending = Ending {
                events: self.order,
                changes: self.changes,
                primitives: self.primitives,
                link: self.chain.link(),
                state_hash: self.world.graph().hash(),
                meta,
            };
            let seal = ending.seal();
            let (name, map) = seal.record();
            self.writer.write_metadata(name, map)?;
        }
        self.writer.finish()?;
        let damage = self.recording.trouble();
        let edited = self.meta.and_then(|meta| meta.edited);
        Ok(Recovered { messages: self.messages, events: self.lost, edited, damage })
    }

    /// The events after the last one, up to `last`, are not there.
    fn lose(&mut self, last: u64) {
        let known = self.meta.as_ref().is_some_and(|meta| meta.gaps.contains(&self.order));
        self.comparable &= known;
        self.lost.push(LostEvents { first: self.order + 1, last: Some(last) });
    }

    /// A link that does not hold though nothing is lost tells of an edit.
    fn compare_link(&mut self, checkpoint: &Checkpoint) {
        let held = self.original.close() == checkpoint.chain;
        if !held {
            self.original = Chain::after(checkpoint.chain);
        }
        // What a damaged checkpoint would have told is unknown.
        let damaged = !self.recording.trouble().is_empty();
        if !held && self.comparable && !damaged {
            self.note_edit();
        }
        self.comparable = true;
    }

    fn compare_seal(&mut self, segment: &Segment, whole: bool) {
        let (Some(seal), Some(meta)) = (&segment.seal, &segment.meta) else { return };
        let damaged = !self.recording.trouble().is_empty();
        if seal.events != self.order || !whole || !self.comparable || damaged {
            return;
        }
        let (link, primitives) = (self.original.link(), seal.primitives);
        let Seal { events, changes, state_hash, .. } = *seal;
        let ending = Ending { events, changes, primitives, link, state_hash, meta };
        if ending.seal() != *seal {
            self.note_edit();
        }
    }

    fn note_edit(&mut self) {
        let order = self.order;
        if let Some(meta) = &mut self.meta {
            meta.edited.get_or_insert(order);
        }
    }
}

/// What a recording of ours says of itself if that is lost; `None` for those of other programs.
fn made_up(recording: &Recording) -> Option<Meta> {
    let segment = recording.segments.iter().find(|segment| segment.is_numbered())?;
    let what = "its metadata are lost: the default configuration is taken for the recorded one";
    recording.report(segment, what);
    Some(Meta::default())
}

/// The class the channel was written with; for channels of other programs, the fitting one.
fn class(
    segment: &Segment,
    channel: &crate::container::Channel,
    message: &RawMessage<'_>,
) -> ChunkClass {
    let schema = segment.log.schemas().get(&channel.schema_id);
    let by_kind = class_of(schema.map_or("", |schema| &schema.name), message.data.len());
    match channel.metadata.get(CLASS_KEY).map(String::as_str) {
        Some("event") => ChunkClass::Event,
        Some("checkpoint") => ChunkClass::Checkpoint,
        Some("sensor") if by_kind == ChunkClass::Event => ChunkClass::Sensor,
        _ => by_kind,
    }
}
