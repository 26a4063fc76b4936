//! The update function U: O × `G_t` → `G_{t+1}` (paper, "Problem Definition").
//!
//! One input event in, the records it causes out: itself, evidence, changes, one transaction.
//! Live recording, import and reprocess all go through [`Updater::update_with`]; it is the only
//! place where detectors meet the graph.
//!
//! What models have to say about an input comes with it: [`Updater::request`] tells what to ask,
//! and the replies are recorded right after the input, before anything is derived from them.
//!
//! Invariant: equal inputs in equal order give equal records, on every machine.
//! Invariant: an updater made from its own bytes goes on as if it had never stopped.

mod bytes;
mod config;
mod decay;
mod language;

use self::language::Answers;

pub use bytes::RestoreError;
pub use config::{Config, ConfigError, Detectors, Language};

use crate::change::{Claim, EvidenceRef, World};
use crate::event::{Event, Logged, TooLong};
use crate::graph::SceneGraph;
use crate::modality::Desk;
use crate::modality::action::ActionDetector;
use crate::modality::human::HumanDetector;
use crate::modality::time::TimeDetector;
use crate::time::Stamp;

/// The world, the detectors with their memory, and the counters of the log.
#[derive(Clone, Debug, PartialEq)]
pub struct Updater {
    config: Config,
    world: World,
    action: ActionDetector,
    human: HumanDetector,
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
    /// Something else was offered as what models said about an input.
    #[error("{topic} is not what a model says about an input; leave it out")]
    NotAModelOutput {
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
            human: HumanDetector::default(),
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

    /// [`Updater::update_with`] without any model: sentences are read by the built-in
    /// interpreter.
    pub fn update(&mut self, published: Stamp, input: Event) -> Result<Vec<Logged>, UpdateError> {
        self.update_with(published, input, Vec::new())
    }

    /// Takes one input that its source stamps `published` and what models said about it,
    /// advances the graph, and returns what is to be recorded: the input, the outputs of the
    /// models, then what follows from them.
    ///
    /// Log time never runs backwards: an input that is stamped earlier than the one before it is
    /// logged at the time of that one, and keeps its own stamp as `published`.
    pub fn update_with(
        &mut self,
        published: Stamp,
        input: Event,
        mut outputs: Vec<Event>,
    ) -> Result<Vec<Logged>, UpdateError> {
        self.check(&input, &outputs)?;
        self.at = self.at.max(published);
        let (at, order) = (self.at, self.order + 1);
        let of = Logged { order, at, published, event: input };
        outputs.iter_mut().for_each(|output| point_to(output, &of));
        let derived = self.derive(order, &of.event, &outputs);
        self.order = order;
        let mut records = vec![of];
        for event in outputs.into_iter().chain(derived) {
            self.order += 1;
            if matches!(event, Event::Change(_)) {
                self.changes += 1;
            }
            records.push(Logged { order: self.order, at, published, event });
        }
        Ok(records)
    }

    fn check(&self, input: &Event, outputs: &[Event]) -> Result<(), UpdateError> {
        if let Some(wrong) = outputs.iter().find(|output| !output.is_model_output()) {
            return Err(UpdateError::NotAModelOutput { topic: wrong.topic().name().into_owned() });
        }
        outputs.iter().try_for_each(Event::check_length)?;
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

    fn derive(&mut self, order: u64, input: &Event, outputs: &[Event]) -> Vec<Event> {
        if let Event::InitialGraph(graph) = input {
            self.world = World::from_graph(graph.clone());
        }
        let plan = self.config.plan();
        let mut desk = Desk::new(&mut self.world, &plan, self.at, self.changes);
        match self.config.detectors {
            Detectors::All => {}
            Detectors::None => return Vec::new(),
            Detectors::Truth => return really_happened(desk, order, input),
        }
        match input {
            Event::Task(task) => self.action.task(&mut desk, order, task),
            Event::TaskStatus(status) => self.action.task_status(&mut desk, order, status),
            Event::Utterance(said) => {
                let answers = Answers::of(&self.config, &said.text, order, outputs);
                answers.utterance(&mut self.human, &mut desk, order, &said.text);
            }
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

/// Carries out what a truth file tells.
fn really_happened(mut desk: Desk<'_>, order: u64, input: &Event) -> Vec<Event> {
    if let Event::TrueChange(change) = input {
        let evidence = vec![EvidenceRef { topic: input.topic().name(), order }];
        // Recorded either way; the truth never contradicts itself.
        let _ = desk.claim(Claim { evidence, ..change.claim.clone() });
    }
    desk.into_events()
}

/// A reply is about the input that it came with, whatever number that had elsewhere.
fn point_to(output: &mut Event, input: &Logged) {
    if let Event::LanguageReply(reply) = output {
        reply.of = input.reference();
    }
}
