//! [`Scene`]: meshes in their places, which rays can meet.

use std::sync::Arc;

use nalgebra::{Isometry3, Point3, Vector3};
use parry3d::math::Vector;
use parry3d::partitioning::Bvh;
use parry3d::query::{Ray, RayCast};
use parry3d::shape::CompositeShapeRef;

use super::light::Lighting;
use super::solid::{Solid, box_around};
use super::vector::{Motion, V3};
use crate::simulation::mesh::Mesh;

/// A mesh in a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct InstanceId(pub(super) u32);

/// Meshes in their places, and the light on them. World frame, metres.
///
/// Meshes can be moved, hidden and shown between pictures at the cost of one step in a tree.
#[derive(Clone)]
pub struct Scene {
    /// The light.
    pub lighting: Lighting,
    pub(super) solids: Vec<Arc<Solid>>,
    pub(super) instances: Vec<Instance>,
    tree: Bvh,
}

#[derive(Clone)]
pub(super) struct Instance {
    pub solid: u32,
    pub world_from_mesh: Isometry3<f64>,
    /// The same, rounded.
    pub motion: Motion,
    pub mask: u16,
    pub shown: bool,
}

/// What a ray meets first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayHit {
    /// How far, in lengths of the direction that was given.
    pub distance: f64,
    /// What.
    pub instance: InstanceId,
    /// Its number in masks.
    pub mask: u16,
    /// Which of its triangles.
    pub triangle: u32,
}

impl Scene {
    /// An empty scene.
    pub fn new(lighting: Lighting) -> Self {
        Self { lighting, solids: Vec::new(), instances: Vec::new(), tree: Bvh::new() }
    }

    /// Adds a mesh. Equal meshes (by pointer) share what is computed from them. `mask` is its
    /// number in masks: 0 for what belongs to the building.
    ///
    /// # Panics
    /// If a triangle of the mesh names a vertex or a material that is not there.
    pub fn add(
        &mut self,
        mesh: &Arc<Mesh>,
        world_from_mesh: &Isometry3<f64>,
        mask: u16,
    ) -> InstanceId {
        let known = self.solids.iter().position(|solid| Arc::ptr_eq(&solid.mesh, mesh));
        let solid = known.unwrap_or_else(|| {
            self.solids.push(Arc::new(Solid::new(mesh.clone())));
            self.solids.len() - 1
        });
        let id = InstanceId(self.instances.len() as u32);
        let (world_from_mesh, motion) = (*world_from_mesh, Motion::of(world_from_mesh));
        let instance = Instance { solid: solid as u32, world_from_mesh, motion, mask, shown: true };
        self.instances.push(instance);
        self.enter(id);
        id
    }

    /// Puts a mesh somewhere else, as for what is in a gripper.
    pub fn place(&mut self, id: InstanceId, world_from_mesh: &Isometry3<f64>) {
        let instance = &mut self.instances[id.0 as usize];
        instance.world_from_mesh = *world_from_mesh;
        instance.motion = Motion::of(world_from_mesh);
        if instance.shown {
            self.tree.remove(id.0);
            self.enter(id);
        }
    }

    /// Takes a mesh out of sight, or brings it back.
    pub fn show(&mut self, id: InstanceId, shown: bool) {
        let instance = &mut self.instances[id.0 as usize];
        match (std::mem::replace(&mut instance.shown, shown), shown) {
            (true, false) => self.tree.remove(id.0),
            (false, true) => self.enter(id),
            _ => {}
        }
    }

    /// Where a mesh is: `world_from_mesh`.
    pub fn pose(&self, id: InstanceId) -> &Isometry3<f64> {
        &self.instances[id.0 as usize].world_from_mesh
    }

    /// Number of triangles in sight.
    pub fn triangles(&self) -> usize {
        let shown = self.instances.iter().filter(|it| it.shown);
        shown.map(|it| self.solid(it).normals.len()).sum()
    }

    /// What the ray from `origin` along `direction` meets first, from either side of a triangle,
    /// up to `max` lengths of `direction`. To within float precision (about a micrometre).
    pub fn cast_ray(
        &self,
        origin: &Point3<f64>,
        direction: &Vector3<f64>,
        max: f64,
    ) -> Option<RayHit> {
        let origin: V3 = origin.coords.map(|it| it as f32).into();
        let direction: V3 = direction.map(|it| it as f32).into();
        let nearest = self.nearest(origin, direction, max as f32)?;
        let instance = &self.instances[nearest.instance as usize];
        Some(RayHit {
            distance: nearest.distance.into(),
            instance: InstanceId(nearest.instance),
            mask: instance.mask,
            triangle: nearest.triangle,
        })
    }

    pub(super) fn nearest(&self, origin: V3, direction: V3, max: f32) -> Option<Nearest> {
        let (instance, _) = self.first(origin, direction, max)?;
        // The triangle is asked for only once, of the mesh that was met first.
        let met = &self.instances[instance as usize];
        let rays = self.solid(met).rays.as_ref()?;
        let (triangle, distance) =
            CompositeShapeRef(rays).cast_local_ray(&local(met, origin, direction), max, false)?;
        Some(Nearest { distance, instance, triangle })
    }

    /// How far away the first thing is, in lengths of `direction`, if within `max` of them.
    pub(super) fn distance(&self, origin: V3, direction: V3, max: f32) -> Option<f32> {
        self.first(origin, direction, max).map(|(_, distance)| distance)
    }

    fn first(&self, origin: V3, direction: V3, max: f32) -> Option<(u32, f32)> {
        let ray = Ray::new(origin.into(), direction.into());
        self.tree.cast_ray(&ray, max, |leaf, best| {
            let instance = &self.instances[leaf as usize];
            let rays = self.solid(instance).rays.as_ref()?;
            rays.cast_local_ray(&local(instance, origin, direction), best, false)
        })
    }

    pub(super) fn solid(&self, instance: &Instance) -> &Solid {
        &self.solids[instance.solid as usize]
    }

    fn enter(&mut self, id: InstanceId) {
        let instance = &self.instances[id.0 as usize];
        let solid = self.solid(instance);
        if solid.rays.is_some() {
            let corners = solid.box_corners().map(|corner| instance.motion.point(corner));
            self.tree.insert(box_around(&corners), id.0);
        }
    }
}

/// The nearest triangle on a ray.
pub(super) struct Nearest {
    pub distance: f32,
    pub instance: u32,
    pub triangle: u32,
}

fn local(instance: &Instance, origin: V3, direction: V3) -> Ray {
    let origin = instance.motion.point_back(origin);
    let direction = instance.motion.direction_back(direction);
    Ray::new(Vector::from(origin), Vector::from(direction))
}
