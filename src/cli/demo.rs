//! `scenefold demo`, also what `scenefold` alone does

use std::io::Write;

use super::Outcome;
use super::output::{Output, Style};
use crate::geometry::Tolerance;
use crate::history::{Diff, Expr, Selector, first_holding, why};
use crate::recording::{RecordError, Recording, reprocess};
use crate::time::At;
use crate::updater::Config;

/// A tour on a built-in recording: a real household's day in a simulated apartment
#[derive(Debug, Default, clap::Args)]
#[command(after_help = "\
Examples:
  scenefold
  scenefold demo | less -R")]
pub struct Demo {}

/// One day of household A of HOMER+ in a VirtualHome apartment; see `recordings/`.
const DAY: &[u8] = include_bytes!("../../recordings/household_day.mcap");
const OBJECT: &str = "mug";

/// Runs `scenefold demo`.
pub fn run(_: &Demo, out: &mut Output) -> anyhow::Result<Outcome> {
    let recording = Recording::from_bytes("household_day.mcap", DAY.to_vec())?;
    contents(&recording, out)?;
    changed(&recording, out)?;
    audited(&recording, out)?;
    bisected(&recording, out)?;
    let outcome = proven(&recording, out)?;
    heading(out, "Try it yourself")?;
    for command in [
        "scenefold replay recordings/household_day.mcap --at 8h20m",
        "scenefold why recordings/household_day.mcap toothbrush",
        "scenefold --help",
    ] {
        writeln!(out, "  {command}")?;
    }
    Ok(outcome)
}

fn heading(out: &mut Output, text: &str) -> anyhow::Result<()> {
    let text = out.paint(Style::Bold, text);
    writeln!(out, "\n{text}")?;
    Ok(())
}

fn contents(recording: &Recording, out: &mut Output) -> anyhow::Result<()> {
    let heading =
        "A day in a household, as its robot recorded it (built in; recordings/household_day.mcap)";
    writeln!(out, "{}", out.paint(Style::Bold, heading))?;
    let (summary, start) = (recording.summary(), recording.state_at(At::Start, 1)?);
    writeln!(
        out,
        "  {} objects in {} rooms; {} inputs, {} change records, {} primitives",
        start.graph().object_count(),
        start.graph().rooms().count(),
        summary.messages - summary.changes * 2 - 1,
        summary.changes,
        summary.primitives
    )?;
    Ok(())
}

fn changed(recording: &Recording, out: &mut Output) -> anyhow::Result<()> {
    heading(
        out,
        "What was elsewhere in the evening      scenefold diff REC --from start --to end",
    )?;
    let (from, to) = (recording.state_at(At::Start, 1)?, recording.state_at(At::End, 1)?);
    let diff = Diff::between(from.graph(), to.graph(), &Tolerance::EXACT);
    indented(out, &diff.to_string())
}

fn audited(recording: &Recording, out: &mut Output) -> anyhow::Result<()> {
    heading(
        out,
        &format!("How the {OBJECT} got where it is             scenefold why REC {OBJECT}"),
    )?;
    let life = why(recording, u64::MAX, &Selector::Label(OBJECT.to_owned()))?;
    indented(out, &life.to_string())
}

fn bisected(recording: &Recording, out: &mut Output) -> anyhow::Result<()> {
    let condition = format!("absent({OBJECT})");
    heading(
        out,
        &format!(
            "When it first went missing             scenefold bisect REC --when '{condition}'"
        ),
    )?;
    let expr: Expr = condition.parse()?;
    if let Some(hit) = first_holding(recording, &expr)? {
        let change = hit.change.map_or(String::new(), |seq| format!(", by change c{seq}"));
        writeln!(out, "  after event #{} at {}{change}", hit.order, hit.at)?;
    }
    Ok(())
}

fn proven(recording: &Recording, out: &mut Output) -> anyhow::Result<Outcome> {
    heading(
        out,
        "Does it replay to the same belief       scenefold verify REC; scenefold reprocess REC",
    )?;
    let config = recording.meta().map_or_else(Config::default, |meta| meta.config.clone());
    let again = reprocess(recording, &config, &mut |_, _| Ok::<_, RecordError>(()))?;
    let replayed = recording.state_at(At::End, 1)?.graph().hash();
    let derived = again.updater.graph().hash();
    let same = replayed == derived && again.different == 0;
    let verdict = if same { "the same" } else { "different" };
    let verdict = out.paint(if same { Style::Green } else { Style::Red }, verdict);
    writeln!(out, "  by folding the recorded primitives   {replayed}")?;
    writeln!(out, "  by running the detectors again       {derived}   {verdict}")?;
    Ok(if same { Outcome::Clean } else { Outcome::Findings })
}

fn indented(out: &mut Output, text: &str) -> anyhow::Result<()> {
    for line in text.lines() {
        writeln!(out, "  {line}")?;
    }
    Ok(())
}
