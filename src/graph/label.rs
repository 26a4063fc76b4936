//! [`Label`]: the name of a semantic class, cheap to copy.

use std::fmt;
use std::sync::Arc;

/// The semantic class of a node in human language, such as `tv remote`; the paper's `l ∈ L`.
///
/// Never empty, at most 200 bytes, without control characters (it is printed on terminals).
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Label(Arc<str>);

const MAX_BYTES: usize = 200;

impl Label {
    /// Takes `text` as it is, if it is a label.
    pub fn new(text: &str) -> Result<Self, LabelError> {
        let error = |problem| LabelError { text: text.chars().take(40).collect(), problem };
        if text.trim().is_empty() {
            Err(error("it is empty"))
        } else if text.len() > MAX_BYTES {
            Err(error("it is longer than 200 bytes"))
        } else if text.chars().any(char::is_control) {
            Err(error("it has control characters"))
        } else {
            Ok(Self(text.into()))
        }
    }

    /// The text.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Whether two labels name the same class when case, `_`, `-` and spaces are set aside, so
    /// that `tv_remote`, `TV remote` and `tvremote` are one.
    pub fn same_class(&self, other: &str) -> bool {
        self.as_str() == other || class_key(self.as_str()) == class_key(other)
    }

    /// What labels of the same class have in common: see [`Label::same_class`].
    pub fn class_key(&self) -> String {
        class_key(self.as_str())
    }
}

/// The text of a label without case, `_`, `-` and spaces: equal for labels of the same class.
pub fn class_key(text: &str) -> String {
    let kept = text.chars().filter(|c| !matches!(c, '_' | '-' | ' '));
    kept.flat_map(char::to_lowercase).collect()
}

impl fmt::Display for Label {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.0)
    }
}

impl fmt::Debug for Label {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(&self.0, f)
    }
}

/// Why a text is no label.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{text:?} cannot be a label: {problem}")]
pub struct LabelError {
    /// The beginning of what was given.
    text: String,
    problem: &'static str,
}
