//! The metadata records of a recording: [`Meta`] at the start, [`Seal`] at the end.

use std::collections::BTreeMap;

use super::chain::{GENESIS, Link, hash_of};
use crate::graph::StateHash;
use crate::updater::{Config, ConfigError};

/// Version of the recording format.
pub const FORMAT_VERSION: u32 = 1;

const META: &str = "scenefold";
const SEAL: &str = "scenefold.end";

/// What a segment says of itself at the start.
#[derive(Clone, Debug, PartialEq)]
pub struct Meta {
    /// Version of the recording format.
    pub format_version: u32,
    /// Program that wrote it, with its version.
    pub program: String,
    /// Every threshold it went by.
    pub config: Config,
    /// Number of its first event.
    pub first_order: u64,
    /// Where the recording before this segment ended: its seal, or its last link if it has none.
    pub chain: Link,
    /// Number of an event up to which the hash chain did not hold, if it was recovered from an
    /// edited recording.
    pub edited: Option<u64>,
    /// Event numbers after which events are known to be missing, if it was recovered from a
    /// damaged recording.
    pub gaps: Vec<u64>,
}

/// What a segment says of itself at the end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seal {
    /// Number of its last event.
    pub events: u64,
    /// Number of its last change.
    pub changes: u64,
    /// Number of primitives in this segment.
    pub primitives: u64,
    /// The seal: over the last link of the chain and everything above and below.
    pub chain: Link,
    /// Hash of the graph after its last event.
    pub state_hash: StateHash,
}

/// What a seal is over.
#[derive(Clone, Copy, Debug)]
pub struct Ending<'m> {
    /// Number of the last event.
    pub events: u64,
    /// Number of the last change.
    pub changes: u64,
    /// Number of primitives in the segment.
    pub primitives: u64,
    /// Link of the chain after the last event.
    pub link: Link,
    /// Hash of the graph after the last event.
    pub state_hash: StateHash,
    /// What the segment says of itself.
    pub meta: &'m Meta,
}

impl Ending<'_> {
    /// The seal.
    pub fn seal(&self) -> Seal {
        let Self { events, changes, primitives, state_hash, meta, .. } = *self;
        let counts = [events, changes, primitives].map(u64::to_le_bytes).concat();
        let gaps: Vec<u8> = meta.gaps.iter().flat_map(|gap| gap.to_le_bytes()).collect();
        let edited = meta.edited.map_or(Vec::new(), |order| order.to_le_bytes().to_vec());
        let chain = hash_of(&[&self.link.0, &counts, &state_hash.0, &gaps, &edited]);
        Seal { events, changes, primitives, chain, state_hash }
    }
}

/// Why the metadata of a recording is not understood.
#[derive(Debug, thiserror::Error)]
pub enum MetaError {
    /// A recording of a later format.
    #[error("the recording has format version {found}, this program reads up to 1: update it")]
    Version {
        /// The version found.
        found: u32,
    },
    /// A field that is missing or has no sensible value.
    #[error("metadata record {record:?} has no valid field {field:?}")]
    Field {
        /// Which record.
        record: &'static str,
        /// Which field.
        field: &'static str,
    },
    /// A configuration of another program.
    #[error(transparent)]
    Config(#[from] ConfigError),
}

type Map = BTreeMap<String, String>;

impl Meta {
    /// What a new recording says of itself.
    pub fn new(config: Config, first_order: u64, chain: Link) -> Self {
        let program = concat!("scenefold ", env!("CARGO_PKG_VERSION")).to_owned();
        let (format_version, edited, gaps) = (FORMAT_VERSION, None, Vec::new());
        Self { format_version, program, config, first_order, chain, edited, gaps }
    }

    /// The link before the first event of the segment.
    pub fn first_link(&self) -> Link {
        let numbers = [u64::from(self.format_version), self.first_order].map(u64::to_le_bytes);
        let (program, config) = (self.program.as_bytes(), self.config.to_json());
        hash_of(&[&self.chain.0, &numbers.concat(), program, config.as_bytes()])
    }

    /// The metadata record: its name and its fields.
    pub fn record(&self) -> (&'static str, Map) {
        let gaps: Vec<String> = self.gaps.iter().map(u64::to_string).collect();
        let mut map = map([
            ("format_version", self.format_version.to_string()),
            ("program", self.program.clone()),
            ("config", self.config.to_json()),
            ("first_order", self.first_order.to_string()),
            ("chain", self.chain.to_string()),
        ]);
        if !gaps.is_empty() {
            map.insert("gaps".to_owned(), gaps.join(","));
        }
        if let Some(order) = self.edited {
            map.insert("edited".to_owned(), order.to_string());
        }
        (META, map)
    }

    /// Finds and reads it among the metadata of a file; `None` if there is none.
    pub(super) fn find(records: &[mcap::records::Metadata]) -> Result<Option<Self>, MetaError> {
        let Some(map) = find(records, META) else { return Ok(None) };
        let format_version = field(map, META, "format_version")?;
        if format_version > FORMAT_VERSION {
            return Err(MetaError::Version { found: format_version });
        }
        let missing = |field| MetaError::Field { record: META, field };
        let config = map.get("config").ok_or(missing("config"))?;
        let gaps = map.get("gaps").map_or(Ok(vec![]), |gaps| {
            gaps.split(',').map(|gap| gap.parse().map_err(|_| missing("gaps"))).collect()
        })?;
        let edited = match map.contains_key("edited") {
            true => Some(field(map, META, "edited")?),
            false => None,
        };
        Ok(Some(Self {
            format_version,
            edited,
            program: map.get("program").cloned().unwrap_or_default(),
            config: Config::from_json(config)?,
            first_order: field(map, META, "first_order")?,
            chain: hash(map, "chain").ok_or(missing("chain"))?,
            gaps,
        }))
    }
}

impl Default for Meta {
    fn default() -> Self {
        Self::new(Config::default(), 1, GENESIS)
    }
}

impl Seal {
    /// The metadata record: its name and its fields.
    pub fn record(&self) -> (&'static str, Map) {
        let map = map([
            ("events", self.events.to_string()),
            ("changes", self.changes.to_string()),
            ("primitives", self.primitives.to_string()),
            ("chain", self.chain.to_string()),
            ("state_hash", self.state_hash.to_string()),
        ]);
        (SEAL, map)
    }

    /// Finds and reads it among the metadata of a file; `None` if there is none.
    pub(super) fn find(records: &[mcap::records::Metadata]) -> Result<Option<Self>, MetaError> {
        let Some(map) = find(records, SEAL) else { return Ok(None) };
        let missing = |field| MetaError::Field { record: SEAL, field };
        Ok(Some(Self {
            events: field(map, SEAL, "events")?,
            changes: field(map, SEAL, "changes")?,
            primitives: field(map, SEAL, "primitives")?,
            chain: hash(map, "chain").ok_or(missing("chain"))?,
            state_hash: hash(map, "state_hash").ok_or(missing("state_hash"))?,
        }))
    }
}

fn map<const N: usize>(fields: [(&str, String); N]) -> Map {
    fields.into_iter().map(|(key, value)| (key.to_owned(), value)).collect()
}

fn find<'a>(records: &'a [mcap::records::Metadata], name: &str) -> Option<&'a Map> {
    records.iter().rev().find(|record| record.name == name).map(|record| &record.metadata)
}

fn field<T: std::str::FromStr>(
    map: &Map,
    record: &'static str,
    field: &'static str,
) -> Result<T, MetaError> {
    let parsed = map.get(field).and_then(|text| text.parse().ok());
    parsed.ok_or(MetaError::Field { record, field })
}

fn hash(map: &Map, field: &str) -> Option<StateHash> {
    map.get(field)?.parse().ok()
}
