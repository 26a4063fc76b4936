//! Patrol: in which order to look into rooms, so that most is learned for each metre walked.
//!
//! The paper's future work: time in path planning. What a look into a room is worth is the
//! number of beliefs it is expected to repair, Σ (1 − p) over the objects that are believed to be
//! there ([`Gain::Stale`]), or their entropy in bits ([`Gain::Entropy`]). A room that is walked
//! through is looked into. Distances are those between the centres of rooms with access to each
//! other ([`RoomGraph`]).
//!
//! With a budget of metres the walk with the largest gain within it is sought (orienteering;
//! Golden, Levy and Vohra, "The orienteering problem", 1987), without one that with the largest
//! gain per metre. Exact for up to [`EXACT_ROOMS`] rooms with anything to gain, by dynamic
//! programming over sets of rooms; beyond that the best of several greedy walks, told with a bound
//! on what any walk could gain ([`Plan::bound`]).
//!
//! A walk that gains too little for each metre need not be made at all ([`Wish::worth_per_m`]):
//! what is not looked at today is worth more tomorrow.
//!
//! Knows nothing of files. Deterministic: among equals the first room by id.

mod exact;
mod greedy;
mod plan;
mod rooms;
#[cfg(test)]
mod tests;

pub use exact::EXACT_ROOMS;
pub use plan::{Gain, Plan, Stop, Target, Wish, plan};
pub use rooms::{MAX_ROOMS, RoomGraph, RoomsError, UNKNOWN_STEP_M};
