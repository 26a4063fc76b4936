//! Reading and writing MCAP files as raw messages.
//!
//! This layer knows channels, times and bytes; it must not know what a message means.
//! The record types are those of the `mcap` crate; the framing is our own, because
//!
//! - the crate's writer has one open chunk and one compression for the whole file, and seeks
//!   back to patch chunk headers, so a crash leaves a torn chunk. Ours keeps event and sensor
//!   chunks apart and hands over each finished chunk in a single write;
//! - its readers stop at the first damage, and some of its parsers allocate or panic on
//!   hostile lengths. Ours finds the next intact record, reports what lies between, and
//!   bounds every allocation.
//!
//! The total order of a log is (`log_time`, file position): [`OrderKey`].
//!
//! - [`LogWriter`] writes a log; [`LogFile`] opens one, whole or damaged.
//! - [`LogFile::messages`] walks chosen channels in order; [`LogFile::read_chunk_into`] with
//!   [`ChunkBuffer`] is the fast path under it, safe to call from many threads.
//! - [`Damage`] says which bytes are lost and why.

mod chunk;
mod cursor;
mod damage;
mod decode;
mod entry;
mod examine;
mod file;
mod filter;
mod index;
mod learn;
mod limits;
mod open_chunk;
mod options;
mod peek;
mod resync;
mod scan;
mod source;
mod summary;
mod window;
mod wire;
mod writer;
mod writer_summary;

#[cfg(test)]
mod tests;

pub use chunk::{ChunkBuffer, OrderKey, Position, RawMessage};
pub use cursor::MessageCursor;
pub use damage::{Damage, DamageKind, DamageList, LogError};
pub use entry::{ChunkEntry, Compression};
pub use file::LogFile;
pub use filter::MessageFilter;
pub use limits::Limits;
pub use mcap::records::{Channel, Header, Metadata, Statistics};
pub use open_chunk::ChunkClass;
pub use options::{ChannelSpec, LogOptions, SchemaSpec, WriteError};
pub use source::{FileSource, Source};
pub use wire::Schema;
pub use writer::{ChannelHandle, LogWriter, Progress};
