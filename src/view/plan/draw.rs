//! A plan as SVG.

use super::labels::{Area, Labels, Placed};
use super::{Plan, PlanChange, PlanThing};
use crate::simulation::shapes::polygon;
use crate::view::svg::{Anchor, Look, Svg, text_width};

/// Width of the drawing without its margins, in units of the page.
const WIDTH: f64 = 1_180.0;
/// Most units for a metre, so that a small room is not drawn huge.
const SCALE_MAX: f64 = 150.0;
const MARGIN: f64 = 26.0;
const HEAD: f64 = 44.0;
const FOOT: f64 = 46.0;

const INK: &str = "#2b2f33";
const WALL: &str = "#3d4247";
const FURNITURE: &str = "#eceae5";
const FURNITURE_LINE: &str = "#8d908f";
const HUNG_LINE: &str = "#b2aea6";
const THING: &str = "#5f88b4";
const QUIET: &str = "#6a6f73";
const ADDED: &str = "#1a8f4c";
const REMOVED: &str = "#cf2e2e";
const MOVED: &str = "#d9730d";
const PATH: &str = "#7b5fb5";
/// Light tints of floors.
const FLOORS: [&str; 6] = ["#faf8f3", "#f4f7f8", "#f7f6fa", "#f5f8f3", "#faf5f3", "#f6f6f2"];

/// From metres to the page.
struct Page {
    scale: f64,
    low: [f64; 2],
    high: [f64; 2],
}

impl Page {
    fn new(plan: &Plan) -> Self {
        let rooms = plan.rooms.iter().flat_map(|room| room.outline.iter().copied());
        let walls = plan.walls.iter().flatten().copied();
        let things = plan.things.iter().flat_map(|thing| thing.corners);
        let points: Vec<[f64; 2]> = rooms.chain(walls).chain(things).collect();
        let least = |k: usize| points.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min);
        let most = |k: usize| points.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max);
        let (low, high) = match points.is_empty() {
            true => ([0.0; 2], [1.0; 2]),
            false => ([least(0), least(1)], [most(0), most(1)]),
        };
        let scale = (WIDTH / (high[0] - low[0]).max(high[1] - low[1]).max(0.1)).min(SCALE_MAX);
        Self { scale, low, high }
    }

    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [MARGIN + (x - self.low[0]) * self.scale, HEAD + (self.high[1] - y) * self.scale]
    }

    fn all(&self, points: &[[f64; 2]]) -> Vec<[f64; 2]> {
        points.iter().map(|point| self.at(*point)).collect()
    }

    fn size(&self) -> [f64; 2] {
        let side = |k: usize| (self.high[k] - self.low[k]) * self.scale;
        // Wide enough for the line of signs at its foot.
        [(side(0) + 2.0 * MARGIN).max(420.0), side(1) + HEAD + FOOT]
    }

    fn area(&self, points: &[[f64; 2]]) -> Area {
        bounds(&self.all(points))
    }
}

/// Draws a plan.
pub fn draw(plan: &Plan) -> String {
    let page = Page::new(plan);
    let [width, height] = page.size();
    let mut svg = Svg::new(width, height);
    let title = Look::fill(INK);
    svg.text([MARGIN, 28.0], 19.0, Anchor::Start, &plan.title, &title);
    floors(plan, &page, &mut svg);
    let order = order(plan);
    let quiet = shows_changes(plan);
    for thing in &order {
        footprint(thing, quiet, &page, &mut svg);
    }
    walls(plan, &page, &mut svg);
    for thing in &order {
        changed(thing, &page, &mut svg);
    }
    path(plan, &page, &mut svg);
    texts(plan, &order, &page, &mut svg);
    foot(plan, &page, &mut svg);
    svg.finish()
}

/// What lies lower is drawn first; the places of things that are gone come last.
fn order(plan: &Plan) -> Vec<&PlanThing> {
    let mut order: Vec<&PlanThing> = plan.things.iter().collect();
    let rank = |thing: &PlanThing| {
        let level = (thing.z[0] * 20.0).round() as i64;
        // A rug lies under all; a table stands over the chairs pushed under it.
        let stands = thing.z[1] - thing.z[0] > 0.05;
        (thing.change == Some(PlanChange::Removed), hangs(thing), thing.movable, level, stands)
    };
    order.sort_by(|a, b| rank(a).cmp(&rank(b)).then(b.z[1].total_cmp(&a.z[1])));
    order
}

/// Whether it is about what changed: small things that stayed are then drawn quietly.
fn shows_changes(plan: &Plan) -> bool {
    plan.things.iter().any(|thing| thing.change.is_some())
}

/// Above what one walks past: drawn as a thin line, as architects draw what is overhead.
fn hangs(thing: &PlanThing) -> bool {
    thing.z[0] > 1.3 && !thing.movable
}

fn floors(plan: &Plan, page: &Page, svg: &mut Svg) {
    for (n, room) in plan.rooms.iter().enumerate() {
        let mut look = Look::fill(FLOORS[n % FLOORS.len()]);
        if plan.walls.is_empty() {
            look = look.outlined(WALL, 1.5).dashed("6 4").with("fill-opacity", 0.7);
        }
        svg.polygon(&page.all(&room.outline), &look);
    }
}

fn walls(plan: &Plan, page: &Page, svg: &mut Svg) {
    let look = Look::fill(WALL).outlined(WALL, 0.6);
    for wall in &plan.walls {
        svg.polygon(&page.all(wall), &look);
    }
    for ends in &plan.doors {
        door(&page.all(ends), svg);
    }
}

/// A leaf, open at a right angle, and the way it swings.
fn door(ends: &[[f64; 2]], svg: &mut Svg) {
    let [a, b] = [ends[0], ends[1]];
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let radius = libm::hypot(dx, dy);
    let tip = [a[0] - dy, a[1] + dx];
    let line = Look::line(QUIET, 1.4);
    svg.segment(a, tip, &line);
    let number = crate::view::svg::number;
    let d = format!(
        "M {} {} A {r} {r} 0 0 0 {} {}",
        number(tip[0]),
        number(tip[1]),
        number(b[0]),
        number(b[1]),
        r = number(radius),
    );
    svg.path(&d, &Look::line(QUIET, 0.7));
}

fn footprint(thing: &PlanThing, quiet: bool, page: &Page, svg: &mut Svg) {
    let corners = page.all(&thing.corners);
    if thing.change == Some(PlanChange::Removed) {
        return;
    }
    let look = match (thing.probability, thing.movable) {
        _ if hangs(thing) => Look::line(HUNG_LINE, 0.8).dashed("4 3"),
        (Some(p), _) => Look::fill(&belief(p)).outlined(INK, 0.5),
        (None, true) if quiet => Look::fill("#dfe6ee").outlined("#a9b8c8", 0.6),
        (None, true) => Look::fill(THING).outlined("#33557a", 0.6).with("fill-opacity", 0.85),
        (None, false) => Look::fill(FURNITURE).outlined(FURNITURE_LINE, 0.9),
    };
    svg.polygon(&corners, &look);
}

/// Colour of a probability: green for sure, yellow for one half, red for none.
fn belief(p: f64) -> String {
    let stops = [[0xc8, 0x45, 0x3b], [0xf0, 0xc0, 0x4a], [0x2f, 0x8f, 0x57]];
    let place = p.clamp(0.0, 1.0) * 2.0;
    let n = usize::from(place >= 1.0);
    let share = place - n as f64;
    let mix = |k: usize| {
        let (low, high) = (f64::from(stops[n][k]), f64::from(stops[n + 1][k]));
        (low + (high - low) * share) as u8
    };
    format!("#{:02x}{:02x}{:02x}", mix(0), mix(1), mix(2))
}

fn colour_of(change: &PlanChange) -> &'static str {
    match change {
        PlanChange::Added => ADDED,
        PlanChange::Removed => REMOVED,
        PlanChange::Moved { .. } => MOVED,
    }
}

fn changed(thing: &PlanThing, page: &Page, svg: &mut Svg) {
    let Some(change) = &thing.change else { return };
    let colour = colour_of(change);
    let [x, y] = middle(page.area(&thing.corners));
    let ring = ring(thing, page);
    let corners = page.all(&thing.corners);
    match change {
        PlanChange::Added => {
            svg.circle([x, y], ring, &Look::fill(colour).with("fill-opacity", 0.18));
            svg.polygon(&corners, &Look::fill(colour).outlined(colour, 1.5));
        }
        PlanChange::Removed => {
            svg.circle([x, y], ring, &Look::fill(colour).with("fill-opacity", 0.1));
            svg.polygon(&corners, &Look::line(colour, 1.5).dashed("3 2.5"));
        }
        PlanChange::Moved { from } => {
            let was = middle(page.area(from));
            svg.polygon(&page.all(from), &Look::line(colour, 1.2).dashed("3 2.5"));
            svg.circle([x, y], ring, &Look::fill(colour).with("fill-opacity", 0.15));
            svg.polygon(&corners, &Look::fill(colour).outlined(colour, 1.5));
            arrow(was, [x, y], ring, colour, svg);
        }
    }
}

/// Radius of the halo that makes a change seen.
fn ring(thing: &PlanThing, page: &Page) -> f64 {
    let [x0, y0, x1, y1] = page.area(&thing.corners);
    libm::hypot(x1 - x0, y1 - y0) / 2.0 + 6.0
}

fn middle(area: Area) -> [f64; 2] {
    [f64::midpoint(area[0], area[2]), f64::midpoint(area[1], area[3])]
}

/// A bent arrow that ends at the halo of what moved.
fn arrow(from: [f64; 2], to: [f64; 2], halo: f64, colour: &str, svg: &mut Svg) {
    let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
    let length = libm::hypot(dx, dy);
    if length < halo + 8.0 {
        return;
    }
    let bend =
        [f64::midpoint(from[0], to[0]) + dy * 0.15, f64::midpoint(from[1], to[1]) - dx * 0.15];
    let (bx, by) = (to[0] - bend[0], to[1] - bend[1]);
    let reach = libm::hypot(bx, by);
    let (ux, uy) = (bx / reach, by / reach);
    let tip = [to[0] - ux * halo, to[1] - uy * halo];
    let neck = [tip[0] - ux * 8.0, tip[1] - uy * 8.0];
    let number = crate::view::svg::number;
    let d = format!(
        "M {} {} Q {} {} {} {}",
        number(from[0]),
        number(from[1]),
        number(bend[0]),
        number(bend[1]),
        number(neck[0]),
        number(neck[1]),
    );
    svg.path(&d, &Look::line(colour, 1.8));
    let side = |s: f64| [neck[0] - uy * 4.0 * s, neck[1] + ux * 4.0 * s];
    svg.polygon(&[tip, side(1.0), side(-1.0)], &Look::fill(colour));
}

fn path(plan: &Plan, page: &Page, svg: &mut Svg) {
    if let (Some(first), Some(last)) = (plan.path.first(), plan.path.last()) {
        let look =
            Look::line(PATH, 2.2).with("stroke-linejoin", "round").with("stroke-opacity", 0.75);
        svg.polyline(&page.all(&plan.path), &look);
        svg.circle(page.at(*first), 4.5, &Look::fill("#ffffff").outlined(PATH, 2.0));
        svg.circle(page.at(*last), 4.5, &Look::fill(PATH));
    }
}

fn texts(plan: &Plan, order: &[&PlanThing], page: &Page, svg: &mut Svg) {
    let [width, height] = page.size();
    let mut labels = Labels::new([4.0, HEAD - 8.0, width - 4.0, height - FOOT + 12.0]);
    for wall in &plan.walls {
        labels.avoid(page.area(wall), 3.0);
    }
    for thing in order {
        let cost = if thing.movable {
            4.0
        } else if hangs(thing) {
            0.2
        } else {
            0.45
        };
        labels.avoid(page.area(&thing.corners), cost);
    }
    for door in &plan.doors {
        labels.avoid(page.area(door), 1.0);
    }
    let rooms: Vec<(usize, [f64; 2])> = plan
        .rooms
        .iter()
        .enumerate()
        .map(|(n, _)| (n, room_name(plan, n, page, &mut labels)))
        .collect();
    // Large things first: their labels go inside. Then what changed, then the small ones.
    let mut all: Vec<&PlanThing> = order.to_vec();
    let space = |thing: &PlanThing| {
        let [x0, y0, x1, y1] = page.area(&thing.corners);
        (x1 - x0) * (y1 - y0)
    };
    all.sort_by(|a, b| {
        let first = |thing: &PlanThing| (thing.change.is_none(), thing.movable);
        first(a).cmp(&first(b)).then(space(b).total_cmp(&space(a)))
    });
    if shows_changes(plan) {
        all.retain(|thing| thing.change.is_some() || !thing.movable);
    }
    let shapes: Vec<Vec<[f64; 2]>> =
        plan.rooms.iter().map(|room| page.all(&room.outline)).collect();
    for (text, thing) in grouped(&all, page) {
        let at = middle(page.area(&thing.corners));
        let room = shapes.iter().find(|shape| polygon::contains(shape, at));
        labels.stay_in(room.map(|shape| bounds(shape)));
        label(&text, thing, page, &mut labels, svg);
    }
    for (n, at) in rooms {
        let name = spaced(&plan.rooms[n].label);
        let look = Look::fill("#9a958a").with("letter-spacing", 2.2);
        svg.text(at, 14.0, Anchor::Middle, &name, &look);
    }
}

fn spaced(label: &str) -> String {
    label.to_uppercase()
}

/// Finds the emptiest place in a room for its name.
fn room_name(plan: &Plan, n: usize, page: &Page, labels: &mut Labels) -> [f64; 2] {
    let outline = &plan.rooms[n].outline;
    let name = spaced(&plan.rooms[n].label);
    let size = [text_width(&name) * 14.0 + 2.2 * name.chars().count() as f64, 16.0];
    let [x0, y0, x1, y1] = page.area(outline);
    let mut best = (f64::INFINITY, middle([x0, y0, x1, y1]));
    for row in 1..24 {
        for column in 1..24 {
            let at =
                [x0 + (x1 - x0) * f64::from(column) / 24.0, y0 + (y1 - y0) * f64::from(row) / 24.0];
            let area = [
                at[0] - size[0] / 2.0,
                at[1] - size[1] / 2.0,
                at[0] + size[0] / 2.0,
                at[1] + size[1] / 2.0,
            ];
            let corners =
                [[area[0], area[1]], [area[2], area[1]], [area[2], area[3]], [area[0], area[3]]];
            let shape = page.all(outline);
            if !corners.iter().all(|corner| polygon::contains(&shape, *corner)) {
                continue;
            }
            let [mx, my] = middle([x0, y0, x1, y1]);
            let far = libm::hypot(at[0] - mx, at[1] - my);
            let trouble = labels.trouble(area) + far * 0.8;
            if trouble < best.0 {
                best = (trouble, at);
            }
        }
    }
    let [x, y] = best.1;
    labels.take([x - size[0] / 2.0, y - size[1] / 2.0, x + size[0] / 2.0, y + size[1] / 2.0]);
    [x, y + 5.0]
}

/// Things with what is written beside them: things of one name close to each other share it.
fn grouped<'a>(all: &[&'a PlanThing], page: &Page) -> Vec<(String, &'a PlanThing)> {
    const CLOSE: f64 = 70.0;
    let mut found: Vec<(u32, &PlanThing)> = Vec::new();
    for thing in all {
        let [x, y] = middle(page.area(&thing.corners));
        let same = found.iter_mut().find(|(_, other)| {
            let [u, v] = middle(page.area(&other.corners));
            let near = libm::hypot(x - u, y - v) < if thing.movable { CLOSE } else { CLOSE / 2.0 };
            other.label == thing.label && other.change.is_none() && thing.change.is_none() && near
        });
        match same {
            Some((count, _)) => *count += 1,
            None => found.push((1, thing)),
        }
    }
    let text = |(count, thing): (u32, &'a PlanThing)| match count {
        1 => (thing.label.clone(), thing),
        _ => (format!("{} \u{d7}{count}", thing.label), thing),
    };
    found.into_iter().map(text).collect()
}

fn bounds(points: &[[f64; 2]]) -> Area {
    let least = |k: usize| points.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min);
    let most = |k: usize| points.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max);
    [least(0), least(1), most(0), most(1)]
}

fn label(text: &str, thing: &PlanThing, page: &Page, labels: &mut Labels, svg: &mut Svg) {
    let area = page.area(&thing.corners);
    let colour = thing.change.as_ref().map(colour_of);
    let large =
        if thing.movable || thing.change.is_some() { &[][..] } else { &[11.5, 10.0, 9.0][..] };
    let size = if thing.change.is_some() { 11.0 } else { 9.0 };
    let Some(placed) = labels.inside(text, area, large).or_else(|| labels.beside(text, area, size))
    else {
        return;
    };
    let quiet = if thing.movable { "#2f4e70" } else { "#5b5f61" };
    write(text, &placed, area, colour.unwrap_or(quiet), svg);
}

fn write(text: &str, placed: &Placed, thing: Area, colour: &str, svg: &mut Svg) {
    if let Some(from) = placed.leader {
        let line = Look::line(colour, 0.5).with("stroke-opacity", 0.75);
        let [x, y] = middle(thing);
        let edge = [from[0].clamp(thing[0], thing[2]), from[1].clamp(thing[1], thing[3])];
        let end = [f64::midpoint(edge[0], x), f64::midpoint(edge[1], y)];
        svg.segment(from, end, &line);
    }
    let mut look = Look::fill(colour);
    if placed.upright {
        let number = crate::view::svg::number;
        let (x, y) = (number(placed.at[0]), number(placed.at[1]));
        look = look.with("transform", format!("rotate(-90 {x} {y})"));
    }
    svg.text(placed.at, placed.size, Anchor::Start, text, &look);
}

/// A measure of one metre, and what the colours mean.
fn foot(plan: &Plan, page: &Page, svg: &mut Svg) {
    let y = page.size()[1] - 16.0;
    let line = Look::line(QUIET, 1.2);
    let end = MARGIN + page.scale;
    svg.segment([MARGIN, y], [end, y], &line);
    for x in [MARGIN, end] {
        svg.segment([x, y - 4.0], [x, y + 4.0], &line);
    }
    svg.text([end + 7.0, y + 4.0], 11.0, Anchor::Start, "1 m", &Look::fill(QUIET));
    let mut x = end + 50.0;
    let has = |test: fn(&PlanThing) -> bool| plan.things.iter().any(test);
    let signs = [
        (has(|it| it.change == Some(PlanChange::Added)), ADDED, "added"),
        (has(|it| it.change == Some(PlanChange::Removed)), REMOVED, "removed"),
        (has(|it| matches!(it.change, Some(PlanChange::Moved { .. }))), MOVED, "moved"),
        (!plan.path.is_empty(), PATH, "way of the robot"),
    ];
    for (_, colour, text) in signs.into_iter().filter(|(there, _, _)| *there) {
        svg.rect([x, y - 5.0], [10.0, 10.0], &Look::fill(colour));
        svg.text([x + 15.0, y + 4.0], 11.0, Anchor::Start, text, &Look::fill(INK));
        x += 32.0 + text_width(text) * 11.0;
    }
    if has(|it| it.probability.is_some()) {
        for n in 0..20 {
            let p = f64::from(n) / 19.0;
            svg.rect([x + f64::from(n) * 5.0, y - 5.0], [5.2, 10.0], &Look::fill(&belief(p)));
        }
        let text = "still there: 0 to 1";
        svg.text([x + 107.0, y + 4.0], 11.0, Anchor::Start, text, &Look::fill(INK));
    }
}
