//! Depth is that of the surface, by analysis and by brute force.

use nalgebra::{Isometry3, Point3, Vector3};
use proptest::prelude::*;

use super::shapes::{at, ball, cuboid, looking, square};
use crate::geometry::Camera;
use crate::simulation::render::{Frame, Lighting, Scene};

const LENS: [f64; 5] = [0.1, -0.2, 0.001, -0.001, 0.05];

fn small(distortion: [f64; 5]) -> Camera {
    Camera { distortion, ..Camera::with_fov(48, 36, 1.2) }
}

/// Compares each pixel's depth with `expected(ray in the world, with z = 1 in the camera)`.
#[track_caller]
fn check(
    scene: &Scene,
    camera: &Camera,
    eye: &Isometry3<f64>,
    tolerance_m: f64,
    expected: impl Fn(&Point3<f64>, &Vector3<f64>) -> Option<f64>,
) {
    let frame = scene.render(camera, eye);
    let origin = Point3::from(eye.translation.vector);
    for (n, found) in frame.depth_m.iter().enumerate() {
        let (u, v) = (n % camera.width as usize, n / camera.width as usize);
        let ray = eye * camera.ray(u as f64, v as f64).unwrap();
        let expected = expected(&origin, &ray).unwrap_or(0.0);
        let miss = (f64::from(*found) - expected).abs();
        assert!(miss <= tolerance_m, "pixel ({u}, {v}): {found} instead of {expected}");
    }
}

fn scene_of(mesh: &std::sync::Arc<crate::simulation::mesh::Mesh>, pose: Isometry3<f64>) -> Scene {
    let mut scene = Scene::new(Lighting::default());
    scene.add(mesh, &pose, 1);
    scene
}

#[test]
fn a_plane_is_as_far_as_its_equation_says() {
    let eye = looking([0.0, 0.0, 1.2], [3.0, 1.0, 0.0]);
    for distortion in [[0.0; 5], LENS] {
        let floor = scene_of(&square(200.0), at(0.0, 0.0, 0.0));
        check(&floor, &small(distortion), &eye, 1e-4, |origin, ray| {
            let distance = -origin.z / ray.z;
            let hit = origin + ray * distance;
            (distance > 0.0 && hit.coords.xy().amax() < 100.0).then_some(distance)
        });
    }
}

/// Where a ray enters a box about the origin (A. Williams et al., "An efficient and robust
/// ray-box intersection algorithm", 2005).
fn enters(half: &Vector3<f64>, origin: &Point3<f64>, ray: &Vector3<f64>) -> Option<f64> {
    let near =
        (half.component_mul(&ray.map(f64::signum)) + origin.coords).component_div(ray) * -1.0;
    let far = (half.component_mul(&ray.map(f64::signum)) - origin.coords).component_div(ray);
    (near.max() <= far.min() && near.max() > 0.0).then_some(near.max())
}

#[test]
fn a_box_is_as_far_as_its_faces_are() {
    let pose = Isometry3::new(Vector3::new(1.0, 0.2, 0.4), Vector3::new(0.3, -0.2, 0.5));
    let eye = looking([-1.0, 0.1, 0.9], [1.0, 0.2, 0.4]);
    for distortion in [[0.0; 5], LENS] {
        let scene = scene_of(&cuboid([0.5, 0.4, 0.75]), pose);
        check(&scene, &small(distortion), &eye, 1e-4, |origin, ray| {
            let (origin, ray) = (pose.inverse() * origin, pose.inverse() * ray);
            enters(&Vector3::new(0.25, 0.2, 0.375), &origin, &ray)
        });
    }
}

#[test]
fn a_ball_is_as_far_as_its_equation_says_but_for_its_flat_faces() {
    let eye = looking([-1.0, 0.1, 0.9], [1.0, 0.0, 0.0]);
    let scene = scene_of(&ball(0.5, 100), at(1.0, 0.0, 0.0));
    let camera = small([0.0; 5]);
    let frame = scene.render(&camera, &eye);
    let (mut seen, mut missed) = (0, 0);
    for (n, found) in frame.depth_m.iter().enumerate() {
        let ray = eye * camera.ray((n % 48) as f64, (n / 48) as f64).unwrap();
        let from = eye.translation.vector - Vector3::x();
        // |from + t·ray|² = r²
        let (a, b, c) = (ray.norm_squared(), from.dot(&ray), from.norm_squared() - 0.25);
        let square = b * b - a * c;
        let expected = if square < 0.0 { 0.0 } else { (-b - square.sqrt()) / a };
        // The faces of a ball of 100 steps lie up to r(1 - cos(π/100)) inside of it, along the
        // normal; near the outline, the ray goes far for that.
        let inwards = 0.5 * (1.0 - libm::cos(std::f64::consts::PI / 100.0)) * 1.5;
        let grazing = (square.max(0.0) / a).sqrt() < 0.1;
        if grazing || (f64::from(*found) - expected).abs() < inwards * 0.5 * a / square.sqrt() {
            seen += u32::from(expected > 0.0);
        } else {
            missed += 1;
        }
    }
    assert!(seen > 150 && missed == 0, "{seen} seen, {missed} missed");
}

/// The nearest triangle of all, one ray and one triangle at a time.
fn by_brute_force(scene: &Scene, origin: &Point3<f64>, ray: &Vector3<f64>) -> Option<(f64, u16)> {
    let mut nearest: Option<(f64, u16)> = None;
    for instance in &scene.instances {
        let mesh = &scene.solid(instance).mesh;
        for corners in &mesh.triangles {
            let [a, b, c] = corners.map(|n| {
                instance.world_from_mesh * Point3::from(mesh.vertices[n as usize].map(f64::from))
            });
            // T. Möller and B. Trumbore, "Fast, minimum storage ray/triangle intersection", 1997.
            let (ab, ac, from) = (b - a, c - a, origin - a);
            let (p, q) = (ray.cross(&ac), from.cross(&ab));
            let determinant = ab.dot(&p);
            let [s, t, along] = [from.dot(&p), ray.dot(&q), ac.dot(&q)].map(|it| it / determinant);
            let inside = s.min(t) >= 0.0 && s + t <= 1.0 && along > 0.0;
            if instance.shown && inside && nearest.is_none_or(|(before, _)| along < before) {
                nearest = Some((along, instance.mask));
            }
        }
    }
    nearest
}

fn differences(scene: &Scene, camera: &Camera, eye: &Isometry3<f64>, frame: &Frame) -> usize {
    let origin = Point3::from(eye.translation.vector);
    let wrong = (0..frame.mask.len()).filter(|n| {
        let (u, v) = (n % camera.width as usize, n / camera.width as usize);
        let ray = eye * camera.ray(u as f64, v as f64).unwrap();
        let (depth, mask) = by_brute_force(scene, &origin, &ray).unwrap_or_default();
        mask != frame.mask[*n] || (depth - f64::from(frame.depth_m[*n])).abs() > 1e-4
    });
    wrong.count()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]
    #[test]
    fn every_pixel_sees_what_its_ray_meets_first(
        boxes in prop::collection::vec(
            (prop::array::uniform3(-2.0..2.0), prop::array::uniform3(-3.0..3.0), 0.05..1.5_f32),
            1..12,
        ),
        eye in prop::array::uniform3(-2.0..2.0_f64),
        lens: bool,
    ) {
        let mut scene = Scene::new(Lighting::default());
        scene.add(&square(10.0), &at(0.0, 0.0, -2.0), 0);
        for (n, (place, turn, size)) in boxes.into_iter().enumerate() {
            let pose = Isometry3::new(place.into(), turn.into());
            scene.add(&cuboid([size, size * 0.7, size * 0.4]), &pose, n as u16 + 1);
        }
        let camera = small(if lens { LENS } else { [0.0; 5] });
        let camera = Camera { width: 24, height: 18, ..camera };
        let eye = looking(eye, [0.01, 0.02, 0.03]);
        let frame = scene.render(&camera, &eye);
        // A ray that meets an edge to within rounding may go either way.
        let wrong = differences(&scene, &camera, &eye, &frame);
        prop_assert!(wrong <= usize::from(lens), "{wrong} pixels");
    }
}
