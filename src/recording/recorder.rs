//! [`Recorder`]: inputs in, a recording out, each update acknowledged once it is safe.

use std::fs::{File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use super::chain::GENESIS;
use super::checkpoint::Checkpoint;
use super::meta::{Meta, Seal};
use super::open::{OpenError, Recording};
use super::resume::End;
use super::segment::{next_segment, segment_files};
use super::sink::Sink;
use crate::container::WriteError;
use crate::event::{Event, Logged};
use crate::modality::human::LanguageModel;
use crate::time::Stamp;
use crate::updater::{Config, UpdateError, Updater};

/// When an update is acknowledged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SyncPolicy {
    /// Each update is on the disk before it is acknowledged: survives loss of power.
    Every,
    /// The disk is synced at most this often; updates are acknowledged then.
    Interval(Duration),
    /// Updates are acknowledged once the operating system has them: survives the death of the
    /// process, not loss of power.
    Never,
}

/// How to record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecorderOptions {
    /// When an update is acknowledged.
    pub sync: SyncPolicy,
    /// Zstandard level of event chunks.
    pub zstd_level: i32,
    /// A checkpoint is written when the events since the last one take this many times its own
    /// bytes in the file. With 10, checkpoints stay below a tenth of the events.
    pub checkpoint_ratio: u64,
}

impl Default for RecorderOptions {
    fn default() -> Self {
        Self { sync: SyncPolicy::Never, zstd_level: 3, checkpoint_ratio: 10 }
    }
}

/// Why recording failed.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// The file system refused.
    #[error("{error}\n  {}", .path.display())]
    Io {
        /// Which file.
        path: PathBuf,
        /// What it said.
        error: io::Error,
    },
    /// Two recorders would give the same numbers to different events.
    #[error("another recorder is writing to this recording; wait until it has ended\n  {}", .path.display())]
    InUse {
        /// Which segment it writes.
        path: PathBuf,
    },
    /// Recordings are never overwritten.
    #[error("there is something already; choose another name, or remove it first\n  {}", .path.display())]
    Exists {
        /// Where.
        path: PathBuf,
    },
    /// The container refused.
    #[error(transparent)]
    Write(#[from] WriteError),
    /// The input is none.
    #[error(transparent)]
    Update(#[from] UpdateError),
    /// The recording to go on with cannot be read.
    #[error(transparent)]
    Open(#[from] OpenError),
    /// The recording to go on with is damaged.
    #[error("{what}; save what is intact with `scenefold recover` and go on with that\n  {}", .path.display())]
    Damaged {
        /// Which recording.
        path: PathBuf,
        /// How.
        what: String,
    },
    /// Only folders take another segment.
    #[error("a single file cannot be gone on with: record into a folder\n  {}", .path.display())]
    NotAFolder {
        /// Which path.
        path: PathBuf,
    },
    /// Event numbers are 32 bits in the file.
    #[error("event number {order} does not fit into a recording: start a new one")]
    Full {
        /// The number.
        order: u64,
    },
    /// A topic of our own without a schema; a bug.
    #[error("a topic has no schema")]
    NoSchema,
}

impl RecordError {
    /// What the file system said of `path`, and how to mend it.
    pub fn io(path: &Path, error: io::Error) -> Self {
        let path = path.to_owned();
        match error.kind() {
            io::ErrorKind::AlreadyExists => Self::Exists { path },
            _ => Self::Io { path, error },
        }
    }
}

/// What one update came to.
#[derive(Clone, Debug, PartialEq)]
pub struct Recorded {
    /// The input and what was derived from it, as written.
    pub events: Vec<Logged>,
    /// Number of the last event that is safe, by the policy.
    pub acknowledged: u64,
}

/// Writes a recording as it happens.
///
/// Dropped without [`Recorder::finish`], it leaves an unfinished file in which everything
/// acknowledged can be read.
pub struct Recorder {
    updater: Updater,
    language: Option<Box<dyn LanguageModel>>,
    sink: Sink,
    ratio: u64,
    /// Event bytes in the file when the last checkpoint was written.
    counted: u64,
    /// What the next checkpoint will take, as far as can be guessed.
    checkpoint_bytes: u64,
}

impl Recorder {
    /// Starts a new recording at `path`: a new file, or the first segment of a new or empty
    /// folder if `path` ends in a separator or is a folder.
    pub fn create(
        path: &Path,
        config: Config,
        options: &RecorderOptions,
    ) -> Result<Self, RecordError> {
        let file = file_for(path)?;
        let meta = Meta::new(config.clone(), 1, GENESIS);
        let sink = Sink::create(&file, &meta, options)?;
        Ok(Self::over(Updater::new(config), sink, options))
    }

    /// Whether `path` is a folder with a recording that can be gone on with; segments that were
    /// never written to do not count.
    pub fn can_append(path: &Path) -> Result<bool, RecordError> {
        if !path.is_dir() {
            return Ok(false);
        }
        match Recording::open(path) {
            Ok(recording) => Ok(recording.meta().is_some() || !recording.is_empty()),
            Err(OpenError::NoSegments { .. }) => Ok(false),
            Err(error) => Err(error.into()),
        }
    }

    /// Goes on with the recording in the folder `path`, in a new segment, from the state that
    /// it ends with.
    pub fn append(path: &Path, options: &RecorderOptions) -> Result<Self, RecordError> {
        if !path.is_dir() {
            return Err(RecordError::NotAFolder { path: path.to_owned() });
        }
        check_not_in_use(path)?;
        let recording = Recording::open(path)?;
        let End { updater, chain, missing } = recording.resume().map_err(|what| {
            RecordError::Damaged { path: path.to_owned(), what: what.to_string() }
        })?;
        let file = next_segment(path).map_err(|error| io_error(path, error))?;
        let first_order = updater.order() + 1 - missing.len() as u64;
        let meta = Meta::new(updater.config().clone(), first_order, chain);
        let mut sink = Sink::create(&file, &meta, options)?;
        sink.append(&missing)?;
        let checkpoint = Checkpoint::of(&updater);
        let packed = checkpoint.packed();
        sink.checkpoint(checkpoint, packed)?;
        Ok(Self::over(updater, sink, options))
    }

    fn over(updater: Updater, sink: Sink, options: &RecorderOptions) -> Self {
        let (ratio, counted) = (options.checkpoint_ratio.max(1), sink.event_bytes());
        Self { updater, language: None, sink, ratio, counted, checkpoint_bytes: 4096 }
    }

    /// The updater: the graph by now, the number of the last event.
    pub fn updater(&self) -> &Updater {
        &self.updater
    }

    /// Gives the recorder a model to ask about sentences, if its configuration says that one is
    /// to be asked. Without one it records that nobody was there.
    pub fn set_language(&mut self, model: Box<dyn LanguageModel>) {
        self.language = Some(model);
    }

    /// Records one input that its source stamps `published`, what models say about it, and what
    /// it changes. Takes as long as the models do.
    ///
    /// # Errors
    /// [`RecordError::Update`] if the input is refused: nothing is written and the recording can
    /// go on. After any other error the recorder is of no use any more; what was acknowledged
    /// is safe.
    pub fn record(&mut self, published: Stamp, input: Event) -> Result<Recorded, RecordError> {
        let model = self.language.as_mut().map(|model| &mut **model as &mut dyn LanguageModel);
        let outputs = self.updater.ask(&input, model);
        self.record_with(published, input, outputs)
    }

    /// As [`Recorder::record`], with what models said about the input before: no model is asked.
    ///
    /// # Errors
    /// As [`Recorder::record`].
    pub fn record_with(
        &mut self,
        published: Stamp,
        input: Event,
        outputs: Vec<Event>,
    ) -> Result<Recorded, RecordError> {
        let events = self.updater.update_with(published, input, outputs)?;
        self.sink.append(&events)?;
        if self.is_checkpoint_due() {
            self.checkpoint()?;
        }
        Ok(Recorded { events, acknowledged: self.sink.acknowledged() })
    }

    /// Number of the last event that is safe, by the policy.
    pub fn acknowledged(&self) -> u64 {
        self.sink.acknowledged()
    }

    /// Makes everything recorded so far safe, and returns the number of the last event.
    pub fn sync(&mut self) -> Result<u64, RecordError> {
        self.sink.flush()?;
        Ok(self.sink.acknowledged())
    }

    /// Ends the recording.
    pub fn finish(self) -> Result<Seal, RecordError> {
        let (events, changes) = (self.updater.order(), self.updater.changes());
        self.sink.finish(events, changes, self.updater.graph().hash())
    }

    fn is_checkpoint_due(&self) -> bool {
        let since = self.sink.event_bytes() - self.counted;
        since >= self.ratio.saturating_mul(self.checkpoint_bytes)
    }

    fn checkpoint(&mut self) -> Result<(), RecordError> {
        let checkpoint = Checkpoint::of(&self.updater);
        let packed = checkpoint.packed();
        self.checkpoint_bytes = packed.len() as u64;
        // The guess may have been too small: then it is not due yet.
        if self.is_checkpoint_due() {
            self.sink.checkpoint(checkpoint, packed)?;
            self.counted = self.sink.event_bytes();
        }
        Ok(())
    }
}

/// A recorder holds a lock on its segment, which goes when its process does.
fn check_not_in_use(folder: &Path) -> Result<(), RecordError> {
    let segments = segment_files(folder).map_err(|error| io_error(folder, error))?;
    let Some(last) = segments.last() else { return Ok(()) };
    let file = File::open(last).map_err(|error| io_error(last, error))?;
    // A recorder that is just ending gets the time to do so.
    for _ in 0..LOCK_TRIES {
        match file.try_lock() {
            Err(TryLockError::WouldBlock) => std::thread::sleep(LOCK_PAUSE),
            // Where files cannot be locked, nobody can tell.
            _ => return Ok(()),
        }
    }
    Err(RecordError::InUse { path: last.clone() })
}

const LOCK_TRIES: usize = 20;
const LOCK_PAUSE: Duration = Duration::from_millis(25);

/// The file a new recording at `path` goes to.
fn file_for(path: &Path) -> Result<PathBuf, RecordError> {
    let folder = path.is_dir() || path.as_os_str().to_string_lossy().ends_with(['/', '\\']);
    if !folder {
        return Ok(path.to_owned());
    }
    std::fs::create_dir_all(path).map_err(|error| io_error(path, error))?;
    if Recorder::can_append(path)? {
        return Err(RecordError::Exists { path: path.to_owned() });
    }
    next_segment(path).map_err(|error| io_error(path, error))
}

fn io_error(path: &Path, error: io::Error) -> RecordError {
    RecordError::io(path, error)
}
