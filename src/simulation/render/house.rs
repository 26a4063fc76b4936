//! A house as a scene: [`HouseScene`].

use nalgebra::{Isometry3, Point3, Vector3};

use super::light::{Ambient, Lamp, Lighting};
use super::scene::{InstanceId, Scene};
use crate::geometry::looking_at;
use crate::simulation::house::{House, Room};

/// From ceiling to lamp, metres.
const LAMP_DROP_M: f64 = 0.25;
/// Lightness of a white surface that faces a lamp from one metre.
const LAMP_STRENGTH: f32 = 2.6;
/// Height of the eye in views of rooms, metres.
const EYE_M: f64 = 1.5;
/// From the corner of a room to the eye, metres.
const FROM_CORNER_M: f64 = 0.4;

/// A house and where its things are in the scene.
#[derive(Clone)]
pub struct HouseScene {
    /// The scene. Masks: 0 for the building, n + 1 for thing n.
    pub scene: Scene,
    /// For each thing of the house its mesh in the scene.
    pub things: Vec<InstanceId>,
}

impl HouseScene {
    /// All of a house, with a lamp in the middle of each room.
    pub fn new(house: &House) -> Self {
        let lamps = house.rooms.iter().map(|room| lamp(house, room)).collect();
        let (ambient, background) = (Ambient::default(), [0.55, 0.62, 0.7]);
        let mut scene = Scene::new(Lighting { lamps, ambient, background });
        for slab in house.walls().iter().chain(&house.floors()).chain(&house.ceilings()) {
            scene.add(&slab.mesh, &slab.pose.isometry(), 0);
        }
        let things = house
            .things
            .iter()
            .enumerate()
            .map(|(n, thing)| scene.add(&thing.mesh, &thing.pose.isometry(), n as u16 + 1));
        let things = things.collect();
        Self { scene, things }
    }

    /// A view of a room from one of its corners (`world_from_camera`): the one from which most
    /// can be seen.
    pub fn view_of(&self, room: &Room) -> Isometry3<f64> {
        let middle = middle(&room.outline);
        let target = [middle[0], middle[1], 0.7];
        let eyes = room.outline.iter().map(|corner| eye_at(*corner, middle));
        let views = eyes.map(|eye| looking_at(eye.into(), target.into()));
        let best = views.max_by(|a, b| self.openness(a).total_cmp(&self.openness(b)));
        best.unwrap_or_else(Isometry3::identity)
    }

    /// Mean depth over a grid of rays of a picture.
    fn openness(&self, world_from_camera: &Isometry3<f64>) -> f64 {
        let origin = Point3::from(world_from_camera.translation.vector);
        let rays = (0..81).map(|n| Vector3::new(f64::from(n % 9), f64::from(n / 9), 0.0));
        let rays =
            rays.map(|n| world_from_camera * Vector3::new(n.x / 6.0 - 0.7, n.y / 8.0 - 0.5, 1.0));
        // What is farther than a room is wide is out of a door.
        rays.filter_map(|ray| self.scene.cast_ray(&origin, &ray, 6.0)).map(|hit| hit.distance).sum()
    }
}

fn lamp(house: &House, room: &Room) -> Lamp {
    let [x, y] = middle(&room.outline);
    Lamp {
        position: [x, y, house.wall_height_m - LAMP_DROP_M],
        radius_m: 0.25,
        colour: [1.0, 0.97, 0.92],
        strength: LAMP_STRENGTH,
        room: room.outline.clone(),
    }
}

/// A little off a corner, towards the middle.
fn eye_at(corner: [f64; 2], middle: [f64; 2]) -> [f64; 3] {
    let (x, y) = (middle[0] - corner[0], middle[1] - corner[1]);
    let share = FROM_CORNER_M / libm::hypot(x, y).max(FROM_CORNER_M);
    [corner[0] + x * share, corner[1] + y * share, EYE_M]
}

/// A point well inside an outline: far from all walls, but near the middle of its box.
fn middle(outline: &[[f64; 2]]) -> [f64; 2] {
    const STEPS: u32 = 24;
    let least = |axis: usize| outline.iter().map(|it| it[axis]).fold(f64::INFINITY, f64::min);
    let most = |axis: usize| outline.iter().map(|it| it[axis]).fold(f64::NEG_INFINITY, f64::max);
    let (low, high) = ([least(0), least(1)], [most(0), most(1)]);
    let place = |n: u32, axis: usize| {
        low[axis] + (high[axis] - low[axis]) * f64::from(n) / f64::from(STEPS)
    };
    let places = (0..(STEPS + 1) * (STEPS + 1))
        .map(|n| [place(n % (STEPS + 1), 0), place(n / (STEPS + 1), 1)]);
    let centre = [0, 1].map(|axis| f64::midpoint(low[axis], high[axis]));
    let worth = |at: &[f64; 2]| {
        let off = libm::hypot(at[0] - centre[0], at[1] - centre[1]);
        let clear = clearance(outline, *at);
        clear - 0.1 * off
    };
    places.max_by(|a, b| worth(a).total_cmp(&worth(b))).unwrap_or(centre)
}

/// How far a point inside an outline is from it; negative outside.
fn clearance(outline: &[[f64; 2]], at: [f64; 2]) -> f64 {
    let (mut nearest, mut inside) = (f64::INFINITY, false);
    for (n, to) in outline.iter().enumerate() {
        let from = outline[(n + outline.len() - 1) % outline.len()];
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let (px, py) = (at[0] - from[0], at[1] - from[1]);
        let along = ((px * dx + py * dy) / (dx * dx + dy * dy)).clamp(0.0, 1.0);
        nearest = nearest.min(libm::hypot(px - along * dx, py - along * dy));
        if (from[1] > at[1]) != (to[1] > at[1]) && px < py / dy * dx {
            inside = !inside;
        }
    }
    if inside { nearest } else { -nearest }
}
