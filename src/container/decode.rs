//! Decompressing chunk bodies within bounds, whatever the chunk claims. Knows no records.

use std::io::{self, Read};

use super::damage::DamageKind;
use super::entry::Compression;

/// Most that is allocated on the word of a header alone.
const TRUSTED: u64 = 8 << 20;
/// Largest zstd window that is accepted, as a power of two.
const WINDOW_LOG_MAX: u32 = 27;

/// Decompression state that is worth keeping from chunk to chunk.
#[derive(Default)]
pub(super) struct Decoder {
    zstd: Option<zstd::bulk::Decompressor<'static>>,
}

impl Decoder {
    /// Decompresses `data` into `body`, which it replaces; the size must come out as `claimed`.
    pub(super) fn decompress(
        &mut self,
        compression: &Compression,
        data: &[u8],
        claimed: u64,
        body: &mut Vec<u8>,
    ) -> Result<(), DamageKind> {
        body.clear();
        let (name, done) = match compression {
            Compression::Loose | Compression::None => {
                body.extend_from_slice(data);
                ("stored", Ok(()))
            }
            Compression::Zstd if data.is_empty() => ("zstd", Ok(())),
            Compression::Zstd if claimed <= TRUSTED => {
                ("zstd", self.zstd_at_once(data, claimed, body))
            }
            Compression::Zstd => ("zstd", zstd_streamed(data, claimed, body)),
            Compression::Lz4 if data.is_empty() => ("lz4", Ok(())),
            Compression::Lz4 => {
                let decoder = lz4_flex::frame::FrameDecoder::new(data);
                ("lz4", read_claimed(decoder, claimed, body))
            }
            Compression::Unknown(name) => {
                return Err(DamageKind::UnknownCompression { name: name.clone() });
            }
        };
        if done.is_err() || body.len() as u64 != claimed {
            body.clear();
            return Err(DamageKind::Decompress { compression: name, claimed });
        }
        Ok(())
    }

    fn zstd_at_once(&mut self, data: &[u8], claimed: u64, body: &mut Vec<u8>) -> io::Result<()> {
        let zstd = match &mut self.zstd {
            Some(zstd) => zstd,
            none => none.insert(zstd::bulk::Decompressor::new()?),
        };
        body.reserve(claimed as usize);
        zstd.decompress_to_buffer(data, body).map(|_| ())
    }
}

fn zstd_streamed(data: &[u8], claimed: u64, body: &mut Vec<u8>) -> io::Result<()> {
    let mut decoder = zstd::stream::read::Decoder::with_buffer(data)?;
    decoder.window_log_max(WINDOW_LOG_MAX)?;
    read_claimed(decoder, claimed, body)
}

/// Reads at most one byte more than claimed, so that a bomb shows and does no harm.
fn read_claimed(decoder: impl Read, claimed: u64, body: &mut Vec<u8>) -> io::Result<()> {
    body.reserve(claimed.min(TRUSTED) as usize);
    decoder.take(claimed.saturating_add(1)).read_to_end(body).map(|_| ())
}
