//! Things of a bathroom.

use super::paint::{cloth, plain, striped};
use super::sketch::Sketch;
use super::{Class, class};

pub const CLASSES: &[Class] = &[
    class("toilet", [0.4, 0.68, 0.8], "furniture", toilet),
    class("bathtub", [1.7, 0.75, 0.58], "furniture", bathtub),
    class("washbasin", [0.6, 0.48, 0.9], "furniture", washbasin),
    class("shower", [0.9, 0.9, 2.0], "furniture", shower),
    class("stall", [0.9, 0.9, 2.0], "furniture", shower),
    class("mirror", [0.6, 0.04, 0.8], "furniture", mirror),
    class("tap", [0.06, 0.16, 0.2], "furniture", tap),
    class("towel", [0.5, 0.08, 0.7], "textile", towel),
    class("folded towel", [0.34, 0.24, 0.09], "textile", folded_towel),
    class("toilet paper", [0.11, 0.11, 0.1], "toiletry", toilet_paper),
    class("soap", [0.09, 0.06, 0.03], "toiletry", soap),
    class("shampoo", [0.07, 0.045, 0.2], "toiletry", shampoo),
    class("toothbrush", [0.19, 0.014, 0.02], "toiletry", toothbrush),
    class("toothpaste", [0.17, 0.05, 0.035], "toiletry", toothpaste),
    class("jar", [0.07, 0.07, 0.06], "toiletry", jar),
    class("laundry basket", [0.45, 0.35, 0.55], "appliance", laundry_basket),
    class("scale", [0.3, 0.3, 0.04], "appliance", scale),
];

const CERAMIC: u32 = 0xf6f8f9;

/// An oval bowl on a foot, a lid, a cistern behind.
fn toilet(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (seat, cistern) = (d * 0.52, h * 0.72);
    s.paint(plain(CERAMIC));
    s.lathe(
        [w / 2.0, cistern - w / 2.0],
        &[
            (0.0, 0.0),
            (w * 0.28, 0.0),
            (w * 0.24, seat * 0.5),
            (w * 0.48, seat * 0.93),
            (0.0, seat * 0.93),
        ],
        20,
    );
    s.block([w * 0.24, cistern - w * 0.5, 0.0], [w * 0.76, h, seat * 0.9]);
    s.block([0.0, cistern, seat * 0.9], [w, h, d * 0.95]);
    s.paint(plain(0xdde4e8));
    s.lathe(
        [w / 2.0, cistern - w / 2.0],
        &[(0.0, seat * 0.93), (w * 0.5, seat * 0.93), (w * 0.5, seat), (0.0, seat)],
        20,
    );
    s.block([0.0, cistern - 0.005, d * 0.95], [w, h, d]);
    // The bowl is drawn round, and reaches to the front.
    s.block([w * 0.3, 0.0, seat * 0.93], [w * 0.7, cistern - w / 2.0, seat]);
    s.surface("cistern", [0.02, cistern + 0.01], [w - 0.02, h - 0.01], d, None);
}

fn bathtub(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (rim, floor) = (0.08, d * 0.25);
    s.paint(plain(CERAMIC));
    s.block([0.0, 0.0, floor], [rim, h, d]);
    s.block([w - rim, 0.0, floor], [w, h, d]);
    s.block([rim, 0.0, floor], [w - rim, rim, d]);
    s.block([rim, h - rim, floor], [w - rim, h, d]);
    s.surface("rim", [0.01, 0.005], [w - 0.01, rim - 0.005], d, None);
    s.paint(plain(0xcfdde6));
    s.block([0.0, 0.0, 0.0], [w, h, floor]);
    s.surface("bottom", [rim + 0.02, rim + 0.02], [w - rim - 0.02, h - rim - 0.02], floor, None);
    s.paint(plain(0x9aa4ad));
    s.rod([rim * 0.5, h / 2.0, d * 0.98], [rim * 1.6, h / 2.0, d * 0.98], d * 0.02, 8);
}

/// A basin on a column, with a tap.
fn washbasin(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let top = d * 0.86;
    s.paint(plain(CERAMIC));
    s.lathe(
        [w / 2.0, h * 0.6],
        &[(0.0, 0.0), (w * 0.2, 0.0), (w * 0.13, top * 0.75), (0.0, top * 0.75)],
        16,
    );
    s.block([w * 0.1, h * 0.1, top * 0.75], [w * 0.9, h, top * 0.86]);
    let [left, right, front, back] = [w * 0.12, w * 0.88, h * 0.12, h * 0.62];
    s.block([0.0, 0.0, top * 0.86], [w, front, top]);
    s.block([0.0, back, top * 0.86], [w, h, top]);
    s.block([0.0, front, top * 0.86], [left, back, top]);
    s.block([right, front, top * 0.86], [w, back, top]);
    s.surface("edge", [0.01, back + 0.01], [w * 0.42, h - 0.01], top, None);
    s.paint(plain(0x9fb0bb));
    s.block([left, front, top * 0.84], [right, back, top * 0.87]);
    s.paint(plain(0xb9c2c9));
    s.rod([w / 2.0, h * 0.85, top], [w / 2.0, h * 0.85, d - 0.02], 0.015, 8);
    s.block([w / 2.0 - 0.012, h * 0.5, d - 0.02], [w / 2.0 + 0.012, h * 0.88, d]);
}

fn shower(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xb9d6df));
    s.block([0.0, 0.0, 0.08], [0.015, h, d]);
    s.block([0.015, 0.0, 0.08], [w * 0.55, 0.015, d]);
    s.paint(plain(CERAMIC));
    s.block([0.0, 0.0, 0.0], [w, h, 0.08]);
    s.surface("floor", [0.05, 0.05], [w - 0.05, h - 0.05], 0.08, None);
    s.paint(plain(0x8e99a1));
    s.rod([w * 0.8, h - 0.03, 0.9], [w * 0.8, h - 0.03, d * 0.94], 0.012, 8);
    s.rod([w * 0.8, h - 0.03, d * 0.94], [w * 0.8, h - 0.3, d * 0.97], 0.012, 8);
    s.cylinder([w * 0.8, h - 0.3], 0.09, [d * 0.96, d], 16);
}

fn mirror(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0x8a6f4d));
    s.block([0.0, 0.006, 0.0], [w, h, d]);
    s.paint(plain(0xc4dbe6));
    s.block([0.03, 0.0, 0.03], [w - 0.03, 0.006, d - 0.03]);
}

fn tap(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xb9c2c9));
    s.cylinder([w / 2.0, h * 0.85], w * 0.3, [0.0, d * 0.8], 10);
    s.block([w * 0.3, 0.0, d * 0.7], [w * 0.7, h, d * 0.85]);
    s.block([0.0, h * 0.75, d * 0.85], [w, h, d]);
}

/// Hung over a rail at its upper end: two waving sheets, the one in front longer.
fn towel(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(striped(0x2a9d8f, 0xf4f1de, 2, d / 3.0));
    let wave = |front: f64, back: f64| -> Vec<[f64; 2]> {
        let at = |n: u32, y: f64| {
            let share = f64::from(n) / 12.0;
            [w * share, h * (y + 0.12 * libm::sin(share * 14.0))]
        };
        let ahead = (0..=12).map(|n| at(n, front));
        ahead.chain((0..=12).rev().map(|n| at(n, back))).collect()
    };
    s.prism(2, &wave(0.14, 0.32), [0.0, d * 0.93]);
    s.prism(2, &wave(0.66, 0.84), [d * 0.25, d * 0.93]);
    s.paint(plain(0x8e99a1));
    s.rod([0.0, h * 0.5, d * 0.96], [w, h * 0.5, d * 0.96], d * 0.04, 8);
}

fn folded_towel(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(cloth(0x2a9d8f));
    let r = d / 6.0;
    for n in 0..3 {
        let z = r + 2.0 * r * f64::from(n);
        s.block([0.0, r, z - r], [w, h, z + r * 0.9]);
        s.rod([0.0, r, z - r * 0.05], [w, r, z - r * 0.05], r * 0.95, 10);
    }
}

/// A roll on its end.
fn toilet_paper(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (middle, r) = ([w / 2.0, h / 2.0], w / 2.0);
    s.paint(plain(0xfbfaf5));
    s.ring(middle, [r * 0.36, r], [0.0, d], 18);
    s.paint(plain(0xb08d62));
    s.ring(middle, [r * 0.3, r * 0.36], [0.0, d], 18);
}

fn soap(s: &mut Sketch) {
    s.paint(plain(0xe79ab0));
    let max = s.size;
    s.cushion([0.0; 3], max, 12);
}

fn shampoo(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0x8e5fb0));
    let (middle, r) = ([w / 2.0, h / 2.0], w / 2.0);
    s.lathe(middle, &[(0.0, 0.0), (r, 0.0), (r, d * 0.7), (r * 0.4, d * 0.8), (0.0, d * 0.8)], 14);
    s.paint(plain(0xf2e9f7));
    s.cylinder(middle, r * 0.45, [d * 0.8, d], 12);
    s.block([0.0, -0.001, d * 0.25], [w, h * 0.1, d * 0.5]);
}

/// Lying along x, its bristles up.
fn toothbrush(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0x2f7fd0));
    s.block([0.0, 0.0, 0.0], [w * 0.55, h, d * 0.45]);
    s.block([w * 0.55, h * 0.3, 0.0], [w, h * 0.7, d * 0.35]);
    s.paint(plain(0xffffff));
    s.block([w * 0.82, h * 0.1, d * 0.35], [w, h * 0.9, d]);
}

fn toothpaste(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(striped(0xffffff, 0xd2322d, 0, w / 2.0));
    s.prism(1, &[[0.0, d * 0.4], [w * 0.86, 0.0], [w * 0.86, d], [0.0, d * 0.6]], [0.0, h]);
    s.paint(plain(0x3060b0));
    s.rod([w * 0.86, h / 2.0, d / 2.0], [w, h / 2.0, d / 2.0], d * 0.38, 10);
}

fn jar(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (middle, r) = ([w / 2.0, h / 2.0], w / 2.0);
    s.paint(plain(0xf1e4d4));
    s.cylinder(middle, r * 0.94, [0.0, d * 0.65], 16);
    s.paint(plain(0xc98d5b));
    s.cylinder(middle, r, [d * 0.65, d], 16);
}

fn laundry_basket(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(striped(0xc9a26b, 0xa37d49, 2, 0.05));
    let wall = 0.02;
    s.block([0.0, 0.0, 0.0], [w, h, wall]);
    s.block([0.0, 0.0, wall], [wall, h, d]);
    s.block([w - wall, 0.0, wall], [w, h, d]);
    s.block([wall, 0.0, wall], [w - wall, wall, d]);
    s.block([wall, h - wall, wall], [w - wall, h, d]);
    s.paint(cloth(0xe8e0d0));
    s.cushion([wall, wall, d * 0.5], [w - wall, h - wall, d * 0.92], 12);
}

fn scale(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0x39424b));
    s.block([0.0, 0.0, 0.0], [w, h, d * 0.95]);
    s.paint(plain(0xa8e0b8));
    s.block([w * 0.35, h * 0.75, d * 0.95], [w * 0.65, h * 0.9, d]);
}
