//! Chunks decoded on several threads, handed on in order.

use std::ops::ControlFlow;
use std::sync::mpsc::{Receiver, sync_channel};

use super::open::Segment;
use crate::change::{Transaction, World};
use crate::container::{ChunkBuffer, ChunkEntry, Damage};
use crate::event::{Event, Topic};
use crate::graph::SceneGraph;
use crate::time::Stamp;
use crate::wire;

/// What an event is to the fold.
#[derive(Debug)]
pub(super) enum Content {
    /// The graph at the start.
    Initial(Box<SceneGraph>),
    /// An update.
    Transaction(Transaction),
    /// Nothing.
    Other,
}

/// An event on its way to the fold.
#[derive(Debug)]
pub(super) struct Item {
    pub order: u64,
    pub at: Stamp,
    /// What it is, or why that cannot be told.
    pub content: Result<Content, String>,
}

impl Content {
    pub fn apply(self, world: &mut World) -> Result<(), String> {
        match self {
            Self::Initial(graph) => *world = World::from_graph(*graph),
            Self::Transaction(transaction) => {
                transaction.apply(world).map_err(|error| error.to_string())?;
            }
            Self::Other => {}
        }
        Ok(())
    }
}

impl Item {
    pub fn of(order: u64, log_time: u64, topic: &Topic, data: &[u8]) -> Self {
        let at = Stamp::from_nanos(log_time);
        let content = match topic {
            Topic::Primitive => wire::decode_transaction(at, data)
                .map(Content::Transaction)
                .map_err(|error| error.to_string()),
            Topic::InitialGraph => match wire::decode(topic, at, data) {
                Ok(Event::InitialGraph(graph)) => Ok(Content::Initial(Box::new(graph))),
                Ok(_) => Ok(Content::Other),
                Err(error) => Err(error.to_string()),
            },
            _ => Ok(Content::Other),
        };
        Self { order, at, content }
    }
}

type Decoded = Result<Vec<Item>, Damage>;
type Visitor<'v, 'e> = dyn FnMut(&'e ChunkEntry, Decoded) -> ControlFlow<()> + 'v;

/// Few chunks are not worth a thread.
const WORTH_A_THREAD: usize = 4;

/// Decodes the events of each chunk, on `threads` threads, and hands them to `visit` in the
/// order of `entries`, until it breaks. At most a few chunks are held at once.
pub(super) fn for_each_chunk<'e>(
    segment: &Segment,
    entries: &[&'e ChunkEntry],
    threads: usize,
    visit: &mut Visitor<'_, 'e>,
) {
    if threads < 2 || entries.len() < WORTH_A_THREAD {
        let mut buffer = ChunkBuffer::new();
        for entry in entries {
            if visit(entry, decode_chunk(segment, entry, &mut buffer)).is_break() {
                return;
            }
        }
        return;
    }
    std::thread::scope(|scope| {
        let receivers: Vec<Receiver<Decoded>> = (0..threads)
            .map(|worker| {
                // Two chunks ahead for each worker keep all of them busy.
                let (sender, receiver) = sync_channel(2);
                scope.spawn(move || {
                    let mut buffer = ChunkBuffer::new();
                    for entry in entries.iter().skip(worker).step_by(threads) {
                        // The other side hangs up when it has what it wants.
                        if sender.send(decode_chunk(segment, entry, &mut buffer)).is_err() {
                            return;
                        }
                    }
                });
                receiver
            })
            .collect();
        for (n, entry) in entries.iter().enumerate() {
            let Ok(decoded) = receivers[n % threads].recv() else { return };
            if visit(entry, decoded).is_break() {
                return;
            }
        }
    });
}

/// The events of a chunk that matter to the fold, and the last one in any case.
fn decode_chunk(segment: &Segment, entry: &ChunkEntry, buffer: &mut ChunkBuffer) -> Decoded {
    segment.log.read_chunk_into(entry, buffer)?;
    buffer.sort_by_time();
    let mut items = Vec::with_capacity(buffer.len());
    for message in buffer.messages() {
        let Some(topic) = segment.topics.get(&message.channel) else { continue };
        if segment.events.contains(&message.channel) {
            let order = u64::from(message.sequence);
            items.push(Item::of(order, message.log_time, topic, message.data));
        }
    }
    Ok(items)
}
