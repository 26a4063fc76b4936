//! A sliding buffer over a [`Source`], for a walk over many small records. Knows no records.

use std::io;

use super::source::Source;

/// Bytes fetched at once; far less than a chunk, far more than a record header.
const WINDOW: usize = 16 << 10;

/// Serves small reads from a buffer that moves with them.
pub(super) struct Window<'s> {
    source: &'s dyn Source,
    len: u64,
    start: u64,
    buffer: Vec<u8>,
}

impl<'s> Window<'s> {
    /// A window over the bytes before `until`.
    pub(super) fn new(source: &'s dyn Source, until: u64) -> Self {
        Self { source, len: source.len().min(until), start: 0, buffer: Vec::new() }
    }

    /// Up to `n` bytes at `offset`, fewer at the end; moves the buffer there if need be.
    pub(super) fn peek(&mut self, offset: u64, n: usize) -> io::Result<&[u8]> {
        let n = self.available(offset, n);
        if self.buffered(offset, n).is_none() {
            let fetch = self.available(offset, WINDOW.max(n));
            self.buffer.resize(fetch, 0);
            self.start = offset;
            self.source.read_at(offset, &mut self.buffer)?;
        }
        Ok(self.buffered(offset, n).unwrap_or_default())
    }

    /// As many bytes as fit `into`, without moving the buffer: for a look far ahead.
    pub(super) fn glance<'b>(&self, offset: u64, into: &'b mut [u8]) -> io::Result<&'b [u8]> {
        let n = self.available(offset, into.len());
        let into = &mut into[..n];
        match self.buffered(offset, n) {
            Some(bytes) => into.copy_from_slice(bytes),
            None => self.source.read_at(offset, into)?,
        }
        Ok(into)
    }

    /// Exactly `n` bytes, which the caller has checked to be there and to be few enough.
    pub(super) fn read(&self, offset: u64, n: u64) -> io::Result<Vec<u8>> {
        let n = usize::try_from(n).map_err(|_| io::ErrorKind::InvalidInput)?;
        let mut bytes = vec![0; n];
        self.source.read_at(offset, &mut bytes)?;
        Ok(bytes)
    }

    fn available(&self, offset: u64, n: usize) -> usize {
        n.min(usize::try_from(self.len.saturating_sub(offset)).unwrap_or(usize::MAX))
    }

    fn buffered(&self, offset: u64, n: usize) -> Option<&[u8]> {
        let from = usize::try_from(offset.checked_sub(self.start)?).ok()?;
        self.buffer.get(from..from.checked_add(n)?)
    }
}
