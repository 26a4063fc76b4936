//! Food.

use super::paint::{plain, striped};
use super::sketch::{Point, Sketch};
use super::tableware::arc;
use super::{Class, class};

pub const CLASSES: &[Class] = &[
    class("banana", [0.19, 0.045, 0.09], "food", banana),
    class("apple", [0.08, 0.08, 0.085], "food", apple),
    class("orange", [0.08, 0.08, 0.078], "food", orange),
    class("lemon", [0.1, 0.065, 0.065], "food", lemon),
    class("tomato", [0.075, 0.075, 0.065], "food", tomato),
    class("bread", [0.26, 0.11, 0.11], "food", bread),
    class("cake", [0.24, 0.24, 0.1], "food", cake),
    class("chicken", [0.26, 0.18, 0.13], "food", chicken),
    class("cutlets", [0.14, 0.1, 0.03], "food", cutlets),
    class("creamy buns", [0.12, 0.1, 0.07], "food", cutlets),
    class("chips", [0.2, 0.09, 0.28], "food", chips),
    class("cereal", [0.19, 0.06, 0.28], "food", cereal),
    class("milk", [0.07, 0.07, 0.23], "food", milk),
    class("can", [0.066, 0.066, 0.11], "food", can),
];

/// Bent upwards at its ends.
fn banana(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let bend =
        |a: f64, b: f64, n| arc([w / 2.0, h / 2.0, d], [w / 2.0 - 0.01, d - h / 2.0], a, b, n);
    let body = bend(-2.75, -0.4, 8);
    let radii = [0.35, 0.7, 0.9, 1.0, 1.0, 1.0, 0.9, 0.7, 0.4].map(|share| share * h / 2.0);
    s.paint(plain(0xf4d03f));
    s.tube(&body.iter().copied().zip(radii).collect::<Vec<(Point, f64)>>(), 10);
    s.paint(plain(0x6b4a1e));
    for (from, to) in [(-3.05, -2.75), (-0.4, -0.28)] {
        let tip: Vec<(Point, f64)> =
            bend(from, to, 1).into_iter().map(|at| (at, h * 0.15)).collect();
        s.tube(&tip, 6);
    }
}

fn stalk(s: &mut Sketch, hex: u32) {
    let [w, h, d] = s.size;
    s.paint(plain(hex));
    s.rod([w / 2.0, h / 2.0, d * 0.8], [w * 0.56, h / 2.0, d], w * 0.035, 6);
}

fn apple(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xb5202a));
    let r = w / 2.0;
    let profile =
        [(0.0, 0.03), (0.35, 0.0), (0.8, 0.2), (1.0, 0.52), (0.85, 0.8), (0.4, 0.92), (0.0, 0.84)];
    s.lathe([r, h / 2.0], &profile.map(|(share, z)| (share * r, z * d)), 14);
    stalk(s, 0x4d3319);
}

fn orange(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xf28c1e));
    s.ball([0.0; 3], [w, h, d], 14);
}

fn lemon(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xe8e337));
    s.ball([w * 0.1, 0.0, 0.0], [w * 0.9, h, d], 14);
    for (from, to) in [(0.0, 0.16), (0.84, 1.0)] {
        s.ball([w * from, h * 0.35, d * 0.35], [w * to, h * 0.65, d * 0.65], 8);
    }
}

fn tomato(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xe02f1f));
    s.ball([0.0; 3], [w, h, d * 0.92], 14);
    stalk(s, 0x3f8a34);
}

fn bread(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xb5763a));
    let outline: Vec<[f64; 2]> = [
        [0.08, 0.0],
        [0.92, 0.0],
        [0.95, 0.55],
        [1.0, 0.72],
        [0.85, 0.93],
        [0.5, 1.0],
        [0.15, 0.93],
        [0.0, 0.72],
        [0.05, 0.55],
    ]
    .iter()
    .map(|[y, z]| [y * h, z * d])
    .collect();
    s.prism(0, &outline, [w * 0.02, w * 0.98]);
    s.paint(plain(0xf0d9a8));
    let inner: Vec<[f64; 2]> = outline
        .iter()
        .map(|[y, z]| [h / 2.0 + (y - h / 2.0) * 0.85, d / 2.0 + (z - d / 2.0) * 0.85])
        .collect();
    s.prism(0, &inner, [0.0, w * 0.02]);
    s.prism(0, &inner, [w * 0.98, w]);
}

fn cake(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (middle, r) = ([w / 2.0, h / 2.0], w / 2.0);
    s.paint(striped(0x8a4b2a, 0xf6e3c5, 2, d * 0.4));
    s.cylinder(middle, r * 0.97, [0.0, d * 0.75], 22);
    s.paint(plain(0xfbeef0));
    s.cylinder(middle, r, [d * 0.75, d * 0.88], 22);
    s.paint(plain(0xc2183a));
    s.ball([w * 0.44, h * 0.44, d * 0.86], [w * 0.56, h * 0.56, d], 8);
}

fn chicken(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xc07a35));
    s.ball([0.0, h * 0.1, 0.0], [w * 0.75, h * 0.9, d], 14);
    for y in [0.0, h * 0.65] {
        s.ball([w * 0.45, y, d * 0.1], [w * 0.88, y + h * 0.35, d * 0.6], 10);
    }
    s.paint(plain(0xf3ead6));
    for y in [h * 0.17, h * 0.83] {
        s.rod([w * 0.86, y, d * 0.35], [w, y, d * 0.35], d * 0.06, 6);
    }
}

fn cutlets(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xa5652b));
    s.ball([0.0, 0.0, 0.0], [w * 0.55, h * 0.9, d], 12);
    s.ball([w * 0.45, h * 0.1, 0.0], [w, h, d * 0.95], 12);
}

fn chips(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(striped(0xf2b705, 0xc8102e, 2, d));
    s.cushion([0.0, 0.0, 0.04 * d], [w, h, 0.96 * d], 12);
    s.block([w * 0.06, h * 0.45, 0.0], [w * 0.94, h * 0.55, d]);
}

fn cereal(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xe8731c));
    s.block([0.0, 0.002, 0.0], [w, h - 0.002, d]);
    s.paint(plain(0x1d4fa1));
    for (from, to) in [(0.0, 0.002), (h - 0.002, h)] {
        s.block([w * 0.08, from, d * 0.66], [w * 0.92, to, d * 0.92]);
    }
    s.paint(plain(0xfff3c4));
    for (from, to) in [(0.0, 0.002), (h - 0.002, h)] {
        s.block([w * 0.2, from, d * 0.12], [w * 0.8, to, d * 0.5]);
    }
}

fn milk(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(striped(0xffffff, 0x2f78c4, 2, d * 0.55));
    s.block([0.0, 0.0, 0.0], [w, h, d * 0.78]);
    s.prism(
        0,
        &[[0.0, d * 0.78], [h, d * 0.78], [h * 0.55, d * 0.94], [h * 0.45, d * 0.94]],
        [0.0, w],
    );
    s.block([0.0, h * 0.45, d * 0.94], [w, h * 0.55, d]);
}

fn can(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (middle, r) = ([w / 2.0, h / 2.0], w / 2.0);
    s.paint(plain(0x1f8a70));
    s.cylinder(middle, r, [d * 0.07, d * 0.93], 16);
    s.paint(plain(0xc4cacf));
    s.lathe(middle, &[(0.0, 0.0), (r * 0.85, 0.0), (r, d * 0.07), (0.0, d * 0.07)], 16);
    s.lathe(middle, &[(0.0, d * 0.93), (r, d * 0.93), (r * 0.85, d), (0.0, d)], 16);
}
