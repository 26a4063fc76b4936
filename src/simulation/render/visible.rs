//! What each pixel sees first: [`Visible`].

use nalgebra::Isometry3;
use rayon::prelude::*;

use super::raster;
use super::scene::Scene;
use super::vector::{Motion, V3, add, cross, dot, scale, sub, unit};
use crate::geometry::Camera;
use crate::simulation::mesh::Material;

/// A triangle at a depth; none if the instance is `NOTHING`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Visible {
    pub instance: u32,
    pub triangle: u32,
    pub depth_m: f32,
}

pub(super) const NOTHING: Visible = Visible { instance: u32::MAX, triangle: 0, depth_m: 0.0 };

impl Visible {
    pub fn is_something(&self) -> bool {
        self.instance != u32::MAX
    }
}

/// A camera in its place, and the ray of each of its pixels.
pub(super) struct View {
    width: usize,
    focal: [f32; 2],
    centre: [f32; 2],
    /// Rays of the pixels, (x, y) at z = 1, where there is distortion; NaN where there are none.
    rays: Vec<[f32; 2]>,
    world_from_camera: Motion,
    pub eye: V3,
}

impl View {
    pub fn new(camera: &Camera, world_from_camera: &Isometry3<f64>) -> Self {
        Self {
            width: camera.width as usize,
            focal: camera.focal.map(|it| it as f32),
            centre: camera.centre.map(|it| it as f32),
            rays: if camera.is_ideal() { Vec::new() } else { distorted_rays(camera) },
            world_from_camera: Motion::of(world_from_camera),
            eye: world_from_camera.translation.vector.map(|it| it as f32).into(),
        }
    }

    /// Direction of a pixel's ray in the world, at depth 1.
    fn ray(&self, column: usize, row: usize) -> V3 {
        let [x, y] = match self.rays.get(row * self.width + column) {
            Some(ray) => *ray,
            None => [
                (column as f32 - self.centre[0]) / self.focal[0],
                (row as f32 - self.centre[1]) / self.focal[1],
            ],
        };
        self.world_from_camera.direction([x, y, 1.0])
    }

    /// Metres across that a pixel covers at a depth of one metre.
    pub fn footprint(&self) -> f32 {
        1.0 / self.focal[0]
    }
}

fn distorted_rays(camera: &Camera) -> Vec<[f32; 2]> {
    let rays = (0..camera.height).into_par_iter().flat_map_iter(|row| {
        (0..camera.width).map(move |column| {
            let ray = camera.ray(f64::from(column), f64::from(row));
            ray.map_or([f32::NAN; 2], |ray| [ray.x as f32, ray.y as f32])
        })
    });
    rays.collect()
}

/// What each pixel sees, row by row.
pub(super) fn look(
    scene: &Scene,
    camera: &Camera,
    world_from_camera: &Isometry3<f64>,
    view: &View,
) -> Vec<Visible> {
    let mut visible = vec![NOTHING; camera.width as usize * camera.height as usize];
    if camera.is_ideal() {
        raster::rasterise(scene, camera, &world_from_camera.inverse(), &mut visible);
    } else {
        cast_all(scene, view, &mut visible);
    }
    visible
}

/// One ray a pixel.
fn cast_all(scene: &Scene, view: &View, visible: &mut [Visible]) {
    visible.par_chunks_mut(view.width).enumerate().for_each(|(row, visible)| {
        for (column, visible) in visible.iter_mut().enumerate() {
            let ray = view.ray(column, row);
            if ray[0].is_nan() {
                continue;
            }
            if let Some(hit) = scene.nearest(view.eye, ray, f32::MAX) {
                let (instance, triangle) = (hit.instance, hit.triangle);
                *visible = Visible { instance, triangle, depth_m: hit.distance };
            }
        }
    });
}

/// A point of a surface that is seen.
pub(super) struct Point<'s> {
    /// World frame.
    pub at: V3,
    /// The same in the frame of the thing.
    pub in_thing: V3,
    /// Of the triangle, towards the eye, world frame.
    pub flat: V3,
    /// Of the surface the triangle stands for, world frame.
    pub normal: V3,
    /// Of the triangle, frame of the thing.
    pub normal_in_thing: V3,
    pub material: &'s Material,
}

impl View {
    /// The point seen at a pixel.
    pub fn point<'s>(
        &self,
        scene: &'s Scene,
        column: usize,
        row: usize,
        visible: &Visible,
    ) -> Point<'s> {
        let instance = &scene.instances[visible.instance as usize];
        let solid = scene.solid(instance);
        let triangle = visible.triangle as usize;
        let ray = self.ray(column, row);
        let at = add(self.eye, scale(ray, visible.depth_m));
        let in_thing = instance.motion.point_back(at);
        let normal_in_thing = solid.normals[triangle];
        let flat = instance.motion.direction(normal_in_thing);
        let back = if dot(flat, ray) > 0.0 { -1.0 } else { 1.0 };
        let normal = match &solid.corners[triangle] {
            None => flat,
            Some(corners) => {
                let vertices = solid.mesh.triangles[triangle];
                let vertices = vertices.map(|vertex| solid.mesh.vertices[vertex as usize]);
                instance.motion.direction(rounded(&vertices, corners, in_thing))
            }
        };
        let material = &solid.materials[usize::from(solid.mesh.material_of[triangle])];
        let (flat, normal) = (scale(flat, back), scale(normal, back));
        Point { at, in_thing, flat, normal, normal_in_thing, material }
    }
}

/// The normal between those at the corners, by areas.
fn rounded(vertices: &[V3; 3], normals: &[V3; 3], at: V3) -> V3 {
    let [a, b, c] = *vertices;
    let whole = cross(sub(b, a), sub(c, a));
    let share = |from: V3, to: V3| dot(cross(sub(to, from), sub(at, from)), whole);
    let [na, nb, nc] = *normals;
    unit(add(add(scale(na, share(b, c)), scale(nb, share(c, a))), scale(nc, share(a, b))))
}
