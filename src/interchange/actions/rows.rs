//! The rows of the log, each valid alone and none earlier than the one before.

use std::collections::BTreeMap;

use super::ActionsError;
use super::csv_rows::{self, Line};
use crate::graph::{Label, Layer, NodeId};

const COLUMNS: &[&str] =
    &["split", "day", "minute", "action", "object", "object_id", "destination", "destination_id"];

/// Two days: a script that began before midnight may end after the next.
const LAST_MINUTE: f64 = 2880.0;
/// A century, so that days in nanoseconds always fit.
const LAST_DAY: u32 = 36_500;

/// Which part of the log.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Split {
    Train,
    Test,
}

impl Split {
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Train => "train",
            Self::Test => "test",
        }
    }
}

/// One line of the log.
#[derive(Clone, Debug)]
pub(super) struct Row {
    pub split: Split,
    /// Of the split.
    pub day: u32,
    /// Of the whole log.
    pub day_overall: u32,
    pub millis: u64,
    pub is_grab: bool,
    pub object: NodeId,
    pub label: Label,
    /// Number and class of where it is put, if that is told.
    pub destination: Option<(u32, Label)>,
}

pub(super) fn read(text: &str) -> Result<Vec<Row>, ActionsError> {
    let mut labels = BTreeMap::new();
    let mut lines = Vec::new();
    let mut rows = csv_rows::read("actions", text, COLUMNS, |line| {
        lines.push(line.number());
        row(line, &mut labels)
    })?;
    let train = rows.iter().filter(|row| row.split == Split::Train);
    let before_test = train.map(|row| row.day + 1).max().unwrap_or(0);
    for row in rows.iter_mut().filter(|row| row.split == Split::Test) {
        row.day_overall = before_test + row.day;
    }
    check_order(&rows, &lines)?;
    Ok(rows)
}

fn row(line: &Line<'_>, labels: &mut BTreeMap<String, Label>) -> Result<Row, ActionsError> {
    let day = line.count(1, LAST_DAY)?;
    // To the millisecond: the minutes are fractions such as 424.857142.
    let millis = libm::round(line.quantity(2, LAST_MINUTE)? * 60_000.0) as u64;
    let is_grab = line.one_of(
        3,
        &[("grab", true), ("putback", false), ("putin", false), ("putobjback", false)],
    )?;
    let mut label = |column| -> Result<Label, ActionsError> {
        if let Some(label) = labels.get(line.text(column)) {
            return Ok(label.clone());
        }
        let label = line.label(column)?;
        labels.insert(label.as_str().to_owned(), label.clone());
        Ok(label)
    };
    let destination = match (line.text(6), line.text(7)) {
        ("", "") => None,
        _ => Some((line.id(7)?, label(6)?)),
    };
    let index = line.id(5)?;
    Ok(Row {
        split: line.one_of(0, &[("train", Split::Train), ("test", Split::Test)])?,
        day,
        day_overall: day,
        millis,
        is_grab,
        object: NodeId::new(Layer::Object, index).expect("the index was checked"),
        label: label(4)?,
        destination: destination.filter(|_| !is_grab),
    })
}

/// Rows are never sorted: a log that runs backwards is one that somebody else has to mend.
fn check_order(rows: &[Row], lines: &[u64]) -> Result<(), ActionsError> {
    for (pair, line) in rows.windows(2).zip(&lines[1.min(lines.len())..]) {
        let [before, after] = pair else { continue };
        if (after.day_overall, after.millis) < (before.day_overall, before.millis)
            || after.split < before.split
        {
            let what = if after.day_overall == before.day_overall { "minute" } else { "day" };
            let problem =
                format!("the {what} is before that of the line above: sort the log by time");
            return Err(ActionsError::Line { file: "actions", line: *line, problem });
        }
    }
    Ok(())
}
