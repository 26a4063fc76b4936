//! Writing a log as MCAP. Knows nothing of what messages mean.
//!
//! Each [`ChunkClass`] fills a chunk of its own. A finished chunk, with its message indexes, is
//! handed over in one write, so a crash leaves at most a torn tail. Since chunks close at
//! different moments, two messages with equal log time could end up in the file the other way
//! round than they arrived; [`LogWriter`] closes chunks early where that would happen, so that
//! (log time, file position) is always the order of arrival.

use std::collections::BTreeMap;
use std::io::Write;

use mcap::records::{ChunkHeader, Header, MessageHeader, Metadata, op};

use super::open_chunk::{ChunkClass, OpenChunk, put_chunk};
use super::options::{
    ChannelSpec, LogOptions, MESSAGE_MAX, WriteError, check_definition, check_length,
    text_map_bytes,
};
use super::wire;
use super::writer_summary::Summary;

/// A class repeats its schemas and channels every so many chunks, so that damage to the first
/// chunk of an unfinished file does not take the meaning of all later ones with it.
const DEFINITIONS_EVERY: u64 = 64;

/// A channel registered with one [`LogWriter`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ChannelHandle(u16);

/// How far a log has got.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Progress {
    /// Messages accepted so far.
    pub accepted: u64,
    /// All of the first so many messages are handed to the inner writer.
    pub written_through: u64,
}

struct Registered {
    spec: ChannelSpec,
    /// Number given at first use; zero before.
    id: u16,
    schema_id: u16,
    /// Whether the current run of chunks of its class holds the definition.
    defined: bool,
}

/// Writes one log. Dropping it without [`LogWriter::finish`] leaves an unfinished, readable file
/// without the messages of the open chunks.
pub struct LogWriter<W: Write> {
    inner: W,
    options: LogOptions,
    compressor: zstd::bulk::Compressor<'static>,
    compressed: Vec<u8>,
    out: Vec<u8>,
    channels: Vec<Registered>,
    next_channel_id: u16,
    chunks: [OpenChunk; 4],
    chunks_closed: [u64; 4],
    /// Bytes of the closed chunks of each class in the file, message indexes included.
    stored: [u64; 4],
    schemas_defined: [Vec<bool>; 4],
    /// `follows[a][b]`: open chunk `a` must come after open chunk `b`.
    follows: [[bool; 4]; 4],
    last_time: u64,
    summary: Summary,
    crc: crc32fast::Hasher,
    position: u64,
    poisoned: bool,
}

impl<W: Write> LogWriter<W> {
    /// Starts a log: writes the magic bytes and the header.
    ///
    /// # Errors
    /// If `inner` refuses them or the compressor cannot be made.
    pub fn new(inner: W, options: LogOptions) -> Result<Self, WriteError> {
        let header = Header { profile: options.profile.clone(), library: options.library.clone() };
        let mut writer = Self {
            inner,
            compressor: zstd::bulk::Compressor::new(options.zstd_level)?,
            options,
            compressed: Vec::new(),
            out: mcap::MAGIC.to_vec(),
            channels: Vec::new(),
            next_channel_id: 1,
            chunks: Default::default(),
            chunks_closed: [0; 4],
            stored: [0; 4],
            schemas_defined: Default::default(),
            follows: Default::default(),
            last_time: 0,
            summary: Summary::default(),
            crc: crc32fast::Hasher::new(),
            position: 0,
            poisoned: false,
        };
        wire::put(&mut writer.out, op::HEADER, &header);
        writer.hand_over()?;
        Ok(writer)
    }

    /// Registers a channel; the same one twice gives the same handle. It enters the file with
    /// its first message.
    ///
    /// # Errors
    /// [`WriteError::TooManyChannels`] or [`WriteError::DefinitionTooLong`]; nothing changed.
    pub fn register(&mut self, spec: ChannelSpec) -> Result<ChannelHandle, WriteError> {
        if let Some(known) = self.channels.iter().position(|channel| channel.spec == spec) {
            return Ok(ChannelHandle(known as u16));
        }
        check_definition(&spec)?;
        // Ids start at one, so one less than all numbers can be given out.
        if self.channels.len() >= usize::from(u16::MAX) {
            return Err(WriteError::TooManyChannels);
        }
        self.channels.push(Registered { spec, id: 0, schema_id: 0, defined: false });
        Ok(ChannelHandle((self.channels.len() - 1) as u16))
    }

    /// Appends a message. It may stay in an open chunk: see [`Progress::written_through`].
    ///
    /// # Errors
    /// A refused message changes nothing; after an IO error the writer is unusable.
    pub fn write(
        &mut self,
        channel: ChannelHandle,
        sequence: u32,
        log_time: u64,
        publish_time: u64,
        data: &[u8],
    ) -> Result<Progress, WriteError> {
        self.check_message(channel, log_time, data)?;
        let class = self.channels[usize::from(channel.0)].spec.class;
        self.make_room(class, data.len())?;
        self.keep_order(class, log_time)?;
        let channel_id = self.define(channel, class);
        let number = self.summary.accept(channel_id, log_time);
        self.last_time = log_time;
        let header = MessageHeader { channel_id, sequence, log_time, publish_time };
        let chunk = &mut self.chunks[class as usize];
        chunk.push(header, data, number);
        if chunk.body.len() >= self.chunk_limit(class) {
            self.close(class)?;
        }
        Ok(self.progress())
    }

    /// Closes every open chunk and flushes the inner writer (which may not be a sync).
    ///
    /// # Errors
    /// If the inner writer fails; the writer is unusable then.
    pub fn flush(&mut self) -> Result<Progress, WriteError> {
        self.check_usable()?;
        self.close(ChunkClass::Event)?;
        if let Err(error) = self.inner.flush() {
            self.poisoned = true;
            return Err(error.into());
        }
        Ok(self.progress())
    }

    /// Writes a metadata record at once, ahead of messages in open chunks.
    ///
    /// # Errors
    /// [`WriteError::DefinitionTooLong`], or if the inner writer fails.
    pub fn write_metadata(
        &mut self,
        name: &str,
        map: BTreeMap<String, String>,
    ) -> Result<(), WriteError> {
        self.check_usable()?;
        let bytes = name.len() + text_map_bytes(&map);
        check_length(name, bytes)?;
        let record = Metadata { name: name.to_owned(), metadata: map };
        wire::put(&mut self.out, op::METADATA, &record);
        self.summary.add_metadata(name, self.position, self.out.len() as u64);
        self.hand_over()
    }

    /// Closes the log with its summary and returns the inner writer.
    ///
    /// # Errors
    /// If the inner writer fails; the file is then unfinished but readable.
    pub fn finish(mut self) -> Result<W, WriteError> {
        self.flush()?;
        let end = mcap::records::DataEnd { data_section_crc: self.crc.clone().finalize() };
        wire::put(&mut self.out, op::DATA_END, &end);
        self.hand_over()?;
        self.out = self.summary.encode(self.position);
        self.out.extend_from_slice(mcap::MAGIC);
        self.hand_over()?;
        self.inner.flush()?;
        Ok(self.inner)
    }

    /// Returns how many messages were accepted and how many surely left for the inner writer.
    pub fn progress(&self) -> Progress {
        let accepted = self.summary.messages();
        let held = self.chunks.iter().filter_map(|chunk| chunk.held);
        let written_through = held.map(|held| held.first_message).min().unwrap_or(accepted);
        Progress { accepted, written_through }
    }

    /// Returns the number of bytes handed to the inner writer.
    pub fn position(&self) -> u64 {
        self.position
    }

    /// Returns the bytes that closed chunks of `class` take in the file.
    pub fn stored(&self, class: ChunkClass) -> u64 {
        self.stored[class as usize]
    }

    /// Returns the inner writer, for example to sync a file.
    pub fn get_ref(&self) -> &W {
        &self.inner
    }

    fn check_usable(&self) -> Result<(), WriteError> {
        if self.poisoned { Err(WriteError::Poisoned) } else { Ok(()) }
    }

    fn check_message(
        &self,
        channel: ChannelHandle,
        log_time: u64,
        data: &[u8],
    ) -> Result<(), WriteError> {
        self.check_usable()?;
        let known = self.channels.get(usize::from(channel.0));
        let topic = &known.ok_or(WriteError::UnknownChannel(channel.0))?.spec.topic;
        if data.len() > MESSAGE_MAX {
            let (bytes, limit) = (data.len(), MESSAGE_MAX);
            return Err(WriteError::MessageTooLong { topic: topic.clone(), bytes, limit });
        }
        if log_time < self.last_time {
            let previous = self.last_time;
            return Err(WriteError::TimeWentBack { topic: topic.clone(), log_time, previous });
        }
        Ok(())
    }

    fn chunk_limit(&self, class: ChunkClass) -> usize {
        match class {
            ChunkClass::Event => self.options.event_chunk_bytes,
            ChunkClass::Sensor | ChunkClass::PackedSensor => self.options.sensor_chunk_bytes,
            ChunkClass::Checkpoint => 0,
        }
    }

    /// Closes the chunk of `class` if the message would take it far over its limit.
    fn make_room(&mut self, class: ChunkClass, bytes: usize) -> Result<(), WriteError> {
        let held = self.chunks[class as usize].body.len();
        if held > 0 && held + bytes > self.chunk_limit(class).saturating_mul(2) {
            self.close(class)?;
        }
        Ok(())
    }

    /// Makes sure that every message held with the same time comes before one in `class`.
    fn keep_order(&mut self, class: ChunkClass, log_time: u64) -> Result<(), WriteError> {
        for other in ChunkClass::ALL {
            if other != class && self.holds(other, log_time) && self.must_follow(other, class) {
                self.close(other)?;
            }
        }
        for other in ChunkClass::ALL {
            if other != class && self.holds(other, log_time) {
                self.follows[class as usize][other as usize] = true;
            }
        }
        Ok(())
    }

    fn holds(&self, class: ChunkClass, log_time: u64) -> bool {
        self.chunks[class as usize].held.is_some_and(|held| held.end_time == log_time)
    }

    /// Whether the open chunk of `later` will be written after that of `earlier`: events always
    /// after sensors, a checkpoint (written at once) before all that is open, and the two
    /// kinds of sensor chunks as their messages require.
    fn must_follow(&self, later: ChunkClass, earlier: ChunkClass) -> bool {
        later == ChunkClass::Event
            || earlier == ChunkClass::Checkpoint
            || self.follows[later as usize][earlier as usize]
    }

    /// Writes the open chunk of `class`, after those that must precede it.
    fn close(&mut self, class: ChunkClass) -> Result<(), WriteError> {
        for other in [ChunkClass::Sensor, ChunkClass::PackedSensor] {
            if other != class && self.must_follow(class, other) {
                // Removed before the descent, so that it ends whatever the relation.
                self.follows[class as usize][other as usize] = false;
                self.close(other)?;
            }
        }
        self.emit(class)?;
        for row in &mut self.follows {
            row[class as usize] = false;
        }
        self.follows[class as usize] = [false; 4];
        Ok(())
    }

    /// Writes schema and channel into the open chunk unless its class has them already.
    fn define(&mut self, handle: ChannelHandle, class: ChunkClass) -> u16 {
        let channel = &mut self.channels[usize::from(handle.0)];
        if channel.defined {
            return channel.id;
        }
        channel.defined = true;
        if channel.id == 0 {
            channel.id = self.next_channel_id;
            self.next_channel_id = self.next_channel_id.wrapping_add(1);
            channel.schema_id = self.summary.add_channel(&channel.spec, channel.id);
        }
        let (id, schema_id) = (channel.id, usize::from(channel.schema_id));
        let body = &mut self.chunks[class as usize].body;
        let defined = &mut self.schemas_defined[class as usize];
        defined.resize(defined.len().max(schema_id + 1), false);
        if schema_id != 0 && !std::mem::replace(&mut defined[schema_id], true) {
            wire::put_schema(body, self.summary.schema(schema_id));
        }
        wire::put(body, op::CHANNEL, self.summary.channel(id));
        id
    }

    /// Writes chunk and message indexes in one go.
    fn emit(&mut self, class: ChunkClass) -> Result<(), WriteError> {
        let Some(held) = self.chunks[class as usize].held else { return Ok(()) };
        let body = &self.chunks[class as usize].body;
        let data = if class.is_compressed() {
            self.compressed.clear();
            self.compressed.reserve(zstd::zstd_safe::compress_bound(body.len()));
            self.compressor.compress_to_buffer(body, &mut self.compressed)?;
            &self.compressed
        } else {
            body
        };
        let header = ChunkHeader {
            message_start_time: held.start_time,
            message_end_time: held.end_time,
            uncompressed_size: body.len() as u64,
            uncompressed_crc: crc32fast::hash(body),
            compression: if class.is_compressed() { "zstd".to_owned() } else { String::new() },
            compressed_size: data.len() as u64,
        };
        let index =
            put_chunk(&mut self.out, header, data, &self.chunks[class as usize], self.position);
        self.summary.add_chunk(index);
        self.chunks[class as usize].clear();
        self.chunks_closed[class as usize] += 1;
        self.stored[class as usize] += self.out.len() as u64;
        if self.chunks_closed[class as usize].is_multiple_of(DEFINITIONS_EVERY) {
            self.repeat_definitions(class);
        }
        self.hand_over()
    }

    fn repeat_definitions(&mut self, class: ChunkClass) {
        self.schemas_defined[class as usize].clear();
        for channel in self.channels.iter_mut().filter(|channel| channel.spec.class == class) {
            channel.defined = false;
        }
    }

    /// Hands `out` to the inner writer in one call and empties it.
    fn hand_over(&mut self) -> Result<(), WriteError> {
        if let Err(error) = self.inner.write_all(&self.out) {
            self.poisoned = true;
            return Err(error.into());
        }
        self.crc.update(&self.out);
        self.position += self.out.len() as u64;
        self.out.clear();
        Ok(())
    }
}
