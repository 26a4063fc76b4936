//! Reading a CSV line by line, with errors that name the line.

use super::ActionsError;
use crate::graph::{Label, NodeId};

/// One line of a CSV.
#[derive(Debug)]
pub(super) struct Line<'a> {
    file: &'static str,
    number: u64,
    record: &'a csv::StringRecord,
    columns: &'a [&'static str],
}

impl Line<'_> {
    pub fn number(&self) -> u64 {
        self.number
    }

    pub fn text(&self, column: usize) -> &str {
        self.record.get(column).unwrap_or_default()
    }

    pub fn error(&self, problem: impl Into<String>) -> ActionsError {
        ActionsError::Line { file: self.file, line: self.number, problem: problem.into() }
    }

    fn wrong(&self, column: usize, mend: &str) -> ActionsError {
        let text: String = self.text(column).chars().take(40).collect();
        self.error(format!("{} is {text:?}: {mend}", self.columns[column]))
    }

    pub fn id(&self, column: usize) -> Result<u32, ActionsError> {
        let id = self.text(column).parse().ok().filter(|id| *id <= NodeId::MAX_INDEX);
        id.ok_or_else(|| self.wrong(column, "it must be a whole number from 0 to 16777215"))
    }

    /// A whole number up to `most`.
    pub fn count(&self, column: usize, most: u32) -> Result<u32, ActionsError> {
        let count = self.text(column).parse().ok().filter(|count| *count <= most);
        count.ok_or_else(|| {
            self.wrong(column, &format!("it must be a whole number from 0 to {most}"))
        })
    }

    /// A number from 0 to `most`.
    pub fn quantity(&self, column: usize, most: f64) -> Result<f64, ActionsError> {
        let number = self.text(column).parse().ok().filter(|n: &f64| (0.0..=most).contains(n));
        number.ok_or_else(|| self.wrong(column, &format!("it must be a number from 0 to {most}")))
    }

    pub fn label(&self, column: usize) -> Result<Label, ActionsError> {
        let name = self.columns[column];
        Label::new(self.text(column)).map_err(|error| self.error(format!("{name}: {error}")))
    }

    pub fn one_of<T: Copy>(&self, column: usize, known: &[(&str, T)]) -> Result<T, ActionsError> {
        let found = known.iter().find(|(word, _)| *word == self.text(column));
        found.map(|(_, value)| *value).ok_or_else(|| {
            let words: Vec<&str> = known.iter().map(|(word, _)| *word).collect();
            self.wrong(column, &format!("it must be one of {}", words.join(", ")))
        })
    }
}

/// Reads every line after the header, which must name exactly `columns`.
pub(super) fn read<T>(
    file: &'static str,
    text: &str,
    columns: &'static [&'static str],
    mut row: impl FnMut(&Line<'_>) -> Result<T, ActionsError>,
) -> Result<Vec<T>, ActionsError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(text.as_bytes());
    let damaged = |error: &csv::Error| {
        let line = error.position().map_or(0, csv::Position::line);
        let problem = match error.kind() {
            csv::ErrorKind::UnequalLengths { expected_len, len, .. } => {
                format!("it has {len} columns, the header {expected_len}")
            }
            _ => "it is not UTF-8 text".to_owned(),
        };
        ActionsError::Line { file, line, problem }
    };
    let header = reader.headers().map_err(|error| damaged(&error))?;
    if !header.iter().eq(columns.iter().copied()) {
        let found = header.iter().collect::<Vec<_>>().join(",").chars().take(200).collect();
        return Err(ActionsError::Header { file, found, expected: columns.join(",") });
    }
    let mut rows = Vec::new();
    let mut record = csv::StringRecord::new();
    while reader.read_record(&mut record).map_err(|error| damaged(&error))? {
        let number = record.position().map_or(0, csv::Position::line);
        rows.push(row(&Line { file, number, record: &record, columns })?);
    }
    Ok(rows)
}
