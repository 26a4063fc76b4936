//! [`ApiKey`]: a secret that only a header is told.

use std::fmt;

/// The key that opens a server. Printed as `[key]`; not serialised.
#[derive(Clone, PartialEq, Eq)]
pub struct ApiKey(String);

/// Why a text is no key. Does not hold the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum KeyError {
    /// Nothing.
    #[error("it is empty")]
    Empty,
    /// It would not fit into a header.
    #[error("it has characters other than printable ASCII ones; is there a line break in it?")]
    Characters,
}

impl ApiKey {
    /// Takes a key as it comes from the environment; spaces around it are dropped.
    pub fn new(text: &str) -> Result<Self, KeyError> {
        let text = text.trim();
        if text.is_empty() {
            return Err(KeyError::Empty);
        }
        match text.bytes().all(|byte| byte.is_ascii_graphic()) {
            true => Ok(Self(text.to_owned())),
            false => Err(KeyError::Characters),
        }
    }

    /// The value of the header `Authorization`.
    pub(super) fn bearer(&self) -> String {
        format!("Bearer {}", self.0)
    }

    /// `text` with `[key]` wherever it quotes the key, or as much as its first or last 8 letters.
    pub(super) fn cut_out_of(&self, text: &str) -> String {
        const PART: usize = 8;
        let mut cut = text.replace(&self.0, "[key]");
        if self.0.len() >= 2 * PART {
            let (first, last) = (&self.0[..PART], &self.0[self.0.len() - PART..]);
            cut = cut.replace(first, "[key]").replace(last, "[key]");
        }
        cut
    }
}

impl fmt::Debug for ApiKey {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("[key]")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_key_is_not_shown() {
        let key = ApiKey::new(" sk-0123456789abcdefghij\n").unwrap();
        assert_eq!(format!("{key:?} {key:#?}"), "[key] [key]");
        let said = "Incorrect key: sk-0123456789abcdefghij, or sk-01234****cdefghij";
        let cut = key.cut_out_of(said);
        assert_eq!(cut, "Incorrect key: [key], or [key]****[key]");
    }

    #[test]
    fn what_is_no_key_is_refused_without_being_shown() {
        assert_eq!(ApiKey::new("  "), Err(KeyError::Empty));
        for text in ["se cret", "sec\nret", "sécret"] {
            let error = ApiKey::new(text).unwrap_err();
            assert_eq!(error, KeyError::Characters);
            assert!(!format!("{error} {error:?}").contains(text));
        }
    }
}
