//! What one eats from, drinks from and cooks with.

use super::paint::{plain, striped, wood};
use super::sketch::{Point, Sketch};
use super::{Class, class};

pub const CLASSES: &[Class] = &[
    class("mug", [0.125, 0.09, 0.1], "tableware", mug),
    class("glass", [0.07, 0.07, 0.13], "tableware", glass),
    class("bowl", [0.16, 0.16, 0.07], "tableware", bowl),
    class("plate", [0.25, 0.25, 0.025], "tableware", plate),
    class("bottle", [0.08, 0.08, 0.3], "tableware", bottle),
    class("kettle", [0.24, 0.17, 0.25], "appliance", kettle),
    class("pot", [0.32, 0.24, 0.18], "tableware", pot),
    class("pan", [0.46, 0.27, 0.07], "tableware", pan),
    class("tray", [0.42, 0.3, 0.035], "tableware", tray),
    class("knife", [0.24, 0.03, 0.015], "tableware", knife),
    class("fork", [0.2, 0.026, 0.015], "tableware", fork),
    class("spoon", [0.2, 0.042, 0.02], "tableware", spoon),
    class("knife block", [0.11, 0.18, 0.24], "appliance", knife_block),
    class("cutting board", [0.36, 0.24, 0.02], "tableware", cutting_board),
    class("salt shaker", [0.05, 0.05, 0.1], "tableware", salt_shaker),
];

/// Points on part of a circle in the plane y = const, from an angle to another.
pub fn arc(centre: Point, r: [f64; 2], from: f64, to: f64, steps: u32) -> Vec<Point> {
    let at = |n: u32| {
        let angle = from + (to - from) * f64::from(n) / f64::from(steps);
        [centre[0] + r[0] * libm::cos(angle), centre[1], centre[2] + r[1] * libm::sin(angle)]
    };
    (0..=steps).map(at).collect()
}

fn handle(s: &mut Sketch, path: &[Point], radius: f64, sides: u32) {
    let path: Vec<(Point, f64)> = path.iter().map(|at| (*at, radius)).collect();
    s.tube(&path, sides);
}

/// A cup with a floor and an inside; its handle points to +x.
fn mug(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (r, y) = (h / 2.0, h / 2.0);
    s.paint(plain(0xd9412b));
    let wall = r * 0.1;
    let outside = [(0.0, 0.0), (r * 0.92, 0.0), (r, d * 0.08), (r, d)];
    let inside = [(r - wall, d), (r - wall, d * 0.12), (0.0, d * 0.12)];
    s.lathe([r, y], &[&outside[..], &inside[..]].concat(), 18);
    let reach = w - 2.0 * r * 0.97 - 0.006;
    let path = arc([2.0 * r * 0.97, y, d * 0.52], [reach, d * 0.3], -1.5, 1.5, 6);
    handle(s, &path, 0.006, 6);
}

fn glass(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let r = w / 2.0;
    s.paint(plain(0xbfe3ee));
    let profile =
        [(0.0, 0.0), (r * 0.75, 0.0), (r, d), (r * 0.9, d), (r * 0.68, d * 0.07), (0.0, d * 0.07)];
    s.lathe([r, h / 2.0], &profile, 18);
}

fn bowl(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let r = w / 2.0;
    s.paint(plain(0x2f6fb5));
    let outside = [(0.0, 0.0), (r * 0.45, 0.0), (r * 0.8, d * 0.45), (r, d)];
    s.lathe([r, h / 2.0], &[&outside[..], &[(r * 0.93, d)]].concat(), 20);
    s.paint(plain(0xeef4fb));
    s.lathe([r, h / 2.0], &[(r * 0.93, d), (r * 0.72, d * 0.45), (0.0, d * 0.18)], 20);
}

fn plate(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let r = w / 2.0;
    s.paint(plain(0xfafafa));
    let profile = [(0.0, 0.0), (r * 0.6, 0.0), (r, d), (r * 0.97, d)];
    s.lathe([r, h / 2.0], &profile, 24);
    s.lathe([r, h / 2.0], &[(r * 0.92, d * 0.93), (r * 0.62, d * 0.4), (0.0, d * 0.4)], 24);
    s.paint(plain(0x2b5fa8));
    s.lathe([r, h / 2.0], &[(r * 0.97, d), (r * 0.92, d * 0.93)], 24);
}

fn bottle(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (middle, r) = ([w / 2.0, h / 2.0], w / 2.0);
    s.paint(plain(0x2e6b3a));
    let body = [(0.0, 0.0), (r, 0.0), (r, d * 0.55), (r * 0.4, d * 0.75), (r * 0.36, d * 0.93)];
    s.lathe(middle, &[&body[..], &[(0.0, d * 0.93)]].concat(), 16);
    s.paint(plain(0xc0392b));
    s.cylinder(middle, r * 0.42, [d * 0.93, d], 12);
    s.paint(plain(0xf1e8c9));
    s.ring(middle, [r * 0.98, r * 1.01], [d * 0.15, d * 0.45], 16);
}

/// Spout to −x, handle to +x, a knob on the lid.
fn kettle(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (r, x, y) = (h / 2.0, w * 0.47, h / 2.0);
    s.paint(plain(0xb8bec4));
    s.lathe(
        [x, y],
        &[(0.0, 0.0), (r, 0.0), (r * 0.95, d * 0.3), (r * 0.6, d * 0.8), (0.0, d * 0.86)],
        20,
    );
    s.tube(&[([x - r * 0.85, y, d * 0.4], 0.02), ([0.014, y, d * 0.72], 0.01)], 8);
    s.paint(plain(0x1f1f1f));
    s.cylinder([x, y], r * 0.15, [d * 0.84, d], 10);
    let path = arc([x + r * 0.6, y, d * 0.5], [w - x - r * 0.6 - 0.01, d * 0.32], -1.2, 1.6, 7);
    handle(s, &path, 0.01, 8);
}

fn pot(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (middle, r) = ([w / 2.0, h / 2.0], h / 2.0);
    s.paint(plain(0x9fa7ae));
    s.cylinder(middle, r * 0.97, [0.0, d * 0.78], 20);
    s.paint(plain(0xc5ccd2));
    s.lathe(middle, &[(0.0, d * 0.78), (r, d * 0.78), (r * 0.9, d * 0.84), (0.0, d * 0.88)], 20);
    s.paint(plain(0x1c1c1c));
    s.cylinder(middle, r * 0.16, [d * 0.86, d], 10);
    for (from, to) in [(0.0, w / 2.0 - r * 0.9), (w / 2.0 + r * 0.9, w)] {
        s.block([from, h * 0.35, d * 0.6], [to, h * 0.65, d * 0.67]);
    }
}

/// The handle points to +x.
fn pan(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let r = h / 2.0;
    s.paint(plain(0x2b2d30));
    let low = d * 0.75;
    let profile = [
        (0.0, 0.0),
        (r * 0.8, 0.0),
        (r, low),
        (r * 0.95, low),
        (r * 0.76, low * 0.15),
        (0.0, low * 0.15),
    ];
    s.lathe([r, r], &profile, 22);
    s.paint(plain(0x5a3a22));
    s.tube(&[([2.0 * r * 0.96, r, low * 0.8], 0.011), ([w, r, d - 0.012], 0.012)], 8);
}

fn tray(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0x6b7a86));
    let (floor, rim) = (d * 0.3, 0.012);
    s.block([0.0, 0.0, 0.0], [w, h, floor]);
    s.block([0.0, 0.0, floor], [rim, h, d]);
    s.block([w - rim, 0.0, floor], [w, h, d]);
    s.block([rim, 0.0, floor], [w - rim, rim, d]);
    s.block([rim, h - rim, floor], [w - rim, h, d]);
    s.surface("top", [rim + 0.01, rim + 0.01], [w - rim - 0.01, h - rim - 0.01], floor, None);
}

fn knife(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xc9ced3));
    s.prism(
        2,
        &[[w * 0.42, 0.0], [w, h * 0.5], [w * 0.95, h * 0.9], [w * 0.42, h * 0.9]],
        [d * 0.3, d * 0.5],
    );
    s.paint(plain(0x1b1b1b));
    s.block([0.0, 0.0, 0.0], [w * 0.42, h, d]);
}

fn fork(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xc9ced3));
    s.block([0.0, h * 0.35, 0.0], [w * 0.7, h * 0.65, d * 0.5]);
    s.block([w * 0.7, 0.0, 0.0], [w * 0.78, h, d * 0.7]);
    for n in 0..4 {
        let y = h * 0.29 * f64::from(n);
        s.block([w * 0.78, y, d * 0.2], [w, y + h * 0.13, d]);
    }
}

fn spoon(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xc9ced3));
    s.block([0.0, h * 0.35, d * 0.2], [w * 0.72, h * 0.65, d * 0.5]);
    s.ball([w * 0.68, 0.0, 0.0], [w, h, d], 12);
}

fn knife_block(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(wood(0x8a5c33));
    s.prism(0, &[[0.0, 0.0], [h * 0.8, 0.0], [h, d * 0.55], [h * 0.4, d * 0.8]], [0.0, w]);
    s.paint(plain(0x202020));
    for n in 0..3 {
        let x = w * (0.12 + 0.28 * f64::from(n));
        s.rod([x + 0.012, h * 0.55, d * 0.72], [x + 0.012, h * 0.75, d], 0.011, 6);
    }
}

fn cutting_board(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(striped(0xd6a96a, 0xb98747, 1, h / 4.0));
    s.block([0.0, 0.0, 0.0], [w, h, d]);
    s.top("top", [0.0; 3], [w, h, d], None);
}

fn salt_shaker(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (middle, r) = ([w / 2.0, h / 2.0], w / 2.0);
    s.paint(plain(0xf3f3f0));
    s.lathe(middle, &[(0.0, 0.0), (r, 0.0), (r * 0.7, d * 0.75), (0.0, d * 0.75)], 14);
    s.paint(plain(0x8d949a));
    s.lathe(middle, &[(0.0, d * 0.75), (r * 0.75, d * 0.75), (r * 0.5, d), (0.0, d)], 14);
}
