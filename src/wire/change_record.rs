//! `ChangeRecord`: the unified language.

use std::borrow::Cow;

use super::common::{
    put_evidence, put_node_ref, put_pose, put_size, read_evidence, read_node_ref, read_pose,
    read_size, read_stamp,
};
use super::fields::{Field, Fields, required};
use super::put::Put;
use super::{WireError, proto};
use crate::change::{Action, ChangeRecord, Claim, Modality, NodeRef, Occurred, Outcome};
use crate::time::Stamp;

/// Most references that one record may hold.
pub const MAX_EVIDENCE: usize = 1 << 16;

const NAME: &str = "ChangeRecord";

/// Appends the payload of a change record.
pub(super) fn put_change_record(record: &ChangeRecord, out: &mut Vec<u8>) {
    let (claim, mut put) = (&record.claim, Put(out));
    put.u64(1, record.seq);
    put.fixed64(2, record.at.nanos());
    put.u64(3, modality(claim.modality) as u64);
    put.text(4, &claim.detector);
    put.u64(5, action(claim.action) as u64);
    put_node_ref(&mut put, 6, Some(&claim.object));
    put_node_ref(&mut put, 7, claim.source_room.as_ref());
    put_node_ref(&mut put, 8, claim.target_room.as_ref());
    put_node_ref(&mut put, 9, claim.support.as_ref());
    if let Some(pose) = &claim.pose {
        put.message(10, |put| put_pose(put, pose));
    }
    if let Some(size) = claim.size {
        put.message(11, |put| put_size(put, size));
    }
    put.double(12, claim.confidence);
    put.optional_fixed64(13, claim.occurred.not_before.map(Stamp::nanos));
    put.optional_fixed64(14, claim.occurred.not_after.map(Stamp::nanos));
    put.u64(15, claim.held.into());
    for reference in &claim.evidence {
        put.message(16, |put| put_evidence(put, reference));
    }
    match &record.outcome {
        Outcome::Applied => put.u64(17, proto::Outcome::Applied as u64),
        Outcome::Rejected { code, reason } => {
            put.u64(17, proto::Outcome::Rejected as u64);
            put.text(18, code);
            put.text(19, reason);
        }
    }
}

fn modality(modality: Modality) -> proto::Modality {
    match modality {
        Modality::Human => proto::Modality::Human,
        Modality::Action => proto::Modality::Action,
        Modality::Perception => proto::Modality::Perception,
        Modality::Time => proto::Modality::Time,
    }
}

fn action(action: Action) -> proto::Action {
    match action {
        Action::Added => proto::Action::Added,
        Action::Moved => proto::Action::Moved,
        Action::Removed => proto::Action::Removed,
    }
}

/// What has no value before its field is read.
#[derive(Default)]
struct Parts {
    seq: u64,
    at: Stamp,
    modality: Option<Modality>,
    action: Option<Action>,
    object: Option<NodeRef>,
    rejected: Option<bool>,
    code: String,
    reason: String,
}

pub(super) fn read_change_record(payload: &[u8]) -> Result<ChangeRecord, WireError> {
    let mut fields = Fields::new(NAME, payload);
    let (mut parts, mut claim) = (Parts::default(), empty_claim());
    while let Some(field) = fields.next()? {
        match field.number {
            1 => parts.seq = field.u64()?,
            2 => parts.at = read_stamp(&field, "at_nanos")?,
            3 => parts.modality = Some(read_modality(&field)?),
            5 => parts.action = Some(read_action(&field)?),
            6 => field.once(&mut parts.object, read_node_ref(&field)?)?,
            17 => parts.rejected = Some(read_outcome(&field)?),
            18 => field.text("reason_code")?.clone_into(&mut parts.code),
            19 => field.derived_text("reason")?.clone_into(&mut parts.reason),
            _ => read_claim(&field, &mut claim)?,
        }
    }
    let outcome = outcome(&mut parts)?;
    Ok(ChangeRecord {
        seq: required(Some(parts.seq).filter(|seq| *seq > 0), NAME, "seq")?,
        at: parts.at,
        claim: Claim {
            modality: required(parts.modality, NAME, "modality")?,
            action: required(parts.action, NAME, "action")?,
            object: required(parts.object, NAME, "object")?,
            ..claim
        },
        outcome,
    })
}

fn empty_claim() -> Claim {
    Claim {
        modality: Modality::Human,
        detector: Cow::Borrowed(""),
        action: Action::Added,
        object: NodeRef::default(),
        source_room: None,
        target_room: None,
        support: None,
        pose: None,
        size: None,
        confidence: 0.0,
        occurred: Occurred::default(),
        held: false,
        evidence: Vec::new(),
    }
}

fn read_claim(field: &Field<'_>, claim: &mut Claim) -> Result<(), WireError> {
    match field.number {
        4 => claim.detector = field.text("detector")?.to_owned().into(),
        7 => field.once(&mut claim.source_room, read_node_ref(field)?)?,
        8 => field.once(&mut claim.target_room, read_node_ref(field)?)?,
        9 => field.once(&mut claim.support, read_node_ref(field)?)?,
        10 => field.once(&mut claim.pose, read_pose(field.message("Pose")?)?)?,
        11 => field.once(&mut claim.size, read_size(field.message("Size")?)?)?,
        12 => claim.confidence = read_confidence(field)?,
        13 => claim.occurred.not_before = Some(read_stamp(field, "not_before_nanos")?),
        14 => claim.occurred.not_after = Some(read_stamp(field, "not_after_nanos")?),
        15 => claim.held = field.bool("held")?,
        16 if claim.evidence.len() == MAX_EVIDENCE => {
            let limit = MAX_EVIDENCE;
            return Err(WireError::TooMuch { message: NAME, field: "evidence", limit });
        }
        16 => claim.evidence.push(read_evidence(field)?),
        _ => {}
    }
    Ok(())
}

fn read_confidence(field: &Field<'_>) -> Result<f64, WireError> {
    let value = field.double()?;
    if (0.0..=1.0).contains(&value) {
        Ok(value + 0.0)
    } else {
        Err(field.refuse("confidence", value, "a number from 0 to 1"))
    }
}

fn read_modality(field: &Field<'_>) -> Result<Modality, WireError> {
    match field.u64()? {
        n @ 1..=4 => Ok(Modality::ALL[n as usize - 1]),
        other => {
            let expected = "1 (human), 2 (action), 3 (perception) or 4 (time)";
            Err(field.refuse("modality", other, expected))
        }
    }
}

fn read_action(field: &Field<'_>) -> Result<Action, WireError> {
    match field.u64()? {
        n @ 1..=3 => Ok(Action::ALL[n as usize - 1]),
        other => Err(field.refuse("action", other, "1 (added), 2 (moved) or 3 (removed)")),
    }
}

/// Whether it was rejected.
fn read_outcome(field: &Field<'_>) -> Result<bool, WireError> {
    match field.u64()? {
        1 => Ok(false),
        2 => Ok(true),
        other => Err(field.refuse("outcome", other, "1 (applied) or 2 (rejected)")),
    }
}

fn outcome(parts: &mut Parts) -> Result<Outcome, WireError> {
    let rejected = required(parts.rejected, NAME, "outcome")?;
    let (code, reason) = (std::mem::take(&mut parts.code), std::mem::take(&mut parts.reason));
    if rejected {
        let code = required(Some(code).filter(|code| !code.is_empty()), NAME, "reason_code")?;
        return Ok(Outcome::Rejected { code: code.into(), reason });
    }
    if code.is_empty() && reason.is_empty() {
        return Ok(Outcome::Applied);
    }
    let value = format!("{code:?}").into();
    let expected = "empty, as the claim was applied";
    Err(WireError::Value { message: NAME, field: "reason_code", value, expected })
}
