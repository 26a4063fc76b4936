//! `WordPiece`: a text to the numbers of its pieces.
//!
//! Lower case and without accents where the model wants that; split at white space, punctuation
//! and around each Chinese character; then for each word the longest piece of the vocabulary
//! that it begins with, again and again (Devlin et al., "BERT", 2019, arXiv:1810.04805).

use std::collections::BTreeMap;
use std::path::Path;

use unicode_normalization::UnicodeNormalization;
use unicode_normalization::char::is_combining_mark;

use super::{EmbedError, json, read};

/// Letters of a word beyond which it is unknown.
const MAX_LETTERS: usize = 100;

/// A vocabulary of word pieces.
pub(super) struct Tokenizer {
    pieces: BTreeMap<String, u32>,
    lower_case: bool,
    unknown: u32,
    first: u32,
    last: u32,
}

impl Tokenizer {
    pub fn load(folder: &Path) -> Result<Self, EmbedError> {
        let (path, pieces) = vocabulary(folder)?;
        let config = json(&folder.join("tokenizer_config.json"))?;
        let lower_case = config.and_then(|config| config.get("do_lower_case")?.as_bool());
        let piece = |name: &str| {
            let what =
                || EmbedError::new(&path, format!("the vocabulary has no {name}: not BERT's"));
            pieces.get(name).copied().ok_or_else(what)
        };
        let (unknown, first, last) = (piece("[UNK]")?, piece("[CLS]")?, piece("[SEP]")?);
        Ok(Self { pieces, lower_case: lower_case.unwrap_or(true), unknown, first, last })
    }

    /// The numbers of the pieces of `text`, at most `limit` with those that mark its ends.
    pub fn encode(&self, text: &str, limit: usize) -> Vec<u32> {
        let words = self.words(text);
        let pieces = words.iter().flat_map(|word| self.split(word));
        let inner = pieces.take(limit.saturating_sub(2));
        std::iter::once(self.first).chain(inner).chain([self.last]).collect()
    }

    fn words(&self, text: &str) -> Vec<String> {
        let cleaned = text.chars().filter(|c| *c != '\u{fffd}').map(|c| match c {
            c if c.is_whitespace() || c.is_control() => ' ',
            c => c,
        });
        let normal: String = match self.lower_case {
            true => cleaned
                .nfd()
                .filter(|c| !is_combining_mark(*c))
                .flat_map(char::to_lowercase)
                .collect(),
            false => cleaned.collect(),
        };
        let mut words = vec![String::new()];
        for c in normal.chars() {
            if c.is_whitespace() {
                words.push(String::new());
            } else if stands_alone(c) {
                words.extend([c.to_string(), String::new()]);
            } else if let Some(word) = words.last_mut() {
                word.push(c);
            }
        }
        words.retain(|word| !word.is_empty());
        words
    }

    fn split(&self, word: &str) -> Vec<u32> {
        let mut ends: Vec<usize> = word.char_indices().skip(1).map(|(at, _)| at).collect();
        ends.push(word.len());
        if ends.len() > MAX_LETTERS {
            return vec![self.unknown];
        }
        let (mut pieces, mut start) = (Vec::new(), 0);
        while start < word.len() {
            let longest = ends.iter().rev().take_while(|end| **end > start).find_map(|end| {
                let mark = if start == 0 { "" } else { "##" };
                let piece = self.pieces.get(&format!("{mark}{}", &word[start..*end]))?;
                Some((*end, *piece))
            });
            let Some((end, piece)) = longest else { return vec![self.unknown] };
            pieces.push(piece);
            start = end;
        }
        pieces
    }
}

/// From `vocab.txt`, a piece a line, or else from `tokenizer.json`.
fn vocabulary(folder: &Path) -> Result<(std::path::PathBuf, BTreeMap<String, u32>), EmbedError> {
    let path = folder.join("vocab.txt");
    if let Some(bytes) = read(&path)? {
        let text = String::from_utf8(bytes).map_err(|error| EmbedError::new(&path, error))?;
        let pieces = text.lines().zip(0..).map(|(piece, n)| (piece.to_owned(), n)).collect();
        return Ok((path, pieces));
    }
    let path = folder.join("tokenizer.json");
    let document = json(&path)?.ok_or_else(|| {
        EmbedError::new(folder, "there is neither vocab.txt nor tokenizer.json in it")
    })?;
    let Some(serde_json::Value::Object(entries)) = document.pointer("/model/vocab") else {
        return Err(EmbedError::new(&path, "its model has no vocabulary of word pieces"));
    };
    let number = |(piece, n): (&String, &serde_json::Value)| {
        Some((piece.clone(), u32::try_from(n.as_u64()?).ok()?))
    };
    let pieces = entries.iter().map(number).collect::<Option<_>>();
    let pieces = pieces.ok_or_else(|| EmbedError::new(&path, "a piece has no number"))?;
    Ok((path, pieces))
}

/// Punctuation, and what Chinese and Japanese write without spaces.
fn stands_alone(c: char) -> bool {
    let chinese = matches!(c,
        '\u{4e00}'..='\u{9fff}' | '\u{3400}'..='\u{4dbf}' | '\u{20000}'..='\u{2a6df}'
        | '\u{2a700}'..='\u{2ceaf}' | '\u{f900}'..='\u{faff}' | '\u{2f800}'..='\u{2fa1f}');
    let punctuation = matches!(c,
        '\u{a1}' | '\u{a7}' | '\u{ab}' | '\u{b6}' | '\u{b7}' | '\u{bb}' | '\u{bf}'
        | '\u{2010}'..='\u{2027}' | '\u{2030}'..='\u{205e}' | '\u{3001}'..='\u{3003}'
        | '\u{3008}'..='\u{3011}' | '\u{3014}'..='\u{301f}');
    c.is_ascii_punctuation() || chinese || punctuation
}

#[cfg(test)]
mod tests {
    use super::*;

    const VOCABULARY: [&str; 12] = [
        "[PAD]", "[UNK]", "[CLS]", "[SEP]", "mug", "tea", "##pot", "##s", "cafe", "'", "杯",
        "tea##",
    ];

    #[track_caller]
    fn check(text: &str, pieces: &[&str]) {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("vocab.txt"), VOCABULARY.join("\n")).unwrap();
        let tokenizer = Tokenizer::load(folder.path()).unwrap();
        let found = tokenizer.encode(text, 8);
        let found: Vec<&str> = found.iter().map(|n| VOCABULARY[*n as usize]).collect();
        assert_eq!(found, [&["[CLS]"], pieces, &["[SEP]"]].concat(), "{text}");
    }

    #[test]
    fn a_text_is_split_into_the_longest_pieces() {
        check("Teapots", &["tea", "##pot", "##s"]);
        check("mug, teapot", &["mug", "[UNK]", "tea", "##pot"]);
        check("CAFÉ's", &["cafe", "'", "[UNK]"]);
        check("mug杯mug", &["mug", "杯", "mug"]);
        check("potmug", &["[UNK]"]);
        check(" \t\u{1b} ", &[]);
        check(&"mug ".repeat(50), &["mug"; 6]);
        check(&"s".repeat(101), &["[UNK]"]);
    }

    #[test]
    fn a_vocabulary_is_read_from_tokenizer_json_too() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("tokenizer.json");
        let load = |text: &str| {
            std::fs::write(&path, text).unwrap();
            Tokenizer::load(folder.path())
        };
        let good = r#"{"model":{"vocab":{"[UNK]":7,"[CLS]":8,"[SEP]":9,"mug":1}}}"#;
        assert_eq!(load(good).unwrap().encode("mug x", 9), [8, 1, 7, 9]);
        let error = |text: &str| load(text).err().unwrap().to_string();
        assert!(error(r#"{"model":{"vocab":{"mug":1}}}"#).contains("[UNK]"));
        assert!(error(r#"{"model":{"vocab":{"mug":"a"}}}"#).contains("no number"));
        assert!(error(r#"{"model":{}}"#).contains("no vocabulary"));
        assert!(error("nonsense").contains("tokenizer.json"));
        std::fs::remove_file(&path).unwrap();
        let missing = Tokenizer::load(folder.path()).err().unwrap().to_string();
        assert!(missing.contains("neither"));
    }
}
