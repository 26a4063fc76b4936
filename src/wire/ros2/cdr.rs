//! Classic CDR: numbers aligned to their size, counted from after the 4-byte header.

use super::CdrError;

const HEADER: usize = 4;

/// Reads the values of a message in turn.
pub(super) struct Reader<'a> {
    body: &'a [u8],
    at: usize,
    big_endian: bool,
    message: &'static str,
}

impl<'a> Reader<'a> {
    pub fn new(message: &'static str, payload: &'a [u8]) -> Result<Self, CdrError> {
        let short = CdrError::Short { message, field: "header", needed: 4, left: payload.len() };
        let (header, body) = payload.split_first_chunk::<HEADER>().ok_or(short)?;
        match [header[0], header[1]] {
            [0, kind @ (0 | 1)] => Ok(Self { body, at: 0, big_endian: kind == 0, message }),
            found => Err(CdrError::Encapsulation { message, found }),
        }
    }

    fn take(&mut self, field: &'static str, len: u64) -> Result<&'a [u8], CdrError> {
        let rest = self.body.get(self.at..).unwrap_or_default();
        let taken = usize::try_from(len).ok().and_then(|len| rest.get(..len));
        let short = CdrError::Short { message: self.message, field, needed: len, left: rest.len() };
        let taken = taken.ok_or(short)?;
        self.at += taken.len();
        Ok(taken)
    }

    fn number<const N: usize>(&mut self, field: &'static str) -> Result<[u8; N], CdrError> {
        self.at = self.at.next_multiple_of(N);
        let bytes = self.take(field, N as u64)?;
        let mut number: [u8; N] = bytes.try_into().expect("as many bytes as were asked for");
        if self.big_endian {
            number.reverse();
        }
        Ok(number)
    }

    pub fn u8(&mut self, field: &'static str) -> Result<u8, CdrError> {
        self.number(field).map(|[byte]| byte)
    }

    pub fn u32(&mut self, field: &'static str) -> Result<u32, CdrError> {
        self.number(field).map(u32::from_le_bytes)
    }

    pub fn i32(&mut self, field: &'static str) -> Result<i32, CdrError> {
        self.number(field).map(i32::from_le_bytes)
    }

    pub fn f64(&mut self, field: &'static str) -> Result<f64, CdrError> {
        self.number(field).map(f64::from_le_bytes)
    }

    pub fn f64s<const N: usize>(&mut self, field: &'static str) -> Result<[f64; N], CdrError> {
        let mut values = [0.0; N];
        for value in &mut values {
            *value = self.f64(field)?;
        }
        Ok(values)
    }

    /// How many entries follow, each of at least `least` bytes: never more than there is room
    /// for.
    pub fn count(&mut self, field: &'static str, least: u64) -> Result<usize, CdrError> {
        let count = self.u32(field)?;
        let (needed, left) = (u64::from(count) * least, self.body.len().saturating_sub(self.at));
        if needed > left as u64 {
            return Err(CdrError::Short { message: self.message, field, needed, left });
        }
        Ok(count as usize)
    }

    pub fn bytes(&mut self, field: &'static str) -> Result<&'a [u8], CdrError> {
        let len = self.u32(field)?;
        self.take(field, len.into())
    }

    pub fn text(&mut self, field: &'static str) -> Result<&'a str, CdrError> {
        let bytes = self.bytes(field)?;
        // Some writers give an empty text no zero.
        let text = if bytes.is_empty() { Some(bytes) } else { bytes.strip_suffix(&[0]) };
        text.and_then(|text| std::str::from_utf8(text).ok())
            .ok_or(CdrError::Text { message: self.message, field })
    }
}

/// Writes the values of a message in turn, little endian.
pub(super) struct Writer(Vec<u8>);

impl Writer {
    pub fn new() -> Self {
        Self(vec![0, 1, 0, 0])
    }

    pub fn finish(self) -> Vec<u8> {
        self.0
    }

    fn number<const N: usize>(&mut self, bytes: [u8; N]) {
        let end = (self.0.len() - HEADER).next_multiple_of(N) + HEADER;
        self.0.resize(end, 0);
        self.0.extend_from_slice(&bytes);
    }

    pub fn u8(&mut self, value: u8) {
        self.0.push(value);
    }

    pub fn u32(&mut self, value: u32) {
        self.number(value.to_le_bytes());
    }

    pub fn i32(&mut self, value: i32) {
        self.number(value.to_le_bytes());
    }

    pub fn f64s(&mut self, values: &[f64]) {
        for value in values {
            self.number(value.to_le_bytes());
        }
    }

    /// How many entries follow.
    ///
    /// # Panics
    /// From 2^32 on, which no message that fits into a recording has.
    pub fn count(&mut self, count: usize) {
        self.u32(u32::try_from(count).expect("a message holds fewer than 2^32 entries"));
    }

    pub fn bytes(&mut self, bytes: &[u8]) {
        self.count(bytes.len());
        self.0.extend_from_slice(bytes);
    }

    pub fn text(&mut self, text: &str) {
        self.count(text.len() + 1);
        self.0.extend_from_slice(text.as_bytes());
        self.u8(0);
    }
}
