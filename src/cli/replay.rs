//! `scenefold replay`

use std::io::Write;

use super::Outcome;
use super::decay::BeliefArgs;
use super::output::{Output, Style};
use super::source::{self, RecordingArg, threads};
use crate::graph::{Layer, NodeId, Object, SceneGraph};
use crate::interchange::scene::SceneDocument;
use crate::learn::Beliefs;
use crate::recording::{Recording, State};
use crate::time::{At, Stamp};

/// The graph at a point in the recording
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  scenefold replay day.mcap                    the last state
  scenefold replay day.mcap --at 36h           after a day and a half
  scenefold replay day.mcap --decay decay.json --time-model birth-death
  scenefold replay day.mcap --at c7 --json     right after change 7, as JSON
  scenefold replay day.mcap --json > scene.json && scenefold import scene scene.json -o new.mcap")]
pub struct Replay {
    #[command(flatten)]
    recording: RecordingArg,
    /// The point: start, end, 12.5s, 36h, 65d, an RFC 3339 instant, #42, c7 or nanoseconds
    #[arg(long, value_name = "AT", default_value = "end")]
    at: At,
    #[command(flatten)]
    beliefs: BeliefArgs,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

/// Runs `scenefold replay`.
pub fn run(args: &Replay, out: &mut Output) -> anyhow::Result<Outcome> {
    let learned = args.beliefs.learned()?;
    let beliefs = args.beliefs.beliefs(learned.as_ref());
    let recording = source::open(&args.recording.path)?;
    let state = state_at(&recording, args.at)?;
    if args.json {
        out.json(&document(&state, beliefs))?;
    } else {
        let hash = state.graph().hash();
        writeln!(out, "{} (event #{}), state {hash}", state.at, state.order)?;
        print_graph(state.graph(), beliefs, state.at, out)?;
    }
    Ok(worst(source::warn(&recording), &state))
}

/// The state at `at`; an uncertain one is told on stderr.
pub fn state_at(recording: &Recording, at: At) -> anyhow::Result<State> {
    let state = recording.state_at(at, threads()).map_err(|error| {
        anyhow::Error::new(error).context(recording.path().display().to_string())
    })?;
    if state.graph().object_count() == 0 && !recording.has_graph() {
        let note = "note: the recording holds neither /graph/initial nor /primitive: no graph";
        let _ = writeln!(std::io::stderr(), "{note}");
    }
    if let Some(why) = &state.uncertain {
        let _ = writeln!(std::io::stderr(), "warning: this state may be wrong: {why}");
    }
    Ok(state)
}

fn worst(outcome: Outcome, state: &State) -> Outcome {
    if state.uncertain.is_some() { Outcome::Findings } else { outcome }
}

/// The graph with the probabilities of a model.
fn document(state: &State, beliefs: Beliefs<'_>) -> SceneDocument {
    let graph = state.graph();
    let mut document = SceneDocument::of(graph, state.at);
    for entry in document.objects.iter_mut().chain(&mut document.held) {
        let object = entry.id.and_then(|id| graph.object(id));
        entry.probability = object.map(|object| beliefs.probability(graph, object, state.at));
    }
    document
}

fn print_graph(
    graph: &SceneGraph,
    beliefs: Beliefs<'_>,
    now: Stamp,
    out: &mut Output,
) -> anyhow::Result<()> {
    for (id, room) in graph.rooms() {
        let heading = out.paint(Style::Bold, &format!("{} {id}", room.label));
        let mut about = Vec::new();
        if let Some(floor) = graph.ancestor(id, Layer::Floor) {
            about.push(format!(
                "on {} {floor}",
                graph.region(floor).map_or("", |f| f.label.as_str())
            ));
        }
        let access: Vec<String> = graph.access_from(id).map(|room| name(graph, room)).collect();
        if !access.is_empty() {
            about.push(format!("opens to {}", access.join(", ")));
        }
        let about = out.paint(Style::Dim, &about.join("; "));
        writeln!(out, "{heading}  {about}")?;
        for (id, object) in graph.objects().filter(|(_, object)| object.room == id) {
            let fresh = beliefs.probability(graph, object, now);
            print_object(graph, id, object, fresh, out)?;
        }
    }
    let mut held = graph.held().peekable();
    if held.peek().is_some() {
        writeln!(out, "{}", out.paint(Style::Bold, "in the gripper"))?;
    }
    for (id, object) in held {
        print_object(graph, id, object, beliefs.probability(graph, object, now), out)?;
    }
    Ok(())
}

fn print_object(
    graph: &SceneGraph,
    id: NodeId,
    object: &Object,
    fresh: f64,
    out: &mut Output,
) -> anyhow::Result<()> {
    let [x, y, z] = object.pose.position();
    let support = object.support.map_or(String::new(), |on| format!("on {}", name(graph, on)));
    let who = format!("{} {id}", object.label);
    let belief = match object.decay_rate > 0.0 || fresh < 1.0 {
        true => format!("{:3.0} %", 100.0 * fresh),
        false => "     ".to_owned(),
    };
    let belief = if fresh < 0.5 { out.paint(Style::Yellow, &belief) } else { belief };
    let source = out.paint(Style::Dim, object.pose_source.as_str());
    writeln!(out, "  {who:28} {belief}  ({x:7.2}, {y:7.2}, {z:6.2})  {support:28} {source}")?;
    Ok(())
}

fn name(graph: &SceneGraph, id: NodeId) -> String {
    graph.label(id).map_or(id.to_string(), |label| format!("{label} {id}"))
}
