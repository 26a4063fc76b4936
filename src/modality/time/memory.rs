//! What the detector remembers between inputs, in bytes.

use std::collections::BTreeMap;

use super::detector::Watch;
use crate::bytes::{Reader, Writer};
use crate::graph::{CanonicalError, NodeId};
use crate::time::Stamp;

/// By object.
type Watched = BTreeMap<NodeId, Watch>;

pub(super) fn write(watched: &Watched, out: &mut Writer) {
    out.u64(watched.len() as u64);
    for (id, watch) in watched {
        out.u64(id.bits());
        out.u64(watch.since.nanos());
        out.option(watch.due, |out, due| out.u64(due.nanos()));
    }
}

pub(super) fn read(input: &mut Reader<'_>) -> Result<Watched, CanonicalError> {
    read_watched(input).ok_or(CanonicalError::Malformed { what: "memory of time" })
}

fn read_watched(input: &mut Reader<'_>) -> Option<Watched> {
    let count = input.u64()?;
    let mut watched = Watched::new();
    for _ in 0..count {
        let id = NodeId::try_from(input.u64()?).ok()?;
        let since = Stamp::from_nanos(input.u64()?);
        let due = input.option(|input| input.u64().map(Stamp::from_nanos))?;
        watched.insert(id, Watch { since, due });
    }
    Some(watched)
}
