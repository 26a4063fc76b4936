//! Patrols against all walks there are.

use proptest::collection::vec;
use proptest::prelude::*;

use super::plan::{Field, Goal, walk};
use super::*;
use crate::graph::{Layer, NodeId};

fn room(n: usize) -> NodeId {
    NodeId::new(Layer::Room, n as u32).expect("few rooms")
}

fn graph(count: usize, ways: &[(usize, usize, f64)]) -> RoomGraph {
    let rooms: Vec<NodeId> = (0..count).map(room).collect();
    let ways = ways.iter().map(|(a, b, metres)| (room(a % count), room(b % count), *metres));
    RoomGraph::new(&rooms, ways.filter(|(a, b, _)| a != b)).expect("ways are long")
}

/// The best value over all walks of at most `steps` steps.
fn brute(field: &Field<'_>, goal: Goal, way: &mut Vec<usize>, steps: usize) -> (f64, f64) {
    let mut best = goal.value(field.gain(way), field.length(way));
    if steps == 0 {
        return best;
    }
    let at = *way.last().expect("it begins somewhere");
    for (next, _) in field.rooms.next(at) {
        way.push(*next);
        if goal.allows(field.length(way)) {
            let found = brute(field, goal, way, steps - 1);
            if found > best {
                best = found;
            }
        }
        way.pop();
    }
    best
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn no_walk_is_better_than_the_planned_one(
        gains in vec(prop_oneof![Just(0.0), 0.1..3.0_f64], 5),
        ways in vec((0..5_usize, 0..5_usize, 1.0..9.0_f64), 4..8),
        budget in prop_oneof![Just(None), (1.0..25.0_f64).prop_map(Some)],
    ) {
        let rooms = graph(5, &ways);
        let goal = Goal { budget };
        let found = walk(&rooms, 0, &gains, budget);
        prop_assert!(found.exact);
        let mut gains = gains;
        gains[0] = 0.0;
        let field = Field { rooms: &rooms, from: 0, gains };
        let value = goal.value(field.gain(&found.way), field.length(&found.way));
        let best = brute(&field, goal, &mut vec![0], 7);
        prop_assert!(value.0 >= best.0 - 1e-9, "{value:?} {best:?} {:?}", found.way);
        prop_assert!(goal.allows(field.length(&found.way)));
        let greedy = greedy::best_greedy(&field, goal);
        let greedy = goal.value(field.gain(&greedy), field.length(&greedy)).0;
        let bound = greedy::bound(&field, goal);
        prop_assert!(greedy <= value.0 + 1e-9 && value.0 <= bound + 1e-9, "{greedy} {value:?} {bound}");
    }

    #[test]
    fn a_large_house_is_walked_within_the_budget_and_the_bound(
        gains in vec(0.1..3.0_f64, 40),
        far in vec(2.0..8.0_f64, 40),
        budget in 5.0..60.0_f64,
    ) {
        let ways: Vec<_> = far.iter().enumerate().map(|(n, metres)| (n, n + 1, *metres)).collect();
        let rooms = graph(40, &ways);
        let found = walk(&rooms, 0, &gains, Some(budget));
        prop_assert!(!found.exact);
        let mut gains = gains;
        gains[0] = 0.0;
        let field = Field { rooms: &rooms, from: 0, gains };
        prop_assert!(field.length(&found.way) <= budget + 1e-9);
        prop_assert!(field.gain(&found.way) <= found.bound + 1e-9);
    }
}

#[test]
fn a_room_that_no_way_leads_to_is_told() {
    let rooms = graph(3, &[(0, 1, 2.0)]);
    let found = walk(&rooms, 0, &[0.0, 1.0, 5.0], None);
    assert_eq!((found.way, found.unreachable), (vec![0, 1], vec![2]));
}

#[test]
fn nothing_to_gain_is_nowhere_to_go() {
    let rooms = graph(3, &[(0, 1, 2.0), (1, 2, 2.0)]);
    assert_eq!(walk(&rooms, 1, &[0.0; 3], None).way, [1]);
    assert_eq!(walk(&rooms, 1, &[1.0, 0.0, 1.0], Some(0.0)).way, [1]);
    assert!(RoomGraph::new(&[], []).is_err());
    assert!(RoomGraph::new(&[room(0), room(1)], [(room(0), room(1), f64::NAN)]).is_err());
}

#[test]
fn entropy_is_a_bit_for_a_coin_and_nothing_for_what_is_certain() {
    assert!((Gain::Entropy.of(0.5) - 1.0).abs() < 1e-12);
    assert!(Gain::Entropy.of(1.0).abs() < 1e-12 && Gain::Entropy.of(0.0).abs() < 1e-12);
    assert!((Gain::Stale.of(0.25) - 0.75).abs() < 1e-12);
}
