//! Chunks decoded on several threads, handed on in order.
//!
//! Whoever is free takes the next chunk, also the thread that folds: it decodes while it waits.

use std::collections::VecDeque;
use std::ops::ControlFlow;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

use super::batch::{Batch, Decoder};
use super::open::Segment;
use crate::container::{ChunkEntry, Damage};

type Visitor<'v, 'e> =
    dyn FnMut(&'e ChunkEntry, Result<&mut Batch, Damage>) -> ControlFlow<()> + 'v;

/// Few chunks are not worth a thread.
const WORTH_A_THREAD: usize = 4;
/// Chunks ahead of the fold, for each thread: enough to keep all of them busy.
const AHEAD: usize = 3;

/// Decodes the events of each chunk, on `threads` threads, and hands them to `visit` in the
/// order of `entries`, until it breaks. At most a few chunks are held at once.
pub(super) fn for_each_chunk<'e>(
    segment: &Segment,
    entries: &[&'e ChunkEntry],
    threads: usize,
    visit: &mut Visitor<'_, 'e>,
) {
    if threads < 2 || entries.len() < WORTH_A_THREAD {
        let (mut decoder, mut batch) = (Decoder::default(), Batch::default());
        for entry in entries {
            let decoded = decoder.decode(segment, entry, &mut batch);
            if visit(entry, decoded.map(|()| &mut batch)).is_break() {
                return;
            }
        }
        return;
    }
    let board = Board::new(entries.len(), threads * AHEAD);
    std::thread::scope(|scope| {
        for _ in 1..threads {
            scope.spawn(|| board.work(segment, entries));
        }
        let _over = Over(&board);
        let mut decoder = Decoder::default();
        for (n, entry) in entries.iter().enumerate() {
            let Some((mut batch, decoded)) = board.take(n, segment, entries, &mut decoder) else {
                return;
            };
            if visit(entry, decoded.map(|()| &mut batch)).is_break() {
                return;
            }
            board.lock().spare.push(batch);
        }
    });
}

type Done = (Batch, Result<(), Damage>);

/// What is to be decoded and what has been.
struct Board {
    tasks: Mutex<Tasks>,
    /// Told whenever there is something new to take or to do.
    news: Condvar,
    count: usize,
    ahead: usize,
}

#[derive(Default)]
struct Tasks {
    /// The next chunk that nobody decodes.
    next: usize,
    /// The next chunk that is to be handed on.
    first: usize,
    /// What has been decoded, from `first` on.
    done: VecDeque<Option<Done>>,
    /// Batches to be used again.
    spare: Vec<Batch>,
    over: bool,
}

/// Ends the work when dropped, also by a panic, so that nobody waits for ever.
struct Over<'b>(&'b Board);

impl Drop for Over<'_> {
    fn drop(&mut self) {
        self.0.lock().over = true;
        self.0.news.notify_all();
    }
}

impl Board {
    fn new(count: usize, ahead: usize) -> Self {
        Self { tasks: Mutex::default(), news: Condvar::new(), count, ahead }
    }

    fn lock(&self) -> MutexGuard<'_, Tasks> {
        self.tasks.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wait<'t>(&self, tasks: MutexGuard<'t, Tasks>) -> MutexGuard<'t, Tasks> {
        self.news.wait(tasks).unwrap_or_else(PoisonError::into_inner)
    }

    /// The next chunk that nobody decodes, unless that is too far ahead.
    fn claim(&self, tasks: &mut Tasks) -> Option<(usize, Batch)> {
        if tasks.next >= self.count.min(tasks.first + self.ahead) {
            return None;
        }
        tasks.next += 1;
        tasks.done.push_back(None);
        Some((tasks.next - 1, tasks.spare.pop().unwrap_or_default()))
    }

    fn put(&self, n: usize, done: Done) {
        let mut tasks = self.lock();
        let place = n - tasks.first;
        if let Some(slot) = tasks.done.get_mut(place) {
            *slot = Some(done);
        }
        drop(tasks);
        self.news.notify_all();
    }

    /// Decodes what is to be decoded until there is nothing left.
    fn work(&self, segment: &Segment, entries: &[&ChunkEntry]) {
        let over = Over(self);
        let mut decoder = Decoder::default();
        let mut tasks = self.lock();
        while !tasks.over && tasks.next < self.count {
            let Some((n, mut batch)) = self.claim(&mut tasks) else {
                tasks = self.wait(tasks);
                continue;
            };
            drop(tasks);
            let decoded = decoder.decode(segment, entries[n], &mut batch);
            self.put(n, (batch, decoded));
            tasks = self.lock();
        }
        drop(tasks);
        // Left in good order: the others go on.
        std::mem::forget(over);
    }

    /// What chunk `n` holds, which is the next one to be handed on. While that is not known, others
    /// are decoded. `None` if a worker has panicked.
    fn take(
        &self,
        n: usize,
        segment: &Segment,
        entries: &[&ChunkEntry],
        decoder: &mut Decoder,
    ) -> Option<Done> {
        let mut tasks = self.lock();
        loop {
            if let Some(done) = tasks.done.front_mut().and_then(Option::take) {
                tasks.done.pop_front();
                tasks.first = n + 1;
                drop(tasks);
                self.news.notify_all();
                return Some(done);
            }
            if tasks.over {
                return None;
            }
            let Some((n, mut batch)) = self.claim(&mut tasks) else {
                tasks = self.wait(tasks);
                continue;
            };
            drop(tasks);
            let decoded = decoder.decode(segment, entries[n], &mut batch);
            self.put(n, (batch, decoded));
            tasks = self.lock();
        }
    }
}
