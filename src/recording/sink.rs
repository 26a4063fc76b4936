//! [`Sink`]: events into one MCAP file, with the chain, checkpoints and acknowledgement.
//!
//! Knows nothing of detectors: it is given events in their order and, for a checkpoint, the
//! state after them.

use std::collections::{BTreeMap, VecDeque};
use std::fs::{File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

use super::chain::Chain;
use super::checkpoint::Checkpoint;
use super::meta::{Ending, Meta, Seal};
use super::recorder::{RecordError, RecorderOptions, SyncPolicy};
use crate::container::{ChannelHandle, ChannelSpec, ChunkClass, LogOptions, LogWriter, SchemaSpec};
use crate::event::{Event, Logged, SensorMessage, Topic};
use crate::graph::StateHash;
use crate::wire;

/// Key of the channel metadata that says which chunks hold it.
pub(super) const CLASS_KEY: &str = "scenefold.class";

/// One segment being written.
pub(super) struct Sink {
    path: PathBuf,
    writer: LogWriter<File>,
    sync: SyncPolicy,
    channels: BTreeMap<Topic, ChannelHandle>,
    sensors: BTreeMap<SensorChannel, (ChannelHandle, ChunkClass)>,
    chain: Chain,
    meta: Meta,
    payload: Vec<u8>,
    /// Messages accepted by the writer up to which which event is complete.
    pending: VecDeque<(u64, u64)>,
    /// Event bytes in the open chunk.
    open_bytes: u64,
    primitives: u64,
    written: u64,
    acknowledged: u64,
    synced_at: Instant,
}

/// Event chunks are closed at this size before compression: a window of 100 messages then reads
/// in well under a millisecond, at 1 % more size than with larger chunks.
const EVENT_CHUNK_BYTES: u64 = 256 << 10;

type SensorChannel = (String, String, String, Vec<u8>);

impl Sink {
    /// Creates the file, which must not exist, and writes what it says of itself.
    pub fn create(
        path: &Path,
        meta: &Meta,
        options: &RecorderOptions,
    ) -> Result<Self, RecordError> {
        let failed = |error: io::Error| RecordError::io(path, error);
        let file = OpenOptions::new().write(true).create_new(true).open(path).map_err(failed)?;
        // Tells other recorders that this segment is being written; see `Recorder::append`.
        let _ = file.try_lock();
        if options.sync != SyncPolicy::Never {
            sync_folder(path).map_err(failed)?;
        }
        // Chunks are closed here, between updates, so that a torn file never shows half of one.
        let event_chunk_bytes = usize::MAX;
        let zstd_level = options.zstd_level;
        let log_options = LogOptions { event_chunk_bytes, zstd_level, ..LogOptions::default() };
        let mut writer = LogWriter::new(file, log_options)?;
        let (name, map) = meta.record();
        writer.write_metadata(name, map)?;
        Ok(Self {
            path: path.to_owned(),
            writer,
            sync: options.sync,
            channels: BTreeMap::new(),
            sensors: BTreeMap::new(),
            chain: Chain::after(meta.first_link()),
            meta: meta.clone(),
            payload: Vec::new(),
            pending: VecDeque::new(),
            open_bytes: 0,
            primitives: 0,
            written: meta.first_order.saturating_sub(1),
            acknowledged: meta.first_order.saturating_sub(1),
            synced_at: Instant::now(),
        })
    }

    /// Appends the events of one update.
    pub fn append(&mut self, events: &[Logged]) -> Result<(), RecordError> {
        let (mut bytes, position) = (0, self.writer.position());
        for logged in events {
            bytes += self.append_one(logged)?;
        }
        if let Some(last) = events.last() {
            self.pending.push_back((self.writer.progress().accepted, last.order));
        }
        self.open_bytes += bytes;
        // A sensor chunk that left takes the events before it along, so that a crash finds as
        // few pictures as can be without them.
        let left = self.writer.position() != position;
        if self.open_bytes >= EVENT_CHUNK_BYTES || (left && self.open_bytes > 0) {
            self.close_chunks()?;
        }
        self.settle()
    }

    /// Bytes that events take in the file by now, those in the open chunk left out.
    pub fn event_bytes(&self) -> u64 {
        self.writer.stored(ChunkClass::Event)
    }

    fn append_one(&mut self, logged: &Logged) -> Result<u64, RecordError> {
        if let Event::Sensor(message) = &logged.event {
            let channel = self.sensor_channel(message)?;
            return self.write(channel, logged, &message.data);
        }
        if let Event::Transaction(transaction) = &logged.event {
            self.primitives += transaction.steps.len() as u64;
        }
        let mut payload = std::mem::take(&mut self.payload);
        payload.clear();
        wire::encode_into(&logged.event, &mut payload);
        let channel = self.own_channel(&logged.event.topic())?;
        let bytes = self.write(channel, logged, &payload)?;
        self.payload = payload;
        Ok(bytes)
    }

    fn write(
        &mut self,
        (handle, class): (ChannelHandle, ChunkClass),
        logged: &Logged,
        data: &[u8],
    ) -> Result<u64, RecordError> {
        let order = logged.order;
        let sequence = u32::try_from(order).map_err(|_| RecordError::Full { order })?;
        let (at, published) = (logged.at.nanos(), logged.published.nanos());
        self.writer.write(handle, sequence, at, published, data)?;
        self.chain.add(&logged.event.topic().name(), order, at, published, data);
        Ok(if class == ChunkClass::Event { data.len() as u64 + 31 } else { 0 })
    }

    /// Writes a checkpoint of the state after the last event, and closes the link of the chain.
    /// `packed` is its packed state.
    pub fn checkpoint(
        &mut self,
        mut checkpoint: Checkpoint,
        packed: Vec<u8>,
    ) -> Result<(), RecordError> {
        self.flush()?;
        checkpoint.chain = self.chain.close();
        let payload = checkpoint.encode(packed);
        let handle = self.own_channel(&Topic::Checkpoint)?.0;
        let at = checkpoint.at.nanos();
        let sequence = u32::try_from(checkpoint.order).unwrap_or(u32::MAX);
        self.writer.write(handle, sequence, at, at, &payload)?;
        Ok(())
    }

    /// Number of the last event that is as safe as the policy asks for.
    pub fn acknowledged(&self) -> u64 {
        self.acknowledged
    }

    /// Hands all events to the operating system and, unless the policy is
    /// [`SyncPolicy::Never`], to the disk.
    pub fn flush(&mut self) -> Result<(), RecordError> {
        self.close_chunks()?;
        self.note_written();
        if self.sync != SyncPolicy::Never {
            self.sync_file()?;
        }
        self.acknowledged = self.written;
        Ok(())
    }

    /// Ends the segment.
    pub fn finish(
        mut self,
        events: u64,
        changes: u64,
        state_hash: StateHash,
    ) -> Result<Seal, RecordError> {
        self.flush()?;
        let (link, primitives, meta) = (self.chain.link(), self.primitives, &self.meta);
        let seal = Ending { events, changes, primitives, link, state_hash, meta }.seal();
        let (name, map) = seal.record();
        self.writer.write_metadata(name, map)?;
        let file = self.writer.finish()?;
        // A child process that is just being started may hold the file open a moment longer.
        let _ = file.unlock();
        if self.sync != SyncPolicy::Never {
            let path = self.path;
            file.sync_all().map_err(|error| RecordError::Io { path, error })?;
        }
        Ok(seal)
    }

    fn close_chunks(&mut self) -> Result<(), RecordError> {
        self.writer.flush()?;
        self.open_bytes = 0;
        Ok(())
    }

    fn settle(&mut self) -> Result<(), RecordError> {
        self.note_written();
        match self.sync {
            SyncPolicy::Every => self.flush(),
            SyncPolicy::Interval(interval) if self.synced_at.elapsed() >= interval => self.flush(),
            SyncPolicy::Interval(_) => Ok(()),
            SyncPolicy::Never => {
                self.acknowledged = self.written;
                Ok(())
            }
        }
    }

    fn note_written(&mut self) {
        let through = self.writer.progress().written_through;
        while let Some((_, order)) = self.pending.pop_front_if(|(accepted, _)| *accepted <= through)
        {
            self.written = order;
        }
    }

    fn sync_file(&mut self) -> Result<(), RecordError> {
        let failed = |error| RecordError::Io { path: self.path.clone(), error };
        self.writer.get_ref().sync_data().map_err(failed)?;
        self.synced_at = Instant::now();
        Ok(())
    }

    fn own_channel(&mut self, topic: &Topic) -> Result<(ChannelHandle, ChunkClass), RecordError> {
        let class = match topic {
            Topic::Checkpoint => ChunkClass::Checkpoint,
            _ => ChunkClass::Event,
        };
        if let Some(handle) = self.channels.get(topic) {
            return Ok((*handle, class));
        }
        let schema = wire::schema_of(topic).ok_or(RecordError::NoSchema)?;
        let spec = ChannelSpec {
            topic: topic.name().into_owned(),
            message_encoding: schema.message_encoding.to_owned(),
            metadata: class_metadata(class),
            schema: Some(SchemaSpec {
                name: schema.name.to_owned(),
                encoding: schema.encoding.to_owned(),
                data: schema.data.to_vec(),
            }),
            class,
        };
        let handle = self.writer.register(spec)?;
        self.channels.insert(topic.clone(), handle);
        Ok((handle, class))
    }

    fn sensor_channel(
        &mut self,
        message: &SensorMessage,
    ) -> Result<(ChannelHandle, ChunkClass), RecordError> {
        let key: SensorChannel = (
            message.topic.to_string(),
            message.message_encoding.to_string(),
            message.schema_name.to_string(),
            message.schema.to_vec(),
        );
        if let Some(known) = self.sensors.get(&key) {
            return Ok(*known);
        }
        let class = class_of(&message.schema_name, message.data.len());
        let schema = (!message.schema_name.is_empty()).then(|| SchemaSpec {
            name: message.schema_name.to_string(),
            encoding: message.schema_encoding.to_string(),
            data: message.schema.to_vec(),
        });
        let spec = ChannelSpec {
            topic: message.topic.to_string(),
            message_encoding: message.message_encoding.to_string(),
            metadata: class_metadata(class),
            schema,
            class,
        };
        let handle = self.writer.register(spec)?;
        self.sensors.insert(key, (handle, class));
        Ok((handle, class))
    }
}

fn class_metadata(class: ChunkClass) -> BTreeMap<String, String> {
    let name = match class {
        ChunkClass::Event => "event",
        ChunkClass::Sensor | ChunkClass::PackedSensor => "sensor",
        ChunkClass::Checkpoint => "checkpoint",
    };
    BTreeMap::from([(CLASS_KEY.to_owned(), name.to_owned())])
}

/// Images and clouds are sensor data, by the name of their schema or their sheer size;
/// everything else is an event.
pub(super) fn class_of(schema_name: &str, bytes: usize) -> ChunkClass {
    const LARGE: usize = 64 << 10;
    let kind = schema_name.rsplit(['/', '.']).next().unwrap_or(schema_name);
    if kind.starts_with("Compressed") && (kind.contains("Image") || kind.contains("Video")) {
        ChunkClass::PackedSensor
    } else if kind.ends_with("Image") || kind.starts_with("PointCloud") || bytes > LARGE {
        ChunkClass::Sensor
    } else {
        ChunkClass::Event
    }
}

/// A new file is only safe once its folder is.
fn sync_folder(path: &Path) -> io::Result<()> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    File::open(folder.unwrap_or(Path::new(".")))?.sync_all()
}
