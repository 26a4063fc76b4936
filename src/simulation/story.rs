//! Everything that happens, tick by tick: [`Story`].
//!
//! Knows people, robot and world, and neither pictures nor files: what it tells is drawn and
//! recorded by [`super::record`].

use std::sync::Arc;

use super::house::House;
use super::random::Random;
use super::robot::behaviour::{Mind, Report};
use super::robot::motion::Body;
use super::scenario::check::{ActionError, Done, act};
use super::scenario::{Scenario, ScenarioError};
use super::world::TrueWorld;
use crate::event::Status;
use crate::time::{Span, Stamp};

/// The robot moves on in steps of this, nanoseconds.
const TICK: u64 = 50_000_000;
/// Poses are published this often, nanoseconds.
const POSES: u64 = 100_000_000;
/// While it sleeps, the clock tells this often, nanoseconds; at most [`CLOCKS`] times a gap.
const CLOCK: u64 = 3_600_000_000_000;
const CLOCKS: u64 = 1000;
/// A robot that finds no end is stopped after this, nanoseconds of being awake.
const LONGEST: u64 = 4 * 3_600_000_000_000;

/// Something that happens at some moment.
#[derive(Clone, Debug, PartialEq)]
pub enum Moment {
    /// Somebody did something; the world is as after it.
    Deed(Done),
    /// Somebody said something: number of the utterance.
    Said(usize),
    /// The robot was told to do something: number of the task.
    Asked(usize),
    /// The robot reports; the world is as after it.
    Reported(Report),
    /// Time passes.
    Clock,
    /// The robot tells where it is.
    Poses,
    /// The camera takes a picture.
    Picture,
}

/// A scenario as it unfolds.
pub struct Story {
    scenario: Scenario,
    world: TrueWorld,
    body: Body,
    mind: Mind,
    /// Draws places, as the check of the scenario does.
    places: Random,
    /// Time awake, nanoseconds from the start.
    awake: u64,
    /// What is still to happen, last first.
    to_come: Vec<(Span, Cue)>,
    over: bool,
}

#[derive(Clone, Copy, Debug)]
enum Cue {
    Action(usize),
    Utterance(usize),
    Task(usize),
    Gap(usize),
}

/// Why a story cannot go on.
#[derive(Debug, thiserror::Error)]
pub enum StoryError {
    /// The scenario cannot happen in this house.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// Something is in the way of what somebody wants to do: the robot changed the world.
    #[error("actions[{n}]: {error}")]
    Action {
        /// Number of the action.
        n: usize,
        /// What is in the way.
        error: ActionError,
    },
    /// The robot fits nowhere.
    #[error("robot.body.radius_m: the robot fits nowhere in the room it starts in")]
    NoRoom,
}

impl Story {
    /// The beginning of a scenario in a house.
    pub fn new(scenario: Scenario, house: &Arc<House>) -> Result<Self, StoryError> {
        scenario.check(house)?;
        let world = TrueWorld::new(house.clone());
        let mut mind = Mind::new(scenario.robot.clone(), &world);
        let at = mind.start(&world).ok_or(StoryError::NoRoom)?;
        let body = Body::new(scenario.robot.body, at, 0.0);
        let places = Random::new(scenario.seed, 0);
        let to_come = cues(&scenario);
        Ok(Self { scenario, world, body, mind, places, awake: 0, to_come, over: false })
    }

    /// The scenario.
    pub fn scenario(&self) -> &Scenario {
        &self.scenario
    }

    /// The world by now.
    pub fn world(&self) -> &TrueWorld {
        &self.world
    }

    /// The robot by now.
    pub fn body(&self) -> &Body {
        &self.body
    }

    /// Seconds awake so far.
    pub fn progress_s(&self) -> f64 {
        self.awake as f64 / 1e9
    }

    /// Lets one tick pass, and tells `each` what happens in it, with the world as it is then;
    /// false once the story is over.
    pub fn tick<E: From<StoryError>>(
        &mut self,
        each: &mut dyn FnMut(&Self, Stamp, &Moment) -> Result<(), E>,
    ) -> Result<bool, E> {
        if self.over {
            return Ok(false);
        }
        while self.to_come.last().is_some_and(|(time, _)| time.0 <= self.awake) {
            let Some((_, cue)) = self.to_come.pop() else { break };
            self.cue(cue, each)?;
        }
        if self.body.is_idle() {
            self.decide(each)?;
        }
        self.body.step(TICK as f64 / 1e9);
        self.carry();
        let now = self.now();
        if self.awake.is_multiple_of(POSES) {
            each(self, now, &Moment::Poses)?;
        }
        let period = 1e9 / self.scenario.robot.camera.rate_hz;
        let pictures = |awake: u64| (awake as f64 / period) as u64;
        if self.awake == 0 || pictures(self.awake) != pictures(self.awake - TICK) {
            // A picture needs the pose it was taken from.
            if !self.awake.is_multiple_of(POSES) {
                each(self, now, &Moment::Poses)?;
            }
            each(self, now, &Moment::Picture)?;
        }
        self.awake += TICK;
        Ok(!self.over)
    }

    /// The instant by now.
    pub fn now(&self) -> Stamp {
        let slept = self.scenario.gaps.iter().enumerate();
        let slept = slept.filter(|(n, _)| !self.is_to_come(*n)).map(|(_, gap)| gap.length.0);
        self.scenario.start.plus_nanos(self.awake + slept.sum::<u64>())
    }

    fn is_to_come(&self, gap: usize) -> bool {
        self.to_come.iter().any(|(_, cue)| matches!(cue, Cue::Gap(n) if *n == gap))
    }

    fn cue<E: From<StoryError>>(
        &mut self,
        cue: Cue,
        each: &mut dyn FnMut(&Self, Stamp, &Moment) -> Result<(), E>,
    ) -> Result<(), E> {
        let now = self.now();
        match cue {
            Cue::Action(n) => {
                let done = act(&mut self.world, &self.scenario.actions[n], &mut self.places);
                let done = done.map_err(|error| StoryError::Action { n, error })?;
                each(self, now, &Moment::Deed(done))
            }
            Cue::Utterance(n) => each(self, now, &Moment::Said(n)),
            Cue::Task(n) => {
                self.mind.ask(n);
                each(self, now, &Moment::Asked(n))
            }
            Cue::Gap(n) => {
                let length = self.scenario.gaps[n].length.0;
                let before = now.nanos() - length;
                let every = CLOCK.max(length / CLOCKS);
                for passed in (0..length).step_by(every as usize).chain([length]) {
                    each(self, Stamp::from_nanos(before + passed), &Moment::Clock)?;
                }
                Ok(())
            }
        }
    }

    fn decide<E: From<StoryError>>(
        &mut self,
        each: &mut dyn FnMut(&Self, Stamp, &Moment) -> Result<(), E>,
    ) -> Result<(), E> {
        let idle = self.to_come.is_empty();
        let (reports, busy) = self.mind.decide(
            &mut self.body,
            &mut self.world,
            &self.scenario.tasks,
            &mut self.places,
            idle,
        );
        for report in reports {
            each(self, self.now(), &Moment::Reported(report))?;
        }
        self.over = (!busy && idle && self.mind.is_free()) || self.awake > LONGEST;
        Ok(())
    }

    /// What is in the gripper goes where the gripper goes.
    fn carry(&mut self) {
        let world_from_gripper = self.body.world_from_base() * Body::base_from_gripper();
        self.world.carry(&world_from_gripper);
    }
}

/// Everything that is to come, last first; at one time people act, then speak, then ask.
fn cues(scenario: &Scenario) -> Vec<(Span, Cue)> {
    let gaps = scenario.gaps.iter().enumerate().map(|(n, it)| (it.time, Cue::Gap(n)));
    let actions = scenario.actions.iter().enumerate().map(|(n, it)| (it.time(), Cue::Action(n)));
    let said = scenario.utterances.iter().enumerate().map(|(n, it)| (it.time, Cue::Utterance(n)));
    let tasks = scenario.tasks.iter().enumerate().map(|(n, it)| (it.time, Cue::Task(n)));
    let mut cues: Vec<(Span, Cue)> = gaps.chain(actions).chain(said).chain(tasks).collect();
    cues.sort_by_key(|(time, _)| *time);
    cues.reverse();
    cues
}

/// Whether a status says that something was picked or placed.
pub fn changes_world(status: Status) -> bool {
    matches!(status, Status::Picked | Status::Placed)
}
