//! A picture of 640×480 with colour, depth and mask, against bare parry ray casts of the same
//! primary rays through the same scene; and what a second thread gains.
//!
//! `cargo bench --bench render`; `SCENEFOLD_BENCH_SMALL=1` for a smoke run.

mod common;

use common::measure::{best_cpu_of, best_of, over, tell_at_least, tell_at_most, tell_time};
use common::room::{Room, Thing};
use common::small;
use nalgebra::{Isometry3, Vector3};
use parry3d::bounding_volume::BoundingVolume;
use parry3d::math::{Pose, Rotation, Vector};
use parry3d::partitioning::{Bvh, BvhBuildStrategy};
use parry3d::query::{Ray, RayCast};
use parry3d::shape::TriMesh;
use rayon::ThreadPool;
use scenefold::geometry::Camera;

fn main() {
    let (width, height) = if small() { (64, 48) } else { (640, 480) };
    let camera = Camera::with_fov(width, height, 1.2);
    let Room { things, scene, eyes } = Room::new();
    let bare = Bare::of(&things);
    let rays = u64::from(width) * u64::from(height) * eyes.len() as u64;
    println!("{} triangles, {} pictures", scene.triangles(), eyes.len());
    let (one, two) = (pool(1), pool(2));
    let pictures = |pool: &ThreadPool| {
        pool.install(|| {
            for eye in &eyes {
                std::hint::black_box(scene.render(&camera, eye));
            }
        });
    };
    let casts = || {
        for eye in &eyes {
            std::hint::black_box(bare.look(&camera, eye));
        }
    };
    let [casting, rendered] =
        one.install(|| best_cpu_of(5, [&mut || casts(), &mut || pictures(&one)]));
    let [single, double] = best_of(5, [&mut || pictures(&one), &mut || pictures(&two)]);
    tell_time("bare parry ray casts", casting, rays, "ray");
    tell_time("colour, depth and mask", rendered, rays, "pixel");
    tell_at_most("picture/bare ray casts", over(rendered, casting), 1.3);
    tell_at_least("speed of two threads/one", over(single, double), 1.6);
}

fn pool(threads: usize) -> ThreadPool {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be started")
}

/// The same scene in parry's own types: a tree of the trees of its meshes.
struct Bare {
    things: Vec<(TriMesh, Pose)>,
    tree: Bvh,
}

impl Bare {
    fn of(things: &[Thing]) -> Self {
        let mesh = |(mesh, pose): &Thing| {
            let vertices = mesh.vertices.iter().map(|at| Vector::from(*at)).collect();
            let mesh = TriMesh::new(vertices, mesh.triangles.clone()).expect("it has triangles");
            (mesh, pose_of(pose))
        };
        let things: Vec<(TriMesh, Pose)> = things.iter().map(mesh).collect();
        let boxes: Vec<_> =
            things.iter().map(|(mesh, pose)| mesh.aabb(pose).loosened(1e-4)).collect();
        Self { tree: Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes), things }
    }

    /// How far each pixel's ray goes, nothing else.
    fn look(&self, camera: &Camera, eye: &Isometry3<f64>) -> f32 {
        let eye: Isometry3<f32> = eye.cast();
        let origin = Vector::from(<[f32; 3]>::from(eye.translation.vector));
        let mut sum = 0.0;
        for v in 0..camera.height {
            for u in 0..camera.width {
                let x = (u as f32 - camera.centre[0] as f32) / camera.focal[0] as f32;
                let y = (v as f32 - camera.centre[1] as f32) / camera.focal[1] as f32;
                let ray = Ray::new(origin, <[f32; 3]>::from(eye * Vector3::new(x, y, 1.0)).into());
                let hit = self.tree.cast_ray(&ray, 100.0, |thing, best| {
                    let (mesh, pose) = &self.things[thing as usize];
                    mesh.cast_ray(pose, &ray, best, false)
                });
                sum += hit.map_or(0.0, |(_, distance)| distance);
            }
        }
        sum
    }
}

fn pose_of(world_from_mesh: &Isometry3<f64>) -> Pose {
    let world_from_mesh: Isometry3<f32> = world_from_mesh.cast();
    let turn = world_from_mesh.rotation.coords;
    let turn = Rotation::from_xyzw(turn.x, turn.y, turn.z, turn.w);
    Pose::from_parts(<[f32; 3]>::from(world_from_mesh.translation.vector).into(), turn)
}
