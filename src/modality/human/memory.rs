//! What the detector remembers between utterances, and its bytes.

use std::collections::VecDeque;

use super::ground::Places;
use crate::bytes::{Reader, Writer};
use crate::change::Action;
use crate::graph::{CanonicalError, NodeId};
use crate::time::Stamp;

/// Longest utterance that is remembered for corrections, in bytes.
const MAX_TEXT: usize = 4 << 10;
/// Things whose earlier places are remembered.
const MAX_PLACES: usize = 1 << 10;
/// Changes of one utterance that can be corrected.
const MAX_DONE: usize = 32;

/// A change that the last utterance made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Done {
    pub action: Action,
    pub id: NodeId,
    /// Where it was before: room and support.
    pub before: Option<(NodeId, Option<NodeId>)>,
}

/// The last utterance, and where things were before people moved them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Memory {
    /// The last utterance that reported or corrected something.
    pub text: String,
    pub said_at: Stamp,
    /// What it changed, in order.
    pub done: Vec<Done>,
    /// Where each thing was before it was last moved.
    pub places: Places,
    /// The things in `places`, in the order in which they were moved.
    order: VecDeque<NodeId>,
}

impl Memory {
    /// Begins a new utterance.
    pub fn begin(&mut self, text: &str, said_at: Stamp) {
        let remembered = if text.len() <= MAX_TEXT { text } else { "" };
        remembered.clone_into(&mut self.text);
        self.said_at = said_at;
        self.done.clear();
    }

    /// Remembers one change of it.
    pub fn add(&mut self, done: Done) {
        if self.done.len() < MAX_DONE {
            self.done.push(done);
        }
        let Some(before) = done.before else { return };
        if self.places.insert(done.id, before).is_some() {
            self.order.retain(|id| *id != done.id);
        }
        self.order.push_back(done.id);
        if self.order.len() > MAX_PLACES
            && let Some(oldest) = self.order.pop_front()
        {
            self.places.remove(&oldest);
        }
    }

    pub fn write(&self, out: &mut Writer) {
        out.text(&self.text);
        out.u64(self.said_at.nanos());
        out.u64(self.done.len() as u64);
        for done in &self.done {
            out.u64(Action::ALL.iter().position(|it| *it == done.action).unwrap_or(0) as u64);
            out.u64(done.id.bits());
            out.option(done.before, write_place);
        }
        out.u64(self.order.len() as u64);
        for id in &self.order {
            out.u64(id.bits());
            out.option(self.places.get(id).copied(), write_place);
        }
    }

    pub fn read(input: &mut Reader<'_>) -> Result<Self, CanonicalError> {
        Self::try_read(input).ok_or(CanonicalError::Malformed { what: "memory of utterances" })
    }

    fn try_read(input: &mut Reader<'_>) -> Option<Self> {
        let text = input.text()?.to_owned();
        let said_at = Stamp::from_nanos(input.u64()?);
        let count = input.u64()?;
        let mut done = Vec::new();
        for _ in 0..count {
            let action = *Action::ALL.get(input.u64()? as usize)?;
            let id = NodeId::try_from(input.u64()?).ok()?;
            done.push(Done { action, id, before: input.option(read_place)? });
        }
        let count = input.u64()?;
        let (mut places, mut order) = (Places::new(), VecDeque::new());
        for _ in 0..count {
            let id = NodeId::try_from(input.u64()?).ok()?;
            places.insert(id, input.option(read_place)??);
            order.push_back(id);
        }
        Some(Self { text, said_at, done, places, order })
    }
}

fn write_place(out: &mut Writer, (room, support): (NodeId, Option<NodeId>)) {
    out.u64(room.bits());
    out.u64(support.map_or(0, NodeId::bits));
}

fn read_place(input: &mut Reader<'_>) -> Option<(NodeId, Option<NodeId>)> {
    let room = NodeId::try_from(input.u64()?).ok()?;
    let support = match input.u64()? {
        0 => None,
        bits => Some(NodeId::try_from(bits).ok()?),
    };
    Some((room, support))
}
