//! Writing protobuf without an intermediate struct: for the messages that are most of a log.
//!
//! Byte for byte what the generated structs would write (a test compares): fields in the order
//! of their numbers, default values left out.

/// Appends the fields of one message.
pub(super) struct Put<'b>(pub &'b mut Vec<u8>);

const VARINT: u64 = 0;
const FIXED64: u64 = 1;
const LENGTH: u64 = 2;

impl Put<'_> {
    fn varint(&mut self, mut value: u64) {
        while value >= 0x80 {
            self.0.push(value as u8 | 0x80);
            value >>= 7;
        }
        self.0.push(value as u8);
    }

    fn key(&mut self, field: u64, kind: u64) {
        self.varint(field << 3 | kind);
    }

    /// A number that is there even if it is zero, as in a `oneof` or an `optional`.
    pub fn present_u64(&mut self, field: u64, value: u64) {
        self.key(field, VARINT);
        self.varint(value);
    }

    pub fn u64(&mut self, field: u64, value: u64) {
        if value != 0 {
            self.present_u64(field, value);
        }
    }

    pub fn optional_u32(&mut self, field: u64, value: Option<u32>) {
        if let Some(value) = value {
            self.present_u64(field, value.into());
        }
    }

    /// Zigzag, as `sint32` and `sint64` are.
    pub fn sint(&mut self, field: u64, value: i64) {
        self.u64(field, ((value << 1) ^ (value >> 63)) as u64);
    }

    pub fn optional_fixed64(&mut self, field: u64, value: Option<u64>) {
        if let Some(value) = value {
            self.key(field, FIXED64);
            self.0.extend_from_slice(&value.to_le_bytes());
        }
    }

    pub fn fixed64(&mut self, field: u64, value: u64) {
        self.optional_fixed64(field, Some(value).filter(|value| *value != 0));
    }

    pub fn double(&mut self, field: u64, value: f64) {
        self.fixed64(field, (value + 0.0).to_bits());
    }

    pub fn text(&mut self, field: u64, text: &str) {
        if !text.is_empty() {
            self.key(field, LENGTH);
            self.varint(text.len() as u64);
            self.0.extend_from_slice(text.as_bytes());
        }
    }

    pub fn packed(&mut self, field: u64, values: impl ExactSizeIterator<Item = u32>) {
        if values.len() > 0 {
            self.message(field, |put| values.for_each(|value| put.varint(value.into())));
        }
    }

    /// A message within, or anything else that is preceded by its length.
    pub fn message(&mut self, field: u64, write: impl FnOnce(&mut Put<'_>)) {
        self.key(field, LENGTH);
        let place = self.0.len();
        // Nearly all are shorter than 128 bytes, whose length takes one.
        self.0.push(0);
        write(&mut Put(self.0));
        let length = self.0.len() - place - 1;
        if length < 0x80 {
            self.0[place] = length as u8;
            return;
        }
        let mut prefix = Vec::with_capacity(5);
        Put(&mut prefix).varint(length as u64);
        self.0.splice(place..=place, prefix);
    }
}
