//! `Staleness`: objects that are probably no longer where they were last observed.

use super::common::{node_ref, optional_ref, read_decay_rate, read_node_ref, read_stamp};
use super::fields::{Field, Fields, required};
use super::{WireError, proto};
use crate::event::{StaleTarget, Staleness};
use crate::graph::MAX_NODES;

const NAME: &str = "Staleness";
const TARGET: &str = "StaleTarget";

pub(super) fn staleness(stale: &Staleness) -> proto::Staleness {
    let target = |it: &StaleTarget| proto::StaleTarget {
        object: Some(node_ref(&it.object)),
        room: optional_ref(it.room.as_ref()),
        probability: it.probability,
        decay_rate_per_s: it.decay_rate,
        last_observed_nanos: it.last_observed.nanos(),
    };
    proto::Staleness {
        threshold: stale.threshold,
        targets: stale.targets.iter().map(target).collect(),
    }
}

pub(super) fn read_staleness(payload: &[u8]) -> Result<Staleness, WireError> {
    let mut fields = Fields::new(NAME, payload);
    let mut stale = Staleness { threshold: 0.0, targets: Vec::new() };
    while let Some(field) = fields.next()? {
        match field.number {
            1 => stale.threshold = read_probability(&field, "threshold")?,
            2 if stale.targets.len() == MAX_NODES => {
                return Err(WireError::TooMuch { message: NAME, field: "targets", limit: MAX_NODES });
            }
            2 => stale.targets.push(read_target(field.message(TARGET)?)?),
            _ => {}
        }
    }
    Ok(stale)
}

fn read_target(mut fields: Fields<'_>) -> Result<StaleTarget, WireError> {
    let (mut object, mut room, mut last_observed) = (None, None, None);
    let (mut probability, mut decay_rate) = (0.0, 0.0);
    while let Some(field) = fields.next()? {
        match field.number {
            1 => field.once(&mut object, read_node_ref(&field)?)?,
            2 => field.once(&mut room, read_node_ref(&field)?)?,
            3 => probability = read_probability(&field, "probability")?,
            4 => decay_rate = read_decay_rate(&field)?,
            5 => last_observed = Some(read_stamp(&field, "last_observed_nanos")?),
            _ => {}
        }
    }
    let object = required(object, TARGET, "object")?;
    let last_observed = last_observed.unwrap_or_default();
    Ok(StaleTarget { object, room, probability, decay_rate, last_observed })
}

fn read_probability(field: &Field<'_>, name: &'static str) -> Result<f64, WireError> {
    let value = field.double()?;
    let valid = (0.0..=1.0).contains(&value);
    // −0.0 becomes 0.0.
    if valid { Ok(value + 0.0) } else { Err(field.refuse(name, value, "from 0 to 1")) }
}
