//! [`Recording`]: one opened for reading, whole or damaged.

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, OnceLock};

use super::batch::Kind;
use super::chain::{GENESIS, Link};
use super::meta::{Meta, MetaError, Seal};
use super::segment::segment_files;
use super::sink::CLASS_KEY;
use crate::container::{ChunkEntry, Damage, FileSource, Limits, LogError, LogFile, Source};
use crate::event::{Role, Topic};
use crate::time::Stamp;

/// A recording opened for reading. Can be shared between threads.
///
/// Damage is no error: everything intact is read, and what is not is told by
/// [`Recording::trouble`].
pub struct Recording {
    pub(super) path: PathBuf,
    pub(super) segments: Vec<Segment>,
    trouble: Mutex<BTreeSet<String>>,
    span: OnceLock<Option<(Stamp, Stamp)>>,
}

/// One file of a recording.
pub(super) struct Segment {
    pub path: PathBuf,
    pub log: LogFile,
    pub meta: Option<Meta>,
    pub seal: Option<Seal>,
    pub topics: BTreeMap<u16, Topic>,
    /// Channels of events: not sensor data, not checkpoints, not projections.
    pub events: BTreeSet<u16>,
    /// Channels of sensor data.
    pub sensors: BTreeSet<u16>,
    pub checkpoints: OnceLock<Vec<super::state::CheckpointRef>>,
    /// What the fold makes of each channel, by its number.
    kinds: Vec<Kind>,
    /// Places of the chunks that may hold events, in the order of the log.
    event_chunks: OnceLock<Vec<u32>>,
    /// Number of the last event that is no picture; see [`super::orphans`].
    pub last_event: OnceLock<u64>,
}

/// Why a recording cannot be opened.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// The file system refused.
    #[error("{error}\n  {}", .path.display())]
    Io {
        /// Which file.
        path: PathBuf,
        /// What it said.
        error: io::Error,
    },
    /// No MCAP file, or one that cannot be read at all.
    #[error("{error}\n  {}", .path.display())]
    Log {
        /// Which file.
        path: PathBuf,
        /// Why.
        error: LogError,
    },
    /// Its metadata is not understood.
    #[error("{error}\n  {}", .path.display())]
    Meta {
        /// Which file.
        path: PathBuf,
        /// Why.
        error: MetaError,
    },
    /// A folder without segments.
    #[error("the folder holds no .mcap file\n  {}", .path.display())]
    NoSegments {
        /// Which folder.
        path: PathBuf,
    },
}

impl Recording {
    /// Opens a file, or a folder of segments.
    pub fn open(path: &Path) -> Result<Self, OpenError> {
        Self::open_with(path, LogFile::open)
    }

    /// Opens it without trusting any index: every record header is walked over.
    pub fn scan(path: &Path) -> Result<Self, OpenError> {
        Self::open_with(path, LogFile::scan)
    }

    /// Opens a recording in memory.
    pub fn from_bytes(name: &str, bytes: Vec<u8>) -> Result<Self, OpenError> {
        let path = PathBuf::from(name);
        let segment = Segment::open(&path, Arc::new(bytes), LogFile::open)?;
        Ok(Self::over(path, vec![segment]))
    }

    /// As [`Recording::scan`], of a recording in memory.
    pub fn scan_bytes(name: &str, bytes: Vec<u8>) -> Result<Self, OpenError> {
        let path = PathBuf::from(name);
        let segment = Segment::open(&path, Arc::new(bytes), LogFile::scan)?;
        Ok(Self::over(path, vec![segment]))
    }

    fn open_with(path: &Path, open: OpenLog) -> Result<Self, OpenError> {
        let failed = |error| OpenError::Io { path: path.to_owned(), error };
        let files = match path.is_dir() {
            true => segment_files(path).map_err(failed)?,
            false => vec![path.to_owned()],
        };
        if files.is_empty() {
            return Err(OpenError::NoSegments { path: path.to_owned() });
        }
        let mut segments = Vec::with_capacity(files.len());
        for file in &files {
            let source = FileSource::open(file)
                .map_err(|error| OpenError::Io { path: file.clone(), error })?;
            let segment = Segment::open(file, Arc::new(source), open)?;
            // One whose writer was killed before it said anything is as good as not there.
            if files.len() == 1 || !segment.says_nothing() {
                segments.push(segment);
            }
        }
        if segments.is_empty() {
            return Err(OpenError::NoSegments { path: path.to_owned() });
        }
        Ok(Self::over(path.to_owned(), segments))
    }

    fn over(path: PathBuf, segments: Vec<Segment>) -> Self {
        let recording = Self { path, segments, trouble: Mutex::default(), span: OnceLock::new() };
        for segment in &recording.segments {
            for damage in segment.log.damage().items() {
                recording.report(segment, damage);
            }
        }
        recording
    }

    /// The path it was opened at.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What is known to be wrong with it so far, a line each. Damage inside chunks is met only
    /// when they are read; [`super::verify()`] reads them all.
    pub fn trouble(&self) -> Vec<String> {
        self.lock().iter().cloned().collect()
    }

    /// What the recording says of itself, if it is one of ours.
    pub fn meta(&self) -> Option<&Meta> {
        self.segments.iter().find_map(|segment| segment.meta.as_ref())
    }

    /// Whether there is anything to make a graph of.
    pub fn has_graph(&self) -> bool {
        let topics = || self.segments.iter().flat_map(|segment| segment.topics.values());
        topics().any(|topic| matches!(topic, Topic::InitialGraph | Topic::Primitive))
    }

    /// Whether no message at all was ever written.
    pub fn is_empty(&self) -> bool {
        self.segments.iter().all(|segment| segment.log.chunks().is_empty())
    }

    /// What the last segment says of its end, if it was ended.
    pub fn seal(&self) -> Option<&Seal> {
        self.segments.last()?.seal.as_ref()
    }

    /// Log time of the first event; `None` if there is none.
    pub fn start(&self) -> Option<Stamp> {
        self.span().map(|(start, _)| start)
    }

    /// Log time of the last event; `None` if there is none.
    pub fn end(&self) -> Option<Stamp> {
        self.span().map(|(_, end)| end)
    }

    /// Whether the files number their events themselves, as ours do; in others an event's
    /// number is its place in the order of the log.
    pub(super) fn is_numbered(&self) -> bool {
        self.segments.iter().all(Segment::is_numbered)
    }

    pub(super) fn report(&self, segment: &Segment, what: impl std::fmt::Display) {
        let file = segment.path.file_name().unwrap_or_default().to_string_lossy();
        // A hostile file can be wrong in any number of ways; the first ones are enough.
        let mut trouble = self.lock();
        if trouble.len() < 1000 {
            trouble.insert(format!("{file}: {what}"));
        }
    }

    pub(super) fn report_damage(&self, segment: &Segment, damage: &Damage) {
        self.report(segment, damage);
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, BTreeSet<String>> {
        self.trouble.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }

    fn span(&self) -> Option<(Stamp, Stamp)> {
        let chunks = || self.segments.iter().flat_map(Segment::chunks_with_messages);
        *self.span.get_or_init(|| {
            let start = chunks().map(|entry| entry.start_time).min()?;
            let end = chunks().map(|entry| entry.end_time).max()?;
            Some((Stamp::from_nanos(start), Stamp::from_nanos(end)))
        })
    }
}

type OpenLog = fn(Arc<dyn Source>, Limits) -> Result<LogFile, LogError>;

impl Segment {
    fn open(path: &Path, source: Arc<dyn Source>, open: OpenLog) -> Result<Self, OpenError> {
        let failed = |error| OpenError::Log { path: path.to_owned(), error };
        let log = open(source, Limits::default()).map_err(failed)?;
        let meta_error = |error| OpenError::Meta { path: path.to_owned(), error };
        let meta = Meta::find(log.metadata()).map_err(meta_error)?;
        let seal = Seal::find(log.metadata()).map_err(meta_error)?;
        let mut segment = Self {
            path: path.to_owned(),
            log,
            meta,
            seal,
            topics: BTreeMap::new(),
            events: BTreeSet::new(),
            sensors: BTreeSet::new(),
            checkpoints: OnceLock::new(),
            kinds: Vec::new(),
            event_chunks: OnceLock::new(),
            last_event: OnceLock::new(),
        };
        segment.sort_channels();
        Ok(segment)
    }

    fn says_nothing(&self) -> bool {
        self.meta.is_none() && self.log.chunks().is_empty() && !self.log.is_finished()
    }

    /// The link of the chain before the first event.
    pub fn first_link(&self) -> Link {
        self.meta.as_ref().map_or(GENESIS, Meta::first_link)
    }

    /// Whether the events are numbered by the file, as ours are even if its metadata are lost.
    pub fn is_numbered(&self) -> bool {
        let ours = |channel: &crate::container::Channel| channel.metadata.contains_key(CLASS_KEY);
        self.meta.is_some() || self.log.channels().values().any(ours)
    }

    fn sort_channels(&mut self) {
        for (id, channel) in self.log.channels() {
            let topic = Topic::named(&channel.topic);
            let sensor = channel.metadata.get(CLASS_KEY).is_some_and(|class| class == "sensor");
            match topic.role() {
                Role::Cache | Role::Projection => {}
                _ if sensor => {
                    self.sensors.insert(*id);
                }
                _ => {
                    self.events.insert(*id);
                    let place = usize::from(*id);
                    self.kinds.resize(self.kinds.len().max(place + 1), Kind::Ignored);
                    self.kinds[place] = Kind::of(&topic);
                }
            }
            self.topics.insert(*id, topic);
        }
    }

    /// The chunks that may hold events or sensor data.
    fn chunks_with_messages(&self) -> impl Iterator<Item = &ChunkEntry> {
        self.log
            .chunks()
            .iter()
            .filter(|entry| self.events.iter().chain(&self.sensors).any(|id| entry.may_hold(*id)))
    }

    /// What the fold makes of a message on `channel`.
    pub fn kind(&self, channel: u16) -> Kind {
        self.kinds.get(usize::from(channel)).copied().unwrap_or_default()
    }

    /// The chunks that may hold events, in the order of the log.
    pub fn event_chunks(&self) -> impl Iterator<Item = &ChunkEntry> {
        let chunks = self.log.chunks();
        let places = self.event_chunks.get_or_init(|| {
            let holds = |entry: &ChunkEntry| self.events.iter().any(|id| entry.may_hold(*id));
            let mut places: Vec<u32> =
                (0..).zip(chunks).filter(|(_, e)| holds(e)).map(|(n, _)| n).collect();
            places.sort_by_key(|n| (chunks[*n as usize].start_time, *n));
            places
        });
        places.iter().map(|n| &chunks[*n as usize])
    }

    /// The channels of a topic; files of other programs may have several.
    pub fn channels_of(&self, topic: &Topic) -> impl Iterator<Item = u16> {
        self.topics.iter().filter(move |(_, other)| *other == topic).map(|(id, _)| *id)
    }
}
