//! Things that come into a house later.

use std::sync::Arc;

use super::{Thing, decay_class};
use crate::geometry::{GeometryError, Pose, Size};
use crate::graph::Label;
use crate::simulation::shapes;

impl Thing {
    /// A thing of a class that people carry about, at the origin, in the first room; its size is
    /// the usual one (0.2 m for classes that nobody drew) unless it is given.
    pub fn of_class(
        name: String,
        label: Label,
        size_m: Option<[f64; 3]>,
    ) -> Result<Self, GeometryError> {
        let class = shapes::class_named(label.as_str());
        let [w, h, d] = size_m.or(class.map(|class| class.usual_m)).unwrap_or([0.2; 3]);
        let size = Size::new(w, h, d)?;
        let (mesh, surfaces) = shapes::drawn(label.as_str(), size);
        let decay =
            class.and_then(|class| decay_class(class.decay)).map_or(0.0, |it| it.decay_rate());
        // What somebody carries in can be carried out, whatever is usual for its class.
        let movable = decay_class("device").map_or(0.0, |it| it.decay_rate());
        Ok(Self {
            name,
            label,
            pose: Pose::IDENTITY,
            size,
            mesh: Arc::new(mesh),
            movable: true,
            decay_rate: if decay > 0.0 { decay } else { movable },
            room: 0,
            support: None,
            surfaces,
        })
    }
}
