//! Meshes of the user's own: [`read`].

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use super::Surface;
use crate::geometry::Size;
use crate::simulation::mesh::{Material, Mesh, Texture};

/// Most triangles of a mesh.
const TRIANGLES_MAX: usize = 500_000;
/// Largest file that is read, bytes.
const BYTES_MAX: u64 = 100_000_000;
/// How things without a material look.
const PLAIN: [f32; 3] = [0.7, 0.7, 0.7];

/// Why an OBJ file was refused.
#[derive(Debug, thiserror::Error)]
pub enum ObjError {
    /// It is not there, or not readable.
    #[error("{file}: {error}")]
    Io {
        /// The file.
        file: String,
        /// Why.
        error: std::io::Error,
    },
    /// It is no OBJ file.
    #[error("{file}: not a Wavefront OBJ file: {error}")]
    Format {
        /// The file.
        file: String,
        /// Why.
        error: tobj::LoadError,
    },
    /// There is nothing in it, or too much, or it is flat.
    #[error("{file}: {problem}")]
    Content {
        /// The file.
        file: String,
        /// What is wrong.
        problem: String,
    },
}

/// Reads an OBJ file (y up, as most programs write them) and scales
/// it to fill a box; its materials' `Kd` colours are taken from the MTL file if there is one. Its
/// top is its only surface.
pub fn read(file: &Path, size: Size) -> Result<(Mesh, Vec<Surface>), ObjError> {
    let name = file.display().to_string();
    let content = |problem: String| ObjError::Content { file: name.clone(), problem };
    let io = |error| ObjError::Io { file: name.clone(), error };
    let opened = File::open(file).map_err(io)?;
    let bytes = opened.metadata().map_err(io)?.len();
    if bytes > BYTES_MAX {
        return Err(content(format!("{bytes} bytes are too many: at most {BYTES_MAX}")));
    }
    let folder = file.parent().unwrap_or(Path::new("")).to_path_buf();
    let options = tobj::LoadOptions {
        triangulate: true,
        ignore_points: true,
        ignore_lines: true,
        ..Default::default()
    };
    let loaded = tobj::load_obj_buf(&mut BufReader::new(opened), &options, |mtl| {
        tobj::load_mtl(folder.join(mtl))
    });
    let (models, materials) =
        loaded.map_err(|error| ObjError::Format { file: name.clone(), error })?;
    // A material file that is missing or broken costs the colours, not the shape.
    let mesh = gather(&models, &materials.unwrap_or_default());
    if mesh.triangles.is_empty() {
        return Err(content("there is no triangle in it".to_owned()));
    }
    if mesh.triangles.len() > TRIANGLES_MAX {
        let count = mesh.triangles.len();
        return Err(content(format!("{count} triangles are too many: at most {TRIANGLES_MAX}")));
    }
    fitted(mesh, size).map_err(content)
}

fn gather(models: &[tobj::Model], materials: &[tobj::Material]) -> Mesh {
    let colour = |material: &tobj::Material| material.diffuse.unwrap_or(PLAIN);
    let look = |colour: [f32; 3]| Material {
        colour: colour.map(|c| c.clamp(0.0, 1.0)),
        texture: Texture::Plain,
    };
    let mut mesh = Mesh {
        materials: std::iter::once(PLAIN).chain(materials.iter().map(colour)).map(look).collect(),
        ..Mesh::default()
    };
    for model in models.iter().map(|model| &model.mesh) {
        let first = mesh.vertices.len() as u32;
        let known = model.material_id.filter(|id| *id < materials.len());
        let material = known.map_or(0, |id| id as u16 + 1);
        // y up, z towards us, to z up, y away from us.
        mesh.vertices.extend(model.positions.chunks_exact(3).map(|v| [v[0], -v[2], v[1]]));
        for corners in model.indices.chunks_exact(3) {
            mesh.triangles.push([corners[0], corners[1], corners[2]].map(|n| n + first));
            mesh.material_of.push(material);
        }
    }
    mesh
}

fn fitted(mut mesh: Mesh, size: Size) -> Result<(Mesh, Vec<Surface>), String> {
    if mesh.vertices.iter().flatten().any(|c| !c.is_finite()) {
        return Err("a coordinate is not a number".to_owned());
    }
    let low: [f32; 3] =
        std::array::from_fn(|k| mesh.vertices.iter().map(|v| v[k]).fold(f32::INFINITY, f32::min));
    let high: [f32; 3] = std::array::from_fn(|k| {
        mesh.vertices.iter().map(|v| v[k]).fold(f32::NEG_INFINITY, f32::max)
    });
    if (0..3).any(|k| !(high[k] > low[k])) {
        return Err("it is flat: it cannot be scaled to fill a box".to_owned());
    }
    let half = size.metres().map(|side| side / 2.0);
    for vertex in &mut mesh.vertices {
        *vertex = std::array::from_fn(|k| {
            let share = f64::from(vertex[k] - low[k]) / f64::from(high[k] - low[k]);
            ((2.0 * share - 1.0) * half[k]) as f32
        });
    }
    let inner = [half[0] * 0.9, half[1] * 0.9];
    let top = Surface {
        name: "top".to_owned(),
        min: inner.map(|h| -h),
        max: inner,
        z: half[2],
        clearance_m: None,
    };
    Ok((mesh, vec![top]))
}
