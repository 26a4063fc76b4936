//! `scenefold bisect`

use std::io::Write;
use std::ops::ControlFlow;

use super::output::Output;
use super::progress::Counted;
use super::replay::state_at;
use super::source::{self, RecordingArg};
use super::{Outcome, UsageError};
use crate::event::Event;
use crate::history::{BisectDocument, Expr, Hit, first_holding};
use crate::recording::{Recording, Walk};
use crate::time::At;

/// The first event after which a condition holds
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Conditions: present(X), absent(X), held(X), in(X, ROOM), on(X, SUPPORT), count(X) OP N,
probability(X) OP P, objects OP N, rooms OP N, changes OP N, with `and`, `or`, `not` and
parentheses; X is an id or a label, OP one of < <= > >= = !=. absent(mug) holds when some mug
that was ever known is not there; what is in the gripper is not there.

Examples:
  scenefold bisect day.mcap --when 'absent(mug)'
  scenefold bisect day.mcap --when 'in(tv remote, living room) and not held(mug)'
  scenefold bisect day.mcap --when 'probability(O17) < 0.5' --json
Exits with 3 if it never holds.")]
pub struct Bisect {
    #[command(flatten)]
    recording: RecordingArg,
    /// The condition
    #[arg(long, value_name = "EXPR")]
    when: String,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

/// Runs `scenefold bisect`.
pub fn run(args: &Bisect, out: &mut Output) -> anyhow::Result<Outcome> {
    let expr: Expr = args.when.parse().map_err(|error| UsageError(format!("--when: {error}")))?;
    let recording = source::open(&args.recording.path)?;
    let hit = first_holding(&Counted::new(&recording), &expr)?;
    if hit.is_none() {
        check_names(&recording, &expr)?;
    }
    if args.json {
        out.json(&BisectDocument::of(hit.as_ref()))?;
    } else {
        print(&recording, hit.as_ref(), out)?;
    }
    let outcome = source::warn(&recording);
    Ok(if hit.is_none() { Outcome::Findings } else { outcome })
}

/// A condition on what nobody ever heard of never holds, but that is not what was asked.
fn check_names(recording: &Recording, expr: &Expr) -> anyhow::Result<()> {
    let state = state_at(recording, At::End)?;
    match expr.unknown_names(&state.world).first() {
        Some(who) => Err(UsageError(format!(
            "--when: nothing in the recording is called {who}; see `scenefold replay`"
        ))
        .into()),
        None => Ok(()),
    }
}

fn print(recording: &Recording, hit: Option<&Hit>, out: &mut Output) -> anyhow::Result<()> {
    let Some(hit) = hit else {
        writeln!(out, "it never holds")?;
        return Ok(());
    };
    writeln!(out, "first holds after event #{} at {}", hit.order, hit.at)?;
    let Some(seq) = hit.change else { return Ok(()) };
    // The change record stands just before the transaction it caused.
    let mut found = None;
    let around = (hit.order.saturating_sub(64), hit.order);
    recording.visit_events(Walk::Events, around, &mut |logged| {
        if let Event::Change(record) = &logged.event
            && record.seq == seq
        {
            found = Some(record.clone());
        }
        ControlFlow::Continue(())
    })?;
    match found {
        Some(record) => super::log::print(&record, out),
        None => Ok(writeln!(out, "by change c{seq}")?),
    }
}
