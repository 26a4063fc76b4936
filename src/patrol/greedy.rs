//! Good walks through many rooms, and a bound on what any walk is worth.
//!
//! The heuristic: from where one stands, go to the room with the most gain for each metre,
//! counting what lies on the way; the same preferring large gains, and near rooms; the best
//! beginning of the best of these walks. The bound: the first time a walk looks into a room it has just walked a
//! way that ends there, at least as long as the shortest of them, and these ways are all
//! different. So no walk within a budget is worth more than filling it with rooms at those
//! prices, the best last one in part (a knapsack); and none is worth more for each metre than
//! the best room at its price.

use super::plan::{Field, Goal};

/// How much the gain counts against the way: gain^power / metres.
const POWERS: [f64; 4] = [0.5, 1.0, 1.5, 2.5];

/// The best walk found, the room it begins in first.
pub(super) fn best_greedy(field: &Field<'_>, goal: Goal) -> Vec<usize> {
    let mut best = (goal.value(0.0, 0.0), vec![field.from]);
    for power in POWERS {
        let way = greedy(field, goal, power);
        for end in 1..=way.len() {
            let part = &way[..end];
            let value = goal.value(field.gain(part), field.length(part));
            if value > best.0 {
                best = (value, part.to_vec());
            }
        }
    }
    best.1
}

fn greedy(field: &Field<'_>, goal: Goal, power: f64) -> Vec<usize> {
    let mut way = vec![field.from];
    let mut left = field.gains.clone();
    let (mut at, mut walked) = (field.from, 0.0);
    loop {
        let mut best: Option<(f64, usize)> = None;
        for (room, gain) in left.iter().enumerate().filter(|(_, gain)| **gain > 0.0) {
            let metres = field.rooms.metres(at, room);
            let value = libm::pow(*gain, power) / metres;
            let reaches = metres.is_finite() && goal.allows(walked + metres);
            if reaches && best.is_none_or(|(most, _)| value > most) {
                best = Some((value, room));
            }
        }
        let Some((_, room)) = best else { return way };
        for step in field.rooms.way(at, room) {
            walked += field.rooms.metres(at, step);
            left[step] = 0.0;
            at = step;
            way.push(step);
        }
    }
}

/// What no walk is worth more than.
pub(super) fn bound(field: &Field<'_>, goal: Goal) -> f64 {
    let price = |room: usize| {
        field.rooms.next(room).iter().map(|(_, metres)| *metres).fold(f64::INFINITY, f64::min)
    };
    let mut offers: Vec<(f64, f64)> = (0..field.gains.len())
        .filter(|room| field.gains[*room] > 0.0)
        .map(|room| (field.gains[room], price(room)))
        // A room without any way cannot be walked into.
        .filter(|(_, metres)| metres.is_finite())
        .collect();
    offers.sort_by(|a, b| (b.0 / b.1).total_cmp(&(a.0 / a.1)));
    let Some(mut budget) = goal.budget else {
        return offers.first().map_or(0.0, |(gain, metres)| gain / metres);
    };
    let mut total = 0.0;
    for (gain, metres) in offers {
        let share = (budget / metres).clamp(0.0, 1.0);
        total += share * gain;
        budget -= metres;
    }
    total
}
