//! Meshes of everyday things, drawn in code: [`shape`], [`surfaces`], [`classes`].
//!
//! A thing faces the −y of its frame: a sofa's back, a refrigerator's hinges and a painting's wall
//! are at +y. Every mesh fills its box exactly. Classes are named in plain words such as
//! "tv remote"; other common names for them are known too (see [`class_named`]).

mod bath;
mod decor;
mod devices;
mod food;
mod furniture;
mod kitchen;
mod names;
mod paint;
pub(super) mod polygon;
mod sketch;
mod tableware;
mod textiles;

use super::house::Surface;
use super::mesh::{Material, Mesh};
use crate::geometry::Size;
pub use names::class_named;
use sketch::Sketch;

/// A class of things that can be drawn.
#[derive(Clone, Copy, Debug)]
pub struct Class {
    /// Its name.
    pub name: &'static str,
    /// Usual width, depth (front to back) and height in metres.
    pub usual_m: [f64; 3],
    /// How soon such things are moved: a decay class of house files.
    pub decay: &'static str,
    draw: fn(&mut Sketch),
}

const fn class(
    name: &'static str,
    usual_m: [f64; 3],
    decay: &'static str,
    draw: fn(&mut Sketch),
) -> Class {
    Class { name, usual_m, decay, draw }
}

/// All classes that can be drawn.
pub fn classes() -> impl Iterator<Item = &'static Class> {
    [
        furniture::CLASSES,
        kitchen::CLASSES,
        bath::CLASSES,
        tableware::CLASSES,
        food::CLASSES,
        devices::CLASSES,
        textiles::CLASSES,
        decor::CLASSES,
    ]
    .into_iter()
    .flatten()
}

/// The mesh of a class, filling a box; a plain box for classes that nobody drew.
pub fn shape(class: &str, size: Size) -> Mesh {
    drawn(class, size).0
}

/// The same, its main colour (and texture) replaced.
pub fn shape_painted(class: &str, size: Size, paint: Material) -> Mesh {
    let mut mesh = shape(class, size);
    if let Some(main) = mesh.materials.first_mut() {
        *main = paint;
    }
    mesh
}

/// The upper faces of a class on which other things can be put, in the frame of the thing.
pub fn surfaces(class: &str, size: Size) -> Vec<Surface> {
    drawn(class, size).1
}

fn drawn(class: &str, size: Size) -> (Mesh, Vec<Surface>) {
    let size = size.metres();
    let Some(known) = class_named(class) else {
        let mut sketch = Sketch::new(size);
        plain_box(&mut sketch, class);
        return sketch.finish(size);
    };
    // Boards and legs have thicknesses of their own: what is far from the usual size is drawn
    // nearer to it, and stretched.
    let near = |k: usize| size[k].clamp(known.usual_m[k] * 0.6, known.usual_m[k] * 2.0);
    let mut sketch = Sketch::new(std::array::from_fn(near));
    (known.draw)(&mut sketch);
    sketch.finish(size)
}

/// A box whose colour depends on the class, so that unlike things look unlike.
fn plain_box(s: &mut Sketch, class: &str) {
    let seed = class
        .bytes()
        .fold(2_166_136_261_u32, |hash, byte| (hash ^ u32::from(byte)).wrapping_mul(16_777_619));
    let hex = 0x0060_6060 + (seed & 0x007f_7f7f);
    s.paint(paint::plain(hex));
    let max = s.size;
    s.block([0.0; 3], max);
    s.top("top", [0.0; 3], max, None);
}

#[cfg(test)]
mod tests;
