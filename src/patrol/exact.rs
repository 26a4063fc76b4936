//! The best walk, by dynamic programming over sets of rooms.
//!
//! A state is the set of worthwhile rooms looked into and the room one stands in; the shortest
//! way to each state is found as Dijkstra found ways ("A note on two problems in connexion with
//! graphs", 1959; over sets: Held and Karp, "A dynamic programming approach to sequencing
//! problems", 1962). The best of all states is the best walk.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use super::plan::{Field, Goal};

/// Most rooms with something to gain for which the best walk is found.
pub const EXACT_ROOMS: usize = 12;

/// Rooms looked into, one bit each; and where one stands.
type State = (u32, usize);

/// Metres as an ordered number; never negative, never NaN.
#[derive(Clone, Copy, PartialEq)]
struct Metres(f64);

impl Eq for Metres {}

impl Ord for Metres {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl PartialOrd for Metres {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

/// The best walk, the room it begins in first.
pub(super) fn best_exact(field: &Field<'_>, goal: Goal) -> Vec<usize> {
    let worth: Vec<usize> = (0..field.gains.len()).filter(|n| field.gains[*n] > 0.0).collect();
    let bit = |room: usize| worth.iter().position(|it| *it == room).map_or(0, |n| 1_u32 << n);
    let start = (0, field.from);
    let mut settled: BTreeMap<State, (f64, Option<State>)> = BTreeMap::new();
    let mut queue = BinaryHeap::from([Reverse((Metres(0.0), start, None))]);
    while let Some(Reverse((Metres(metres), state, before))) = queue.pop() {
        if settled.contains_key(&state) {
            continue;
        }
        settled.insert(state, (metres, before));
        let (seen, room) = state;
        for (next, step) in field.rooms.next(room) {
            let onward = (seen | bit(*next), *next);
            let walked = metres + step;
            if goal.allows(walked) && !settled.contains_key(&onward) {
                queue.push(Reverse((Metres(walked), onward, Some(state))));
            }
        }
    }
    let gain = |seen: u32| -> f64 {
        worth.iter().enumerate().filter(|(n, _)| seen >> n & 1 == 1).map(|(_, it)| field.gains[*it]).sum()
    };
    let mut best = (goal.value(0.0, 0.0), start);
    for (state, (metres, _)) in &settled {
        let value = goal.value(gain(state.0), *metres);
        // Sums in another order differ in the last bits: better is better by more than that.
        let better = value.0 > best.0.0 + 1e-12;
        let equal = (value.0 - best.0.0).abs() <= 1e-12;
        if better || (equal && value.1 > best.0.1 + 1e-12) {
            best = (value, *state);
        }
    }
    back(&settled, best.1)
}

fn back(settled: &BTreeMap<State, (f64, Option<State>)>, end: State) -> Vec<usize> {
    let mut way = vec![end.1];
    let mut state = end;
    while let Some((_, Some(before))) = settled.get(&state) {
        way.push(before.1);
        state = *before;
    }
    way.reverse();
    way
}
