//! A patrol on the floor plan, as SVG.

use super::svg::{Anchor, Look, Svg, text_width};
use crate::graph::{NodeId, Region, SceneGraph};
use crate::patrol::Plan;

/// Metres around the rooms.
const MARGIN_M: f64 = 1.0;
/// Units of the drawing for a metre.
const SCALE: f64 = 60.0;

/// Draws rooms as boxes, the more there is to gain the darker, and the walk with the number of
/// each stop. Rooms without a box are left out; `None` if no room has one.
pub fn svg(graph: &SceneGraph, plan: &Plan) -> Option<String> {
    let frame = Frame::of(graph)?;
    let mut svg = Svg::new(frame.width, frame.height);
    let most = plan.stops.iter().map(|stop| stop.gain).fold(1e-9, f64::max);
    for (id, room) in graph.rooms() {
        let gain: f64 = plan.stops.iter().filter(|it| it.room == id).map(|it| it.gain).sum();
        draw_room(&mut svg, &frame, room, gain / most);
    }
    // Over all rooms, since boxes of rooms may overlap.
    for (id, room) in graph.rooms() {
        let gain: f64 = plan.stops.iter().filter(|it| it.room == id).map(|it| it.gain).sum();
        name_room(&mut svg, &frame, room, gain);
    }
    let points: Vec<[f64; 2]> =
        plan.stops.iter().filter_map(|stop| frame.centre(graph, stop.room)).collect();
    let line = Look::line("#0072b2", 4.0).with("stroke-linejoin", "round");
    svg.polyline(&points, &line.with("stroke-opacity", "0.7"));
    let mut drawn: Vec<NodeId> = Vec::new();
    for (n, stop) in plan.stops.iter().enumerate() {
        let Some(at) = frame.centre(graph, stop.room) else { continue };
        if drawn.contains(&stop.room) {
            continue;
        }
        drawn.push(stop.room);
        svg.circle(at, 16.0, &Look::fill("#0072b2").outlined("#ffffff", 2.0));
        let [x, y] = at;
        svg.text([x, y + 6.0], 17.0, Anchor::Middle, &n.to_string(), &Look::fill("#ffffff"));
    }
    Some(svg.finish())
}

fn draw_room(svg: &mut Svg, frame: &Frame, room: &Region, share: f64) {
    let Some([min, max]) = bounds(room) else { return };
    let ([x, bottom], [right, y]) = (frame.at(min), frame.at(max));
    let size = [right - x, bottom - y];
    // From white to a warm orange.
    let mix = |from: f64, to: f64| (from + (to - from) * share) as u8;
    let (g, b) = (mix(255.0, 178.0), mix(255.0, 90.0));
    let fill = format!("#{:02x}{g:02x}{b:02x}", mix(255.0, 244.0));
    let look = Look::fill(&fill).outlined("#555555", 2.0).with("fill-opacity", "0.85");
    svg.rect([x, y], size, &look);
}

fn name_room(svg: &mut Svg, frame: &Frame, room: &Region, gain: f64) {
    let Some([min, max]) = bounds(room) else { return };
    let ([x, bottom], [right, y]) = (frame.at(min), frame.at(max));
    let label = room.label.as_str();
    let letters = ((right - x) / text_width(label).max(0.1) * 0.9).min(18.0);
    svg.text([x + 8.0, y + letters + 6.0], letters, Anchor::Start, label, &Look::fill("#333333"));
    if gain > 0.0 {
        let words = format!("{gain:.1} to gain");
        svg.text([x + 8.0, bottom - 8.0], 14.0, Anchor::Start, &words, &Look::fill("#555555"));
    }
}

/// Corners of a room's box seen from above, metres; its turn is left out.
fn bounds(room: &Region) -> Option<[[f64; 2]; 2]> {
    let (pose, size) = room.extent?;
    let ([x, y, _], [w, h, _]) = (pose.position(), size.metres());
    Some([[x - w / 2.0, y - h / 2.0], [x + w / 2.0, y + h / 2.0]])
}

/// From metres, y up, to units of the drawing, y down.
struct Frame {
    left: f64,
    top: f64,
    width: f64,
    height: f64,
}

impl Frame {
    fn of(graph: &SceneGraph) -> Option<Self> {
        let boxes: Vec<[[f64; 2]; 2]> =
            graph.rooms().filter_map(|(_, room)| bounds(room)).collect();
        let least = |n: usize| boxes.iter().map(|it| it[0][n]).fold(f64::INFINITY, f64::min);
        let most = |n: usize| boxes.iter().map(|it| it[1][n]).fold(f64::NEG_INFINITY, f64::max);
        if boxes.is_empty() {
            return None;
        }
        let (left, top) = (least(0) - MARGIN_M, most(1) + MARGIN_M);
        let width = (most(0) + MARGIN_M - left) * SCALE;
        let height = (top - least(1) + MARGIN_M) * SCALE;
        Some(Self { left, top, width, height })
    }

    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [(x - self.left) * SCALE, (self.top - y) * SCALE]
    }

    fn centre(&self, graph: &SceneGraph, room: NodeId) -> Option<[f64; 2]> {
        let [x, y, _] = graph.region(room)?.extent?.0.position();
        Some(self.at([x, y]))
    }
}
