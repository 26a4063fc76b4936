//! Integrity and determinism: is the recording what it was, and does it give what it gave?

mod contents;
mod structure;

use std::path::Path;

use super::chain::{Chain, GENESIS, Link};
use super::open::{OpenError, Recording, Segment};
use super::orphans::Orphans;
use super::reprocess::Again;
use crate::change::World;
use crate::graph::StateHash;
use crate::updater::{Config, Updater};

/// The verdict, the worst that was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// Nothing is wrong.
    Intact,
    /// The detectors derive something else from the inputs than was recorded, or the recorded
    /// primitives do not give the recorded states.
    Nondeterministic,
    /// The end is missing, as after a crash; everything before it is whole.
    Truncated,
    /// All checksums hold, but the events are not those that were recorded.
    Tampered,
    /// Bytes were lost or changed.
    Corrupt,
}

impl Status {
    /// The word for it in JSON.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Intact => "intact",
            Self::Nondeterministic => "nondeterministic",
            Self::Truncated => "truncated",
            Self::Tampered => "tampered",
            Self::Corrupt => "corrupt",
        }
    }
}

/// One thing that is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// What kind it is.
    pub status: Status,
    /// File name of the segment.
    pub segment: String,
    /// In words, with the place.
    pub what: String,
}

/// What came of verifying.
#[derive(Clone, Debug, PartialEq)]
pub struct Verified {
    /// The verdict.
    pub status: Status,
    /// Hash of the graph after the last intact event.
    pub hash: StateHash,
    /// The seal of the chain, or its last link where the recording has no seal; compare it with
    /// one kept elsewhere. `None` if events are lost: then nobody can tell.
    pub chain: Option<Link>,
    /// How many events were read.
    pub events: u64,
    /// How many checkpoints were found to be right.
    pub checkpoints: u64,
    /// How many inputs gave again what was recorded.
    pub reprocessed: u64,
    /// What is wrong.
    pub findings: Vec<Finding>,
    /// Event numbers after which events are missing, if it was recovered from a damaged one.
    pub gaps: Vec<u64>,
}

/// Reads all of the recording at `path` and checks everything that can be checked: structure
/// and checksums, the hash chain, the states at checkpoints and at the end by folding, and the
/// derived records by running the detectors again. `progress` is told the events read so far.
pub fn verify(path: &Path, progress: &mut dyn FnMut(u64)) -> Result<Verified, OpenError> {
    Ok(verify_opened(&Recording::scan(path)?, &Recording::open(path)?, progress))
}

/// As [`verify`], of a recording in memory.
pub fn verify_bytes(name: &str, bytes: Vec<u8>) -> Result<Verified, OpenError> {
    let opened = Recording::from_bytes(name, bytes.clone())?;
    Ok(verify_opened(&Recording::scan_bytes(name, bytes)?, &opened, &mut |_| {}))
}

/// A scan does not look at the indexes, opening does; both must tell the same.
fn verify_opened(
    scanned: &Recording,
    opened: &Recording,
    progress: &mut dyn FnMut(u64),
) -> Verified {
    let mut check = Check::new(scanned);
    check.structure();
    check.compare_indexes(opened);
    check.contents(progress);
    check.verdict()
}

struct Check<'r> {
    recording: &'r Recording,
    findings: Vec<Finding>,
    chain: Chain,
    world: World,
    again: Option<Again>,
    order: u64,
    events: u64,
    checkpoints: u64,
    reprocessed: u64,
    /// Something before here is missing: states cannot be compared until a checkpoint.
    broken: bool,
    /// Something is missing that the recording does not know of: links cannot be compared.
    lost: bool,
    ever_lost: bool,
    changes: u64,
    primitives: u64,
    orphans: Orphans,
    /// Where the last segment ended.
    ended: Option<Link>,
    gaps: Vec<u64>,
}

impl<'r> Check<'r> {
    pub(super) fn new(recording: &'r Recording) -> Self {
        let config = recording.meta().map_or_else(Config::default, |meta| meta.config.clone());
        let first = recording.segments.first().map_or(GENESIS, Segment::first_link);
        let gaps = recording.segments.iter().filter_map(|segment| segment.meta.as_ref());
        Self {
            recording,
            findings: Vec::new(),
            chain: Chain::after(first),
            world: World::default(),
            again: Some(Again::new(Updater::new(config))),
            order: 0,
            events: 0,
            checkpoints: 0,
            reprocessed: 0,
            broken: false,
            lost: false,
            ever_lost: false,
            changes: 0,
            primitives: 0,
            orphans: Orphans::of(recording, 0),
            ended: None,
            gaps: gaps.flat_map(|meta| meta.gaps.clone()).collect(),
        }
    }

    pub(super) fn find(&mut self, status: Status, segment: &Segment, what: String) {
        let segment = segment.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let finding = Finding { status, segment, what };
        if self.findings.len() < 1000 && !self.findings.contains(&finding) {
            self.findings.push(finding);
        }
    }

    /// Ends a stretch over which the detectors ran again, and notes what they said differently.
    pub(super) fn compare_derived(&mut self, segment: &Segment) {
        self.settle(segment);
        let Some(again) = self.again.take() else { return };
        let result = again.finish();
        self.reprocessed += result.inputs - result.different;
        for difference in result.differences.iter().take(20) {
            let order = difference.order;
            let what = format!("the detectors derive something else now from event #{order}");
            self.find(Status::Nondeterministic, segment, what);
        }
    }

    fn verdict(mut self) -> Verified {
        if let Some(segment) = self.recording.segments.last() {
            self.compare_derived(segment);
        }
        let worst = self.findings.iter().map(|finding| finding.status).max();
        Verified {
            status: worst.unwrap_or(Status::Intact),
            hash: self.world.graph().hash(),
            chain: self.ended.filter(|_| !self.ever_lost),
            events: self.events,
            checkpoints: self.checkpoints,
            reprocessed: self.reprocessed,
            findings: self.findings,
            gaps: self.gaps,
        }
    }
}
