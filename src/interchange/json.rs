//! Reading JSON of others by hand: every complaint names the place, such as `objects[3].size[1]`.
//!
//! Also the JSON form of poses and sizes. Knows nothing of any one format.

// What serde calls with a reference takes one.
#![allow(clippy::ref_option, clippy::trivially_copy_pass_by_ref)]

use std::fmt::Display;

use serde::{Serialize, Serializer};
use serde_json::Value;

use crate::document::PoseDocument;
use crate::geometry::{Pose, Size};
use crate::graph::PoseSource;

/// A place in a JSON text that is not as it must be.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{path}: {problem}")]
pub struct JsonError {
    /// Where: `objects[3].size[1]`, or a line and a column.
    pub path: String,
    /// What is wrong, and how to mend it.
    pub problem: String,
}

/// Reads a JSON text.
pub(super) fn parse(text: &str) -> Result<Value, JsonError> {
    serde_json::from_str(text).map_err(|error| JsonError {
        path: format!("line {} column {}", error.line(), error.column()),
        problem: "the text is not JSON here; is the file complete?".to_owned(),
    })
}

/// A value and the way to it.
#[derive(Clone, Debug)]
pub(super) struct At<'a> {
    pub value: &'a Value,
    path: String,
}

impl<'a> At<'a> {
    pub fn root(value: &'a Value) -> Self {
        Self { value, path: String::new() }
    }

    pub fn error(&self, problem: impl Display) -> JsonError {
        let path = if self.path.is_empty() { "the document" } else { &self.path };
        JsonError { path: path.to_owned(), problem: problem.to_string() }
    }

    fn expected(&self, what: &str) -> JsonError {
        self.error(format!("{} must be {what}", brief(self.value)))
    }

    fn child(&self, value: &'a Value, name: &str) -> Self {
        let dot = if self.path.is_empty() { "" } else { "." };
        Self { value, path: format!("{}{dot}{name}", self.path) }
    }

    /// The field, unless it is missing or null.
    pub fn optional(&self, name: &str) -> Result<Option<Self>, JsonError> {
        let fields = self.value.as_object().ok_or_else(|| self.expected("an object {…}"))?;
        let value = fields.get(name).filter(|value| !value.is_null());
        Ok(value.map(|value| self.child(value, name)))
    }

    pub fn field(&self, name: &str) -> Result<Self, JsonError> {
        self.optional(name)?.ok_or_else(|| self.error(format!("the field {name:?} is missing")))
    }

    /// Refuses fields of other names: a misspelt one would silently be lost.
    pub fn only(&self, names: &[&str]) -> Result<(), JsonError> {
        let fields = self.value.as_object().ok_or_else(|| self.expected("an object {…}"))?;
        match fields.iter().find(|(name, _)| !names.contains(&name.as_str())) {
            Some((name, value)) => {
                let known = names.join(", ");
                Err(self.child(value, name).error(format!("unknown field; known are {known}")))
            }
            None => Ok(()),
        }
    }

    pub fn items(&self) -> Result<impl Iterator<Item = Self>, JsonError> {
        let items = self.value.as_array().ok_or_else(|| self.expected("an array […]"))?;
        let path = self.path.clone();
        let item = move |(n, value)| Self { value, path: format!("{path}[{n}]") };
        Ok(items.iter().enumerate().map(item))
    }

    /// The items of an array field; none if it is missing.
    pub fn list(&self, name: &str) -> Result<Vec<Self>, JsonError> {
        self.optional(name)?.map_or(Ok(Vec::new()), |list| Ok(list.items()?.collect()))
    }

    pub fn text(&self) -> Result<&'a str, JsonError> {
        self.value.as_str().ok_or_else(|| self.expected("a text \"…\""))
    }

    /// Whole numbers never pass through a float: ids are beyond 2⁵³.
    pub fn u64(&self) -> Result<u64, JsonError> {
        self.value.as_u64().ok_or_else(|| self.expected("a whole number from 0 to 2^64-1"))
    }

    pub fn f64(&self) -> Result<f64, JsonError> {
        self.value.as_f64().ok_or_else(|| self.expected("a number"))
    }

    pub fn triple(&self) -> Result<[f64; 3], JsonError> {
        let numbers = self.items()?.map(|item| item.f64()).collect::<Result<Vec<_>, _>>()?;
        numbers.try_into().map_err(|_| self.expected("three numbers"))
    }

    /// (w, x, y, z) from `{"w":…,"x":…,"y":…,"z":…}`.
    pub fn quaternion(&self) -> Result<[f64; 4], JsonError> {
        let part = |name| self.field(name)?.f64();
        Ok([part("w")?, part("x")?, part("y")?, part("z")?])
    }

    /// A text that is something.
    pub fn parsed<T: std::str::FromStr<Err: Display>>(&self) -> Result<T, JsonError> {
        self.text()?.parse().map_err(|error| self.error(error))
    }

    /// A box side by side, so that the error names the side.
    pub fn size(&self) -> Result<Size, JsonError> {
        let sides = self.triple()?;
        for (side, item) in sides.iter().zip(self.items()?) {
            Size::new(*side, 1.0, 1.0).map_err(|error| match error {
                crate::geometry::GeometryError::NotPositive { value, .. } => {
                    item.error(format!("a box side of {value} must be positive, in metres"))
                }
                other => item.error(other),
            })?;
        }
        let [w, h, d] = sides;
        Size::new(w, h, d).map_err(|error| self.error(error))
    }
}

/// The beginning of a value.
fn brief(value: &Value) -> String {
    match value {
        Value::Array(items) => format!("an array of {}", items.len()),
        Value::Object(_) => "an object {…}".to_owned(),
        other => other.to_string().chars().take(40).collect(),
    }
}

/// Writes an optional value as its text.
pub(super) fn shown<T: Display, S: Serializer>(
    value: &Option<T>,
    to: S,
) -> Result<S::Ok, S::Error> {
    match value {
        Some(value) => to.collect_str(value),
        None => to.serialize_none(),
    }
}

/// Writes an optional pose as `{position, orientation}`.
pub(super) fn pose<S: Serializer>(pose: &Option<Pose>, to: S) -> Result<S::Ok, S::Error> {
    pose.as_ref().map(PoseDocument::of).serialize(to)
}

/// Writes an optional size as `[w, h, d]`.
pub(super) fn size<S: Serializer>(size: &Option<Size>, to: S) -> Result<S::Ok, S::Error> {
    size.map(Size::metres).serialize(to)
}

/// Writes how a pose is known.
pub(super) fn source<S: Serializer>(source: &Option<PoseSource>, to: S) -> Result<S::Ok, S::Error> {
    source.map(PoseSource::as_str).serialize(to)
}
