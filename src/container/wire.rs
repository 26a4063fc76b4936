//! MCAP records to bytes and back.
//!
//! Parsing is by hand and never trusts a length: every one is checked against the bytes that
//! are there, so nothing here allocates more than its input. Does no IO.

use std::collections::BTreeMap;
use std::io::Cursor;
use std::sync::Arc;

use binrw::{BinWrite, BinWriterExt};
use mcap::records::{Channel, ChunkHeader, ChunkIndex, Footer, Header, Metadata, Statistics, op};

/// Bytes of a record before its body: opcode and length.
pub(super) const FRAME: u64 = 9;
/// Bytes of a message record between frame and payload.
pub(super) const MESSAGE_FIXED: usize = 22;
/// Longest compression name that is looked at.
const COMPRESSION_NAME_MAX: usize = 32;
/// Bytes that surely hold the fixed part of a chunk record's body.
pub(super) const CHUNK_HEADER_MAX: usize = 40 + COMPRESSION_NAME_MAX;

/// A schema: the description of a message type, in its own language.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Schema {
    /// Id in the file, never zero.
    pub id: u16,
    /// Name of the message type.
    pub name: String,
    /// Language of the description, for example `protobuf`.
    pub encoding: String,
    /// The description.
    pub data: Arc<[u8]>,
}

/// Reads fields from the front of a slice; `None` as soon as one does not fit.
pub(super) struct Fields<'a> {
    rest: &'a [u8],
}

impl<'a> Fields<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes }
    }

    pub(super) fn bytes(&mut self, n: usize) -> Option<&'a [u8]> {
        let (taken, rest) = self.rest.split_at_checked(n)?;
        self.rest = rest;
        Some(taken)
    }

    fn array<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (taken, rest) = self.rest.split_first_chunk::<N>()?;
        self.rest = rest;
        Some(*taken)
    }

    pub(super) fn u16(&mut self) -> Option<u16> {
        self.array().map(u16::from_le_bytes)
    }

    pub(super) fn u32(&mut self) -> Option<u32> {
        self.array().map(u32::from_le_bytes)
    }

    pub(super) fn u64(&mut self) -> Option<u64> {
        self.array().map(u64::from_le_bytes)
    }

    /// Bytes preceded by their length in 32 bits.
    fn sized(&mut self) -> Option<&'a [u8]> {
        let n = self.u32()?;
        self.bytes(n as usize)
    }

    pub(super) fn text(&mut self) -> Option<String> {
        Some(std::str::from_utf8(self.sized()?).ok()?.to_owned())
    }

    fn text_map(&mut self) -> Option<BTreeMap<String, String>> {
        let mut inner = Self::new(self.sized()?);
        let mut map = BTreeMap::new();
        while !inner.is_empty() {
            let (key, value) = (inner.text()?, inner.text()?);
            // The specification forbids duplicates; keeping either would hide the other.
            if map.insert(key, value).is_some() {
                return None;
            }
        }
        Some(map)
    }

    fn int_map(&mut self) -> Option<BTreeMap<u16, u64>> {
        let mut inner = Self::new(self.sized()?);
        let mut map = BTreeMap::new();
        while !inner.is_empty() {
            map.insert(inner.u16()?, inner.u64()?);
        }
        Some(map)
    }

    pub(super) fn is_empty(&self) -> bool {
        self.rest.is_empty()
    }

    pub(super) fn len(&self) -> usize {
        self.rest.len()
    }
}

/// Opcode and length of the record that starts `bytes`.
pub(super) fn frame(bytes: &[u8]) -> Option<(u8, u64)> {
    let mut fields = Fields::new(bytes);
    let [opcode] = fields.array()?;
    Some((opcode, fields.u64()?))
}

pub(super) fn header(body: &[u8]) -> Option<Header> {
    let mut fields = Fields::new(body);
    Some(Header { profile: fields.text()?, library: fields.text()? })
}

pub(super) fn schema(body: &[u8]) -> Option<Schema> {
    let mut fields = Fields::new(body);
    let (id, name, encoding) = (fields.u16()?, fields.text()?, fields.text()?);
    let data = Arc::from(fields.sized()?);
    // Id zero means "no schema" and must not be defined.
    (id != 0).then_some(Schema { id, name, encoding, data })
}

pub(super) fn channel(body: &[u8]) -> Option<Channel> {
    let mut fields = Fields::new(body);
    Some(Channel {
        id: fields.u16()?,
        schema_id: fields.u16()?,
        topic: fields.text()?,
        message_encoding: fields.text()?,
        metadata: fields.text_map()?,
    })
}

/// Parses the fixed part of a chunk; also returns its length, at which the data starts.
pub(super) fn chunk_header(body: &[u8]) -> Option<(ChunkHeader, usize)> {
    let mut fields = Fields::new(body);
    let (message_start_time, message_end_time) = (fields.u64()?, fields.u64()?);
    let (uncompressed_size, uncompressed_crc) = (fields.u64()?, fields.u32()?);
    let compression = fields.text()?;
    if compression.len() > COMPRESSION_NAME_MAX {
        return None;
    }
    let compressed_size = fields.u64()?;
    let header = ChunkHeader {
        message_start_time,
        message_end_time,
        uncompressed_size,
        uncompressed_crc,
        compression,
        compressed_size,
    };
    Some((header, body.len() - fields.len()))
}

pub(super) fn chunk_index(body: &[u8]) -> Option<ChunkIndex> {
    let mut fields = Fields::new(body);
    Some(ChunkIndex {
        message_start_time: fields.u64()?,
        message_end_time: fields.u64()?,
        chunk_start_offset: fields.u64()?,
        chunk_length: fields.u64()?,
        message_index_offsets: fields.int_map()?,
        message_index_length: fields.u64()?,
        compression: fields.text()?,
        compressed_size: fields.u64()?,
        uncompressed_size: fields.u64()?,
    })
}

pub(super) fn metadata(body: &[u8]) -> Option<Metadata> {
    let mut fields = Fields::new(body);
    Some(Metadata { name: fields.text()?, metadata: fields.text_map()? })
}

pub(super) fn statistics(body: &[u8]) -> Option<Statistics> {
    let mut fields = Fields::new(body);
    Some(Statistics {
        message_count: fields.u64()?,
        schema_count: fields.u16()?,
        channel_count: fields.u32()?,
        attachment_count: fields.u32()?,
        metadata_count: fields.u32()?,
        chunk_count: fields.u32()?,
        message_start_time: fields.u64()?,
        message_end_time: fields.u64()?,
        channel_message_counts: fields.int_map()?,
    })
}

pub(super) fn footer(body: &[u8]) -> Option<Footer> {
    let mut fields = Fields::new(body);
    Some(Footer {
        summary_start: fields.u64()?,
        summary_offset_start: fields.u64()?,
        summary_crc: fields.u32()?,
    })
}

/// Appends a record of the `mcap` crate with its frame.
pub(super) fn put<R>(out: &mut Vec<u8>, opcode: u8, record: &R)
where
    R: for<'a> BinWrite<Args<'a> = ()>,
{
    let mut body = Cursor::new(Vec::new());
    body.write_le(record).expect("writing to memory cannot fail");
    put_bytes(out, opcode, body.get_ref());
}

/// Appends a record whose body is ready.
pub(super) fn put_bytes(out: &mut Vec<u8>, opcode: u8, body: &[u8]) {
    out.push(opcode);
    out.extend_from_slice(&(body.len() as u64).to_le_bytes());
    out.extend_from_slice(body);
}

/// Appends a schema record.
pub(super) fn put_schema(out: &mut Vec<u8>, schema: &Schema) {
    let mut body = schema.id.to_le_bytes().to_vec();
    for field in [schema.name.as_bytes(), schema.encoding.as_bytes(), &schema.data] {
        body.extend_from_slice(&(field.len() as u32).to_le_bytes());
        body.extend_from_slice(field);
    }
    put_bytes(out, op::SCHEMA, &body);
}
