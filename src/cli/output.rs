//! Standard output: buffered, with colour only on a terminal, and JSON documents.

use std::io::{self, BufWriter, IsTerminal, StdoutLock, Write};

use serde::Serialize;

/// Where results go.
pub struct Output {
    stdout: BufWriter<StdoutLock<'static>>,
    colour: bool,
}

/// Looks of a piece of text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// Headings.
    Bold,
    /// What was added, and what is right.
    Green,
    /// What was removed, and what is wrong.
    Red,
    /// What changed, and what deserves a look.
    Yellow,
    /// What is less important.
    Dim,
}

impl Output {
    /// Standard output. Colour is used on a terminal unless `NO_COLOR` is set.
    pub fn new() -> Self {
        let stdout = io::stdout();
        let no_colour = std::env::var_os("NO_COLOR").is_some_and(|value| !value.is_empty());
        let colour = stdout.is_terminal() && !no_colour;
        Self { stdout: BufWriter::new(stdout.lock()), colour }
    }

    /// `text` in a style, if there is colour.
    pub fn paint(&self, style: Style, text: &str) -> String {
        let code = match style {
            Style::Bold => 1,
            Style::Dim => 2,
            Style::Red => 31,
            Style::Green => 32,
            Style::Yellow => 33,
        };
        if self.colour { format!("\x1b[{code}m{text}\x1b[0m") } else { text.to_owned() }
    }

    /// One JSON document, indented for people.
    pub fn json(&mut self, document: &impl Serialize) -> anyhow::Result<()> {
        serde_json::to_writer_pretty(&mut self.stdout, document)?;
        writeln!(self)?;
        Ok(())
    }

    /// One JSON document on one line, for streams.
    pub fn json_line(&mut self, document: &impl Serialize) -> anyhow::Result<()> {
        serde_json::to_writer(&mut self.stdout, document)?;
        writeln!(self)?;
        Ok(())
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.stdout.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.stdout.flush()
    }
}

/// `text` without what would steer a terminal; file names and messages may hold anything.
pub fn plain(text: &str) -> String {
    text.chars().map(|c| if c.is_control() && c != '\n' { '\u{fffd}' } else { c }).collect()
}
