//! `scenefold patrol`

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context;
use clap::ValueEnum;
use serde::Serialize;

use super::decay::BeliefArgs;
use super::output::{Output, Style};
use super::replay::state_at;
use super::source::{self, RecordingArg};
use super::{Outcome, UsageError};
use crate::change::NodeRef;
use crate::document::RefDocument;
use crate::graph::{NodeId, SceneGraph};
use crate::patrol::{Gain, Plan, RoomGraph, Wish, plan};
use crate::time::At;
use crate::view;

/// In which order to look into rooms, to learn most for each metre
#[derive(Debug, clap::Args)]
#[command(after_help = "\
What a look is worth is how many beliefs it is expected to repair: the sum of 1 - p over what is
believed to be in the room. With --budget the walk that is worth most within it is planned,
without it the one that is worth most for each metre. Up to 12 rooms with anything to gain the
plan is the best there is; beyond that it comes with a bound on what the best could be worth.

Examples:
  scenefold patrol day.mcap --from kitchen
  scenefold patrol day.mcap --at 30h --from R41 --budget 40 -o plan.png
  scenefold patrol day.mcap --from kitchen --decay decay.json --time-model birth-death --json")]
pub struct Patrol {
    #[command(flatten)]
    recording: RecordingArg,
    /// The point: start, end, 12.5s, 36h, 65d, an RFC 3339 instant, #42, c7 or nanoseconds
    #[arg(long, value_name = "AT", default_value = "end")]
    at: At,
    /// The room where the robot is: an id (R41) or a label
    #[arg(long, value_name = "ROOM")]
    from: String,
    /// How far the robot may walk
    #[arg(long, value_name = "METRES")]
    budget: Option<f64>,
    /// Stay, unless this much is gained for each metre: what is not looked at now is worth more
    /// later; 0 always goes
    #[arg(long, value_name = "GAIN", default_value_t = 0.2)]
    worth: f64,
    /// What a look is worth
    #[arg(long, default_value = "stale")]
    gain: GainArg,
    #[command(flatten)]
    beliefs: BeliefArgs,
    /// Draw the walk on the floor plan, SVG or PNG by the name of the file
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, ValueEnum)]
enum GainArg {
    /// Beliefs that are expected to be wrong
    Stale,
    /// Bits that are expected to be told
    Entropy,
}

#[derive(Serialize)]
struct PatrolDocument {
    at: String,
    from: RefDocument,
    budget: Option<f64>,
    metres: f64,
    gain: f64,
    gain_per_metre: Option<f64>,
    exact: bool,
    bound: f64,
    stops: Vec<StopDocument>,
    unreachable: Vec<RefDocument>,
}

#[derive(Serialize)]
struct StopDocument {
    room: RefDocument,
    metres: f64,
    gain: f64,
    targets: Vec<TargetDocument>,
}

#[derive(Serialize)]
struct TargetDocument {
    id: String,
    label: Option<String>,
    probability: f64,
}

/// Runs `scenefold patrol`.
pub fn run(args: &Patrol, out: &mut Output) -> anyhow::Result<Outcome> {
    if let Some(budget) = args.budget.filter(|it| !(it.is_finite() && *it >= 0.0)) {
        return Err(UsageError(format!("--budget is {budget}: metres of at least 0")).into());
    }
    if !(args.worth.is_finite() && args.worth >= 0.0) {
        return Err(UsageError(format!("--worth is {}: a gain of at least 0", args.worth)).into());
    }
    let learned = args.beliefs.learned()?;
    let beliefs = args.beliefs.beliefs(learned.as_ref());
    let recording = source::open(&args.recording.path)?;
    let state = state_at(&recording, args.at)?;
    let graph = state.graph();
    let from = room_named(graph, &args.from)?;
    let rooms = RoomGraph::of(graph)?;
    let wish = Wish { budget_m: args.budget, gain: args.gain(), worth_per_m: args.worth };
    let probability = |_, object: &_| beliefs.probability(graph, object, state.at);
    let planned = plan(graph, &rooms, from, &wish, probability);
    let planned = planned.context("the room is not among those of the graph")?;
    if args.json {
        out.json(&document(args, graph, &planned, state.at.to_string()))?;
    } else {
        print(graph, &rooms, &planned, args.gain(), out)?;
    }
    if let Some(path) = &args.out {
        draw(graph, &planned, path)?;
    }
    Ok(source::warn(&recording))
}

impl Patrol {
    fn gain(&self) -> Gain {
        match self.gain {
            GainArg::Stale => Gain::Stale,
            GainArg::Entropy => Gain::Entropy,
        }
    }
}

/// The room with this id or label.
fn room_named(graph: &SceneGraph, name: &str) -> anyhow::Result<NodeId> {
    let by_id = name.parse::<NodeId>().ok();
    let same =
        |id: NodeId, label: &crate::graph::Label| by_id == Some(id) || label.same_class(name);
    let found: Vec<NodeId> =
        graph.rooms().filter(|(id, room)| same(*id, &room.label)).map(|(id, _)| id).collect();
    match found.as_slice() {
        [room] => Ok(*room),
        [] => {
            let known = graph.rooms().map(|(id, room)| format!("{} {id}", room.label));
            let known = known.take(20).collect::<Vec<_>>().join(", ");
            Err(UsageError(format!("--from: no room is called {name:?}; there are: {known}"))
                .into())
        }
        several => {
            let ids = several.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
            Err(UsageError(format!("--from: {name:?} may be any of {ids}: give an id")).into())
        }
    }
}

fn reference(graph: &SceneGraph, id: NodeId) -> RefDocument {
    RefDocument::of(&NodeRef { id: Some(id), label: graph.label(id).cloned() })
}

fn document(args: &Patrol, graph: &SceneGraph, plan: &Plan, at: String) -> PatrolDocument {
    let target = |it: &crate::patrol::Target| TargetDocument {
        id: it.object.to_string(),
        label: graph.label(it.object).map(ToString::to_string),
        probability: it.probability,
    };
    let stops = plan.stops.iter().map(|stop| StopDocument {
        room: reference(graph, stop.room),
        metres: stop.metres,
        gain: stop.gain,
        targets: stop.targets.iter().map(target).collect(),
    });
    let stops: Vec<StopDocument> = stops.collect();
    PatrolDocument {
        at,
        from: reference(graph, plan.stops[0].room),
        budget: args.budget,
        metres: plan.metres,
        gain: plan.gain,
        gain_per_metre: (plan.metres > 0.0).then(|| plan.gain / plan.metres),
        exact: plan.exact,
        bound: plan.bound,
        stops,
        unreachable: plan.unreachable.iter().map(|id| reference(graph, *id)).collect(),
    }
}

fn print(
    graph: &SceneGraph,
    rooms: &RoomGraph,
    plan: &Plan,
    gain: Gain,
    out: &mut Output,
) -> anyhow::Result<()> {
    const SHOWN: usize = 5;
    let name = |id| RefName(graph, id).to_string();
    for (n, stop) in plan.stops.iter().enumerate() {
        let targets: Vec<String> = stop
            .targets
            .iter()
            .take(SHOWN)
            .map(|it| format!("{} {:.0} %", name(it.object), 100.0 * it.probability))
            .collect();
        let rest = stop.targets.len().saturating_sub(SHOWN);
        let more = if rest > 0 { format!(" and {rest} more") } else { String::new() };
        let room = out.paint(Style::Bold, &format!("{:24}", name(stop.room)));
        let (metres, worth) = (stop.metres, stop.gain);
        writeln!(out, "{n:2}  {room} {metres:6.1} m  {worth:5.2}  {}{more}", targets.join(", "))?;
    }
    let unit = match gain {
        Gain::Stale => "wrong beliefs expected",
        Gain::Entropy => "bits expected",
    };
    let best = match plan.exact {
        true => "no walk is better".to_owned(),
        false => format!("no walk is worth more than {:.2}", plan.bound),
    };
    writeln!(out, "{:.2} {unit} in {:.1} m; {best}", plan.gain, plan.metres)?;
    if rooms.open {
        writeln!(
            out,
            "no ways between rooms are known: every room is taken to open to every other"
        )?;
    }
    if !plan.unreachable.is_empty() {
        let names: Vec<String> = plan.unreachable.iter().map(|id| name(*id)).collect();
        writeln!(out, "no way leads to {}", names.join(", "))?;
    }
    Ok(())
}

/// `kitchen R41`.
struct RefName<'g>(&'g SceneGraph, NodeId);

impl std::fmt::Display for RefName<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.0.label(self.1) {
            Some(label) => write!(f, "{label} {}", self.1),
            None => write!(f, "{}", self.1),
        }
    }
}

fn draw(graph: &SceneGraph, plan: &Plan, path: &Path) -> anyhow::Result<()> {
    let svg = view::patrol::svg(graph, plan);
    let svg = svg.context("no room of the graph has a box: there is nothing to draw")?;
    let bytes = match path.extension().and_then(|it| it.to_str()) {
        Some("svg") => svg.into_bytes(),
        Some("png") => view::raster::png(&svg, 1200)?,
        _ => {
            let what = format!("-o: {} must end in .svg or .png", path.display());
            return Err(UsageError(what).into());
        }
    };
    std::fs::write(path, bytes).with_context(|| path.display().to_string())
}
