//! Rooms of a graph as rectangles that meet.

use crate::graph::{NodeId, SceneGraph};
use crate::simulation::house::space::around;
use crate::simulation::house::{HouseError, Room};
use crate::simulation::shapes::paint;

/// Lowest x and y, highest x and y, metres.
pub type Rectangle = [[f64; 2]; 2];

/// The rooms of one storey.
pub struct Storey {
    /// Rooms by their ids in the graph.
    pub rooms: Vec<(NodeId, Room)>,
    /// Height of the floor in the graph, metres.
    pub floor_z: f64,
    /// Floor to ceiling, metres.
    pub height_m: f64,
}

/// Rooms whose sides are within this of each other share a wall, metres.
const WALL_GAP_M: f64 = 0.6;
/// Rooms smaller than this are left out, metres.
const SMALLEST_M: f64 = 0.8;
/// Floors of rooms, told apart by their colours.
const FLOORS: [u32; 6] =
    [0x00b8_9468, 0x00cf_d6d8, 0x00a9_8360, 0x00c9_bfae, 0x009f_aeb8, 0x00d8_c7a0];

pub fn storey(graph: &SceneGraph, notes: &mut Vec<String>) -> Result<Storey, HouseError> {
    let mut found: Vec<(NodeId, Rectangle)> = Vec::new();
    let (mut nowhere, mut bottoms, mut heights) = (Vec::new(), Vec::new(), Vec::new());
    for (id, room) in graph.rooms() {
        if let Some((pose, size)) = room.extent {
            let [low, high] = around(&pose, size).z;
            bottoms.push(low);
            heights.push(high - low);
        }
        match rectangle(graph, id) {
            Some(it) if (0..2).all(|k| it[1][k] - it[0][k] > SMALLEST_M) => found.push((id, it)),
            _ => nowhere.push(format!("{} {id}", room.label)),
        }
    }
    if !nowhere.is_empty() {
        notes.push(format!("rooms without an extent were left out: {}", nowhere.join(", ")));
    }
    if found.is_empty() {
        let problem = "no room of the graph has an extent, nor objects to take one from";
        return Err(HouseError::new("rooms", problem));
    }
    join(&mut found);
    drop_overlapping(graph, &mut found, notes);
    let room = |(n, (id, it)): (usize, &(NodeId, Rectangle))| {
        let [[x0, y0], [x1, y1]] = *it;
        let outline = vec![[x0, y0], [x1, y0], [x1, y1], [x0, y1]];
        let label = graph.label(*id).expect("it is a room of the graph").clone();
        (*id, Room { label, outline, floor: paint::wood(FLOORS[n % FLOORS.len()]) })
    };
    let rooms = found.iter().enumerate().map(room).collect();
    let (floor_z, height_m) = (median(bottoms, 0.0), median(heights, 2.5).clamp(2.2, 4.0));
    Ok(Storey { rooms, floor_z, height_m })
}

/// Around the floors of a room, or its own box, or its objects.
fn rectangle(graph: &SceneGraph, room: NodeId) -> Option<Rectangle> {
    let inside = || graph.objects().filter(move |(_, object)| object.room == room);
    let boxes = |floors: bool| {
        inside()
            .filter(move |(_, object)| !floors || object.label.same_class("floor"))
            .map(|(_, object)| around(&object.pose, object.size).corners())
    };
    let floors: Vec<[f64; 2]> = boxes(true).flatten().collect();
    let own = graph.region(room)?.extent;
    match (floors.is_empty(), own) {
        (false, _) => bounds(&floors),
        (true, Some((pose, size))) => bounds(&around(&pose, size).corners()),
        (true, None) => bounds(&boxes(false).flatten().collect::<Vec<_>>()),
    }
}

fn bounds(points: &[[f64; 2]]) -> Option<Rectangle> {
    let least = |k: usize| points.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min);
    let most = |k: usize| points.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max);
    (!points.is_empty()).then(|| [[least(0), least(1)], [most(0), most(1)]])
}

/// Moves sides that nearly meet, or overlap a little, to the line between them.
fn join(rooms: &mut [(NodeId, Rectangle)]) {
    for n in 0..rooms.len() {
        for m in 0..n {
            let (a, b) = (rooms[n].1, rooms[m].1);
            // Positive where they overlap.
            let overlap = |k: usize| a[1][k].min(b[1][k]) - a[0][k].max(b[0][k]);
            let k = if overlap(0) < overlap(1) { 0 } else { 1 };
            if overlap(k).abs() > WALL_GAP_M || overlap(1 - k) < 0.3 {
                continue;
            }
            let (lower, upper) = if a[0][k] < b[0][k] { (n, m) } else { (m, n) };
            let line = f64::midpoint(rooms[lower].1[1][k], rooms[upper].1[0][k]);
            rooms[lower].1[1][k] = line;
            rooms[upper].1[0][k] = line;
        }
    }
}

fn drop_overlapping(
    graph: &SceneGraph,
    rooms: &mut Vec<(NodeId, Rectangle)>,
    notes: &mut Vec<String>,
) {
    let area = |it: &Rectangle| (it[1][0] - it[0][0]) * (it[1][1] - it[0][1]);
    let mut kept: Vec<(NodeId, Rectangle)> = Vec::new();
    let mut by_size = rooms.clone();
    by_size.sort_by(|a, b| area(&b.1).total_cmp(&area(&a.1)).then(a.0.cmp(&b.0)));
    for (id, it) in by_size {
        let overlaps = |other: &Rectangle| {
            (0..2).all(|k| it[1][k].min(other[1][k]) - it[0][k].max(other[0][k]) > 0.002)
        };
        if let Some((other, _)) = kept.iter().find(|(_, other)| overlaps(other)) {
            let name =
                |id: NodeId| graph.label(id).map_or_else(String::new, |l| format!("{l} {id}"));
            notes.push(format!("{} was left out: it overlaps {}", name(id), name(*other)));
        } else {
            kept.push((id, it));
        }
    }
    kept.sort_by_key(|(id, _)| *id);
    *rooms = kept;
}

fn median(mut values: Vec<f64>, otherwise: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(otherwise)
}
