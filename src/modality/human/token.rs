//! From text to words with their places in it, and to sentences.

/// A word, number or punctuation mark.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Token {
    /// Lower case, with a plain apostrophe.
    pub text: String,
    /// Bytes of the text, `start..end`.
    pub span: (usize, usize),
    /// Whether it is a word or a number, as opposed to a comma.
    pub word: bool,
    /// Whether it began with a capital letter.
    pub capital: bool,
}

impl Token {
    /// Whether it is this word or mark.
    pub fn is(&self, text: &str) -> bool {
        self.text == text
    }
}

/// Words up to a full stop, a line's end or the like.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Sentence {
    pub tokens: Vec<Token>,
    /// It ends with a question mark.
    pub question: bool,
    /// Part of it stands in quotes: somebody else's words, or a name.
    pub quoted: bool,
}

/// Whether `text` holds what nobody says: control characters, or the marks of markup and code.
pub(super) fn is_no_speech(text: &str) -> bool {
    let code = |c: char| matches!(c, '{' | '}' | '[' | ']' | '<' | '>' | '\\' | '`' | '=' | '|' | '^' | '~' | '$');
    text.chars().any(|c| code(c) || (c.is_control() && !matches!(c, '\n' | '\r' | '\t')))
}

/// The sentences of `text`, in order; those without words are left out.
pub(super) fn sentences(text: &str) -> impl Iterator<Item = Sentence> + '_ {
    let mut rest = 0;
    std::iter::from_fn(move || {
        while rest < text.len() {
            let sentence = next_sentence(text, &mut rest);
            if sentence.tokens.iter().any(|token| token.word) {
                return Some(sentence);
            }
        }
        None
    })
}

fn next_sentence(text: &str, from: &mut usize) -> Sentence {
    let mut sentence = Sentence::default();
    let mut at = *from;
    while let Some(c) = text[at..].chars().next() {
        let after = at + c.len_utf8();
        if is_word_char(c) {
            let end = word_end(text, at);
            push_word(&mut sentence.tokens, text, at, end);
            at = end;
            continue;
        }
        at = after;
        match c {
            '?' => sentence.question = true,
            '"' | '\u{201c}' | '\u{201d}' | '\u{ab}' | '\u{bb}' => sentence.quoted = true,
            ',' | ':' | '(' | ')' | '\u{2014}' | '\u{2013}' | '-' => push_comma(&mut sentence.tokens, after),
            '&' => push(&mut sentence.tokens, "&", (at - 1, at), true),
            _ => {}
        }
        let again = text[at..].starts_with(['?', '!', '.']);
        if matches!(c, '.' | '!' | '?' | ';' | '\n' | '\u{2026}') && !again {
            break;
        }
    }
    *from = at;
    sentence
}

fn is_word_char(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

fn is_apostrophe(c: char) -> bool {
    matches!(c, '\'' | '\u{2019}' | '\u{2018}')
}

/// The end of the word that begins at `at`: hyphens, apostrophes and points join what stands on
/// both sides of them.
fn word_end(text: &str, at: usize) -> usize {
    let mut end = at;
    let mut chars = text[at..].chars().peekable();
    while let Some(c) = chars.next() {
        let next = chars.peek().copied();
        let digits = c == '.' && text[..end].ends_with(|c: char| c.is_ascii_digit());
        let joins = is_apostrophe(c) || c == '-' || digits;
        let goes_on = next.is_some_and(|n| is_word_char(n) && (!digits || n.is_ascii_digit()));
        if !is_word_char(c) && !(joins && goes_on) {
            break;
        }
        end += c.len_utf8();
    }
    end
}

fn push(tokens: &mut Vec<Token>, text: &str, span: (usize, usize), word: bool) {
    let capital = text.starts_with(char::is_uppercase);
    let text = text.chars().map(|c| if is_apostrophe(c) { '\'' } else { c });
    let text = text.flat_map(char::to_lowercase).collect();
    tokens.push(Token { text, span, word, capital });
}

fn push_comma(tokens: &mut Vec<Token>, end: usize) {
    if tokens.last().is_some_and(|token| token.word) {
        push(tokens, ",", (end - 1, end), false);
    }
}

/// Splits "didn't" into "did" and "n't", "it's" into "it" and "'s".
fn push_word(tokens: &mut Vec<Token>, text: &str, start: usize, end: usize) {
    let word = &text[start..end];
    let plain: String = word.chars().map(|c| if is_apostrophe(c) { '\'' } else { c }).collect();
    let low = plain.to_lowercase();
    let bytes_of_apostrophe = word.chars().find(|c| is_apostrophe(*c)).map_or(1, char::len_utf8);
    let tail = if low.ends_with("n't") && low.len() > 3 {
        2 + bytes_of_apostrophe
    } else if let Some(suffix) = ["s", "re", "ve", "m", "ll", "d"]
        .iter()
        .find(|suffix| low.strip_suffix(**suffix).is_some_and(|rest| rest.len() > 1 && rest.ends_with('\'')))
    {
        suffix.len() + bytes_of_apostrophe
    } else {
        0
    };
    let split = end - tail;
    if tail == 0 || !text.is_char_boundary(split) || split <= start {
        push(tokens, word, (start, end), true);
        return;
    }
    push(tokens, &text[start..split], (start, split), true);
    push(tokens, &text[split..end], (split, end), true);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check_words(text: &str, words: &str) {
        let found: Vec<String> = sentences(text)
            .map(|it| it.tokens.iter().map(|t| t.text.clone()).collect::<Vec<_>>().join(" "))
            .collect();
        assert_eq!(found.join(" / "), words);
        for token in sentences(text).flat_map(|it| it.tokens) {
            assert!(text.get(token.span.0..token.span.1).is_some(), "{token:?}");
        }
    }

    #[test]
    fn words_marks_and_sentences_are_told_apart() {
        check_words("I didn't. It's here!", "i did n't / it 's here");
        check_words("I ate it, the cup\u{2019}s gone", "i ate it , the cup 's gone");
        check_words("at 3.5 m. End", "at 3.5 m / end");
        check_words("bath-tub - now", "bath-tub , now");
        check_words("...\n\n?!", "");
        check_words("\u{1f600} \u{e9}t\u{e9} 2 mugs", "\u{e9}t\u{e9} 2 mugs");
        check_words("can't we'll I've", "ca n't we 'll i 've");
    }
}
