//! [`EvidenceRef`]: which message of the log something rests on.

use std::borrow::Cow;

/// Points to a message of the same log.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EvidenceRef {
    /// The topic it was recorded on.
    pub topic: Cow<'static, str>,
    /// Its event number: the place in the total order of the log, from 1.
    pub order: u64,
}
