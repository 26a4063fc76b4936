//! What the robot publishes: poses, pictures, reports, and what it hears.

use std::sync::Arc;

use nalgebra::Isometry3;

use super::house::House;
use super::render::HouseScene;
use super::robot::behaviour::Report;
use super::robot::motion::Body;
use super::scenario::{Errand, Scenario};
use super::sensor::{
    FileError, NoiseConfig, Picture, TF_STATIC_TOPIC, TF_TOPIC, Transform, colour_message,
    depth_message, info_message, mask_message, tf_message,
};
use super::story::{Moment, Story};
use super::truth::{object_id, room_id};
use super::world::{Presence, TrueWorld};
use crate::change::NodeRef;
use crate::event::{Event, Task, TaskStatus, Utterance};
use crate::geometry::Camera;
use crate::time::Stamp;

/// Name of the world frame.
pub const WORLD: &str = "w";
/// Name of the frame of the robot's base.
pub const BASE: &str = "base_link";
/// Name of the foot of the pan-tilt head.
pub const MOUNT: &str = "camera_mount";
/// Name of the head, x along the line of sight.
pub const HEAD: &str = "camera_link";
/// Name of the optical frame of colour and depth.
pub const OPTICAL: &str = "camera_optical_frame";
/// Name of the frame between the fingers.
pub const GRIPPER: &str = "gripper";

/// Draws what the camera sees and words what the robot says.
pub struct Publisher {
    house: HouseScene,
    camera: Camera,
    noise: NoiseConfig,
    seed: u64,
    jpeg_quality: u8,
    pictures: u64,
    poses: u64,
}

impl Publisher {
    /// The robot of a scenario in a house.
    pub fn new(scenario: &Scenario, house: &Arc<House>) -> Self {
        let camera = &scenario.robot.camera;
        Self {
            house: HouseScene::new(house),
            camera: Camera::with_fov(camera.width, camera.height, camera.fov_deg.to_radians()),
            noise: scenario.noise.clone(),
            seed: scenario.seed,
            jpeg_quality: camera.jpeg_quality,
            pictures: 0,
            poses: 0,
        }
    }

    /// The inputs of a moment that is no picture.
    pub fn inputs(&mut self, story: &Story, at: Stamp, moment: &Moment) -> Vec<Event> {
        let scenario = story.scenario();
        match moment {
            Moment::Said(n) => {
                let said = &scenario.utterances[*n];
                let (speaker, text) = (said.speaker.clone(), said.text.clone());
                vec![Event::Utterance(Utterance { speaker, text })]
            }
            Moment::Asked(n) => vec![Event::Task(task(*n, &scenario.tasks[*n], story.world()))],
            Moment::Reported(report) => vec![Event::TaskStatus(status(report, story.world()))],
            Moment::Clock => vec![Event::Tick],
            Moment::Poses => self.poses(story.body(), at),
            Moment::Deed(_) | Moment::Picture => Vec::new(),
        }
    }

    fn poses(&mut self, body: &Body, at: Stamp) -> Vec<Event> {
        let transform =
            |(parent, child, parent_from_child)| Transform { parent, child, parent_from_child };
        let moving = [(WORLD, BASE, body.world_from_base()), (MOUNT, HEAD, body.mount_from_head())];
        let fixed = [
            (BASE, MOUNT, body.base_from_mount()),
            (HEAD, OPTICAL, Body::head_from_optical()),
            (BASE, GRIPPER, Body::base_from_gripper()),
        ];
        self.poses += 1;
        let moving = tf_message(at, TF_TOPIC, &moving.map(transform));
        match self.poses {
            1 => vec![tf_message(at, TF_STATIC_TOPIC, &fixed.map(transform)), moving],
            _ => vec![moving],
        }
    }

    /// The messages of the camera, and the true mask.
    pub fn picture(&mut self, story: &Story, at: Stamp) -> Result<(Vec<Event>, Event), FileError> {
        self.set_scene(story.world());
        let frame = self.house.scene.render(&self.camera, &story.body().world_from_camera());
        let picture = Picture::take(&frame, &self.camera, &self.noise, self.seed, self.pictures);
        self.pictures += 1;
        let events = vec![
            info_message(at, OPTICAL, &self.camera),
            colour_message(at, OPTICAL, &picture, self.jpeg_quality)?,
            depth_message(at, OPTICAL, &picture),
        ];
        Ok((events, mask_message(at, OPTICAL, &frame)))
    }

    /// Puts every thing where it is by now.
    fn set_scene(&mut self, world: &TrueWorld) {
        let HouseScene { scene, things } = &mut self.house;
        for n in things.len()..world.len() {
            let (thing, mask) = (world.thing(n), n as u16 + 1);
            things.push(scene.add(&thing.mesh, &thing.pose.isometry(), mask));
        }
        for (n, instance) in things.iter().enumerate() {
            let pose: Isometry3<f64> = world.thing(n).pose.isometry();
            if *scene.pose(*instance) != pose {
                scene.place(*instance, &pose);
            }
            scene.show(*instance, world.presence(n) != Presence::Gone);
        }
    }
}

fn task_id(n: usize) -> String {
    format!("t{}", n + 1)
}

/// What the robot is told; with the nodes only if its planner knows them.
fn task(n: usize, errand: &Errand, world: &TrueWorld) -> Task {
    let task =
        Task { task_id: task_id(n), instruction: errand.instruction.clone(), ..Task::default() };
    let known = world.find(&errand.pick).ok().filter(|_| errand.planned);
    let Some(object) = known else { return task };
    let room = |n: usize| NodeRef::id(room_id(n));
    let support = errand.place.on.as_ref().and_then(|on| world.find(on).ok());
    let floor = errand.place.room.as_ref().and_then(|room| world.room(room).ok());
    Task {
        object: Some(NodeRef::id(object_id(object))),
        source_room: Some(room(world.thing(object).room)),
        target_room: support.map(|n| world.thing(n).room).or(floor).map(room),
        support: support.map(|n| NodeRef::id(object_id(n))),
        ..task
    }
}

/// What the robot reports; the pose where the gripper closed or opened.
fn status(report: &Report, world: &TrueWorld) -> TaskStatus {
    let bare = TaskStatus::bare(task_id(report.errand), report.status);
    let Some(n) = report.thing.filter(|_| super::story::changes_world(report.status)) else {
        return bare;
    };
    let thing = world.thing(n);
    // The robot knows by its number what it knew at the start, and nothing else.
    let known = |n: usize| (n < world.house().things.len()).then(|| object_id(n));
    let named = |n: usize| NodeRef { id: known(n), label: Some(world.thing(n).label.clone()) };
    let room = Some(NodeRef::id(room_id(thing.room)));
    let support = thing.support.map(named);
    TaskStatus { pose: Some(thing.pose), object: Some(named(n)), room, support, ..bare }
}
