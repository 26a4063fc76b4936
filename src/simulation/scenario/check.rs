//! Whether a scenario can happen in a house.

use std::sync::Arc;

use super::{NewThing, Scenario, VirtualAction};
use crate::graph::{Label, LabelError};
use crate::simulation::house::{House, Thing};
use crate::simulation::random::Random;
use crate::simulation::world::{PlaceError, Presence, TrueWorld};
use crate::time::Span;

/// Why a scenario cannot happen: which field, and what is wrong with it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{path}: {what}")]
pub struct ScenarioError {
    /// The field, such as `actions[2].to`.
    pub path: String,
    /// What is wrong, and how to mend it.
    pub what: String,
}

impl ScenarioError {
    fn new(path: impl Into<String>, what: impl std::fmt::Display) -> Self {
        let (path, what) = (path.into(), what.to_string());
        Self { path, what }
    }
}

impl Scenario {
    /// Checks everything that can be checked without the robot: numbers, names and places, each
    /// at its time.
    pub fn check(&self, house: &Arc<House>) -> Result<(), ScenarioError> {
        self.check_camera()?;
        self.check_robot(house)?;
        self.rehearse(house, &mut |_| {})
    }

    fn check_camera(&self) -> Result<(), ScenarioError> {
        let camera = &self.robot.camera;
        let path = |field: &str| format!("robot.camera.{field}");
        for (field, side) in [("width", camera.width), ("height", camera.height)] {
            if !(16..=4096).contains(&side) {
                let what = format!("{side} pixels: it must be 16 to 4096");
                return Err(ScenarioError::new(path(field), what));
            }
        }
        in_range(&path("fov_deg"), camera.fov_deg, 10.0, 150.0)?;
        in_range(&path("rate_hz"), camera.rate_hz, 0.01, 20.0)?;
        if camera.jpeg_quality > 100 {
            let what = format!("{}: it must be 0 (PNG) to 100", camera.jpeg_quality);
            return Err(ScenarioError::new(path("jpeg_quality"), what));
        }
        Ok(())
    }

    fn check_robot(&self, house: &Arc<House>) -> Result<(), ScenarioError> {
        let body = &self.robot.body;
        for (field, value, least, most) in [
            ("radius_m", body.radius_m, 0.05, 1.0),
            ("speed_m_s", body.speed_m_s, 0.01, 5.0),
            ("turn_rad_s", body.turn_rad_s, 0.05, 20.0),
            ("head_rad_s", body.head_rad_s, 0.05, 20.0),
            ("camera_height_m", body.camera_height_m, 0.1, 2.2),
            ("reach_m", body.reach_m, 0.2, 3.0),
        ] {
            in_range(&format!("robot.body.{field}"), value, least, most)?;
        }
        let world = TrueWorld::new(house.clone());
        let rooms = self.robot.round.iter().enumerate();
        let named = rooms.map(|(n, room)| (format!("robot.round[{n}]"), room));
        let first = self.robot.room.iter().map(|room| ("robot.room".to_owned(), room));
        for (path, room) in first.chain(named) {
            world.room(room).map_err(|error| ScenarioError::new(path, error))?;
        }
        Ok(())
    }

    /// Lets everything happen in order, robot and all, on paper; `after` is shown the world after
    /// each step.
    pub fn rehearse(
        &self,
        house: &Arc<House>,
        after: &mut dyn FnMut(&TrueWorld),
    ) -> Result<(), ScenarioError> {
        let mut world = TrueWorld::new(house.clone());
        let mut random = Random::new(self.seed, 0);
        for step in self.in_order() {
            match step {
                Step::Action(n) => {
                    let path = format!("actions[{n}]");
                    let done = act(&mut world, &self.actions[n], &mut random);
                    done.map_err(|error| ScenarioError::new(path, error))?;
                }
                Step::Task(n) => {
                    let errand = &self.tasks[n];
                    let failed = |field: &str, error: PlaceError| {
                        ScenarioError::new(format!("tasks[{n}].{field}"), error)
                    };
                    let thing = world.find(&errand.pick).map_err(|e| failed("pick", e))?;
                    world.take(thing, Presence::Held);
                    let spot = world.place(world.thing(thing), &errand.place, &mut random);
                    world.put(thing, spot.map_err(|error| failed("place", error))?);
                }
            }
            after(&world);
        }
        Ok(())
    }

    /// Actions and tasks by time; those of one time as they stand in the file, actions first.
    fn in_order(&self) -> Vec<Step> {
        let actions = self.actions.iter().enumerate();
        let tasks = self.tasks.iter().enumerate();
        let mut steps: Vec<(Span, Step)> = actions
            .map(|(n, action)| (action.time(), Step::Action(n)))
            .chain(tasks.map(|(n, task)| (task.time, Step::Task(n))))
            .collect();
        steps.sort_by_key(|(time, _)| *time);
        steps.into_iter().map(|(_, step)| step).collect()
    }
}

#[derive(Clone, Copy)]
enum Step {
    Action(usize),
    Task(usize),
}

fn in_range(path: &str, value: f64, least: f64, most: f64) -> Result<(), ScenarioError> {
    if value.is_finite() && (least..=most).contains(&value) {
        return Ok(());
    }
    Err(ScenarioError::new(path, format!("{value}: it must be {least} to {most}")))
}

/// Why an action cannot be carried out.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ActionError {
    /// A thing or a place.
    #[error(transparent)]
    Place(#[from] PlaceError),
    /// A label that is none.
    #[error(transparent)]
    Label(#[from] LabelError),
    /// A box that is none.
    #[error("object.size: {0}")]
    Size(#[from] crate::geometry::GeometryError),
    /// Other things stand on it.
    #[error("{} stands on {thing:?}: take that away first", .on.join(", "))]
    Laden {
        /// What was to be taken.
        thing: String,
        /// What stands on it.
        on: Vec<String>,
    },
    /// There is one of that name.
    #[error("object.name: there is a {name:?} already: choose another name")]
    Taken {
        /// The name.
        name: String,
    },
}

/// What an action did, and to which thing.
#[derive(Clone, Debug, PartialEq)]
pub enum Done {
    /// Thing number so and so is gone.
    Removed(usize),
    /// It is elsewhere, and so are the things that stand on it.
    Moved(Vec<usize>),
    /// It is new.
    Added(usize),
}

/// Carries out what somebody does.
pub fn act(
    world: &mut TrueWorld,
    action: &VirtualAction,
    random: &mut Random,
) -> Result<Done, ActionError> {
    match action {
        VirtualAction::Removed { object, .. } => {
            let n = world.find(object)?;
            let above = world.standing_on(n);
            if !above.is_empty() {
                let on = above.iter().map(|n| world.thing(*n).name.clone()).collect();
                return Err(ActionError::Laden { thing: world.thing(n).name.clone(), on });
            }
            world.take(n, Presence::Gone);
            Ok(Done::Removed(n))
        }
        VirtualAction::Moved { object, to, .. } => {
            let n = world.find(object)?;
            let spot = world.place(world.thing(n), to, random)?;
            world.put(n, spot);
            let mut moved = vec![n];
            moved.extend(world.standing_on(n));
            Ok(Done::Moved(moved))
        }
        VirtualAction::Added { object, to, .. } => {
            let thing = new_thing(world, object)?;
            let spot = world.place(&thing, to, random)?;
            let n = world.add(thing);
            world.put(n, spot);
            Ok(Done::Added(n))
        }
    }
}

/// The thing that `new` describes, nowhere in particular.
fn new_thing(world: &TrueWorld, new: &NewThing) -> Result<Thing, ActionError> {
    let name = new.name.as_ref().unwrap_or(&new.label).clone();
    if (0..world.len()).any(|n| world.thing(n).name == name) {
        return Err(ActionError::Taken { name });
    }
    let label = Label::new(&new.label)?;
    Ok(Thing::of_class(name, label, new.size)?)
}
