//! Things for a house from a graph.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::rooms::Storey;
use super::{WALL_M, is_structure};
use crate::geometry::{Pose, Size};
use crate::graph::{NodeId, Object, SceneGraph};
use crate::simulation::house::space::around;
use crate::simulation::house::{House, Thing};
use crate::simulation::shapes;

/// Largest part of its size that a thing may lose so that it fits its room.
const SHRINK: f64 = 0.5;

pub fn put(graph: &SceneGraph, storey: &Storey, house: &mut House, notes: &mut Vec<String>) {
    let mut numbers: BTreeMap<NodeId, usize> = BTreeMap::new();
    let (mut moved, mut shrunk, mut left_out) = (0, 0, Vec::new());
    for (id, object) in graph.objects().filter(|(_, object)| !is_structure(object)) {
        let Some(room) = storey.rooms.iter().position(|(room, _)| *room == object.room) else {
            left_out.push(format!("{} {id}", object.label));
            continue;
        };
        let Some(fitted) = fit(object, room, house, storey.floor_z) else {
            left_out.push(format!("{} {id}", object.label));
            continue;
        };
        moved += u32::from(fitted.moved);
        shrunk += u32::from(fitted.shrunk);
        numbers.insert(id, house.things.len());
        house.things.push(thing(id, object, room, &fitted, house));
    }
    for (id, n) in &numbers {
        let below = graph.object(*id).and_then(|object| object.support);
        house.things[*n].support = below.and_then(|below| numbers.get(&below).copied());
    }
    name(house);
    for (count, what) in [
        (moved, "things were pushed into their rooms"),
        (shrunk, "things were made smaller to fit their rooms"),
    ] {
        if count > 0 {
            notes.push(format!("{count} {what}"));
        }
    }
    if !left_out.is_empty() {
        let shown: Vec<&str> = left_out.iter().take(8).map(String::as_str).collect();
        let more = if left_out.len() > 8 { " …" } else { "" };
        let count = left_out.len();
        notes.push(format!(
            "{count} things do not fit and were left out: {}{more}",
            shown.join(", ")
        ));
    }
}

struct Fitted {
    pose: Pose,
    size: Size,
    moved: bool,
    shrunk: bool,
}

/// Pushes and shrinks a thing until it stands clear of the walls, the floor and the ceiling.
fn fit(object: &Object, room: usize, house: &House, floor_z: f64) -> Option<Fitted> {
    let corners = &house.rooms[room].outline;
    let clear = WALL_M / 2.0 + 0.002;
    let (low, high) = (corners[0], corners[2]);
    let free = [
        [low[0] + clear, high[0] - clear],
        [low[1] + clear, high[1] - clear],
        [0.0, house.wall_height_m - 0.002],
    ];
    let block = around(&object.pose, object.size);
    let reach = |k: usize| {
        let corners = block.corners();
        let values = corners.iter().map(|p| p[k]);
        (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max))
    };
    let spans = [reach(0), reach(1), (block.z[0], block.z[1])];
    // One scale for the plan keeps what is turned in its proportions.
    let share = |k: usize| ((free[k][1] - free[k][0]) / (spans[k].1 - spans[k].0)).min(1.0);
    let (plan, up) = (share(0).min(share(1)), share(2));
    if plan < SHRINK || up < SHRINK {
        return None;
    }
    let [w, h, d] = object.size.metres();
    let size = Size::new(w * plan, h * plan, d * up).ok()?;
    let [x, y, z] = object.pose.position();
    let centre = [x, y, z - floor_z];
    let at: [f64; 3] = std::array::from_fn(|k| {
        let half = (spans[k].1 - spans[k].0) / 2.0 * if k == 2 { up } else { plan };
        let [least, most] = [free[k][0] + half, free[k][1] - half];
        centre[k].clamp(least.min(most), most.max(least))
    });
    let pose = Pose::new(at, object.pose.orientation()).ok()?;
    let moved = (0..3).any(|k| (at[k] - centre[k]).abs() > 0.005);
    Some(Fitted { pose, size, moved, shrunk: plan < 0.999 || up < 0.999 })
}

fn thing(id: NodeId, object: &Object, room: usize, fitted: &Fitted, house: &House) -> Thing {
    let (pose, size) = facing(object, room, fitted, house);
    let (mesh, surfaces) = shapes::drawn(object.label.as_str(), size);
    let same = house.things.iter().find(|thing| *thing.mesh == mesh);
    Thing {
        name: id.index().to_string(),
        label: object.label.clone(),
        pose,
        size,
        mesh: same.map_or_else(|| Arc::new(mesh), |thing| thing.mesh.clone()),
        movable: object.decay_rate > 0.0,
        decay_rate: object.decay_rate,
        room,
        support: None,
        surfaces,
    }
}

/// Boxes of graphs are often aligned with the axes whatever they hold. What stands with a side
/// at a wall is turned so that its back is there; its box stays where it is.
fn facing(object: &Object, room: usize, fitted: &Fitted, house: &House) -> (Pose, Size) {
    let unturned = object.pose.orientation() == Pose::IDENTITY.orientation();
    let corners = &house.rooms[room].outline;
    let (low, high) = (corners[0], corners[2]);
    let [x, y, z] = fitted.pose.position();
    let [w, h, d] = fitted.size.metres();
    // How far each side is from its wall, and the yaw (in quarter turns) that puts the back there.
    let sides = [
        (high[1] - y - h / 2.0, 0),
        (x - w / 2.0 - low[0], 1),
        (y - h / 2.0 - low[1], 2),
        (high[0] - x - w / 2.0, 3),
    ];
    let nearest = sides.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
    let Some((_, quarters)) = nearest.filter(|(gap, _)| unturned && *gap < 0.35) else {
        return (fitted.pose, fitted.size);
    };
    let half = f64::from(quarters) * std::f64::consts::FRAC_PI_4;
    let turned = Pose::new([x, y, z], [libm::cos(half), 0.0, 0.0, libm::sin(half)]);
    let size = if quarters % 2 == 1 { Size::new(h, w, d) } else { Ok(fitted.size) };
    match (turned, size) {
        (Ok(pose), Ok(size)) => (pose, size),
        _ => (fitted.pose, fitted.size),
    }
}

/// Names things after their labels, with the number in the graph where several share one.
fn name(house: &mut House) {
    let mut counts: BTreeMap<String, u32> = BTreeMap::new();
    for thing in &house.things {
        *counts.entry(thing.label.to_string()).or_default() += 1;
    }
    for thing in &mut house.things {
        let label = thing.label.to_string();
        thing.name = if counts[&label] == 1 { label } else { format!("{label} {}", thing.name) };
    }
}
