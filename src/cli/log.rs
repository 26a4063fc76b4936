//! `scenefold log`

use std::io::Write;
use std::ops::ControlFlow;

use clap::ValueEnum;

use super::Outcome;
use super::output::{Output, Style};
use super::source::{self, RecordingArg};
use crate::change::{Action, ChangeRecord, Modality, NodeRef, Outcome as ChangeOutcome};
use crate::document::ChangeDocument;
use crate::event::Event;
use crate::graph::NodeId;
use crate::recording::Walk;

/// Change records, newest last
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  scenefold log day.mcap
  scenefold log day.mcap --object mug            everything about mugs
  scenefold log day.mcap --object O17 --json     as JSON, a line each
  scenefold log day.mcap --rejected              what was claimed but not believed")]
pub struct Log {
    #[command(flatten)]
    recording: RecordingArg,
    /// Only changes of this object
    #[arg(long, value_name = "ID|LABEL")]
    object: Option<String>,
    /// Only changes that this modality noticed
    #[arg(long)]
    modality: Option<ModalityArg>,
    /// Only rejected changes
    #[arg(long)]
    rejected: bool,
    /// Print one JSON document per line
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum ModalityArg {
    Human,
    Action,
    Perception,
    Time,
}

/// Runs `scenefold log`.
pub fn run(args: &Log, out: &mut Output) -> anyhow::Result<Outcome> {
    let recording = source::open(&args.recording.path)?;
    let (mut result, mut found) = (Ok(()), false);
    recording.visit_events(Walk::Events, (1, u64::MAX), &mut |logged| {
        let Event::Change(record) = &logged.event else { return ControlFlow::Continue(()) };
        if args.wants(record) {
            found = true;
            result = match args.json {
                true => out.json_line(&ChangeDocument::of(record)),
                false => print(record, out),
            };
        }
        if result.is_err() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })?;
    result?;
    if let (false, Some(object)) = (found, &args.object) {
        // Silence could be taken for a misspelt name; on stderr it is no part of the answer.
        let _ = writeln!(std::io::stderr(), "no such change of {object:?}");
    }
    Ok(source::warn(&recording))
}

impl Log {
    fn wants(&self, record: &ChangeRecord) -> bool {
        let modality = self.modality.is_none_or(|modality| {
            record.claim.modality
                == match modality {
                    ModalityArg::Human => Modality::Human,
                    ModalityArg::Action => Modality::Action,
                    ModalityArg::Perception => Modality::Perception,
                    ModalityArg::Time => Modality::Time,
                }
        });
        let object = self.object.as_deref().is_none_or(|name| is_about(&record.claim.object, name));
        modality && object && !(self.rejected && record.is_applied())
    }
}

fn is_about(object: &NodeRef, name: &str) -> bool {
    match name.parse::<NodeId>() {
        Ok(id) if object.id == Some(id) => true,
        _ => object.label.as_ref().is_some_and(|label| label.same_class(name)),
    }
}

/// One change as a line for people.
pub fn print(record: &ChangeRecord, out: &mut Output) -> anyhow::Result<()> {
    let claim = &record.claim;
    let verb = match (claim.action, claim.held) {
        (Action::Removed, true) => "picked up",
        (action, _) => action.as_str(),
    };
    let mut line = format!(
        "c{:<5} {}  {:10} {verb:9} {}",
        record.seq,
        record.at,
        claim.modality.as_str(),
        claim.object
    );
    let mut part = |word: &str, node: &Option<NodeRef>| {
        if let Some(node) = node {
            line.extend([" ", word, " ", &node.to_string()]);
        }
    };
    if claim.action == Action::Removed {
        part("off", &claim.support);
        part("in", &claim.source_room);
    } else {
        part("from", &claim.source_room);
        part("to", &claim.target_room);
        part("on", &claim.support);
    }
    match &record.outcome {
        ChangeOutcome::Applied => writeln!(out, "{line}")?,
        ChangeOutcome::Rejected { reason, .. } => {
            let rejected = out.paint(Style::Red, "rejected");
            writeln!(out, "{line}\n       {rejected}: {reason}")?;
        }
    }
    Ok(())
}
