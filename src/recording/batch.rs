//! [`Batch`]: the events of one chunk as the fold needs them, in memory that is used again.

use super::open::Segment;
use crate::change::{Edit, World, apply_edits};
use crate::container::{ChunkBuffer, ChunkEntry, Damage};
use crate::event::{Event, Topic};
use crate::graph::SceneGraph;
use crate::time::Stamp;
use crate::wire::{self, Labels};

/// What the messages of a channel are to the fold.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Kind {
    /// No events.
    #[default]
    Ignored,
    /// Events that change nothing.
    Noted,
    /// Transactions.
    Primitive,
    /// The graph at the start.
    Initial,
}

impl Kind {
    /// Of a channel of events.
    pub fn of(topic: &Topic) -> Self {
        match topic {
            Topic::Primitive => Self::Primitive,
            Topic::InitialGraph => Self::Initial,
            _ => Self::Noted,
        }
    }
}

/// What an event does to the world.
#[derive(Debug)]
enum Effect {
    Nothing,
    /// These edits of the batch, all or none.
    Edits(std::ops::Range<usize>),
    Initial(Box<SceneGraph>),
    /// That cannot be told.
    Unknown(String),
}

/// An event on its way to the fold.
#[derive(Debug)]
pub(super) struct Mark {
    pub order: u64,
    pub at: Stamp,
    effect: Effect,
}

/// Events in the order of the log, and what they do.
#[derive(Debug, Default)]
pub(super) struct Batch {
    pub marks: Vec<Mark>,
    pub edits: Vec<Edit>,
}

impl Batch {
    pub fn clear(&mut self) {
        self.marks.clear();
        self.edits.clear();
    }

    pub fn push(
        &mut self,
        kind: Kind,
        order: u64,
        log_time: u64,
        data: &[u8],
        labels: &mut Labels,
    ) {
        let at = Stamp::from_nanos(log_time);
        let effect = match kind {
            Kind::Ignored => return,
            Kind::Noted => Effect::Nothing,
            Kind::Primitive => self.transaction(at, data, labels),
            Kind::Initial => initial(at, data),
        };
        self.marks.push(Mark { order, at, effect });
    }

    fn transaction(&mut self, at: Stamp, data: &[u8], labels: &mut Labels) -> Effect {
        let start = self.edits.len();
        match wire::decode_edits(at, data, labels, &mut self.edits) {
            Ok(()) => Effect::Edits(start..self.edits.len()),
            Err(error) => Effect::Unknown(error.to_string()),
        }
    }
}

fn initial(at: Stamp, data: &[u8]) -> Effect {
    match wire::decode(&Topic::InitialGraph, at, data) {
        Ok(Event::InitialGraph(graph)) => Effect::Initial(Box::new(graph)),
        Ok(_) => Effect::Nothing,
        Err(error) => Effect::Unknown(error.to_string()),
    }
}

impl Mark {
    /// Does to `world` what the event says; `edits` are those of its batch.
    pub fn apply(self, edits: &[Edit], world: &mut World) -> Result<(), String> {
        match self.effect {
            Effect::Nothing => Ok(()),
            Effect::Edits(range) => {
                apply_edits(&edits[range], world).map_err(|error| error.to_string())
            }
            Effect::Initial(graph) => {
                *world = World::from_graph(*graph);
                Ok(())
            }
            Effect::Unknown(why) => Err(why),
        }
    }
}

/// What decoding needs besides the chunk, used again from chunk to chunk.
#[derive(Default)]
pub(super) struct Decoder {
    buffer: ChunkBuffer,
    labels: Labels,
}

impl Decoder {
    /// Decodes the events of a chunk into `batch`, which it replaces.
    pub fn decode(
        &mut self,
        segment: &Segment,
        entry: &ChunkEntry,
        batch: &mut Batch,
    ) -> Result<(), Damage> {
        batch.clear();
        segment.log.read_chunk_into(entry, &mut self.buffer)?;
        self.buffer.sort_by_time();
        for message in self.buffer.messages() {
            let (order, kind) = (u64::from(message.sequence), segment.kind(message.channel));
            batch.push(kind, order, message.log_time, message.data, &mut self.labels);
        }
        Ok(())
    }
}
