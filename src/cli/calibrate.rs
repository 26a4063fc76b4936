//! `scenefold calibrate`

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;
use serde::Serialize;

use super::learn_decay::{gaps, read_all};
use super::output::{Output, Style};
use super::source::text;
use super::{Outcome, UsageError, decay};
use crate::learn::{
    Bin, Calibration, LookPlan, ModelReport, PresenceLog, PresenceTrial, Protocol, Score, Tally,
    Visits, calibrate, presence_trial,
};
use crate::modality::time::HumanDuration;
use crate::time::{At, Span};
use crate::view::{raster, reliability};

/// How good predictions of what has moved are, on what really happened
#[derive(Debug, clap::Args)]
#[command(after_help = "\
At set hours of every day every thing that ever moved, and is not in the gripper, is looked at,
and it is predicted whether it is in the same place some time later. With --train-until the
models learn from the looks before that point and are tested on those after it; --decay tests
what was learned elsewhere. Log loss and Brier score: lower is better.

With --presence a table of noisy detections and of the truth (landmark,kind,time_s,present) is
used instead: the models learn
from all detections before --split; after it they see those during visits only, and say all the
time whether each landmark is there.

Examples:
  scenefold calibrate home.mcap --train-until 65d --looks 2h --gaps 1h,2h,4h,8h --same-day
  scenefold calibrate home.mcap --decay decay.json --plot reliability.svg
  scenefold calibrate --presence room.csv --split 2h --visit 30s --every 5m")]
pub struct Calibrate {
    /// Recordings: MCAP files or folders of segments
    #[arg(value_name = "REC", required_unless_present = "presence")]
    recordings: Vec<PathBuf>,
    /// Also test what was learned before
    #[arg(long, value_name = "FILE")]
    decay: Option<PathBuf>,
    /// Learn up to this point, test after it
    #[arg(long, value_name = "AT")]
    train_until: Option<At>,
    /// From one look to the next
    #[arg(long, value_name = "SPAN", default_value = "2h")]
    looks: Span,
    /// Time of day (UTC) of the first look
    #[arg(long, value_name = "SPAN", default_value = "6h")]
    first: Span,
    /// Time of day after which there are no more looks
    #[arg(long, value_name = "SPAN", default_value = "22h")]
    last: Span,
    /// From a look to what is predicted
    #[arg(long, value_name = "SPANS", value_delimiter = ',', default_value = "1h,2h,4h,8h")]
    gaps: Vec<Span>,
    /// Never compare across midnight: every day begins anew
    #[arg(long)]
    same_day: bool,
    /// Noisy detections and the truth (CSV)
    #[arg(long, value_name = "CSV", conflicts_with_all = ["recordings", "train_until", "decay"])]
    presence: Option<PathBuf>,
    /// With --presence: learn up to then
    #[arg(long, value_name = "SPAN", default_value = "2h")]
    split: Span,
    /// With --presence: how long a visit lasts
    #[arg(long, value_name = "SPAN", default_value = "20s")]
    visit: Span,
    /// With --presence: from one visit to the next
    #[arg(long, value_name = "SPAN", default_value = "60s")]
    every: Span,
    /// Draw a reliability diagram, SVG or PNG by the name of the file
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct ModelDocument {
    #[serde(flatten)]
    score: Score,
    /// Right guesses of the place, of all.
    #[serde(skip_serializing_if = "Option::is_none")]
    top_1: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    changing: Option<Score>,
    by_class: BTreeMap<String, Score>,
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    by_age: BTreeMap<String, Score>,
    reliability: Vec<Bin>,
}

/// What is printed of one model.
struct Row {
    name: &'static str,
    all: Tally,
    document: ModelDocument,
}

/// Runs `scenefold calibrate`.
pub fn run(args: &Calibrate, out: &mut Output) -> anyhow::Result<Outcome> {
    let (rows, note, outcome) = match &args.presence {
        Some(path) => presence(args, path)?,
        None => recordings(args)?,
    };
    if args.json {
        let documents: BTreeMap<&str, &ModelDocument> =
            rows.iter().map(|row| (row.name, &row.document)).collect();
        out.json(&documents)?;
    } else {
        writeln!(out, "{note}")?;
        print(&rows, out)?;
    }
    if let Some(path) = &args.plot {
        draw(&rows, path)?;
    }
    Ok(outcome)
}

fn recordings(args: &Calibrate) -> anyhow::Result<(Vec<Row>, String, Outcome)> {
    let (every, first, last) = (args.looks.0, args.first.0, args.last.0);
    if every == 0 || first > last {
        let what = "--looks must be above 0, and --first not after --last";
        return Err(UsageError(what.to_owned()).into());
    }
    let plan = LookPlan { every, first, last, gaps: gaps(&args.gaps)?, same_day: args.same_day };
    let (logs, cuts, outcome) = read_all(&args.recordings, args.train_until.unwrap_or(At::End))?;
    let learned = args.decay.as_deref().map(decay::learned).transpose()?;
    let protocol = Protocol { plan, train_until: cuts, learned: learned.as_ref() };
    let calibration = calibrate(&logs, &protocol);
    check(args, &calibration)?;
    let note = format!(
        "{} looks to learn from, {} predictions",
        calibration.trained_on, calibration.tested_on
    );
    Ok((calibration.models.iter().map(|(name, it)| row(name, it)).collect(), note, outcome))
}

/// A score of nothing is no score.
fn check(args: &Calibrate, calibration: &Calibration) -> anyhow::Result<()> {
    if calibration.tested_on == 0 {
        anyhow::bail!(
            "there is nothing to predict: no thing that had moved was looked at{}",
            if args.train_until.is_some() { " after --train-until" } else { "" }
        );
    }
    if args.train_until.is_some() && calibration.trained_on == 0 {
        anyhow::bail!("there is nothing to learn from before --train-until");
    }
    Ok(())
}

fn row(name: &'static str, report: &ModelReport) -> Row {
    let score = |(class, tally): (&String, &Tally)| (class.clone(), tally.score());
    let age = |(seconds, tally): (&u64, &Tally)| {
        (HumanDuration::seconds(*seconds as f64).to_string(), tally.score())
    };
    let document = ModelDocument {
        score: report.all.score(),
        top_1: report.top_1.map(|(right, of)| right as f64 / of as f64),
        changing: None,
        by_class: report.by_class.iter().map(score).collect(),
        by_age: report.by_age_s.iter().map(age).collect(),
        reliability: report.all.reliability(),
    };
    Row { name, all: report.all.clone(), document }
}

fn presence(args: &Calibrate, path: &Path) -> anyhow::Result<(Vec<Row>, String, Outcome)> {
    let named = || path.display().to_string();
    let log = PresenceLog::from_csv(&text(path)?).with_context(named)?;
    let seconds = |span: Span| span.0 as f64 / 1e9;
    let visits = Visits { length_s: seconds(args.visit), every_s: seconds(args.every) };
    let trial = presence_trial(&log, seconds(args.split), visits).with_context(named)?;
    let models = [
        ("sigmoid", &trial.sigmoid),
        ("birth-death", &trial.birth_death),
        ("training-mean", &trial.training_mean),
    ];
    let rows = models.into_iter().map(|(name, tallies)| presence_row(name, tallies, &trial));
    let note = format!(
        "visits of {} every {} after {}; come and go: {}",
        args.visit,
        args.every,
        args.split,
        trial.changing.join(", ")
    );
    Ok((rows.collect(), note, Outcome::Clean))
}

fn presence_row(
    name: &'static str,
    tallies: &BTreeMap<String, Tally>,
    trial: &PresenceTrial,
) -> Row {
    let (mut all, mut changing) = (Tally::default(), Tally::default());
    for (landmark, tally) in tallies {
        all.extend(tally);
        if trial.changing.contains(landmark) {
            changing.extend(tally);
        }
    }
    let document = ModelDocument {
        score: all.score(),
        top_1: None,
        changing: Some(changing.score()),
        by_class: tallies.iter().map(|(name, tally)| (name.clone(), tally.score())).collect(),
        by_age: BTreeMap::new(),
        reliability: all.reliability(),
    };
    Row { name, all, document }
}

fn print(rows: &[Row], out: &mut Output) -> anyhow::Result<()> {
    let changing = rows.iter().any(|row| row.document.changing.is_some());
    let last = if changing { "of what comes and goes" } else { "right place" };
    let heading = format!("{:20} {:>9} {:>9} {:>9}  {last}", "model", "log loss", "Brier", "n");
    writeln!(out, "{}", out.paint(Style::Bold, &heading))?;
    for Row { name, document, .. } in rows {
        let Score { log_loss, brier, n } = document.score;
        let more = match (document.top_1, document.changing) {
            (Some(share), _) => format!("{:.1} %", 100.0 * share),
            (_, Some(score)) => format!("log loss {:.4}, Brier {:.4}", score.log_loss, score.brier),
            _ => String::new(),
        };
        writeln!(
            out,
            "{}",
            format!("{name:20} {log_loss:9.4} {brier:9.4} {n:9}  {more}").trim_end()
        )?;
    }
    Ok(())
}

/// The models that are worth a line: not those that say one number.
fn draw(rows: &[Row], path: &Path) -> anyhow::Result<()> {
    let flat = ["never-changes", "training-mean", "most-frequent-place", "graph"];
    let lines = rows.iter().filter(|row| !flat.contains(&row.name));
    let series: Vec<reliability::Series> = lines
        .map(|row| reliability::Series { name: row.name.to_owned(), bins: row.all.reliability() })
        .collect();
    let svg = reliability::svg("Still where it was?", &series)?;
    let bytes = match path.extension().and_then(|it| it.to_str()) {
        Some("svg") => svg.into_bytes(),
        Some("png") => raster::png(&svg, 1280)?,
        _ => {
            let what = format!("--plot: {} must end in .svg or .png", path.display());
            return Err(UsageError(what).into());
        }
    };
    std::fs::write(path, bytes).with_context(|| path.display().to_string())
}
