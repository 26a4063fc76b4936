//! Meshes whose pictures are known.

use std::sync::Arc;

use nalgebra::{Isometry3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};

use crate::simulation::mesh::{Material, Mesh, Texture};

pub fn mesh(vertices: Vec<[f32; 3]>, triangles: Vec<[u32; 3]>) -> Arc<Mesh> {
    let material_of = vec![0; triangles.len()];
    let materials = vec![Material { colour: [0.8, 0.3, 0.2], texture: Texture::Plain }];
    Arc::new(Mesh { vertices, triangles, material_of, materials })
}

/// A level square about the origin, facing up.
pub fn square(side: f32) -> Arc<Mesh> {
    let half = side / 2.0;
    let vertices = [[-half, -half], [half, -half], [half, half], [-half, half]];
    mesh(vertices.map(|[x, y]| [x, y, 0.0]).to_vec(), vec![[0, 1, 2], [0, 2, 3]])
}

/// A box about the origin.
pub fn cuboid(size: [f32; 3]) -> Arc<Mesh> {
    let corner = |n: usize| [0, 1, 2].map(|axis| size[axis] * ((n >> axis & 1) as f32 - 0.5));
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = faces.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    mesh((0..8).map(corner).collect(), triangles.collect())
}

/// A ball about the origin, of squares halved into triangles.
pub fn ball(radius: f32, steps: u32) -> Arc<Mesh> {
    let mut vertices = Vec::new();
    for n in 0..=steps {
        for m in 0..=2 * steps {
            let (up, round) = (
                std::f64::consts::PI * f64::from(n) / f64::from(steps),
                std::f64::consts::PI * f64::from(m) / f64::from(steps),
            );
            let at =
                [libm::sin(up) * libm::cos(round), libm::sin(up) * libm::sin(round), libm::cos(up)];
            vertices.push(at.map(|it| it as f32 * radius));
        }
    }
    let row = 2 * steps + 1;
    let corners = (0..steps).flat_map(|n| (0..2 * steps).map(move |m| n * row + m));
    let triangles = corners.flat_map(|a| [[a, a + row, a + row + 1], [a, a + row + 1, a + 1]]);
    mesh(vertices, triangles.collect())
}

/// `world_from_camera` of an optical frame at `eye` that looks at `target`, upright.
pub fn looking(eye: [f64; 3], target: [f64; 3]) -> Isometry3<f64> {
    let forward = (Point3::from(target) - Point3::from(eye)).normalize();
    let right = forward.cross(&Vector3::z()).try_normalize(1e-9).unwrap_or(Vector3::x());
    let down = forward.cross(&right);
    let rotation = Rotation3::from_basis_unchecked(&[right, down, forward]);
    let rotation = UnitQuaternion::from_rotation_matrix(&rotation);
    Isometry3::from_parts(Translation3::from(eye), rotation)
}

pub fn at(x: f64, y: f64, z: f64) -> Isometry3<f64> {
    Isometry3::translation(x, y, z)
}
