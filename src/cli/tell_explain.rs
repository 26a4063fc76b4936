//! The grounding of a sentence, drawn under its words.

use std::io::Write;

use super::output::{Output, Style, plain};
use crate::change::NodeRef;
use crate::event::Span;

/// Longest sentence under which words are marked.
const WIDTH: usize = 160;

/// Draws, for each statement, the sentence with its words marked, and what each was taken to mean.
pub fn draw(sentence: &str, statements: &[&[Span]], out: &mut Output) -> anyhow::Result<()> {
    for spans in statements.iter().filter(|spans| !spans.is_empty()) {
        if sentence.chars().count() <= WIDTH && !sentence.contains('\n') {
            writeln!(out, "\n  {}", plain(sentence))?;
            let marks = marks(sentence, spans);
            writeln!(out, "  {}", out.paint(Style::Dim, marks.trim_end()))?;
        }
        for span in *spans {
            let words = sentence.get(span.start as usize..span.end as usize).unwrap_or_default();
            let words = if words.is_empty() { "(said before)" } else { words };
            let role = out.paint(Style::Bold, &format!("{:<9}", span.role));
            writeln!(out, "  {role} {:?}: {}", plain(words), meaning(span))?;
        }
    }
    Ok(())
}

fn meaning(span: &Span) -> String {
    let names = |nodes: &[NodeRef]| {
        let shown: Vec<String> = nodes.iter().take(6).map(ToString::to_string).collect();
        let more =
            if nodes.len() > 6 { format!(" and {} more", nodes.len() - 6) } else { String::new() };
        shown.join(", ") + &more
    };
    let others = span.candidates.len() > span.chosen.len();
    let of = if others { format!(" of {}", names(&span.candidates)) } else { String::new() };
    match span.chosen.is_empty() {
        true if span.candidates.is_empty() => span.why.clone(),
        true => format!("{}: {}", span.why, names(&span.candidates)),
        false => format!("{}{of} ({})", names(&span.chosen), span.why),
    }
}

/// A line of `~` under the words of the spans.
fn marks(sentence: &str, spans: &[Span]) -> String {
    let marked =
        |at: usize| spans.iter().any(|span| (span.start as usize..span.end as usize).contains(&at));
    sentence.char_indices().map(|(at, _)| if marked(at) { '~' } else { ' ' }).collect()
}
