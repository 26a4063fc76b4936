//! Time: what is probably no longer where it was seen (paper, "Time").
//!
//! # What it detects
//! p(static | Δt, l) = 2 / (1 + e^{λΔt}) falls while nobody looks ([`probability_static`]). An
//! object whose probability falls below a threshold is reported once, on `/evidence/staleness`,
//! at the first event at or after the moment it crosses ([`TimeDetector`]); it can be reported
//! again after it was added, moved or seen once more. λ is by class ([`DecayTable`]).
//!
//! # What it never does
//! Time removes nothing and moves nothing: it makes no change record at all. A report is a wish
//! for a look; what the look shows is for perception to say.
//!
//! # Static or not
//! Two poses of an object count as one place while `‖X_t ⊟ X_t0‖ < ε` ([`Stillness`]).
//!
//! # Cost
//! The moment of the next crossing is known ahead: a queue of them is kept, and an event before
//! the first costs one comparison, whatever the number of objects.

mod detector;
mod duration;
mod memory;
mod near;
mod stillness;
mod table;

pub use detector::TimeDetector;
pub use duration::{DurationError, HumanDuration};
pub use stillness::Stillness;
pub use table::{ClassDecay, DecayTable, Origin, TableError};
pub(crate) use table::read_decay;

/// ln 3: λ times the half-life, since 2 / (1 + e^{λt}) = 1/2 where e^{λt} = 3.
pub const LN_3: f64 = 1.098_612_288_668_109_8;

/// p(static | Δt) = 2 / (1 + e^{λΔt}), λ in 1/s, Δt in seconds (paper, "Time"); 1 where λ is 0.
pub fn probability_static(decay_rate: f64, age_s: f64) -> f64 {
    2.0 / (1.0 + libm::exp(decay_rate * age_s))
}

/// The age in seconds at which the probability falls to `probability`:
/// Δt = ln(2/p − 1) / λ; `None` if it never does (λ = 0, or a probability of 0).
pub fn age_at(decay_rate: f64, probability: f64) -> Option<f64> {
    let age_s = libm::log(2.0 / probability - 1.0) / decay_rate;
    (decay_rate > 0.0 && probability > 0.0 && age_s.is_finite()).then_some(age_s.max(0.0))
}

/// Half-life in seconds of a λ in 1/s: ln 3 / λ; `None` for λ = 0.
pub fn half_life_s(decay_rate: f64) -> Option<f64> {
    (decay_rate > 0.0).then(|| LN_3 / decay_rate)
}

#[cfg(test)]
mod tests;
