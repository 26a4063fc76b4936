//! [`plan`]: the walk, and what it is expected to be worth.

use super::exact::{EXACT_ROOMS, best_exact};
use super::greedy::{best_greedy, bound};
use super::rooms::RoomGraph;
use crate::graph::{NodeId, Object, SceneGraph};

/// What a look at an object is worth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Gain {
    /// 1 − p: how many wrong beliefs it is expected to repair.
    #[default]
    Stale,
    /// −p log₂ p − (1−p) log₂ (1−p): how many bits it is expected to tell.
    Entropy,
}

impl Gain {
    /// What a look is worth at something that is there with this probability.
    pub fn of(self, probability: f64) -> f64 {
        let bits = |p: f64| if p > 0.0 { -p * libm::log2(p) } else { 0.0 };
        match self {
            Self::Stale => 1.0 - probability,
            Self::Entropy => bits(probability) + bits(1.0 - probability),
        }
    }
}

/// What a patrol is to be like.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wish {
    /// How far it may go, metres: the most gain within that is sought. Without it, the most gain
    /// per metre.
    pub budget_m: Option<f64>,
    /// What a look is worth.
    pub gain: Gain,
    /// A walk that gains less than this for each metre is not worth it: the robot stays, and more
    /// can be gained later.
    pub worth_per_m: f64,
}

/// Something to look at.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// The object.
    pub object: NodeId,
    /// Probability that it is where it was last observed.
    pub probability: f64,
}

/// A room on the walk.
#[derive(Clone, Debug, PartialEq)]
pub struct Stop {
    /// The room.
    pub room: NodeId,
    /// Metres walked by then.
    pub metres: f64,
    /// What the look into it is worth; 0 where it was looked into before.
    pub gain: f64,
    /// What to look at, least probable first.
    pub targets: Vec<Target>,
}

/// A walk through rooms.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// The rooms in order, the one it begins in first.
    pub stops: Vec<Stop>,
    /// How long it is, metres.
    pub metres: f64,
    /// What it is worth, with the room it begins in.
    pub gain: f64,
    /// Whether no other walk is better.
    pub exact: bool,
    /// No walk is worth more than this: gain with a budget, gain per metre beyond the room it
    /// begins in without one.
    pub bound: f64,
    /// Rooms with something to gain that no way leads to.
    pub unreachable: Vec<NodeId>,
}

/// What is sought: with a budget the most gain, without one the most gain per metre.
#[derive(Clone, Copy, Debug)]
pub(super) struct Goal {
    pub budget: Option<f64>,
}

impl Goal {
    /// How good a walk is; the first of two equal numbers decides, then the second.
    pub fn value(self, gain: f64, metres: f64) -> (f64, f64) {
        match self.budget {
            Some(_) => (gain, -metres),
            None if metres > 0.0 => (gain / metres, gain),
            None => (0.0, 0.0),
        }
    }

    pub fn allows(self, metres: f64) -> bool {
        self.budget.is_none_or(|budget| metres <= budget + 1e-9)
    }
}

/// Rooms as numbers, with what each is worth; the room where it begins counts nothing here.
pub(super) struct Field<'r> {
    pub rooms: &'r RoomGraph,
    pub from: usize,
    pub gains: Vec<f64>,
}

/// Plans a patrol that begins in `from`: `probability` gives for an object that it is where the
/// graph says. `None` if `from` is no room of the graph.
pub fn plan(
    graph: &SceneGraph,
    rooms: &RoomGraph,
    from: NodeId,
    wish: &Wish,
    probability: impl Fn(NodeId, &Object) -> f64,
) -> Option<Plan> {
    let start = rooms.place(from)?;
    let mut targets: Vec<Vec<Target>> = vec![Vec::new(); rooms.rooms().len()];
    for (id, object) in graph.objects() {
        let probability = probability(id, object);
        if let Some(room) = rooms.place(object.room).filter(|_| probability < 1.0) {
            targets[room].push(Target { object: id, probability });
        }
    }
    for targets in &mut targets {
        targets.sort_by(|a, b| a.probability.total_cmp(&b.probability).then(a.object.cmp(&b.object)));
    }
    let worth = |targets: &Vec<Target>| targets.iter().map(|it| wish.gain.of(it.probability)).sum();
    let gains: Vec<f64> = targets.iter().map(worth).collect();
    let walk = walk(rooms, start, &gains, wish.budget_m);
    Some(walk.if_worth(rooms, &gains, wish.worth_per_m).into_plan(rooms, &gains, targets))
}

/// A walk by numbers of rooms.
pub(super) struct Walk {
    pub way: Vec<usize>,
    pub exact: bool,
    pub bound: f64,
    pub unreachable: Vec<usize>,
}

pub(super) fn walk(rooms: &RoomGraph, from: usize, gains: &[f64], budget: Option<f64>) -> Walk {
    let goal = Goal { budget };
    let mut gains = gains.to_vec();
    gains[from] = 0.0;
    let cut_off = |room: &usize| gains[*room] > 0.0 && !rooms.metres(from, *room).is_finite();
    let unreachable: Vec<usize> = (0..gains.len()).filter(cut_off).collect();
    unreachable.iter().for_each(|room| gains[*room] = 0.0);
    let field = Field { rooms, from, gains };
    let worth = field.gains.iter().filter(|gain| **gain > 0.0).count();
    let exact = worth <= EXACT_ROOMS;
    let way = if exact { best_exact(&field, goal) } else { best_greedy(&field, goal) };
    let bound = match exact {
        true => goal.value(field.gain(&way), field.length(&way)).0,
        false => bound(&field, goal),
    };
    Walk { way, exact, bound, unreachable }
}

impl Field<'_> {
    /// What a walk is worth: each room counts once.
    pub fn gain(&self, way: &[usize]) -> f64 {
        let mut seen = vec![false; self.gains.len()];
        let fresh = |room: &&usize| !std::mem::replace(&mut seen[**room], true);
        way.iter().filter(fresh).map(|room| self.gains[*room]).sum()
    }

    /// How long a walk is, beginning where the field does.
    pub fn length(&self, way: &[usize]) -> f64 {
        let from = std::iter::once(&self.from).chain(way);
        from.zip(way).map(|(a, b)| self.rooms.metres(*a, *b)).sum()
    }
}

impl Walk {
    /// This walk if it gains so much for each metre beyond the first room, else none.
    fn if_worth(mut self, rooms: &RoomGraph, gains: &[f64], worth_per_m: f64) -> Self {
        let from = self.way[0];
        let field = Field { rooms, from, gains: gains.to_vec() };
        let gain = field.gain(&self.way) - gains[from];
        if gain < worth_per_m * field.length(&self.way) {
            self.way.truncate(1);
        }
        self
    }

    fn into_plan(self, rooms: &RoomGraph, gains: &[f64], mut targets: Vec<Vec<Target>>) -> Plan {
        let from = self.way.first().copied().unwrap_or_default();
        let (mut metres, mut total, mut last) = (0.0, 0.0, from);
        let mut seen = vec![false; gains.len()];
        let mut stops = Vec::with_capacity(self.way.len());
        for room in self.way {
            metres += rooms.metres(last, room);
            last = room;
            let fresh = !std::mem::replace(&mut seen[room], true);
            let gain = if fresh { gains[room] } else { 0.0 };
            total += gain;
            let targets = std::mem::take(&mut targets[room]);
            stops.push(Stop { room: rooms.rooms()[room], metres, gain, targets });
        }
        let id = |room: &usize| rooms.rooms()[*room];
        let unreachable = self.unreachable.iter().map(id).collect();
        Plan { stops, metres, gain: total, exact: self.exact, bound: self.bound, unreachable }
    }
}
