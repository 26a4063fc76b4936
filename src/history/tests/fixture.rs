//! Small worlds and logs from lines of text.

use crate::change::{Cause, NodeRef, Step, Transaction, World};
use crate::event::{Event, Logged, Status, Task, TaskStatus};
use crate::geometry::{Pose, Size};
use crate::graph::{Label, NodeId, Object, Placement, PoseSource, Region, SceneGraph};
use crate::history::primitives_between;
use crate::time::Stamp;
use crate::updater::{Config, Updater};

pub fn id(text: &str) -> NodeId {
    text.parse().unwrap()
}

pub fn label(text: &str) -> Label {
    Label::new(text).unwrap()
}

/// `O17`, or a label.
pub fn node(text: &str) -> NodeRef {
    text.parse().map_or_else(|_| NodeRef::label(label(text)), NodeRef::id)
}

/// The start of every log here: midnight.
pub fn start() -> Stamp {
    "2026-01-05T00:00:00Z".parse().unwrap()
}

/// A graph from lines: `R1 kitchen`, then `O4 mug R1 O1 1.2 0 0.6`: id, label (`_` for a space),
/// room, support or `-`, position; `held` may follow.
pub fn graph(lines: &str) -> SceneGraph {
    let mut graph = SceneGraph::new();
    let mut resting = Vec::new();
    for line in lines.lines().map(str::trim).filter(|line| !line.is_empty()) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let name = label(&words[1].replace('_', " "));
        if words[0].starts_with('R') {
            let region = Region { label: name, extent: None, parent: None };
            graph.insert_region(id(words[0]), region).unwrap();
            continue;
        }
        let [x, y, z] = [4, 5, 6].map(|n| words[n].parse::<f64>().unwrap());
        let big = ["table", "bed", "cupboard"].contains(&name.as_str());
        let side = if big { 1.0 } else { 0.1 };
        let held = words.last() == Some(&"held");
        let object = Object {
            label: name,
            pose: Pose::at([x, y, z]).unwrap(),
            size: Size::new(side, side, side).unwrap(),
            decay_rate: if big { 0.0 } else { 1.0e-4 },
            last_observed: start(),
            pose_source: if held { PoseSource::Held } else { PoseSource::Measured },
            room: id(words[2]),
            support: (words[3] != "-").then(|| id(words[3])),
        };
        resting.push((id(words[0]), Placement::of(&object)));
        graph.insert_object(id(words[0]), Object { support: None, ..object }).unwrap();
    }
    // A support may come later in the text.
    for (id, placement) in &resting {
        graph.place_object(*id, placement).unwrap();
    }
    graph
}

/// A kitchen with a mug in a cupboard and a bowl of cereal on a table, a bedroom with a mug.
pub fn house() -> SceneGraph {
    graph(
        "R1 kitchen
         R2 bedroom
         O1 table R1 - 1 0 0.5
         O2 bowl R1 O1 1 0 1.05
         O3 cereal R1 O2 1 0 1.1
         O4 mug R1 O7 3 0 1.2
         O5 mug R2 - 5 0 0.05
         O6 bed R2 - 5 1 0.5
         O7 cupboard R1 - 3 0 1
         O8 tv_remote R2 O6 5 1 1.05",
    )
}

/// A log from lines such as `480 t picked mug`, `490 t placed mug on table in kitchen`,
/// `500 tick`, `510 t failed`: minutes since midnight, task, status, and what it names; and
/// `470 t told mug on bed`, a task.
pub fn log(lines: &str) -> Vec<Logged> {
    let mut updater = Updater::new(Config::default());
    let mut log = updater.update(start(), Event::InitialGraph(house())).unwrap();
    for line in lines.lines().map(str::trim).filter(|line| !line.is_empty()) {
        let (minute, rest) = line.split_once(' ').unwrap();
        let at = start().plus_nanos(minute.parse::<u64>().unwrap() * 60_000_000_000);
        log.extend(updater.update(at, input(rest)).unwrap());
    }
    log
}

fn input(line: &str) -> Event {
    if line == "tick" {
        return Event::Tick;
    }
    let mut words = line.splitn(3, ' ');
    let (task, status) = (words.next().unwrap(), words.next().unwrap());
    let named = words.next().unwrap_or_default();
    let told = status == "told";
    let (named, room) = split(named, " in ");
    let (object, support) = split(named, " on ");
    let object = Some(object).filter(|object| !object.is_empty()).map(node);
    let (room, support) = (room.map(node), support.map(node));
    if told {
        let instruction = format!("Fetch the {named}.");
        return Event::Task(Task {
            task_id: task.into(),
            instruction,
            object,
            target_room: room,
            support,
            ..Task::default()
        });
    }
    let status = Status::ALL.into_iter().find(|s| s.as_str() == status).unwrap();
    Event::TaskStatus(TaskStatus { object, room, support, ..TaskStatus::bare(task, status) })
}

fn split<'a>(text: &'a str, at: &str) -> (&'a str, Option<&'a str>) {
    text.split_once(at).map_or((text, None), |(head, tail)| (head, Some(tail)))
}

/// A log that leads through `graphs`, one primitive at a time, a second each.
pub fn journey(graphs: &[SceneGraph]) -> Vec<Logged> {
    let mut world = World::from_graph(graphs[0].clone());
    let mut events = vec![Event::InitialGraph(graphs[0].clone())];
    for graph in &graphs[1..] {
        for primitive in primitives_between(&world, graph, Stamp::EPOCH) {
            primitive.apply(&mut world).unwrap();
            let steps = vec![Step { cause: Cause::Change(events.len() as u64), primitive }];
            events.push(Event::Transaction(Transaction { at: Stamp::EPOCH, steps }));
        }
    }
    let logged = |(order, event)| {
        let at = Stamp::from_nanos(order * 1_000_000_000);
        Logged { order, at, published: at, event }
    };
    (1..).zip(events).map(logged).collect()
}
