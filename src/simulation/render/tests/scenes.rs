//! Masks, moving and hiding, threads.

use nalgebra::{Isometry3, Point2, Point3, Vector3};

use super::shapes::{at, ball, cuboid, looking, square};
use crate::geometry::Camera;
use crate::simulation::render::{Frame, InstanceId, Lamp, Lighting, Scene};

fn camera() -> Camera {
    Camera::with_fov(64, 48, 1.2)
}

fn lit() -> Lighting {
    let lamp = Lamp {
        position: [0.5, 0.5, 2.4],
        radius_m: 0.2,
        colour: [1.0, 0.95, 0.85],
        strength: 3.0,
        room: Vec::new(),
    };
    Lighting { lamps: vec![lamp], ..Lighting::default() }
}

/// A floor, a box (1) and a ball (2) before it.
fn scene() -> (Scene, [InstanceId; 2]) {
    let mut scene = Scene::new(lit());
    scene.add(&square(20.0), &at(0.0, 0.0, 0.0), 0);
    let turned = Isometry3::new(Vector3::new(1.0, 0.3, 0.25), Vector3::new(0.0, 0.0, 0.5));
    let a = scene.add(&cuboid([0.5, 0.5, 0.5]), &turned, 1);
    let b = scene.add(&ball(0.2, 12), &at(0.3, -0.3, 0.2), 2);
    (scene, [a, b])
}

fn eye() -> Isometry3<f64> {
    looking([-1.5, 0.0, 1.0], [1.0, 0.0, 0.2])
}

fn pixels(frame: &Frame, mask: u16) -> usize {
    frame.mask.iter().filter(|it| **it == mask).count()
}

#[test]
fn a_mask_fills_the_projected_box_of_a_box() {
    let (scene, [cuboid, _]) = scene();
    let frame = scene.render(&camera(), &eye());
    let camera_from_box = eye().inverse() * scene.pose(cuboid);
    let inside = |u: f64, v: f64| {
        // In the convex hull of the corners: to one side of no line through two of them.
        let corners = (0..8).map(|n| [0, 1, 2].map(|axis| 0.5 * f64::from(n >> axis & 1) - 0.25));
        let corners: Vec<Point2<f64>> = corners
            .map(|corner| camera().project(&(camera_from_box * Point3::from(corner))).unwrap())
            .collect();
        let pixel = Point2::new(u, v);
        let side = |a: &Point2<f64>, b: &Point2<f64>, c: &Point2<f64>| (b - a).perp(&(c - a));
        !corners.iter().any(|a| {
            corners.iter().any(|b| {
                a != b && corners.iter().all(|c| side(a, b, c) >= -1e-9) && side(a, b, &pixel) < 0.0
            })
        })
    };
    let (mut both, mut either) = (0, 0);
    for (n, mask) in frame.mask.iter().enumerate() {
        let projected = inside((n % 64) as f64, (n / 64) as f64);
        // The ball stands before a part of it.
        both += u32::from(projected && *mask == 1);
        either += u32::from((projected && *mask != 2) || *mask == 1);
    }
    assert!(both > 100 && both == either, "{both} of {either}");
}

#[test]
fn what_is_hidden_is_not_seen_and_comes_back() {
    let (mut scene, [cuboid, ball]) = scene();
    let before = scene.render(&camera(), &eye());
    assert!(pixels(&before, 1) > 50 && pixels(&before, 2) > 50);
    scene.show(ball, false);
    scene.show(ball, false);
    let without = scene.render(&camera(), &eye());
    assert_eq!(pixels(&without, 2), 0);
    assert!(pixels(&without, 1) >= pixels(&before, 1));
    scene.place(ball, &at(0.5, 0.0, 0.5));
    scene.place(ball, &at(0.3, -0.3, 0.2));
    scene.show(ball, true);
    scene.place(cuboid, &scene.pose(cuboid).clone());
    assert_eq!(scene.render(&camera(), &eye()), before);
}

#[test]
fn what_moves_is_seen_where_it_went() {
    let (mut scene, [_, ball]) = scene();
    scene.place(ball, &at(-0.5, 0.0, 0.7));
    let frame = scene.render(&camera(), &eye());
    let middle = eye().inverse() * Point3::new(-0.5, 0.0, 0.7);
    let pixel = camera().project(&middle).unwrap();
    let n = pixel.y.round() as usize * 64 + pixel.x.round() as usize;
    assert_eq!(frame.mask[n], 2);
    assert!((f64::from(frame.depth_m[n]) - (middle.z - 0.2)).abs() < 0.01);
}

#[test]
fn rays_meet_what_pixels_see() {
    let (scene, _) = scene();
    let (camera, eye) = (camera(), eye());
    let frame = scene.render(&camera, &eye);
    let origin = Point3::from(eye.translation.vector);
    let differ = (0..frame.mask.len()).filter(|n| {
        let ray = eye * camera.ray((n % 64) as f64, (n / 64) as f64).unwrap();
        let hit = scene.cast_ray(&origin, &ray, 100.0);
        let (mask, depth) = hit.map_or((0, 0.0), |hit| (hit.mask, hit.distance));
        mask != frame.mask[*n] || (depth - f64::from(frame.depth_m[*n])).abs() > 1e-3
    });
    assert!(differ.count() <= 2);
}

#[test]
fn the_number_of_threads_changes_no_byte() {
    let (scene, _) = scene();
    let lens = Camera { distortion: [0.1, 0.0, 0.0, 0.0, 0.0], ..camera() };
    for camera in [camera(), lens] {
        let with = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| scene.render(&camera, &eye()))
        };
        assert_eq!(with(1), with(2));
        assert_eq!(with(1), with(5));
    }
}

#[test]
fn a_thing_darkens_the_floor_beneath_it() {
    let (mut scene, [cuboid, _]) = scene();
    scene.place(cuboid, &at(0.3, -0.3, 0.6));
    let down = looking([0.3, -0.3, 3.0], [0.3, -0.3, 0.0]);
    let shaded = scene.render(&camera(), &down);
    scene.show(cuboid, false);
    let free = scene.render(&camera(), &down);
    let floor = |n: &usize| shaded.mask[*n] == 0 && free.mask[*n] == 0;
    let floor: Vec<usize> = (0..free.mask.len()).filter(floor).collect();
    assert!(floor.iter().all(|n| shaded.colour[*n][1] <= free.colour[*n][1] + 4));
    let darker = floor.iter().filter(|n| shaded.colour[**n][0] + 10 < free.colour[**n][0]);
    assert!(darker.count() > 10);
}

#[test]
fn an_empty_scene_shows_its_background() {
    let frame = Scene::new(Lighting::default()).render(&camera(), &eye());
    assert!(frame.depth_m.iter().all(|depth| *depth == 0.0));
    assert!(frame.colour.iter().all(|colour| *colour == frame.colour[0]));
}
