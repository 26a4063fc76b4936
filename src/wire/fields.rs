//! The fields of a protobuf message, one after the other, borrowed from its bytes.
//!
//! Knows the wire format and no message. Walking instead of building generated structs first
//! keeps memory at what is valid, names every field that is refused, and is fast enough for
//! replay. Stricter than protobuf asks: numbers that do not fit their type and groups are
//! refused. Fields that are not known are skipped, since later versions may add some.

use std::fmt::Display;

use super::WireError;

/// Longest text of a field, in bytes, unless it says otherwise.
pub(super) const MAX_TEXT: usize = crate::event::MAX_NAME;
/// Longest text that is derived from others: it may quote the longest input there is, with every
/// character escaped, and must be readable all the same.
pub(super) const MAX_DERIVED_TEXT: usize = 8 << 20;

/// Walks over the fields of one message.
#[derive(Clone, Debug)]
pub(super) struct Fields<'a> {
    rest: &'a [u8],
    message: &'static str,
}

/// One field: its number and what it holds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Field<'a> {
    pub number: u32,
    message: &'static str,
    value: Value<'a>,
}

#[derive(Clone, Copy, Debug)]
enum Value<'a> {
    Varint(u64),
    Fixed64(u64),
    Bytes(&'a [u8]),
    Fixed32,
}

impl<'a> Fields<'a> {
    pub fn new(message: &'static str, bytes: &'a [u8]) -> Self {
        Self { rest: bytes, message }
    }

    /// The next field; `None` at the end.
    #[inline(always)] // measured: a field that goes through memory costs as much as its number
    #[allow(clippy::inline_always)]
    pub fn next(&mut self) -> Result<Option<Field<'a>>, WireError> {
        if self.rest.is_empty() {
            return Ok(None);
        }
        let (number, wire_type) = self.key()?;
        let value = match wire_type {
            0 => Value::Varint(self.varint()?),
            1 => Value::Fixed64(u64::from_le_bytes(self.array()?)),
            2 => Value::Bytes(self.bytes()?),
            5 => self.array::<4>().map(|_| Value::Fixed32)?,
            _ => return Err(self.malformed("a field is of an unknown kind")),
        };
        Ok(Some(Field { number, message: self.message, value }))
    }

    /// The number of the next field, without going past it.
    pub fn peek(&self) -> Option<u32> {
        self.clone().key().ok().map(|(number, _)| number)
    }

    #[inline]
    fn key(&mut self) -> Result<(u32, u8), WireError> {
        let key = self.varint()?;
        match u32::try_from(key) {
            Ok(key) if key >= 8 => Ok((key >> 3, (key & 7) as u8)),
            _ => Err(self.malformed("a field number is out of range")),
        }
    }

    #[inline]
    fn varint(&mut self) -> Result<u64, WireError> {
        match self.rest {
            [byte, rest @ ..] if *byte < 0x80 => {
                self.rest = rest;
                return Ok(u64::from(*byte));
            }
            _ => {}
        }
        if let Some(word) = self.rest.first_chunk::<8>() {
            let word = u64::from_le_bytes(*word);
            // The high bit of the first byte that ends a number.
            let end = !word & 0x8080_8080_8080_8080;
            if end != 0 {
                self.rest = &self.rest[end.trailing_zeros() as usize / 8 + 1..];
                return Ok(joined(word & (end ^ (end - 1))));
            }
        }
        self.long_varint()
    }

    #[cold]
    fn long_varint(&mut self) -> Result<u64, WireError> {
        let mut value = 0_u64;
        for (n, byte) in self.rest.iter().enumerate().take(10) {
            value |= u64::from(byte & 0x7f) << (7 * n);
            if *byte < 0x80 {
                if n == 9 && *byte > 1 {
                    break;
                }
                self.rest = &self.rest[n + 1..];
                return Ok(value);
            }
        }
        Err(self.malformed("a number does not end or is too large"))
    }

    #[inline]
    fn array<const N: usize>(&mut self) -> Result<[u8; N], WireError> {
        match self.rest.split_first_chunk::<N>() {
            Some((array, rest)) => {
                self.rest = rest;
                Ok(*array)
            }
            None => Err(self.malformed("it ends within a field")),
        }
    }

    #[inline]
    fn bytes(&mut self) -> Result<&'a [u8], WireError> {
        let len = self.varint()?;
        let split = usize::try_from(len).ok().and_then(|len| self.rest.split_at_checked(len));
        match split {
            Some((bytes, rest)) => {
                self.rest = rest;
                Ok(bytes)
            }
            None => Err(self.malformed("it ends within a field")),
        }
    }

    #[cold]
    fn malformed(&self, problem: &'static str) -> WireError {
        WireError::Malformed { message: self.message, problem }
    }
}

impl<'a> Field<'a> {
    /// A refusal of this field.
    #[cold]
    pub fn refuse(
        &self,
        field: &'static str,
        value: impl Display,
        expected: &'static str,
    ) -> WireError {
        let value: String = format!("{value}").chars().take(80).collect();
        WireError::Value { message: self.message, field, value: value.into(), expected }
    }

    #[cold]
    fn kind(&self) -> WireError {
        WireError::Malformed {
            message: self.message,
            problem: "a field is of another kind than its contract says",
        }
    }

    /// Puts the value of a message field where none may be yet. Protobuf would merge the two;
    /// no writer of ours makes that.
    #[inline]
    pub fn once<T>(&self, slot: &mut Option<T>, value: T) -> Result<(), WireError> {
        if slot.is_some() {
            let problem = "a field that may be given once is given twice";
            return Err(WireError::Malformed { message: self.message, problem });
        }
        *slot = Some(value);
        Ok(())
    }

    #[inline]
    pub fn u64(&self) -> Result<u64, WireError> {
        match self.value {
            Value::Varint(value) => Ok(value),
            _ => Err(self.kind()),
        }
    }

    #[inline]
    pub fn u32(&self, field: &'static str) -> Result<u32, WireError> {
        let value = self.u64()?;
        u32::try_from(value).map_err(|_| self.refuse(field, value, "less than 2^32"))
    }

    #[inline]
    pub fn sint64(&self) -> Result<i64, WireError> {
        let value = self.u64()?;
        Ok((value >> 1).cast_signed() ^ -(value & 1).cast_signed())
    }

    #[inline]
    pub fn sint32(&self, field: &'static str) -> Result<i32, WireError> {
        let value = self.sint64()?;
        i32::try_from(value).map_err(|_| self.refuse(field, value, "of 32 bits"))
    }

    pub fn bool(&self, field: &'static str) -> Result<bool, WireError> {
        match self.u64()? {
            0 => Ok(false),
            1 => Ok(true),
            other => Err(self.refuse(field, other, "0 or 1")),
        }
    }

    #[inline]
    pub fn fixed64(&self) -> Result<u64, WireError> {
        match self.value {
            Value::Fixed64(value) => Ok(value),
            _ => Err(self.kind()),
        }
    }

    pub fn double(&self) -> Result<f64, WireError> {
        self.fixed64().map(f64::from_bits)
    }

    #[inline]
    pub fn bytes(&self) -> Result<&'a [u8], WireError> {
        match self.value {
            Value::Bytes(bytes) => Ok(bytes),
            _ => Err(self.kind()),
        }
    }

    /// The fields of a message within this one.
    #[inline]
    pub fn message(&self, name: &'static str) -> Result<Fields<'a>, WireError> {
        Ok(Fields::new(name, self.bytes()?))
    }

    pub fn text(&self, field: &'static str) -> Result<&'a str, WireError> {
        self.long_text(field, MAX_TEXT)
    }

    pub fn derived_text(&self, field: &'static str) -> Result<&'a str, WireError> {
        self.long_text(field, MAX_DERIVED_TEXT)
    }

    pub fn long_text(&self, field: &'static str, limit: usize) -> Result<&'a str, WireError> {
        let bytes = self.bytes()?;
        if bytes.len() > limit {
            return Err(WireError::TooMuch { message: self.message, field, limit });
        }
        std::str::from_utf8(bytes).map_err(|_| {
            let shown = String::from_utf8_lossy(&bytes[..bytes.len().min(80)]);
            self.refuse(field, format!("{shown:?}"), "text in UTF-8")
        })
    }

    /// The numbers of a repeated field, packed or one at a time.
    pub fn numbers(
        &self,
        mut each: impl FnMut(u64) -> Result<(), WireError>,
    ) -> Result<(), WireError> {
        match self.value {
            Value::Varint(value) => each(value),
            Value::Bytes(bytes) => {
                let mut packed = Fields::new(self.message, bytes);
                while !packed.rest.is_empty() {
                    each(packed.varint()?)?;
                }
                Ok(())
            }
            _ => Err(self.kind()),
        }
    }
}

/// Joins the low seven bits of eight bytes, pair by pair, without a branch.
#[inline]
const fn joined(word: u64) -> u64 {
    let pairs = (word & 0x007f_007f_007f_007f) | ((word & 0x7f00_7f00_7f00_7f00) >> 1);
    let fours = (pairs & 0x0000_3fff_0000_3fff) | ((pairs & 0x3fff_0000_3fff_0000) >> 2);
    (fours & 0x0fff_ffff) | ((fours & 0x0fff_ffff_0000_0000) >> 4)
}

/// The value of a field that must be there.
#[inline]
pub(super) fn required<T>(
    value: Option<T>,
    message: &'static str,
    field: &'static str,
) -> Result<T, WireError> {
    value.ok_or(WireError::Missing { message, field })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use prost::encoding::{decode_varint, encode_varint};

    proptest! {
        #[test]
        fn numbers_read_as_generated_code_reads_them(
            value: u64, bits in 0..64_u32, tail in proptest::collection::vec(any::<u8>(), 0..12),
        ) {
            let mut bytes = Vec::new();
            encode_varint(value >> bits, &mut bytes);
            bytes.extend(tail);
            let mut fields = Fields::new("Tick", &bytes);
            prop_assert_eq!(fields.varint(), Ok(value >> bits));
            let ours = fields.varint().ok();
            let mut rest = &bytes[prost::encoding::encoded_len_varint(value >> bits)..];
            prop_assert_eq!(ours, decode_varint(&mut rest).ok());
            if ours.is_some() {
                prop_assert_eq!(fields.rest, rest);
            }
        }
    }
}
