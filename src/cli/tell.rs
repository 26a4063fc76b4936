//! `scenefold tell`

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;
use serde::Serialize;

use super::ingest::initial_graph;
use super::language::LanguageArgs;
use super::output::{Output, Style, plain};
use super::source::text;
use super::{Outcome, UsageError, tell_explain};
use crate::change::{ChangeRecord, World};
use crate::document::{ChangeDocument, ContentDocument, RefDocument};
use crate::event::{Event, Interpretation, Utterance};
use crate::modality::human::{
    Errand, GroundedErrand, LanguageModel, errands, ground_errand, interpret, parse_task,
    read_task, task_request,
};
use crate::model::Models;
use crate::recording::{Recorder, RecorderOptions};
use crate::time::Stamp;
use crate::updater::{Config, Updater};

/// What a sentence changes, and why; or what a task asks for
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  scenefold tell scene.json \"I put the mug on the desk\"      what that would change
  scenefold tell day.mcap \"The banana is gone\" --explain     and which words mean what
  scenefold tell scene.json \"Anna ate the banana\" -o day.mcap    and record it
  scenefold tell scene.json --task \"Bring the mug to the kitchen\"
  scenefold tell scene.json --lines said.txt --json           each line by itself
  scenefold tell scene.json \"The clicker is gone\" --server http://localhost:11434/v1 --model NAME
Exits with 3 if something was claimed but rejected.")]
pub struct Tell {
    /// The graph it is said in: scene JSON, or a recording (its last state)
    graph: PathBuf,
    /// The sentence
    #[arg(required_unless_present = "lines", conflicts_with = "lines")]
    sentence: Option<String>,
    /// Take each line of a file (- for standard input) by itself against the same graph
    #[arg(long, value_name = "FILE", conflicts_with = "out")]
    lines: Option<PathBuf>,
    /// Take it for what the robot is asked to do
    #[arg(long, conflicts_with = "out")]
    task: bool,
    /// When it is said (RFC 3339); by default when the graph is of, or now if that does not say
    #[arg(long, value_name = "TIME")]
    at: Option<Stamp>,
    /// Who says it
    #[arg(long, default_value = "")]
    speaker: String,
    /// Record it here: a new recording, or a folder of segments to go on with
    #[arg(short, long, value_name = "REC")]
    out: Option<PathBuf>,
    /// Show which words mean what, the candidates, and why one was chosen
    #[arg(long)]
    explain: bool,
    /// Print JSON: one document, or with --lines one per line
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    language: LanguageArgs,
}

/// What was said and what it changes.
#[derive(Serialize)]
struct TellDocument<'a> {
    text: &'a str,
    changes: Vec<ChangeDocument>,
    #[serde(skip_serializing_if = "Option::is_none")]
    interpretations: Option<Vec<ContentDocument>>,
}

/// What was asked for.
#[derive(Serialize)]
struct TaskDocument<'a> {
    text: &'a str,
    tasks: Vec<ErrandDocument>,
}

#[derive(Serialize)]
struct ErrandDocument {
    object: Option<RefDocument>,
    source_room: Option<RefDocument>,
    target_room: Option<RefDocument>,
    support: Option<RefDocument>,
}

/// Runs `scenefold tell`.
pub fn run(args: &Tell, out: &mut Output) -> anyhow::Result<Outcome> {
    let (graph, start) = initial_graph(&args.graph)?;
    let at = args.at.unwrap_or_else(|| said_at(start));
    if at < start {
        let what = format!("--at {at} is before the graph, which is of {start}");
        return Err(UsageError(what).into());
    }
    let config = args.language.applied_to(Config::default());
    let mut models = args.language.models(&config)?;
    let mut updater = Updater::new(config);
    updater.update(start, Event::InitialGraph(graph))?;
    if let Some(path) = &args.lines {
        return each_line(args, (&updater, &mut models), at, &text(path)?, out);
    }
    let sentence = args.sentence.as_deref().unwrap_or_default();
    if args.task {
        return task(args, updater.world(), &mut models, sentence, out);
    }
    let said = args.said(sentence);
    let replies = updater.ask(&said, Some(&mut models));
    if let Some(path) = &args.out {
        record(args, path, &updater, (start, at), (said.clone(), replies.clone()))?;
    }
    one(args, &mut updater, at, (said, replies), out)
}

/// The moment of the graph, or now where it has none.
fn said_at(start: Stamp) -> Stamp {
    if start > Stamp::EPOCH {
        return start;
    }
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    now.map_or(start, |since| Stamp::from_nanos(since.as_nanos() as u64))
}

fn each_line(
    args: &Tell,
    (updater, models): (&Updater, &mut Models),
    at: Stamp,
    lines: &str,
    out: &mut Output,
) -> anyhow::Result<Outcome> {
    let mut outcome = Outcome::Clean;
    for line in lines.lines() {
        if args.task {
            task(args, updater.world(), models, line, out)?;
            continue;
        }
        let said = args.said(line);
        let replies = updater.ask(&said, Some(models));
        if one(args, &mut updater.clone(), at, (said, replies), out)? == Outcome::Findings {
            outcome = Outcome::Findings;
        }
    }
    // Of many lines each is answered by itself: a rejection among them is no finding of all.
    Ok(if args.json { Outcome::Clean } else { outcome })
}

fn one(
    args: &Tell,
    updater: &mut Updater,
    at: Stamp,
    (said, replies): (Event, Vec<Event>),
    out: &mut Output,
) -> anyhow::Result<Outcome> {
    let logged = updater.update_with(at, said.clone(), replies)?;
    let Event::Utterance(Utterance { text: sentence, .. }) = &said else {
        return Ok(Outcome::Clean);
    };
    let (mut changes, mut understood) = (Vec::new(), Vec::new());
    for logged in logged {
        match logged.event {
            Event::Change(record) => changes.push(record),
            Event::Interpretation(interpretation) => understood.push(interpretation),
            _ => {}
        }
    }
    let rejected = changes.iter().any(|record| !record.is_applied());
    if args.json {
        tell_json(args, sentence, &changes, &understood, out)?;
    } else {
        tell_text(args, (at, sentence), &changes, &understood, out)?;
    }
    Ok(if rejected { Outcome::Findings } else { Outcome::Clean })
}

fn tell_json(
    args: &Tell,
    text: &str,
    changes: &[ChangeRecord],
    understood: &[Interpretation],
    out: &mut Output,
) -> anyhow::Result<()> {
    let changes = changes.iter().map(ChangeDocument::of).collect();
    let interpretations = args.explain.then(|| {
        understood
            .iter()
            .map(|it| ContentDocument::of(&Event::Interpretation(it.clone())))
            .collect()
    });
    print_json(args, &TellDocument { text, changes, interpretations }, out)
}

fn print_json(args: &Tell, document: &impl Serialize, out: &mut Output) -> anyhow::Result<()> {
    if args.lines.is_some() { out.json_line(document) } else { out.json(document) }
}

fn tell_text(
    args: &Tell,
    (at, sentence): (Stamp, &str),
    changes: &[ChangeRecord],
    understood: &[Interpretation],
    out: &mut Output,
) -> anyhow::Result<()> {
    if args.lines.is_some() {
        let quoted = out.paint(Style::Bold, &plain(sentence));
        writeln!(out, "{quoted}")?;
    }
    for record in changes {
        super::log::print(record, out)?;
    }
    if changes.is_empty() {
        let reading = interpret(sentence, at);
        let why = if reading.statements.is_empty() { &reading.note } else { "it is known already" };
        writeln!(out, "changes nothing: {why}")?;
    }
    if args.explain {
        let spans: Vec<_> = understood.iter().map(|it| it.spans.as_slice()).collect();
        tell_explain::draw(sentence, &spans, out)?;
    }
    Ok(())
}

fn task(
    args: &Tell,
    world: &World,
    models: &mut Models,
    text: &str,
    out: &mut Output,
) -> anyhow::Result<Outcome> {
    let errands = match ask_task(args, world, models, text) {
        Some(Ok(errands)) => errands,
        Some(Err(why)) => {
            let _ =
                writeln!(std::io::stderr(), "read by the built-in interpreter: {}", plain(&why));
            read_task(text)
        }
        None => read_task(text),
    };
    let grounded: Vec<GroundedErrand> =
        errands.iter().map(|errand| ground_errand(world, errand, None)).collect();
    if args.json {
        let tasks = grounded.iter().map(ErrandDocument::of).collect();
        print_json(args, &TaskDocument { text, tasks }, out)?;
        return Ok(Outcome::Clean);
    }
    if grounded.is_empty() {
        writeln!(out, "asks for nothing that is known to be done")?;
    }
    for errand in &grounded {
        writeln!(out, "{}", errand_words(errand))?;
    }
    Ok(Outcome::Clean)
}

/// What a server makes of an instruction, if one is to be asked.
///
/// # Errors
/// Why nothing can be made of its answer.
fn ask_task(
    args: &Tell,
    world: &World,
    models: &mut Models,
    text: &str,
) -> Option<Result<Vec<Errand>, String>> {
    let request = task_request(world, text).filter(|_| args.language.asks_server())?;
    let reply = models.answer(&request);
    Some(reply.answer.and_then(|answer| {
        parse_task(text, &answer).map(|it| errands(&it)).map_err(|error| error.to_string())
    }))
}

fn errand_words(errand: &GroundedErrand) -> String {
    let word = |preposition: &str, node: Option<&crate::change::NodeRef>| {
        node.map_or(String::new(), |node| format!(" {preposition} {node}"))
    };
    let object = errand.object.as_ref().map_or("something unknown".to_owned(), ToString::to_string);
    format!(
        "take {object}{}{}{}",
        word("from", errand.source_room.as_ref()),
        word("to", errand.target_room.as_ref()),
        word("onto", errand.support.as_ref())
    )
}

impl Tell {
    fn said(&self, text: &str) -> Event {
        Event::Utterance(Utterance { speaker: self.speaker.clone(), text: text.to_owned() })
    }
}

impl ErrandDocument {
    fn of(errand: &GroundedErrand) -> Self {
        let maybe = |node: &Option<crate::change::NodeRef>| RefDocument::maybe(node.as_ref());
        Self {
            object: maybe(&errand.object),
            source_room: maybe(&errand.source_room),
            target_room: maybe(&errand.target_room),
            support: maybe(&errand.support),
        }
    }
}

/// Records the utterance: in a new recording that begins with the graph, or at the end of one.
fn record(
    args: &Tell,
    path: &Path,
    updater: &Updater,
    (start, at): (Stamp, Stamp),
    (said, replies): (Event, Vec<Event>),
) -> anyhow::Result<()> {
    let options = RecorderOptions::default();
    let mut recorder = if Recorder::can_append(path)? {
        let recorder = Recorder::append(path, &options)?;
        args.language.models(recorder.updater().config())?;
        recorder
    } else {
        let mut recorder = Recorder::create(path, updater.config().clone(), &options)?;
        recorder.record(start, Event::InitialGraph(updater.graph().clone()))?;
        recorder
    };
    recorder.record_with(at, said, replies).context("recording the sentence")?;
    recorder.finish()?;
    Ok(())
}
