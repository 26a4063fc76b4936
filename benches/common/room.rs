//! A furnished room to take pictures of, equal in every run.

use std::sync::Arc;

use nalgebra::{Isometry3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};
use scenefold::simulation::mesh::{Material, Mesh, Texture};
use scenefold::simulation::render::{Lamp, Lighting, Scene};

use super::household::Dice;

/// A mesh and `world_from_mesh`.
pub type Thing = (Arc<Mesh>, Isometry3<f64>);

/// A furnished room.
pub struct Room {
    /// What is in it, the room itself first.
    pub things: Vec<Thing>,
    /// The same, as a scene.
    pub scene: Scene,
    /// Four ways to look at it: `world_from_camera`.
    pub eyes: Vec<Isometry3<f64>>,
}

impl Room {
    /// Balls, boxes and walls.
    pub fn new() -> Self {
        let things = things();
        let mut scene = Scene::new(lighting());
        for (n, (mesh, pose)) in things.iter().enumerate() {
            scene.add(mesh, pose, n as u16);
        }
        let corners = [[-2.8, -2.3], [2.8, -2.3], [2.8, 2.3], [-2.8, 2.3]];
        let eyes = corners.map(|[x, y]| looking([x, y, 1.3], [0.0, 0.0, 0.7])).to_vec();
        Self { things, scene, eyes }
    }
}

fn lighting() -> Lighting {
    let lamp = Lamp {
        position: [0.0, 0.0, 2.4],
        radius_m: 0.25,
        colour: [1.0, 0.95, 0.85],
        strength: 3.0,
        room: vec![[-3.0, -2.5], [3.0, -2.5], [3.0, 2.5], [-3.0, 2.5]],
    };
    Lighting { lamps: vec![lamp], ..Lighting::default() }
}

fn things() -> Vec<Thing> {
    let wall = Texture::Grain { scale_m: 0.02, strength: 0.2 };
    let shell = grid(1, cube_face, [6.0, 5.0, 2.5], wall);
    let mut things = vec![(shell, Isometry3::translation(0.0, 0.0, 1.25))];
    let wood = Texture::Grain { scale_m: 0.01, strength: 0.4 };
    let checks = Texture::Checker { side_m: 0.05, second: [0.1, 0.2, 0.6] };
    let mut dice = Dice::new();
    let mut somewhere = |reach: f64| f64::from(dice.below(1 << 20)) / f64::from(1 << 20) * reach;
    for n in 0..100_u16 {
        let size = [0.1, 0.15, 0.1].map(|least| least + somewhere(0.5) as f32);
        let texture = [wood, checks, Texture::Plain][usize::from(n) % 3];
        let mesh = if n % 2 == 0 {
            grid(16, ball_face, size, texture)
        } else {
            grid(4, cube_face, size, texture)
        };
        let place = Translation3::new(somewhere(5.0) - 2.5, somewhere(4.0) - 2.0, somewhere(1.2));
        let turn = UnitQuaternion::from_euler_angles(0.0, 0.0, somewhere(3.0));
        things.push((mesh, Isometry3::from_parts(place, turn)));
    }
    things
}

fn looking(eye: [f64; 3], target: [f64; 3]) -> Isometry3<f64> {
    let forward = (Point3::from(target) - Point3::from(eye)).normalize();
    let right = forward.cross(&Vector3::z()).normalize();
    let basis = [right, forward.cross(&right), forward];
    let rotation = Rotation3::from_basis_unchecked(&basis);
    let rotation = UnitQuaternion::from_rotation_matrix(&rotation);
    Isometry3::from_parts(Translation3::from(eye), rotation)
}

/// A point of the face z = ½ of the unit cube.
fn cube_face(u: f32, v: f32) -> [f32; 3] {
    [u - 0.5, v - 0.5, 0.5]
}

/// The same, on the ball of diameter 1.
fn ball_face(u: f32, v: f32) -> [f32; 3] {
    let at = cube_face(u, v);
    let length = at.iter().map(|it| it * it).sum::<f32>().sqrt();
    at.map(|it| it / length / 2.0)
}

/// Six faces of `steps`² squares of two triangles.
fn grid(
    steps: u32,
    face: impl Fn(f32, f32) -> [f32; 3],
    size: [f32; 3],
    texture: Texture,
) -> Arc<Mesh> {
    let mut mesh =
        Mesh { materials: vec![Material { colour: [0.7, 0.6, 0.4], texture }], ..Mesh::default() };
    for turn in 0..6 {
        let first = mesh.vertices.len() as u32;
        for n in 0..(steps + 1) * (steps + 1) {
            let [u, v] = [n % (steps + 1), n / (steps + 1)].map(|it| it as f32 / steps as f32);
            let mut at = face(u, v);
            if turn >= 3 {
                at = [at[1], at[0], -at[2]];
            }
            at.rotate_right(turn % 3);
            mesh.vertices.push([0, 1, 2].map(|axis| at[axis] * size[axis]));
        }
        for n in 0..steps * steps {
            let a = first + n / steps * (steps + 1) + n % steps;
            let (b, c, d) = (a + 1, a + steps + 2, a + steps + 1);
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh.material_of = vec![0; mesh.triangles.len()];
    Arc::new(mesh)
}
