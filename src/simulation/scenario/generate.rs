//! Random scenarios: [`generate`].

use std::sync::Arc;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::check::{Done, act};
use super::{Errand, NewThing, Place, RobotConfig, Said, Scenario, VirtualAction};
use crate::graph::Label;
use crate::simulation::house::{House, Thing};
use crate::simulation::random::Random;
use crate::simulation::sensor::NoiseConfig;
use crate::simulation::world::{Presence, TrueWorld};
use crate::time::Span;

/// How much happens.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Draw {
    /// Things that are taken away.
    pub removed: u32,
    /// Things that are put elsewhere.
    pub moved: u32,
    /// Things that are new.
    pub added: u32,
    /// Things the robot is told to carry.
    pub tasks: u32,
    /// Share of removals, moves and additions that somebody tells, 0 to 1.
    pub told: f64,
    /// Everything happens within this many seconds.
    pub within_s: f64,
}

impl Default for Draw {
    fn default() -> Self {
        Self { removed: 2, moved: 2, added: 2, tasks: 1, told: 0.3, within_s: 20.0 }
    }
}

/// Classes of things that people bring, with their sizes in metres.
const BROUGHT: [(&str, [f64; 3]); 10] = [
    ("book", [0.15, 0.22, 0.03]),
    ("mug", [0.12, 0.09, 0.1]),
    ("banana", [0.2, 0.1, 0.04]),
    ("apple", [0.08, 0.08, 0.08]),
    ("bottle", [0.08, 0.08, 0.26]),
    ("vase", [0.14, 0.14, 0.28]),
    ("laptop", [0.33, 0.24, 0.22]),
    ("bowl", [0.17, 0.17, 0.08]),
    ("cereal", [0.19, 0.07, 0.28]),
    ("clock", [0.16, 0.08, 0.16]),
];

/// A scenario in `house`, which is called `name`, drawn from a seed. Every place is free at its
/// time: nothing overlaps, floats or juts out. Where the house has too little to take or too
/// little room to put things, less happens than was asked for.
pub fn generate(name: &str, house: &Arc<House>, seed: u64, draw: Draw) -> Scenario {
    let mut draft = Draft {
        world: TrueWorld::new(house.clone()),
        random: Random::new(seed, 1),
        touched: Vec::new(),
        scenario: Scenario {
            name: format!("random {seed}"),
            house: name.to_owned(),
            seed,
            start: super::default_start(),
            robot: RobotConfig::default(),
            actions: Vec::new(),
            utterances: Vec::new(),
            tasks: Vec::new(),
            gaps: Vec::new(),
            noise: NoiseConfig::default(),
        },
    };
    let mut kinds: Vec<Kind> =
        [(draw.removed, Kind::Remove), (draw.moved, Kind::Move), (draw.added, Kind::Add)]
            .into_iter()
            .flat_map(|(count, kind)| std::iter::repeat_n(kind, count as usize))
            .collect();
    let spacing = draw.within_s / (kinds.len() + draw.tasks as usize).max(1) as f64;
    let mut time_s = 1.0;
    while !kinds.is_empty() {
        let kind = kinds.swap_remove(draft.random.below(kinds.len()));
        draft.happen(kind, time_s, draw.told);
        time_s += draft.random.between(0.2, 1.0) * spacing;
    }
    // Errands come last: the robot takes its time, and people need not wait for it.
    for _ in 0..draw.tasks {
        draft.errand(seconds(time_s));
        time_s += spacing;
    }
    draft.scenario
}

/// So many supports are tried before something is left where it is.
const TRIES: usize = 20;

#[derive(Clone, Copy)]
enum Kind {
    Remove,
    Move,
    Add,
}

struct Draft {
    world: TrueWorld,
    random: Random,
    /// Nothing is taken twice: what happened to it could not be told apart.
    touched: Vec<usize>,
    scenario: Scenario,
}

fn seconds(s: f64) -> Span {
    Span((s * 1000.0) as u64 * 1_000_000)
}

impl Draft {
    fn happen(&mut self, kind: Kind, time_s: f64, told: f64) {
        let time = seconds(time_s);
        let tried = match kind {
            Kind::Remove => self.removal(time),
            Kind::Move => self.relocation(time),
            Kind::Add => self.addition(time),
        };
        let Some((action, sentence)) = tried else { return };
        let Ok(done) = act(&mut self.world, &action, &mut self.random.clone()) else { return };
        match done {
            Done::Removed(n) | Done::Added(n) => self.touched.push(n),
            Done::Moved(all) => self.touched.extend(all),
        }
        self.scenario.actions.push(action);
        if self.random.chance(told) {
            let time = seconds(time_s + 1.0);
            let speaker = String::new();
            self.scenario.utterances.push(Said { time, speaker, text: sentence });
        }
    }

    /// Something that can be taken, and was not yet.
    fn taken(&mut self) -> Option<usize> {
        let world = &self.world;
        let free: Vec<usize> = world
            .present()
            .filter(|n| world.thing(*n).movable && world.standing_on(*n).is_empty())
            .filter(|n| !self.touched.contains(n))
            .collect();
        self.random.pick(&free).copied()
    }

    fn removal(&mut self, time: Span) -> Option<(VirtualAction, String)> {
        let n = self.taken()?;
        let (thing, room) = (self.world.thing(n), self.room_of(n));
        let text = format!("I removed the {} from the {room}.", thing.label.as_str());
        let object = thing.name.clone();
        Some((VirtualAction::Removed { time, object }, text))
    }

    fn relocation(&mut self, time: Span) -> Option<(VirtualAction, String)> {
        let n = self.taken()?;
        let thing = self.world.thing(n).clone();
        let to = self.place_for(&thing)?;
        let (from, on) = (self.room_of(n), self.support_and_room(&to));
        let label = thing.label.as_str();
        let text = format!("I moved the {label} from the {from} to {on}.");
        Some((VirtualAction::Moved { time, object: thing.name.clone(), to }, text))
    }

    fn addition(&mut self, time: Span) -> Option<(VirtualAction, String)> {
        let (label, size) = *self.random.pick(&BROUGHT)?;
        let name = format!("new {label} {}", self.scenario.actions.len());
        let thing = Thing::of_class(name, Label::new(label).ok()?, Some(size)).ok()?;
        let to = self.place_for(&thing)?;
        let text = format!("I put a new {label} on {}.", self.support_and_room(&to));
        let (name, size) = (Some(thing.name), Some(size));
        let object = NewThing { name, label: label.to_owned(), size };
        Some((VirtualAction::Added { time, object, to }, text))
    }

    fn errand(&mut self, time: Span) {
        let Some(n) = self.taken() else { return };
        let thing = self.world.thing(n).clone();
        let Some(place) = self.place_for(&thing) else { return };
        let (from, on) = (self.room_of(n), self.support_and_room(&place));
        let label = thing.label.as_str();
        let instruction = format!("Take the {label} in the {from} and put it on {on}.");
        self.world.take(n, Presence::Held);
        let placed = self.world.place(&thing, &place, &mut self.random.clone());
        if let Ok(spot) = placed {
            self.world.put(n, spot);
            self.touched.push(n);
            let pick = thing.name;
            self.scenario.tasks.push(Errand { time, instruction, pick, place, planned: false });
        }
    }

    /// A place, to the millimetre, where the thing fits; on another thing than it is on.
    fn place_for(&mut self, thing: &Thing) -> Option<Place> {
        let world = &self.world;
        let supports: Vec<usize> = world
            .present()
            .filter(|n| !world.thing(*n).surfaces.is_empty() && Some(*n) != thing.support)
            .filter(|n| !world.thing(*n).movable)
            .collect();
        (0..TRIES).find_map(|_| {
            let on = self.world.thing(*self.random.pick(&supports)?).name.clone();
            let place = Place { on: Some(on), ..Place::default() };
            let spot = self.world.place(thing, &place, &mut self.random).ok()?;
            let [x, y, _] = spot.pose.position();
            let yaw = crate::simulation::blocks::yaw(&spot.pose);
            let (at, yaw_deg) = (Some([x, y]), Some(yaw.to_degrees()));
            Some(Place { at, yaw_deg, ..place })
        })
    }

    fn room_of(&self, n: usize) -> String {
        let room = self.world.thing(n).room;
        self.world.house().rooms[room].label.as_str().to_owned()
    }

    /// Such as `the table in the kitchen`.
    fn support_and_room(&self, place: &Place) -> String {
        let support = place.on.as_ref().and_then(|on| self.world.find(on).ok());
        support.map_or(String::new(), |n| {
            format!("the {} in the {}", self.world.thing(n).label.as_str(), self.room_of(n))
        })
    }
}
