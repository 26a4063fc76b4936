//! A story recorded: [`record`] writes what the robot gets, and the truth apart from it.
//!
//! The recording holds inputs only, as a robot would publish them; the truth file beside it is a
//! recording as well, whose graph over time is what was really where. No detector sees that.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::house::House;
use super::publish::Publisher;
use super::scenario::Scenario;
use super::scenario::check::Done;
use super::story::{Moment, Story, StoryError};
use super::truth;
use crate::change::{Action, ChangeRecord};
use crate::event::{Event, Status};
use crate::recording::{RecordError, Recorder, RecorderOptions};
use crate::time::Stamp;
use crate::updater::{Config, Detectors};

/// What came of a simulation.
#[derive(Clone, Debug, PartialEq)]
pub struct Simulated {
    /// The recording of inputs.
    pub recording: PathBuf,
    /// The truth beside it.
    pub truth: PathBuf,
    /// How many pictures were taken.
    pub pictures: u64,
    /// How many things really changed.
    pub changes: u64,
    /// How long it took in the house, awake, seconds.
    pub seconds: f64,
    /// The way of the robot on the floor, metres.
    pub way: Vec<[f64; 2]>,
}

/// Why a simulation ended early.
#[derive(Debug, thiserror::Error)]
pub enum SimulationError {
    /// The scenario cannot happen.
    #[error(transparent)]
    Story(#[from] StoryError),
    /// The files cannot be written.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// A picture could not be packed.
    #[error("a picture could not be written: {0}")]
    Picture(#[from] super::sensor::FileError),
}

/// Where the truth of a recording is: `in.mcap` has `in.truth.mcap`.
pub fn truth_of(recording: &Path) -> PathBuf {
    recording.with_extension("truth.mcap")
}

/// Simulates `scenario` in `house` and writes the recording to `path`, with the truth beside it.
/// `progress` is told the seconds that have passed in the house.
pub fn record(
    scenario: &Scenario,
    house: &Arc<House>,
    path: &Path,
    progress: &mut dyn FnMut(f64),
) -> Result<Simulated, SimulationError> {
    let mut story = Story::new(scenario.clone(), house)?;
    let mut files = Files::create(path, scenario, house)?;
    loop {
        let more = story.tick(&mut |story, at, moment| files.take(story, at, moment))?;
        progress(story.progress_s());
        if !more {
            break;
        }
    }
    files.finish(&story)
}

struct Files {
    inputs: Recorder,
    truth: Recorder,
    publisher: Publisher,
    simulated: Simulated,
}

impl Files {
    fn create(
        path: &Path,
        scenario: &Scenario,
        house: &Arc<House>,
    ) -> Result<Self, SimulationError> {
        // Recordings are made once and kept: depth takes a third less than at level 3.
        let options = RecorderOptions { zstd_level: 17, ..RecorderOptions::default() };
        let with = |detectors| {
            let mut config = Config::default();
            config.detectors = detectors;
            config
        };
        let (recording, truth_path) = (path.to_owned(), truth_of(path));
        // Before either is made, so that a refusal leaves none.
        if let Some(path) = [&recording, &truth_path].into_iter().find(|path| path.exists()) {
            return Err(RecordError::Exists { path: path.clone() }.into());
        }
        let mut inputs = Recorder::create(path, with(Detectors::None), &options)?;
        let mut truth = Recorder::create(&truth_path, with(Detectors::Truth), &options)?;
        let graph = house.graph(scenario.start);
        inputs.record(scenario.start, Event::InitialGraph(graph.clone()))?;
        truth.record(scenario.start, Event::InitialGraph(graph))?;
        let publisher = Publisher::new(scenario, house);
        let (pictures, changes, seconds, way) = (0, 0, 0.0, Vec::new());
        let simulated = Simulated { recording, truth: truth_path, pictures, changes, seconds, way };
        Ok(Self { inputs, truth, publisher, simulated })
    }

    fn take(&mut self, story: &Story, at: Stamp, moment: &Moment) -> Result<(), SimulationError> {
        match moment {
            Moment::Deed(done) => return self.deed(story, at, done),
            Moment::Reported(report) => {
                if let (Status::Picked | Status::Placed, Some(n)) = (report.status, report.thing) {
                    let action = match report.status {
                        Status::Picked => Action::Removed,
                        _ => Action::Moved,
                    };
                    self.true_change(at, truth::by_robot(story, action, n, at))?;
                }
            }
            Moment::Poses => self.note_way(story.body().at),
            Moment::Picture => {
                self.simulated.pictures += 1;
                let (events, mask) = self.publisher.picture(story, at)?;
                for event in events {
                    self.inputs.record(at, event)?;
                }
                self.truth.record(at, mask)?;
                return Ok(());
            }
            Moment::Said(_) | Moment::Asked(_) | Moment::Clock => {}
        }
        for event in self.publisher.inputs(story, at, moment) {
            self.inputs.record(at, event)?;
        }
        Ok(())
    }

    fn deed(&mut self, story: &Story, at: Stamp, done: &Done) -> Result<(), SimulationError> {
        for change in truth::by_people(story, done, at) {
            self.true_change(at, change)?;
        }
        Ok(())
    }

    fn true_change(&mut self, at: Stamp, mut change: ChangeRecord) -> Result<(), SimulationError> {
        self.simulated.changes += 1;
        change.seq = self.simulated.changes;
        self.truth.record(at, Event::TrueChange(change))?;
        Ok(())
    }

    fn note_way(&mut self, at: [f64; 2]) {
        if self.simulated.way.last() != Some(&at) {
            self.simulated.way.push(at);
        }
    }

    fn finish(mut self, story: &Story) -> Result<Simulated, SimulationError> {
        self.inputs.finish()?;
        self.truth.finish()?;
        self.simulated.seconds = story.progress_s();
        Ok(self.simulated)
    }
}
