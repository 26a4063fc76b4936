//! [`RoomGraph`]: rooms, and how far it is from one to the next.

use std::collections::BTreeMap;

use crate::graph::{NodeId, SceneGraph};

/// Rooms and the ways between them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RoomGraph {
    rooms: Vec<NodeId>,
    /// By room: the rooms next to it and the metres to them, in order of id.
    next: Vec<Vec<(usize, f64)>>,
    /// Metres of the shortest way, infinite where there is none.
    shortest: Vec<Vec<f64>>,
    /// Whether no way between rooms is known, so that every room is taken to open to every other.
    pub open: bool,
}

/// From one room to the next where the centre of one of them is not known, metres.
pub const UNKNOWN_STEP_M: f64 = 4.0;

/// Most rooms that ways are found between.
pub const MAX_ROOMS: usize = 512;

/// Why there is no graph of rooms.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum RoomsError {
    /// No room at all.
    #[error("the graph has no room to patrol")]
    None,
    /// More than are taken.
    #[error("the graph has {count} rooms, a patrol takes up to {MAX_ROOMS}")]
    TooMany {
        /// How many.
        count: usize,
    },
    /// A length that is none.
    #[error("{from} to {to} is {metres} m: a way must be a number above 0")]
    Length {
        /// From.
        from: NodeId,
        /// To.
        to: NodeId,
        /// What was given.
        metres: f64,
    },
}

impl RoomGraph {
    /// The rooms of a scene graph: from one to the next it is as far as between the centres of
    /// their boxes, [`UNKNOWN_STEP_M`] where one has none. Where no room gives access to any
    /// other, nothing is known of doors, and every room is taken to open to every other.
    pub fn of(graph: &SceneGraph) -> Result<Self, RoomsError> {
        let rooms: Vec<NodeId> = graph.rooms().map(|(id, _)| id).collect();
        let mut access: Vec<(NodeId, NodeId)> = graph.access().collect();
        let open = access.is_empty() && rooms.len() > 1;
        if rooms.len() > MAX_ROOMS {
            return Err(RoomsError::TooMany { count: rooms.len() });
        }
        if open {
            let pairs = |(n, a): (usize, &NodeId)| {
                rooms[n + 1..].iter().map(|b| (*a, *b)).collect::<Vec<_>>()
            };
            access = rooms.iter().enumerate().flat_map(pairs).collect();
        }
        let ways = access.into_iter().map(|(a, b)| (a, b, metres(graph, a, b)));
        Ok(Self { open, ..Self::new(&rooms, ways)? })
    }

    /// Rooms and the ways between them, in metres.
    pub fn new(
        rooms: &[NodeId],
        ways: impl IntoIterator<Item = (NodeId, NodeId, f64)>,
    ) -> Result<Self, RoomsError> {
        if rooms.is_empty() {
            return Err(RoomsError::None);
        }
        let places: BTreeMap<NodeId, usize> =
            rooms.iter().enumerate().map(|(n, id)| (*id, n)).collect();
        let mut next = vec![Vec::new(); rooms.len()];
        for (from, to, metres) in ways {
            if !(metres.is_finite() && metres > 0.0) {
                return Err(RoomsError::Length { from, to, metres });
            }
            let Some((a, b)) = places.get(&from).zip(places.get(&to)) else { continue };
            next[*a].push((*b, metres));
            next[*b].push((*a, metres));
        }
        next.iter_mut().for_each(|ways| ways.sort_by_key(|(room, _)| *room));
        let shortest = shortest(&next);
        Ok(Self { rooms: rooms.to_vec(), next, shortest, open: false })
    }

    /// The rooms, in order of id.
    pub fn rooms(&self) -> &[NodeId] {
        &self.rooms
    }

    pub(super) fn place(&self, room: NodeId) -> Option<usize> {
        self.rooms.iter().position(|id| *id == room)
    }

    pub(super) fn next(&self, room: usize) -> &[(usize, f64)] {
        &self.next[room]
    }

    pub(super) fn metres(&self, from: usize, to: usize) -> f64 {
        self.shortest[from][to]
    }

    /// The rooms on a shortest way, without the first.
    pub(super) fn way(&self, from: usize, to: usize) -> Vec<usize> {
        let (mut at, mut way) = (from, Vec::new());
        while at != to {
            let onward = self.next[at].iter().min_by(|a, b| {
                let whole = |(room, step): &(usize, f64)| step + self.shortest[*room][to];
                whole(a).total_cmp(&whole(b))
            });
            let Some((room, _)) = onward.filter(|_| way.len() < self.rooms.len()) else { break };
            at = *room;
            way.push(at);
        }
        way
    }
}

fn metres(graph: &SceneGraph, a: NodeId, b: NodeId) -> f64 {
    let centre = |id| Some(graph.region(id)?.extent?.0.position());
    let Some(([ax, ay, az], [bx, by, bz])) = centre(a).zip(centre(b)) else {
        return UNKNOWN_STEP_M;
    };
    let (dx, dy, dz) = (ax - bx, ay - by, az - bz);
    // Two rooms drawn over each other are a step apart.
    libm::sqrt(dx * dx + dy * dy + dz * dz).max(0.1)
}

/// Shortest ways between all rooms (Floyd, "Algorithm 97: shortest path", 1962).
fn shortest(next: &[Vec<(usize, f64)>]) -> Vec<Vec<f64>> {
    let count = next.len();
    let mut metres = vec![vec![f64::INFINITY; count]; count];
    for (from, ways) in next.iter().enumerate() {
        metres[from][from] = 0.0;
        for (to, way) in ways {
            metres[from][*to] = way.min(metres[from][*to]);
        }
    }
    for via in 0..count {
        for from in 0..count {
            for to in 0..count {
                let around = metres[from][via] + metres[via][to];
                metres[from][to] = around.min(metres[from][to]);
            }
        }
    }
    metres
}
