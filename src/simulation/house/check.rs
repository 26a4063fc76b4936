//! Whether a house is possible.

use super::HouseError;
use super::build::Complaints;
use super::space::{Misfit, Space, TOUCH_M, around, surface_in_world};
use super::{House, Thing};

/// What hangs may be this far from its wall or the ceiling, metres.
const HANGS_M: f64 = 0.03;
/// What stands may be this far above or below what it stands on, metres.
const STANDS_M: f64 = 0.005;

/// Complains of things that float, lie beside what they stand on, or reach into walls or others.
pub fn check(house: &House, wrong: &mut Complaints) {
    let space = Space::new(house);
    for (n, thing) in house.things.iter().enumerate() {
        let held = match thing.support {
            Some(below) => stands(thing, &house.things[below]),
            None => stands_or_hangs(house, &space, thing),
        };
        let path = format!("objects[{n}]");
        if let Err(problem) = held {
            let problem = format!("{:?} {problem}", thing.name);
            wrong.push(HouseError::new(format!("{path}.position"), problem));
        }
        if let Err(Misfit::Occupied { other, by_m }) = space.collision_of(n) {
            if let Some(problem) = collision(house, n, other, by_m) {
                wrong.push(HouseError::new(format!("{path}.position"), problem));
            }
        }
    }
}

/// What to say of a collision; nothing if the other thing says it.
fn collision(house: &House, n: usize, other: Option<usize>, by_m: f64) -> Option<String> {
    let name = &house.things[n].name;
    match other {
        None => Some(format!("{name:?} reaches {by_m:.2} m into a wall: move it away from there")),
        Some(other) if other > n => None,
        Some(other) => {
            let second = &house.things[other].name;
            Some(format!(
                "{name:?} reaches {by_m:.2} m into {second:?} (objects[{other}]): move one of them"
            ))
        }
    }
}

fn stands(thing: &Thing, below: &Thing) -> Result<(), String> {
    let bottom = around(&thing.pose, thing.size).z[0];
    let mut problem = format!("cannot stand on {:?}: it has no level surface", below.name);
    let mut nearest = f64::INFINITY;
    for surface in below.surfaces.iter().map(|surface| surface_in_world(below, surface)) {
        let gap = bottom - surface.z;
        let held = surface.holds(&thing.pose, thing.size);
        if gap.abs() <= STANDS_M && held.is_ok() {
            return Ok(());
        }
        if gap.abs() < nearest {
            nearest = gap.abs();
            problem = match held {
                _ if gap.abs() > STANDS_M => format!(
                    "is {gap:.2} m above the {} of {:?}: leave out the third coordinate",
                    surface.name, below.name
                ),
                Err(why) => {
                    format!("does not fit on the {} of {:?}: {why}", surface.name, below.name)
                }
                Ok(()) => problem,
            };
        }
    }
    Err(problem)
}

fn stands_or_hangs(house: &House, space: &Space, thing: &Thing) -> Result<(), String> {
    let block = around(&thing.pose, thing.size);
    let [bottom, top] = block.z;
    if bottom.abs() <= STANDS_M {
        return Ok(());
    }
    if bottom < 0.0 {
        return Err(format!(
            "reaches {:.2} m into the floor: leave out the third coordinate",
            -bottom
        ));
    }
    if top > house.wall_height_m + TOUCH_M {
        let problem = format!("reaches {:.2} m into the ceiling", top - house.wall_height_m);
        return Err(problem);
    }
    let hangs =
        house.wall_height_m - top < HANGS_M || space.to_wall(&thing.pose, thing.size) < HANGS_M;
    if hangs {
        return Ok(());
    }
    Err(format!(
        "floats {bottom:.2} m above the floor: name its support, leave out the third coordinate, \
         or hang it on a wall"
    ))
}
