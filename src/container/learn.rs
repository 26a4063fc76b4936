//! Schemas and channels of a file, wherever they are defined.
//!
//! Definitions in a chunk are believed first, since its checksum covers them; those outside
//! chunks fill what is missing.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use mcap::records::{Channel, op};

use super::chunk::ChunkBuffer;
use super::damage::{Damage, DamageKind};
use super::entry::{ChunkEntry, Compression};
use super::limits::Limits;
use super::scan::Found;
use super::source::Source;
use super::wire::{self, Schema};

/// Schemas and channels by id.
#[derive(Default)]
pub(super) struct Definitions {
    pub schemas: BTreeMap<u16, Schema>,
    pub channels: BTreeMap<u16, Channel>,
    bytes: u64,
}

impl Definitions {
    /// Adds a schema, or says that another one has its id.
    pub(super) fn add_schema(&mut self, schema: Schema) -> Result<(), DamageKind> {
        match self.schemas.get(&schema.id) {
            Some(known) if *known == schema => Ok(()),
            Some(known) => Err(DamageKind::Redefined { what: "schema", id: known.id }),
            None => {
                self.schemas.insert(schema.id, schema);
                Ok(())
            }
        }
    }

    /// Adds a channel, or says that another one has its id.
    pub(super) fn add_channel(&mut self, channel: Channel) -> Result<(), DamageKind> {
        match self.channels.get(&channel.id) {
            Some(known) if *known == channel => Ok(()),
            Some(known) => Err(DamageKind::Redefined { what: "channel", id: known.id }),
            None => {
                self.channels.insert(channel.id, channel);
                Ok(())
            }
        }
    }

    /// Says whether the definitions in a chunk agree with those known.
    pub(super) fn check(&self, buffer: &ChunkBuffer) -> Result<(), DamageKind> {
        for (opcode, body) in buffer.definitions() {
            let malformed = DamageKind::Malformed { opcode };
            if opcode == op::SCHEMA {
                let schema = wire::schema(body).ok_or(malformed)?;
                let id = schema.id;
                if self.schemas.get(&id).is_some_and(|known| *known != schema) {
                    return Err(DamageKind::Redefined { what: "schema", id });
                }
            } else {
                let channel = wire::channel(body).ok_or(malformed)?;
                let id = channel.id;
                if self.channels.get(&id).is_some_and(|known| *known != channel) {
                    return Err(DamageKind::Redefined { what: "channel", id });
                }
            }
        }
        Ok(())
    }

    fn take_from(&mut self, buffer: &ChunkBuffer, limit: u64) -> Result<(), DamageKind> {
        self.check(buffer)?;
        for (opcode, body) in buffer.definitions() {
            let known = if opcode == op::SCHEMA {
                wire::schema(body).is_none_or(|schema| self.schemas.contains_key(&schema.id))
            } else {
                wire::channel(body).is_none_or(|channel| self.channels.contains_key(&channel.id))
            };
            if known {
                continue;
            }
            // Small records cost more in memory than in the file.
            self.bytes += body.len() as u64 + 64;
            if self.bytes > limit {
                return Err(DamageKind::TooMuch { what: "schema and channel definitions", limit });
            }
            if let Some(schema) = wire::schema(body).filter(|_| opcode == op::SCHEMA) {
                self.add_schema(schema)?;
            } else if let Some(channel) = wire::channel(body) {
                self.add_channel(channel)?;
            }
        }
        Ok(())
    }

    fn explains(&self, channel: u16) -> bool {
        self.channels
            .get(&channel)
            .is_some_and(|c| c.schema_id == 0 || self.schemas.contains_key(&c.schema_id))
    }
}

/// Completes `definitions` from the chunks and loose records that were found, and notes what is
/// in chunks that no index describes.
pub(super) fn learn(
    source: &dyn Source,
    limits: &Limits,
    found: &mut Found,
    definitions: &mut Definitions,
) {
    let mut chunks = std::mem::take(&mut found.chunks);
    let mut buffer = ChunkBuffer::new();
    // Channels whose first intact chunk has been read: a definition can only be there or before.
    let mut searched = BTreeSet::new();
    for entry in &mut chunks {
        if !must_read(entry, definitions, &searched) {
            continue;
        }
        // A damaged chunk is reported when it is read for its messages.
        if buffer.load(source, limits, entry).is_err() {
            continue;
        }
        // A conflict shows again whenever the chunk is read.
        let _ = definitions.take_from(&buffer, limits.definition_bytes);
        let channels = entry.channels.get_or_insert_with(|| count_channels(&buffer));
        searched.extend(channels.keys().copied());
    }
    found.chunks = chunks;
    add_loose(found, definitions);
}

fn must_read(entry: &ChunkEntry, definitions: &Definitions, searched: &BTreeSet<u16>) -> bool {
    // Loose definitions have been seen by the walk itself.
    entry.compression != Compression::Loose
        && entry.channels.as_ref().is_none_or(|channels| {
            channels.keys().any(|id| !searched.contains(id) && !definitions.explains(*id))
        })
}

fn count_channels(buffer: &ChunkBuffer) -> BTreeMap<u16, Option<u64>> {
    let mut counts: BTreeMap<u16, u64> = BTreeMap::new();
    for message in buffer.messages() {
        *counts.entry(message.channel).or_default() += 1;
    }
    counts.into_iter().map(|(channel, count)| (channel, Some(count))).collect()
}

fn add_loose(found: &mut Found, definitions: &mut Definitions) {
    // Behind the data section stand copies, which cannot overrule what the data says.
    let data_end = found.data_end.map_or(u64::MAX, |(offset, _)| offset);
    for (at, schema) in std::mem::take(&mut found.schemas) {
        let conflict = definitions.add_schema(schema).err();
        report(found, conflict.filter(|_| at.start < data_end), &at);
    }
    for (at, channel) in std::mem::take(&mut found.channels) {
        let conflict = definitions.add_channel(channel).err();
        report(found, conflict.filter(|_| at.start < data_end), &at);
    }
}

fn report(found: &mut Found, kind: Option<DamageKind>, at: &Range<u64>) {
    let (offset, length) = (at.start, at.end - at.start);
    found.damage.extend(kind.map(|kind| Damage { offset, length, kind }));
}
