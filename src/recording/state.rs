//! [`State`]: what the robot believed at some point, by folding the recorded primitives.

use super::batch::{Batch, Kind, Mark};
use super::checkpoint::Checkpoint;
use super::events::WalkError;
use super::open::{Recording, Segment};
use super::parallel::for_each_chunk;
use super::point::{Point, PointError};
use crate::change::{Edit, World};
use crate::container::ChunkEntry;
use crate::event::Topic;
use crate::graph::SceneGraph;
use crate::time::{At, Stamp};
use crate::wire::{self, Labels};

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
        let chunks = segment.log.chunks();
        let place = chunks.binary_search_by_key(&at.offset, |entry| entry.offset);
        let entry = place.ok().and_then(|place| chunks.get(place));
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
    /// Numbers of events after which some are known to be missing.
    gaps: Vec<u64>,
}

impl<'r> Fold<'r> {
    fn new(recording: &'r Recording, point: Point) -> Self {
        let (world, time) = (World::default(), recording.start().unwrap_or_default());
        let (order, segment, offset, uncertain) = (0, 0, 0, None);
        let has_sensors = recording.segments.iter().any(|segment| !segment.sensors.is_empty());
        let metas = recording.segments.iter().filter_map(|segment| segment.meta.as_ref());
        let gaps = metas.flat_map(|meta| meta.gaps.iter().copied()).collect();
        Self { recording, point, world, order, time, segment, offset, uncertain, has_sensors, gaps }
    }

    /// Starts from the last checkpoint before the point that can be used.
    fn start(&mut self) {
        let (recording, point) = (self.recording, self.point);
        let before = recording.checkpoints().rev().filter(|at| is_before(at, &point));
        for at in before {
            if self.load(at) {
                break;
            }
        }
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

    fn segment(&mut self, n: usize, segment: &'r Segment, threads: usize) -> Flow {
        let offset = if n == self.segment { self.offset } else { 0 };
        let last_time = self.point.last_time.nanos();
        let entries: Vec<&ChunkEntry> = segment
            .event_chunks()
            .take_while(|entry| entry.start_time <= last_time)
            .filter(|entry| entry.offset >= offset)
            .collect();
        let mut flow = Flow::More;
        for_each_chunk(segment, &entries, threads, &mut |entry, batch| {
            if entry.offset < self.offset && n == self.segment {
                return std::ops::ControlFlow::Continue(());
            }
            match batch {
                Ok(batch) => flow = self.take(segment, batch),
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
        let (recording, point) = (self.recording, self.point);
        let after = |at: &&CheckpointRef| at.segment == n && at.offset > entry.offset;
        self.uncertain = Some(damage.to_string());
        for at in recording.checkpoints().filter(after).filter(|at| is_before(at, &point)) {
            if self.load(at) {
                return;
            }
        }
    }

    fn take(&mut self, segment: &Segment, batch: &mut Batch) -> Flow {
        let Batch { marks, edits } = batch;
        for mark in marks.drain(..) {
            if mark.order > self.point.last_order || mark.at > self.point.last_time {
                return Flow::Done;
            }
            if mark.order > self.order {
                self.check_next(segment, mark.order);
                self.apply(segment, mark, edits);
            }
        }
        Flow::More
    }

    /// Where there is nothing but events, their numbers go up by one; a recovered recording knows
    /// where some are missing.
    fn check_next(&mut self, segment: &Segment, order: u64) {
        let expected = self.order + 1;
        if order == expected {
            return;
        }
        let what = format!("events #{expected} to #{} are missing", order - 1);
        if self.gaps.iter().any(|gap| (self.order..order).contains(gap)) {
            self.uncertain.get_or_insert(what);
        } else if !self.has_sensors {
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

    fn apply(&mut self, segment: &Segment, mark: Mark, edits: &[Edit]) {
        let order = mark.order;
        (self.order, self.time) = (order, mark.at);
        if let Err(why) = mark.apply(edits, &mut self.world) {
            self.doubt(segment, format!("event #{order}: {why}"));
        }
    }

    /// Recordings of other programs are folded message by message.
    fn walk(&mut self) -> Result<(), WalkError> {
        let recording = self.recording;
        let (mut batch, mut labels) = (Batch::default(), Labels::default());
        recording.walk(super::events::Walk::Events, (1, u64::MAX), &mut |segment, raw| {
            batch.clear();
            batch.push(Kind::of(raw.topic), raw.order, raw.log_time, raw.data, &mut labels);
            match self.take(segment, &mut batch) {
                Flow::More => std::ops::ControlFlow::Continue(()),
                Flow::Done => std::ops::ControlFlow::Break(()),
            }
        })
    }

    fn state(mut self) -> State {
        let at = self.point.moment.unwrap_or(self.time);
        if at > self.time && self.gaps.contains(&self.order) {
            let what = format!("events after #{} are missing", self.order);
            self.uncertain.get_or_insert(what);
        }
        State { world: self.world, order: self.order, at, uncertain: self.uncertain }
    }
}

fn is_before(at: &CheckpointRef, point: &Point) -> bool {
    at.order <= point.last_order && at.at <= point.last_time
}
