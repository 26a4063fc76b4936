//! A `safetensors` file: the length of a JSON header, the header, the numbers.
//!
//! Format: 8 bytes of length, little-endian; `{"name": {"dtype", "shape", "data_offsets"}}`;
//! then the bytes that the offsets speak of (huggingface.co/docs/safetensors).

use std::path::Path;

use serde::Deserialize;
use serde_json::{Map, Value};

use super::matrix::{Linear, Matrix, Norm};
use super::{EmbedError, read};

/// The tensors of a file, read one by one.
pub(super) struct Tensors<'p> {
    path: &'p Path,
    header: Map<String, Value>,
    /// The file after its header.
    data: Vec<u8>,
    /// What stands before every name.
    prefix: &'static str,
}

#[derive(Deserialize)]
struct Entry {
    dtype: String,
    shape: Vec<usize>,
    data_offsets: (usize, usize),
}

impl<'p> Tensors<'p> {
    pub fn open(path: &'p Path) -> Result<Self, EmbedError> {
        let wrong = |what: &str| EmbedError::new(path, what);
        let mut bytes = read(path)?.ok_or_else(|| wrong("there is no such file"))?;
        let length = bytes.first_chunk().map(|length| u64::from_le_bytes(*length));
        let end = length.and_then(|length| usize::try_from(length).ok()?.checked_add(8));
        let end = end.filter(|end| *end <= bytes.len());
        let end = end.ok_or_else(|| wrong("it is no safetensors file: the header does not end"))?;
        let header: Map<String, Value> = serde_json::from_slice(&bytes[8..end])
            .map_err(|error| wrong(&format!("it is no safetensors file: {error}")))?;
        bytes.drain(..end);
        let prefix = match header.contains_key("bert.embeddings.word_embeddings.weight") {
            true => "bert.",
            false => "",
        };
        Ok(Self { path, header, data: bytes, prefix })
    }

    fn wrong(&self, name: &str, what: &str) -> EmbedError {
        EmbedError::new(self.path, format!("tensor {name:?} {what}"))
    }

    /// The tensor with this name, as 32-bit numbers, with its shape.
    fn tensor(&self, name: &str) -> Result<(Vec<usize>, Vec<f32>), EmbedError> {
        let name = format!("{}{name}", self.prefix);
        let entry = self.header.get(&name).ok_or_else(|| self.wrong(&name, "is missing"))?;
        let entry = Entry::deserialize(entry);
        let Entry { dtype, shape, data_offsets: (start, end) } =
            entry.map_err(|error| self.wrong(&name, &error.to_string()))?;
        let bytes = self.data.get(start..end);
        let bytes = bytes.ok_or_else(|| self.wrong(&name, "is not within the file"))?;
        let values: Vec<f32> = match dtype.as_str() {
            "F32" => bytes.as_chunks().0.iter().map(|b| f32::from_le_bytes(*b)).collect(),
            "F16" => bytes.as_chunks().0.iter().map(|b| half(u16::from_le_bytes(*b))).collect(),
            "BF16" => {
                let wide = |b: &[u8; 2]| f32::from_bits(u32::from(u16::from_le_bytes(*b)) << 16);
                bytes.as_chunks().0.iter().map(wide).collect()
            }
            other => {
                let what = format!("is of type {other}: F32, F16 and BF16 are read");
                return Err(self.wrong(&name, &what));
            }
        };
        let count = shape.iter().try_fold(1_usize, |n, side| n.checked_mul(*side));
        if count != Some(values.len()) {
            return Err(self.wrong(&name, "has another size than its shape says"));
        }
        if !values.iter().all(|value| value.is_finite()) {
            return Err(self.wrong(&name, "holds numbers that are not finite"));
        }
        Ok((shape, values))
    }

    pub fn vector(&self, name: &str, length: usize) -> Result<Vec<f32>, EmbedError> {
        let (shape, values) = self.tensor(name)?;
        match shape == [length] {
            true => Ok(values),
            false => Err(self.wrong(name, &format!("has shape {shape:?} instead of [{length}]"))),
        }
    }

    /// A matrix with so many columns, and so many rows if that is given.
    pub fn matrix(
        &self,
        name: &str,
        rows: Option<usize>,
        columns: usize,
    ) -> Result<Matrix, EmbedError> {
        let (shape, values) = self.tensor(name)?;
        match *shape {
            [n, m] if m == columns && n > 0 && rows.is_none_or(|rows| rows == n) => {
                Ok(Matrix { columns, values })
            }
            _ => Err(self.wrong(
                name,
                &format!(
                    "has shape {shape:?} instead of [{}, {columns}]",
                    rows.map_or("n".to_owned(), |rows| rows.to_string())
                ),
            )),
        }
    }

    pub fn linear(&self, name: &str, rows: usize, columns: usize) -> Result<Linear, EmbedError> {
        let weight = self.matrix(&format!("{name}.weight"), Some(rows), columns)?;
        Ok(Linear { weight, bias: self.vector(&format!("{name}.bias"), rows)? })
    }

    pub fn norm(&self, name: &str, length: usize, epsilon: f32) -> Result<Norm, EmbedError> {
        let weight = self.vector(&format!("{name}.weight"), length)?;
        Ok(Norm { weight, bias: self.vector(&format!("{name}.bias"), length)?, epsilon })
    }
}

/// A number of 16 bits (IEEE 754 binary16).
fn half(bits: u16) -> f32 {
    let sign = if bits >> 15 == 1 { -1.0 } else { 1.0 };
    let (exponent, fraction) = (i32::from(bits >> 10 & 31), f32::from(bits & 1023));
    let power = |n: i32| f32::from_bits(((n + 127) as u32) << 23);
    match exponent {
        0 => sign * fraction * power(-24),
        31 if fraction == 0.0 => sign * f32::INFINITY,
        31 => f32::NAN,
        _ => sign * (1.0 + fraction / 1024.0) * power(exponent - 15),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_are_widened() {
        for (bits, value) in [
            (0x3c00, 1.0),
            (0xc000, -2.0),
            (0x3555, 0.333_251_95),
            (0x0001, 5.960_464_5e-8),
            (0x7bff, 65504.0),
        ] {
            assert_eq!(half(bits).to_bits(), f32::to_bits(value), "{bits:x}");
        }
        assert!(half(0x7c00).is_infinite() && half(0x7e00).is_nan());
    }

    #[track_caller]
    fn refused(bytes: &[u8], because: &str) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("model.safetensors");
        std::fs::write(&path, bytes).unwrap();
        let error = Tensors::open(&path).and_then(|tensors| tensors.vector("a", 2)).unwrap_err();
        assert!(error.to_string().contains(because), "{error}");
    }

    fn file(header: &str, data: &[u8]) -> Vec<u8> {
        [&(header.len() as u64).to_le_bytes(), header.as_bytes(), data].concat()
    }

    #[test]
    fn damaged_files_are_refused_by_what_is_wrong() {
        refused(b"", "header does not end");
        refused(&u64::MAX.to_le_bytes(), "header does not end");
        refused(&file("[]", b""), "no safetensors file");
        refused(&file("{}", b""), "missing");
        let entry = |dtype: &str, shape: &str, offsets: &str| {
            format!(r#"{{"a":{{"dtype":"{dtype}","shape":{shape},"data_offsets":{offsets}}}}}"#)
        };
        refused(&file(&entry("F32", "[2]", "[0,8]"), &[0; 4]), "not within the file");
        refused(&file(&entry("F32", "[2]", "[8,0]"), &[0; 8]), "not within the file");
        refused(&file(&entry("F32", "[3]", "[0,8]"), &[0; 8]), "another size");
        refused(
            &file(&entry("F32", "[9999999999999,9999999999999]", "[0,8]"), &[0; 8]),
            "another size",
        );
        refused(&file(&entry("F32", "[1,2]", "[0,8]"), &[0; 8]), "shape [1, 2]");
        refused(&file(&entry("F32", "[2]", "[0,8]"), &[0xff; 8]), "not finite");
        refused(&file(&entry("I8", "[2]", "[0,2]"), &[0; 2]), "type I8");
    }
}
