//! [`Scanner`]: the words and signs of a condition, with their columns.

/// A place in a text.
#[derive(Clone, Debug)]
pub(super) struct Scanner<'a> {
    text: &'a str,
    /// Byte offset.
    offset: usize,
}

impl<'a> Scanner<'a> {
    pub fn new(text: &'a str) -> Self {
        Self { text, offset: 0 }
    }

    pub fn rest(&self) -> &'a str {
        &self.text[self.offset..]
    }

    /// The column, from 1, in characters.
    pub fn column(&self) -> usize {
        self.text[..self.offset].chars().count() + 1
    }

    pub fn skip_space(&mut self) {
        let rest = self.rest();
        self.offset += rest.len() - rest.trim_start().len();
    }

    pub fn at_end(&self) -> bool {
        self.rest().is_empty()
    }

    /// Takes `sign` if it comes next, after spaces.
    pub fn sign(&mut self, sign: &str) -> bool {
        self.skip_space();
        let comes = self.rest().starts_with(sign);
        if comes {
            self.offset += sign.len();
        }
        comes
    }

    /// Takes the word `word` if it comes next, whole, in any case.
    pub fn keyword(&mut self, word: &str) -> bool {
        self.skip_space();
        let comes = self.peek_word().eq_ignore_ascii_case(word);
        if comes {
            self.offset += word.len();
        }
        comes
    }

    /// Takes the letters that come next, which may be none.
    pub fn word(&mut self) -> &'a str {
        self.skip_space();
        let word = self.peek_word();
        self.offset += word.len();
        word
    }

    /// Takes characters while `wanted` says so.
    pub fn take_while(&mut self, wanted: impl Fn(char) -> bool) -> &'a str {
        let rest = self.rest();
        let end = rest.find(|c| !wanted(c)).unwrap_or(rest.len());
        self.offset += end;
        &rest[..end]
    }

    fn peek_word(&self) -> &'a str {
        let rest = self.rest();
        let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        &rest[..end]
    }
}
