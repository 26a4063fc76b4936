//! Laws of the simulation, in a small house made for them.

mod motion;
mod places;
mod scenarios;

use std::sync::Arc;

use super::house::{Door, House, Room, Surface, Thing};
use super::mesh::{Material, Texture};
use crate::geometry::{Pose, Size};
use crate::graph::Label;

fn plain() -> Material {
    Material { colour: [0.8; 3], texture: Texture::Plain }
}

fn label(text: &str) -> Label {
    Label::new(text).unwrap()
}

fn room(name: &str, [x0, y0, x1, y1]: [f64; 4]) -> Room {
    let outline = vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
    Room { label: label(name), outline, floor: plain() }
}

fn thing(name: &str, room: usize, on: Option<usize>, at: [f64; 3], size: [f64; 3]) -> Thing {
    let [w, h, d] = size;
    let top = Surface {
        name: "top".to_owned(),
        min: [-w / 2.0, -h / 2.0],
        max: [w / 2.0, h / 2.0],
        z: d / 2.0,
        clearance_m: None,
    };
    Thing {
        name: name.to_owned(),
        label: label(name),
        pose: Pose::at(at).unwrap(),
        size: Size::new(w, h, d).unwrap(),
        mesh: Arc::new(super::shapes::shape(name, Size::new(w, h, d).unwrap())),
        movable: d < 0.3,
        decay_rate: if d < 0.3 { 1e-4 } else { 0.0 },
        room,
        support: on,
        surfaces: if d < 0.3 { Vec::new() } else { vec![top] },
    }
}

/// A kitchen and a bedroom with a door between them; a table with a mug, a bed with a book.
pub(super) fn small_house() -> Arc<House> {
    Arc::new(House {
        name: "small".to_owned(),
        wall_height_m: 2.5,
        wall_thickness_m: 0.1,
        wall: plain(),
        rooms: vec![room("kitchen", [0.0, 0.0, 4.0, 3.0]), room("bedroom", [4.0, 0.0, 8.0, 3.0])],
        doors: vec![Door { rooms: [0, 1], ends: [[4.0, 1.0], [4.0, 1.9]], height_m: 2.0 }],
        things: vec![
            thing("table", 0, None, [1.0, 2.2, 0.4], [1.2, 0.8, 0.8]),
            thing("bed", 1, None, [7.0, 1.5, 0.25], [1.6, 2.0, 0.5]),
            thing("mug", 0, Some(0), [1.2, 2.1, 0.85], [0.1, 0.08, 0.1]),
            thing("book", 1, Some(1), [6.8, 1.0, 0.52], [0.2, 0.15, 0.04]),
        ],
    })
}
