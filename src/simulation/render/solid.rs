//! [`Solid`]: a mesh made ready for rays and shading, once for all that look like it.

use std::sync::Arc;

use parry3d::bounding_volume::Aabb;
use parry3d::math::Vector;
use parry3d::shape::TriMesh;

use super::tone::linear;
use super::vector::{V3, add, cross, dot, sub, unit};
use crate::simulation::mesh::{Material, Mesh, Texture};

/// Cosine of the angle between two faces up to which their common edge is rounded: 40°.
const CREASE_COSINE: f32 = 0.766;

/// A mesh with what rays and shading need of it, in its own frame, metres.
pub(super) struct Solid {
    pub mesh: Arc<Mesh>,
    pub rays: Option<TriMesh>,
    /// For each triangle its normal, unit length.
    pub normals: Vec<V3>,
    /// For each triangle the normals at its corners, where the surface is curved.
    pub corners: Vec<Option<[V3; 3]>>,
    /// Materials with their colours in linear light.
    pub materials: Vec<Material>,
    /// Lowest and highest coordinates.
    pub bounds: [V3; 2],
}

impl Solid {
    pub fn new(mesh: Arc<Mesh>) -> Self {
        let normals: Vec<V3> =
            mesh.triangles.iter().map(|corners| normal(&mesh, corners)).collect();
        let corners = corner_normals(&mesh, &normals);
        let materials = mesh.materials.iter().map(in_linear_light).collect();
        let vertices: Vec<Vector> = mesh.vertices.iter().map(|at| Vector::from(*at)).collect();
        let rays = TriMesh::new(vertices, mesh.triangles.clone()).ok();
        let bounds = bounds(&mesh.vertices);
        Self { mesh, rays, normals, corners, materials, bounds }
    }

    /// The corners of its box.
    pub fn box_corners(&self) -> [V3; 8] {
        let pick = |n: usize, axis: usize| self.bounds[n >> axis & 1][axis];
        [0, 1, 2, 3, 4, 5, 6, 7].map(|n| [pick(n, 0), pick(n, 1), pick(n, 2)])
    }
}

/// The box around some points, with a little room for what rounding does to it.
pub(super) fn box_around(points: &[V3]) -> Aabb {
    let [min, max] = bounds(points);
    let room = Vector::splat(1.0e-4);
    Aabb::new(Vector::from(min) - room, Vector::from(max) + room)
}

fn bounds(points: &[V3]) -> [V3; 2] {
    let Some(first) = points.first() else { return [[0.0; 3]; 2] };
    let [mut min, mut max] = [*first; 2];
    for point in points {
        for axis in 0..3 {
            min[axis] = min[axis].min(point[axis]);
            max[axis] = max[axis].max(point[axis]);
        }
    }
    [min, max]
}

fn normal(mesh: &Mesh, corners: &[u32; 3]) -> V3 {
    let [a, b, c] = corners.map(|corner| mesh.vertices[corner as usize]);
    unit(cross(sub(b, a), sub(c, a)))
}

fn in_linear_light(material: &Material) -> Material {
    let texture = match material.texture {
        Texture::Stripes { axis, period_m, second } => {
            Texture::Stripes { axis, period_m, second: linear(second) }
        }
        Texture::Checker { side_m, second } => Texture::Checker { side_m, second: linear(second) },
        other @ (Texture::Plain | Texture::Grain { .. }) => other,
    };
    Material { colour: linear(material.colour), texture }
}

/// The mean normals of the faces that meet at each corner, those across a crease left out.
fn corner_normals(mesh: &Mesh, normals: &[V3]) -> Vec<Option<[V3; 3]>> {
    let meeting = Meeting::of(mesh);
    let corner = |own: V3, vertex: u32| {
        let near = meeting.at(vertex).filter(|face| dot(normals[*face], own) > CREASE_COSINE);
        unit(near.fold([0.0; 3], |sum, face| add(sum, normals[face])))
    };
    let faces = mesh.triangles.iter().zip(normals);
    let rounded = faces.map(|(vertices, own)| {
        let corners = vertices.map(|vertex| corner(*own, vertex));
        corners.iter().any(|it| dot(*it, *own) < 0.999_9).then_some(corners)
    });
    rounded.collect()
}

/// Which faces meet at which place, whether or not they share vertices there.
struct Meeting {
    /// For each vertex the number of its place.
    place_of: Vec<u32>,
    /// (place, face), in order.
    faces: Vec<(u32, u32)>,
}

impl Meeting {
    fn of(mesh: &Mesh) -> Self {
        let key = |vertex: u32| mesh.vertices[vertex as usize].map(|part| (part + 0.0).to_bits());
        let mut by_place: Vec<u32> = (0..mesh.vertices.len() as u32).collect();
        by_place.sort_by_key(|vertex| key(*vertex));
        let mut place_of = vec![0; mesh.vertices.len()];
        for pair in by_place.windows(2) {
            let step = u32::from(key(pair[0]) != key(pair[1]));
            place_of[pair[1] as usize] = place_of[pair[0] as usize] + step;
        }
        let faces = mesh.triangles.iter().enumerate().flat_map(|(face, vertices)| {
            vertices.map(|vertex| (place_of[vertex as usize], face as u32))
        });
        let mut faces: Vec<(u32, u32)> = faces.collect();
        faces.sort_unstable();
        Self { place_of, faces }
    }

    fn at(&self, vertex: u32) -> impl Iterator<Item = usize> {
        let place = self.place_of[vertex as usize];
        let first = self.faces.partition_point(|(at, _)| *at < place);
        let here = self.faces[first..].iter().take_while(move |(at, _)| *at == place);
        here.map(|(_, face)| *face as usize)
    }
}
