//! `scenefold learn-decay`

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;

use super::Outcome;
use super::output::{Output, Style};
use super::progress::Counted;
use super::source;
use crate::learn::{Histories, LearnOptions, Learned, histories, learn, unify};
use crate::modality::time::{HumanDuration, half_life_s};
use crate::recording::Recording;
use crate::time::{At, Span, Stamp};

/// Learn from recordings how long things stay where they are
#[derive(Debug, clap::Args)]
#[command(after_help = "\
For every class of things that can move: λ of the paper's sigmoid with its 95 % interval, rates
of leaving and coming back, and where it is by the hour of the day (UTC). A thing may have moved
at any time between two looks, or not yet; classes with few data lean on all the others. In a
recording that tells of a camera nothing is known between and after looks; any other is taken
to tell of every change.

Examples:
  scenefold learn-decay week.mcap -o decay.json
  scenefold learn-decay a.mcap b.mcap --until 65d -o decay.json
  scenefold replay week.mcap --decay decay.json --time-model birth-death
Exits with 1 if there is nothing to learn from.")]
pub struct LearnDecay {
    /// Recordings: MCAP files or folders of segments
    #[arg(value_name = "REC", required = true)]
    recordings: Vec<PathBuf>,
    /// Write what was learned to this file
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Learn only from what was recorded up to this point
    #[arg(long, value_name = "AT", default_value = "end")]
    until: At,
    /// Never compare across midnight: every day begins anew
    #[arg(long)]
    same_day: bool,
    /// After how long places are compared
    #[arg(long, value_name = "SPANS", value_delimiter = ',')]
    gaps: Vec<Span>,
    /// Print what is written to the file, instead of a table
    #[arg(long)]
    json: bool,
}

/// Runs `scenefold learn-decay`.
pub fn run(args: &LearnDecay, out: &mut Output) -> anyhow::Result<Outcome> {
    let (logs, until, outcome) = read_all(&args.recordings, args.until)?;
    let mut options = LearnOptions { until, ..LearnOptions::default() };
    options.plan.same_day = args.same_day;
    if !args.gaps.is_empty() {
        options.plan.gaps = gaps(&args.gaps)?;
    }
    if let Some(name) = args.out.as_deref().and_then(Path::file_name) {
        options.name = name.to_string_lossy().into_owned();
    }
    let mut learned = learn(&logs, &options)?;
    let names = args.recordings.iter().map(|path| file_name(path));
    learned.learned_from = names.collect();
    let json = learned.to_json();
    if let Some(path) = &args.out {
        std::fs::write(path, format!("{json}\n")).with_context(|| path.display().to_string())?;
    }
    if args.json {
        writeln!(out, "{json}")?;
    } else {
        print(&learned, out)?;
    }
    Ok(outcome)
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().into_owned()
}

/// Spans as gaps: they must rise, from above 0.
pub fn gaps(spans: &[Span]) -> anyhow::Result<Vec<u64>> {
    let gaps: Vec<u64> = spans.iter().map(|span| span.0).collect();
    if gaps.first() == Some(&0) || !gaps.is_sorted_by(|a, b| a < b) {
        let what = "--gaps: give spans above 0 that rise, such as 1h,2h,4h,8h";
        return Err(super::UsageError(what.to_owned()).into());
    }
    Ok(gaps)
}

/// The histories of recordings, and the instant that `until` means in each.
pub fn read_all(
    paths: &[PathBuf],
    until: At,
) -> anyhow::Result<(Vec<Histories>, Vec<Option<Stamp>>, Outcome)> {
    let (mut logs, mut ends, mut worst) = (Vec::new(), Vec::new(), Outcome::Clean);
    for (number, path) in (0..).zip(paths) {
        let recording = source::open(path)?;
        let named = || path.display().to_string();
        logs.push(histories(&Counted::new(&recording), number).with_context(named)?);
        ends.push(instant(&recording, until).with_context(named)?);
        if source::warn(&recording) == Outcome::Findings {
            worst = Outcome::Findings;
        }
    }
    unify(&mut logs);
    Ok((logs, ends, worst))
}

/// The instant of a point; none for the end.
fn instant(recording: &Recording, at: At) -> anyhow::Result<Option<Stamp>> {
    if at == At::End {
        return Ok(None);
    }
    let point = recording.point(at)?;
    match point.moment {
        Some(moment) => Ok(Some(moment)),
        None => Ok(Some(super::replay::state_at(recording, at)?.at)),
    }
}

fn print(learned: &Learned, out: &mut Output) -> anyhow::Result<()> {
    let heading = format!(
        "{:22} {:>12} {:^27} {:>7} {:>6} {:>12} {:>13}  mostly at",
        "class", "half-life", "95 %", "dwells", "ended", "leaves after", "returns after"
    );
    writeln!(out, "{}", out.paint(Style::Bold, &heading))?;
    let half_life =
        |rate: f64| half_life_s(rate).map_or(HumanDuration::NEVER, HumanDuration::seconds);
    for (class, it) in &learned.classes {
        let Some(fit) = it.decay else { continue };
        let ends = [fit.high_per_s, fit.low_per_s].map(|rate| half_life(rate).to_string());
        let [leaves, returns] = it.birth_death.map_or([String::new(), String::new()], |fit| {
            [fit.model.leave_per_s, fit.model.return_per_s]
                .map(|rate| HumanDuration::seconds(1.0 / rate).to_string())
        });
        let place = it
            .places
            .first()
            .map_or(String::new(), |it| format!("{} {:.0} %", it.place, 100.0 * it.share));
        writeln!(
            out,
            "{class:22} {:>12} {:>12} – {:12} {:>7} {:>6} {leaves:>12} {returns:>13}  {place}",
            half_life(fit.rate_per_s).to_string(),
            ends[0],
            ends[1],
            fit.count,
            fit.ended
        )?;
    }
    if let Some(default) = learned.table.default_decay() {
        let words = format!("any other: half-life {}", default.half_life());
        writeln!(out, "{}", out.paint(Style::Dim, &words))?;
    }
    Ok(())
}
