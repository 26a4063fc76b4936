//! The update function U: O × `G_t` → `G_{t+1}` (paper, "Problem Definition").
//!
//! One input event in, the records it causes out: itself, evidence, changes, one transaction.
//! Live recording, import and reprocess all go through [`Updater::update`]; it is the only place
//! where detectors meet the graph.
//!
//! Invariant: equal inputs in equal order give equal records, on every machine.
//! Invariant: an updater made from its own bytes goes on as if it had never stopped.

mod bytes;
mod config;
mod decay;

pub use bytes::RestoreError;
pub use config::{Config, ConfigError};

use crate::change::World;
use crate::event::{Event, Logged, TooLong};
use crate::graph::SceneGraph;
use crate::modality::Desk;
use crate::modality::action::ActionDetector;
use crate::modality::time::TimeDetector;
use crate::time::Stamp;

/// The world, the detectors with their memory, and the counters of the log.
#[derive(Clone, Debug, PartialEq)]
pub struct Updater {
    config: Config,
    world: World,
    action: ActionDetector,
    /// Idle unless the configuration has a threshold of staleness.
    time: TimeDetector,
    /// Number of the last event.
    order: u64,
    /// Number of the last change.
    changes: u64,
    /// Log time of the last event.
    at: Stamp,
}

/// Why an input was not taken. Nothing is changed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum UpdateError {
    /// A derived record was offered as an input.
    #[error("{topic} is derived from inputs and cannot be one; leave it out")]
    NotAnInput {
        /// Its topic.
        topic: String,
    },
    /// It could not be read back.
    #[error(transparent)]
    TooLong(#[from] TooLong),
    /// A graph to start from came after the start.
    #[error("the initial graph must be the first event, but {events} events came before it")]
    InitialGraphTooLate {
        /// How many.
        events: u64,
    },
}

impl Updater {
    /// An updater at the beginning of a log, with an empty graph.
    pub fn new(config: Config) -> Self {
        Self {
            config,
            world: World::default(),
            action: ActionDetector::default(),
            time: TimeDetector::default(),
            order: 0,
            changes: 0,
            at: Stamp::EPOCH,
        }
    }

    /// The configuration.
    pub fn config(&self) -> &Config {
        &self.config
    }

    /// The world by now.
    pub fn world(&self) -> &World {
        &self.world
    }

    /// The graph by now.
    pub fn graph(&self) -> &SceneGraph {
        self.world.graph()
    }

    /// Number of the last event.
    pub fn order(&self) -> u64 {
        self.order
    }

    /// Number of the last change.
    pub fn changes(&self) -> u64 {
        self.changes
    }

    /// Log time of the last event.
    pub fn at(&self) -> Stamp {
        self.at
    }

    /// Takes one input that its source stamps `published`, advances the graph, and returns what
    /// is to be recorded, the input first.
    ///
    /// Log time never runs backwards: an input that is stamped earlier than the one before it is
    /// logged at the time of that one, and keeps its own stamp as `published`.
    pub fn update(&mut self, published: Stamp, input: Event) -> Result<Vec<Logged>, UpdateError> {
        self.check(&input)?;
        self.at = self.at.max(published);
        let at = self.at;
        self.order += 1;
        let order = self.order;
        let derived = self.derive(order, &input);
        let mut records = vec![Logged { order, at, published, event: input }];
        for event in derived {
            self.order += 1;
            if matches!(event, Event::Change(_)) {
                self.changes += 1;
            }
            records.push(Logged { order: self.order, at, published, event });
        }
        Ok(records)
    }

    fn check(&self, input: &Event) -> Result<(), UpdateError> {
        if !input.is_input() {
            return Err(UpdateError::NotAnInput { topic: input.topic().name().into_owned() });
        }
        input.check_length()?;
        match input {
            Event::InitialGraph(_) if self.order > 0 => {
                Err(UpdateError::InitialGraphTooLate { events: self.order })
            }
            _ => Ok(()),
        }
    }

    fn derive(&mut self, order: u64, input: &Event) -> Vec<Event> {
        if let Event::InitialGraph(graph) = input {
            self.world = World::from_graph(graph.clone());
        }
        let plan = self.config.plan();
        let mut desk = Desk::new(&mut self.world, &plan, self.at, self.changes);
        match input {
            Event::Task(task) => self.action.task(&mut desk, order, task),
            Event::TaskStatus(status) => self.action.task_status(&mut desk, order, status),
            _ => {}
        }
        if let Some(table) = &self.config.decay {
            match input {
                Event::InitialGraph(_) => decay::settle(&mut desk, table, order),
                _ => decay::settle_added(&mut desk, table),
            }
        }
        if let Some(threshold) = self.config.stale_below {
            if matches!(input, Event::InitialGraph(_)) {
                self.time.watch_all(desk.world().graph(), threshold);
            }
            self.time.update(&mut desk, threshold);
        }
        desk.into_events()
    }
}
