//! [`ChangeDocument`]: a change record, as every command prints it.

use serde::Serialize;

use super::{EvidenceDocument, OccurredDocument, PoseDocument, RefDocument};
use crate::change::{ChangeRecord, Outcome};

/// A change record: the unified language in JSON.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ChangeDocument {
    /// Number of the change in its log, from 1.
    pub seq: u64,
    /// When it was learned.
    pub at: String,
    /// `human`, `action`, `perception` or `time`.
    pub modality: &'static str,
    /// Name and version of the detector.
    pub detector: String,
    /// `added`, `moved` or `removed`.
    pub action: &'static str,
    /// The object it is about.
    pub object: RefDocument,
    /// The room it was in.
    pub source_room: Option<RefDocument>,
    /// The room it is in now.
    pub target_room: Option<RefDocument>,
    /// What it rests on now; for a removal, what it rested on.
    pub support: Option<RefDocument>,
    /// Its pose now, if measured.
    pub pose: Option<PoseDocument>,
    /// Its box (w, h, d) in metres, if measured.
    pub size: Option<[f64; 3]>,
    /// How sure the detector is, in [0, 1].
    pub confidence: f64,
    /// When it happened in the world.
    pub occurred: OccurredDocument,
    /// `applied` or `rejected`.
    pub outcome: &'static str,
    /// Why it was rejected, in words.
    pub reason: Option<String>,
    /// What it rests on.
    pub evidence: Vec<EvidenceDocument>,
    /// The stable word for why it was rejected.
    pub code: Option<String>,
    /// Whether a removal is a pick: the object is in the gripper.
    pub held: bool,
}

impl ChangeDocument {
    /// The document of a change record.
    pub fn of(record: &ChangeRecord) -> Self {
        let claim = &record.claim;
        let (outcome, reason, code) = match &record.outcome {
            Outcome::Applied => ("applied", None, None),
            Outcome::Rejected { code, reason } => {
                ("rejected", Some(reason.clone()), Some(code.to_string()))
            }
        };
        Self {
            seq: record.seq,
            at: record.at.to_string(),
            modality: claim.modality.as_str(),
            detector: claim.detector.to_string(),
            action: claim.action.as_str(),
            object: RefDocument::of(&claim.object),
            source_room: RefDocument::maybe(claim.source_room.as_ref()),
            target_room: RefDocument::maybe(claim.target_room.as_ref()),
            support: RefDocument::maybe(claim.support.as_ref()),
            pose: claim.pose.as_ref().map(PoseDocument::of),
            size: claim.size.map(crate::geometry::Size::metres),
            confidence: claim.confidence,
            occurred: OccurredDocument::of(&claim.occurred),
            outcome,
            reason,
            evidence: claim.evidence.iter().map(EvidenceDocument::of).collect(),
            code,
            held: claim.held,
        }
    }
}
