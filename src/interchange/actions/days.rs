//! From rows to events, with what is put back at midnight.

use std::collections::BTreeMap;

use super::Options;
use super::homes::{Home, Homes};
use super::rows::Row;
use crate::change::{
    Action, Cause, Claim, Modality, NodeRef, Occurred, PlanConfig, Step, Transaction, World, plan,
};
use crate::event::{Event, Status, TaskStatus};
use crate::geometry::Size;
use crate::graph::{NodeId, SceneGraph};
use crate::interchange::{ImportReport, MOVABLE_DECAY_RATE};
use crate::time::Stamp;

const NANOS_PER_DAY: u64 = 86_400_000_000_000;
const NANOS_PER_MILLI: u64 = 1_000_000;

/// Plays all rows; returns the events.
pub(super) fn play(
    graph: &SceneGraph,
    homes: &Homes,
    rows: &[Row],
    options: &Options<'_>,
    destinations: &BTreeMap<u32, NodeId>,
    report: &mut ImportReport,
) -> Vec<(Stamp, Event)> {
    let mut player = Player {
        world: World::from_graph(graph.clone()),
        now: options.start,
        picked_from: BTreeMap::new(),
        events: Vec::with_capacity(rows.len() + rows.len() / 8),
        report,
    };
    let mut day = rows.first().map_or(0, |row| row.day_overall);
    for row in rows {
        if row.day_overall != day {
            day = row.day_overall;
            player.reset(homes, options, day);
        }
        player.advance(
            options,
            day,
            row.millis * NANOS_PER_MILLI,
            "rows set to the end of the day before",
        );
        player.row(row, options.name, destinations);
    }
    player.events
}

struct Player<'a> {
    world: World,
    now: Stamp,
    /// Where what is in the gripper came from.
    picked_from: BTreeMap<NodeId, Home>,
    events: Vec<(Stamp, Event)>,
    report: &'a mut ImportReport,
}

impl Player<'_> {
    /// Sets the clock, but never back: a day that ran past midnight delays the next.
    fn advance(&mut self, options: &Options<'_>, day: u32, nanos: u64, delayed: &str) {
        let then = options.start.plus_nanos(u64::from(day) * NANOS_PER_DAY + nanos);
        if then < self.now {
            self.report.count(delayed, 1);
        }
        self.now = self.now.max(then);
    }

    fn row(&mut self, row: &Row, name: &str, destinations: &BTreeMap<u32, NodeId>) {
        let (split, day, index) = (row.split.as_str(), row.day, row.object.index());
        let task = format!("{name}/{split}{day}/{index}");
        let held = self.is_held(row.object);
        if row.is_grab {
            self.report.count("grabs of what is in the gripper already", u64::from(held));
            self.pick(row.object, task);
            return;
        }
        self.report.count("puts of what is not in the gripper", u64::from(!held));
        let place = row.destination.as_ref().map(|(number, _)| destinations[number]);
        let to = if let Some(place) = place {
            self.place_at(place)
        } else {
            self.report.count("puts without a destination, taken as back to where it was", 1);
            let before = self.picked_from.get(&row.object).copied();
            before.unwrap_or_else(|| self.home_now(row.object))
        };
        self.place(row.object, to, task);
    }

    fn is_held(&self, id: NodeId) -> bool {
        self.world.graph().object(id).is_some_and(crate::graph::Object::is_held)
    }

    /// On or in a thing, or in a room.
    fn place_at(&mut self, place: NodeId) -> Home {
        let Some(below) = self.world.graph().object(place) else {
            return Home { room: place, support: None };
        };
        let (room, held) = (below.room, below.is_held());
        self.report.count("puts on or in something that is in the gripper", u64::from(held));
        Home { room, support: Some(place) }
    }

    fn home_now(&self, id: NodeId) -> Home {
        let object = self.world.graph().object(id).expect("every handled thing was added");
        Home { room: object.room, support: object.support }
    }

    fn pick(&mut self, id: NodeId, task_id: String) {
        if !self.is_held(id) {
            self.picked_from.insert(id, self.home_now(id));
        }
        self.say(id, task_id, Status::Picked, None);
        let claim = Claim { held: true, ..self.claim(id, Action::Removed) };
        self.apply(&claim);
    }

    fn place(&mut self, id: NodeId, to: Home, task_id: String) {
        self.say(id, task_id, Status::Placed, Some(to));
        let claim = Claim {
            target_room: Some(NodeRef::id(to.room)),
            support: to.support.map(NodeRef::id),
            ..self.claim(id, Action::Moved)
        };
        self.apply(&claim);
    }

    fn say(&mut self, id: NodeId, task_id: String, status: Status, to: Option<Home>) {
        let graph = self.world.graph();
        let named = |id| NodeRef { id: Some(id), label: graph.label(id).cloned() };
        let status = TaskStatus {
            task_id,
            status,
            pose: None,
            object: Some(named(id)),
            room: to.map(|to| named(to.room)),
            support: to.and_then(|to| to.support).map(named),
        };
        self.events.push((self.now, Event::TaskStatus(status)));
    }

    fn claim(&self, id: NodeId, action: Action) -> Claim {
        Claim {
            modality: Modality::Action,
            detector: "import".into(),
            action,
            object: NodeRef::id(id),
            source_room: None,
            target_room: None,
            support: None,
            pose: None,
            size: None,
            confidence: 1.0,
            occurred: Occurred::at(self.now),
            held: false,
            evidence: Vec::new(),
        }
    }

    /// What the planner refuses, it will refuse in the updater too: the world stays as it is.
    fn apply(&mut self, claim: &Claim) {
        let size = Size::from_micrometres([100_000; 3]).expect("the side is positive");
        let config = PlanConfig { decay_rate: MOVABLE_DECAY_RATE, size };
        let Ok(plan) = plan(&self.world, claim, self.now, &config) else { return };
        let step = |primitive| Step { cause: Cause::Change(0), primitive };
        let steps = plan.primitives.into_iter().map(step).collect();
        // A refusal of the graph itself leaves the world as it is, too.
        let _ = Transaction { at: self.now, steps }.apply(&mut self.world);
    }

    /// Puts back what is elsewhere, supports before what rests on them.
    fn reset(&mut self, homes: &Homes, options: &Options<'_>, day: u32) {
        self.advance(options, day, 0, "midnights delayed by the day before");
        let mut astray = Vec::new();
        for (id, home) in homes {
            let held = self.is_held(*id);
            if !held && self.home_now(*id) == *home {
                continue;
            }
            let task = || format!("{}/reset{day}/{}", options.name, id.index());
            if !held {
                self.pick(*id, task());
            }
            self.place(*id, *home, task());
            self.report.count("things put back at midnight", 1);
            if self.is_held(*id) || self.home_now(*id) != *home {
                astray.push(*id);
            }
        }
        self.picked_from.clear();
        if !astray.is_empty() {
            let what = format!("things could not be put back on day {day}");
            self.report.note(crate::interchange::counted(&astray, &what));
        }
    }
}
