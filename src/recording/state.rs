//! [`State`]: what the robot believed at some point, by folding the recorded primitives.

use super::checkpoint::Checkpoint;
use super::events::WalkError;
use super::open::{Recording, Segment};
use super::parallel::{Item, for_each_chunk};
use super::point::{Point, PointError};
use crate::change::World;
use crate::container::ChunkEntry;
use crate::event::Topic;
use crate::graph::SceneGraph;
use crate::time::{At, Stamp};
use crate::wire;

/// What the robot believed at some point of a recording.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// The graph, and what is remembered of what left it.
    pub world: World,
    /// Number of the last event by then.
    pub order: u64,
    /// The moment: the time that was named, or that of the last event by then.
    pub at: Stamp,
    /// Why the state may be wrong, if the recording is damaged before this point and no
    /// checkpoint after the damage mends it.
    pub uncertain: Option<String>,
}

impl State {
    /// The graph.
    pub fn graph(&self) -> &SceneGraph {
        self.world.graph()
    }
}

/// Where a checkpoint is, and after what it stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct CheckpointRef {
    pub segment: usize,
    /// Offset of its chunk.
    pub offset: u64,
    pub order: u64,
    pub changes: u64,
    pub at: Stamp,
}

/// Bytes from the start of a chunk within which a checkpoint tells what it stands after.
const PEEK: usize = 8192;

impl Recording {
    /// The state at the point that `at` names, folded on `threads` threads.
    pub fn state_at(&self, at: At, threads: usize) -> Result<State, PointError> {
        let point = self.point(at)?;
        let state = self.state(point, threads)?;
        match at {
            // The fold passes over images; an event number may be that of one.
            At::Event(order) if order > state.order => match self.event(order)? {
                Some(sensor) => Ok(State { order, at: sensor.at, ..state }),
                None => Err(PointError::NoSuchEvent { order, last: state.order }),
            },
            _ => Ok(state),
        }
    }

    /// The state at `point`, from the last usable checkpoint before it.
    pub fn state(&self, point: Point, threads: usize) -> Result<State, PointError> {
        let mut fold = Fold::new(self, point);
        fold.start();
        if self.is_numbered() {
            for (n, segment) in self.segments.iter().enumerate().skip(fold.segment) {
                if fold.segment(n, segment, threads) == Flow::Done {
                    break;
                }
            }
            fold.check_end();
        } else {
            fold.walk()?;
        }
        Ok(fold.state())
    }

    /// The checkpoints of all segments, in order.
    pub(super) fn checkpoints(&self) -> impl DoubleEndedIterator<Item = &CheckpointRef> {
        self.segments.iter().enumerate().flat_map(|(n, segment)| {
            segment.checkpoints.get_or_init(|| list_checkpoints(n, segment)).iter()
        })
    }

    /// Reads and verifies a checkpoint.
    pub(super) fn checkpoint(&self, at: &CheckpointRef) -> Result<Checkpoint, String> {
        let segment = &self.segments[at.segment];
        let entry = segment.log.chunks().iter().find(|entry| entry.offset == at.offset);
        let entry = entry.ok_or("it is not in the file any more")?;
        let mut buffer = crate::container::ChunkBuffer::new();
        segment.log.read_chunk_into(entry, &mut buffer).map_err(|damage| damage.to_string())?;
        let is_checkpoint = |channel: u16| segment.topics.get(&channel) == Some(&Topic::Checkpoint);
        let message = buffer.messages().find(|message| is_checkpoint(message.channel));
        let message = message.ok_or("its chunk holds none")?;
        Checkpoint::decode(message.data).map_err(|error| error.to_string())
    }
}

/// Reads the beginning of each chunk that holds checkpoints; those that make no sense are left
/// out, for they are only caches.
fn list_checkpoints(n: usize, segment: &Segment) -> Vec<CheckpointRef> {
    let channels: Vec<u16> = segment.channels_of(&Topic::Checkpoint).collect();
    let known = |entry: &&ChunkEntry| {
        entry.channels.is_some() && channels.iter().any(|channel| entry.may_hold(*channel))
    };
    let peek = |entry: &ChunkEntry| {
        let payload = channels.iter().find_map(|id| segment.log.peek(entry, *id, PEEK))?;
        let checkpoint = wire::peek_checkpoint(&payload).ok()?;
        Some(CheckpointRef {
            segment: n,
            offset: entry.offset,
            order: checkpoint.order,
            changes: checkpoint.changes,
            at: checkpoint.at,
        })
    };
    segment.log.chunks().iter().filter(known).filter_map(peek).collect()
}

#[derive(PartialEq, Eq)]
enum Flow {
    More,
    Done,
}

/// A fold on its way to a point.
struct Fold<'r> {
    recording: &'r Recording,
    point: Point,
    world: World,
    order: u64,
    time: Stamp,
    /// Segment and offset before which everything is in the world already.
    segment: usize,
    offset: u64,
    uncertain: Option<String>,
    /// Some event numbers are those of pictures, which the fold passes over.
    has_sensors: bool,
}

impl<'r> Fold<'r> {
    fn new(recording: &'r Recording, point: Point) -> Self {
        let (world, time) = (World::default(), recording.start().unwrap_or_default());
        let (order, segment, offset, uncertain) = (0, 0, 0, None);
        let has_sensors = recording.segments.iter().any(|segment| !segment.sensors.is_empty());
        Self { recording, point, world, order, time, segment, offset, uncertain, has_sensors }
    }

    /// Starts from the last checkpoint before the point that can be used.
    fn start(&mut self) {
        let before = self.recording.checkpoints().rev().filter(|c| self.is_before_point(c));
        for at in before.copied().collect::<Vec<_>>() {
            if self.load(&at) {
                break;
            }
        }
        self.note_gaps();
    }

    fn is_before_point(&self, at: &CheckpointRef) -> bool {
        at.order <= self.point.last_order && at.at <= self.point.last_time
    }

    fn load(&mut self, at: &CheckpointRef) -> bool {
        let loaded = self
            .recording
            .checkpoint(at)
            .and_then(|checkpoint| checkpoint.world().map_err(|error| error.to_string()));
        match loaded {
            Ok(world) => {
                (self.world, self.order, self.time) = (world, at.order, at.at);
                (self.segment, self.offset) = (at.segment, at.offset);
                self.uncertain = None;
                true
            }
            Err(why) => {
                let segment = &self.recording.segments[at.segment];
                let what = format_args!("checkpoint after event #{} is not used: {why}", at.order);
                self.recording.report(segment, what);
                false
            }
        }
    }

    /// A recovered recording knows where events are missing.
    fn note_gaps(&mut self) {
        let metas = self.recording.segments.iter().filter_map(|segment| segment.meta.as_ref());
        for gap in metas.flat_map(|meta| &meta.gaps) {
            if *gap >= self.order && *gap < self.point.last_order {
                let why = format!("events after #{gap} are missing from this recovered recording");
                self.uncertain.get_or_insert(why);
            }
        }
    }

    fn segment(&mut self, n: usize, segment: &'r Segment, threads: usize) -> Flow {
        let offset = if n == self.segment { self.offset } else { 0 };
        let entries: Vec<&ChunkEntry> = event_chunks(segment)
            .filter(|entry| entry.offset >= offset)
            .filter(|entry| entry.start_time <= self.point.last_time.nanos())
            .collect();
        let mut flow = Flow::More;
        for_each_chunk(segment, &entries, threads, &mut |entry, items| {
            if entry.offset < self.offset && n == self.segment {
                return std::ops::ControlFlow::Continue(());
            }
            match items {
                Ok(items) => flow = self.take(segment, items),
                Err(damage) => self.lost(n, segment, entry, &damage),
            }
            match flow {
                Flow::More => std::ops::ControlFlow::Continue(()),
                Flow::Done => std::ops::ControlFlow::Break(()),
            }
        });
        flow
    }

    /// A chunk is lost: what it did is unknown until the next checkpoint.
    fn lost(
        &mut self,
        n: usize,
        segment: &Segment,
        entry: &ChunkEntry,
        damage: &crate::container::Damage,
    ) {
        self.recording.report_damage(segment, damage);
        let after = self.recording.checkpoints().copied();
        let next: Vec<CheckpointRef> = after
            .filter(|c| c.segment == n && c.offset > entry.offset && self.is_before_point(c))
            .collect();
        self.uncertain = Some(damage.to_string());
        for at in next {
            if self.load(&at) {
                return;
            }
        }
    }

    fn take(&mut self, segment: &Segment, items: Vec<Item>) -> Flow {
        for item in items {
            if item.order > self.point.last_order || item.at > self.point.last_time {
                return Flow::Done;
            }
            if item.order > self.order {
                self.check_next(segment, item.order);
                self.apply(segment, item);
            }
        }
        Flow::More
    }

    /// Where there is nothing but events, their numbers go up by one.
    fn check_next(&mut self, segment: &Segment, order: u64) {
        let expected = self.order + 1;
        if order != expected && !self.has_sensors {
            let what = format!("events #{expected} to #{} are missing", order - 1);
            self.doubt(segment, what);
        }
    }

    /// A recording that was ended tells how many events there are.
    fn check_end(&mut self) {
        let Some(segment) = self.recording.segments.last() else { return };
        let Some(seal) = segment.seal.filter(|_| self.point.is_end()) else { return };
        let last_may_be_a_picture = self.has_sensors;
        if self.order < seal.events && !last_may_be_a_picture {
            let (order, events) = (self.order, seal.events);
            let what = format!("events #{} to #{events} are missing", order + 1);
            self.doubt(segment, what);
        }
    }

    fn doubt(&mut self, segment: &Segment, what: String) {
        self.recording.report(segment, &what);
        self.uncertain.get_or_insert(what);
    }

    fn apply(&mut self, segment: &Segment, item: Item) {
        (self.order, self.time) = (item.order, item.at);
        if let Err(why) = item.content.and_then(|content| content.apply(&mut self.world)) {
            self.doubt(segment, format!("event #{}: {why}", item.order));
        }
    }

    /// Recordings of other programs are folded message by message.
    fn walk(&mut self) -> Result<(), WalkError> {
        let recording = self.recording;
        recording.walk(super::events::Walk::Events, (1, u64::MAX), &mut |segment, raw| {
            let item = Item::of(raw.order, raw.log_time, raw.topic, raw.data);
            match self.take(segment, vec![item]) {
                Flow::More => std::ops::ControlFlow::Continue(()),
                Flow::Done => std::ops::ControlFlow::Break(()),
            }
        })
    }

    fn state(self) -> State {
        let at = self.point.moment.unwrap_or(self.time);
        State { world: self.world, order: self.order, at, uncertain: self.uncertain }
    }
}

/// The chunks that may hold events, in the order of the log.
fn event_chunks(segment: &Segment) -> impl Iterator<Item = &ChunkEntry> {
    let holds_events =
        |entry: &&ChunkEntry| segment.events.iter().any(|channel| entry.may_hold(*channel));
    let mut entries: Vec<&ChunkEntry> = segment.log.chunks().iter().filter(holds_events).collect();
    entries.sort_by_key(|entry| (entry.start_time, entry.offset));
    entries.into_iter()
}
