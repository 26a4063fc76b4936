//! The JSON documents of the CLI contract, one struct for each.
//!
//! Knows nothing of commands, files or terminals. Domain types are not serialised themselves, so
//! that they can change without changing what other programs read. Field names, their order and
//! their meaning are a contract: fields are only ever added, at the end. Ids print as `O17`,
//! times as RFC 3339 in UTC, lengths in metres, angles as unit quaternions, rates in 1/s.
//! Numbers print as the domain has them.
//!
//! Main items: [`ChangeDocument`], [`PrimitiveDocument`], [`EventDocument`].

mod change;
mod event;
mod parts;
mod primitive;
#[cfg(test)]
mod tests;

pub use change::ChangeDocument;
pub use event::{
    CauseDocument, ContentDocument, EventDocument, SpanDocument, StaleTargetDocument, StepDocument,
};
pub use parts::{
    EvidenceDocument, OccurredDocument, OrientationDocument, PoseDocument, RefDocument,
};
pub use primitive::{NodeDocument, PlacementDocument, PrimitiveDocument, SightingDocument};
