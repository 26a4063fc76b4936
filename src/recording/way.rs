//! The way of a frame over the floor, from `/tf`.

use std::ops::ControlFlow;

use super::events::{Walk, WalkError};
use super::open::Recording;
use crate::event::{Event, SensorMessage};
use crate::wire::ros2::{TF_MESSAGE, decode_tf};

/// Points closer than this to the one before are left out, metres.
const STEP_M: f64 = 0.03;

impl Recording {
    /// Where `frame` was, by the transforms that events `first` to `last` give of it in its parent
    /// frame: (x, y) in metres, one after the other. Empty if the recording does not tell. What
    /// cannot be read is left out.
    pub fn way_of(&self, frame: &str, first: u64, last: u64) -> Result<Vec<[f64; 2]>, WalkError> {
        let mut way: Vec<[f64; 2]> = Vec::new();
        self.visit_events(Walk::Events, (first, last), &mut |logged| {
            if let Event::Sensor(message) = &logged.event {
                way.extend(places(message, frame).filter(|at| is_new(&way, *at)).last());
            }
            ControlFlow::Continue(())
        })?;
        Ok(way)
    }
}

fn places<'m>(message: &'m SensorMessage, frame: &'m str) -> impl Iterator<Item = [f64; 2]> + 'm {
    let is_tf = *message.schema_name == *TF_MESSAGE.name;
    let transforms = if is_tf { decode_tf(&message.data).unwrap_or_default() } else { Vec::new() };
    transforms
        .into_iter()
        .filter(move |transform| transform.child_frame_id == frame)
        .map(|transform| [transform.translation[0], transform.translation[1]])
        .filter(|at| at.iter().all(|value| value.is_finite()))
}

fn is_new(way: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    way.last().is_none_or(|last| libm::hypot(x - last[0], y - last[1]) >= STEP_M)
}
