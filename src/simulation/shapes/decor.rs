//! What makes a home: plants, pictures, clocks, toys, boxes.

use super::paint::{checked, cloth, plain, striped, wood};
use super::sketch::Sketch;
use super::tableware::arc;
use super::{Class, class};

pub const CLASSES: &[Class] = &[
    class("plant", [0.4, 0.4, 0.8], "decoration", plant),
    class("vase", [0.14, 0.14, 0.28], "decoration", vase),
    class("candle", [0.06, 0.06, 0.12], "decoration", candle),
    class("painting", [0.8, 0.04, 0.55], "furniture", painting),
    class("picture frame", [0.16, 0.09, 0.2], "decoration", picture_frame),
    class("clock", [0.3, 0.05, 0.3], "furniture", clock),
    class("window", [1.2, 0.06, 1.1], "furniture", window),
    class("door", [0.9, 0.05, 2.0], "furniture", door),
    class("basket", [0.35, 0.25, 0.2], "appliance", basket),
    class("box", [0.35, 0.25, 0.22], "appliance", carton),
    class("ball", [0.22, 0.22, 0.22], "toy", ball),
    class("teddy bear", [0.26, 0.22, 0.32], "toy", teddy),
    class("guitar", [0.36, 0.11, 1.0], "toy", guitar),
    class("chessboard", [0.35, 0.35, 0.03], "toy", chessboard),
    class("watering can", [0.3, 0.14, 0.24], "decoration", watering_can),
];

/// A pot with leaves that lean outwards.
fn plant(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (x, y) = (w / 2.0, h / 2.0);
    let pot = d * 0.3;
    s.paint(plain(0x2f8f3e));
    for n in 0..9 {
        let angle = 2.4 * f64::from(n);
        let reach = w * (0.22 + 0.02 * f64::from(n % 4));
        let top = d * (0.62 + 0.04 * f64::from(n));
        let (cos, sin) = (libm::cos(angle), libm::sin(angle));
        let (near, far) =
            ([x + cos * reach * 0.5, y + sin * reach * 0.5], [x + cos * reach, y + sin * reach]);
        let bend = f64::midpoint(pot, top) + d * 0.08;
        s.tube(
            &[
                ([x + cos * 0.02, y + sin * 0.02, pot * 0.95], 0.008),
                ([near[0], near[1], bend], w * 0.075),
                ([far[0], far[1], top], w * 0.012),
            ],
            5,
        );
    }
    s.paint(plain(0xb4552d));
    let r = w * 0.28;
    s.lathe([x, y], &[(0.0, 0.0), (r * 0.75, 0.0), (r, pot), (0.0, pot)], 16);
    s.paint(plain(0x3b2a1c));
    s.cylinder([x, y], r * 0.85, [pot, pot + 0.005], 16);
}

fn vase(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let r = w / 2.0;
    s.paint(plain(0x1f7a8c));
    let outside = [(0.0, 0.0), (r * 0.5, 0.0), (r, d * 0.35), (r * 0.45, d * 0.75), (r * 0.62, d)];
    let inside = [(r * 0.52, d), (r * 0.36, d * 0.75), (0.0, d * 0.6)];
    s.lathe([r, h / 2.0], &[&outside[..], &inside[..]].concat(), 18);
}

fn candle(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let middle = [w / 2.0, h / 2.0];
    s.paint(plain(0xf4efe0));
    s.cylinder(middle, w / 2.0, [0.0, d * 0.8], 14);
    s.paint(plain(0xf6a01a));
    s.lathe(middle, &[(0.0, d * 0.8), (w * 0.09, d * 0.88), (0.0, d)], 8);
}

fn painting(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(wood(0x6b4f2a));
    s.block([0.0, h * 0.2, 0.0], [w, h, d]);
    let (low, high) = (d * 0.1, d * 0.9);
    s.paint(plain(0x86bbd8));
    s.block([w * 0.07, h * 0.1, d * 0.45], [w * 0.93, h * 0.2, high]);
    s.paint(plain(0x4f8a4c));
    s.block([w * 0.07, h * 0.1, low], [w * 0.93, h * 0.2, d * 0.45]);
    s.paint(plain(0xf6c945));
    s.rod([w * 0.75, h * 0.1, d * 0.7], [w * 0.75, 0.0, d * 0.7], d * 0.1, 14);
}

/// Stands, leaning back.
fn picture_frame(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xb8893b));
    s.prism(0, &[[0.0, 0.0], [h * 0.2, 0.0], [h * 0.7, d], [h * 0.5, d]], [0.0, w]);
    s.prism(
        0,
        &[[h * 0.9, 0.0], [h, 0.0], [h * 0.55, d * 0.7], [h * 0.45, d * 0.7]],
        [w * 0.4, w * 0.6],
    );
    s.paint(plain(0xe9c9b1));
    let lean = |z: f64| h * 0.5 * z / d;
    let (low, high) = (d * 0.12, d * 0.88);
    s.prism(
        0,
        &[
            [lean(low) - 0.002, low],
            [lean(low), low],
            [lean(high), high],
            [lean(high) - 0.002, high],
        ],
        [w * 0.12, w * 0.88],
    );
}

fn clock(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (x, z) = (w / 2.0, d / 2.0);
    s.paint(plain(0x24323e));
    s.rod([x, h, z], [x, h * 0.3, z], w / 2.0, 24);
    s.paint(plain(0xfbfbf6));
    s.rod([x, h * 0.3, z], [x, h * 0.15, z], w * 0.43, 24);
    s.paint(plain(0x111111));
    s.block([x - 0.006, 0.0, z], [x + 0.006, h * 0.15, z + d * 0.34]);
    s.block([x, 0.0, z - 0.006], [x + w * 0.24, h * 0.15, z + 0.006]);
    for (dx, dz) in [(0.0, 0.38), (0.0, -0.38), (0.38, 0.0), (-0.38, 0.0)] {
        let (cx, cz) = (x + w * dx, z + d * dz);
        s.block([cx - 0.008, h * 0.1, cz - 0.008], [cx + 0.008, h * 0.15, cz + 0.008]);
    }
}

fn window(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xfafafa));
    let bar = 0.05;
    s.block([0.0, 0.0, 0.0], [w, h, bar]);
    s.block([0.0, 0.0, d - bar], [w, h, d]);
    for x in [0.0, w / 2.0 - bar / 2.0, w - bar] {
        s.block([x, 0.0, bar], [x + bar, h, d - bar]);
    }
    s.paint(plain(0xbfe0f5));
    s.block([bar, h * 0.6, bar], [w - bar, h * 0.8, d - bar]);
}

fn door(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(wood(0xd9c6a5));
    s.block([0.0, h * 0.3, 0.0], [w, h, d]);
    s.paint(plain(0x8e99a1));
    s.block([w * 0.86, 0.0, d * 0.5], [w * 0.96, h * 0.3, d * 0.52]);
}

fn basket(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (wall, rim) = (0.02, d * 0.6);
    s.paint(striped(0xb07d3c, 0x8a5f2a, 2, 0.04));
    s.block([0.0, 0.0, 0.0], [w, h, wall]);
    s.block([0.0, 0.0, wall], [wall, h, rim]);
    s.block([w - wall, 0.0, wall], [w, h, rim]);
    s.block([wall, 0.0, wall], [w - wall, wall, rim]);
    s.block([wall, h - wall, wall], [w - wall, h, rim]);
    s.surface("inside", [wall + 0.01, wall + 0.01], [w - wall - 0.01, h - wall - 0.01], wall, None);
    s.paint(plain(0x6e4a1f));
    let grip: Vec<_> =
        arc([w / 2.0, h / 2.0, rim * 0.9], [w / 2.0 - 0.01, d - rim * 0.9 - 0.01], 0.0, 3.1416, 10)
            .into_iter()
            .map(|at| (at, 0.01))
            .collect();
    s.tube(&grip, 6);
}

fn carton(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xb98d5a));
    s.block([0.0; 3], [w, h, d * 0.985]);
    s.top("top", [0.0; 3], [w, h, d], None);
    s.paint(plain(0xe3d3a8));
    s.block([0.0, h * 0.42, d * 0.985], [w, h * 0.58, d]);
}

fn ball(s: &mut Sketch) {
    let max = s.size;
    s.paint(checked(0xf4f4f4, 0xd62828, max[0] / 3.0));
    s.ball([0.0; 3], max, 16);
}

/// Sitting, facing the front.
fn teddy(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(cloth(0xa9743f));
    s.ball([w * 0.2, h * 0.25, 0.0], [w * 0.8, h, d * 0.6], 12);
    s.ball([w * 0.25, h * 0.3, d * 0.52], [w * 0.75, h * 0.9, d * 0.94], 12);
    for x in [0.18, 0.62] {
        s.ball([w * x, h * 0.5, d * 0.82], [w * (x + 0.2), h * 0.7, d], 8);
        s.ball([w * x, 0.0, 0.0], [w * (x + 0.2), h * 0.6, d * 0.2], 8);
    }
    for x in [0.0, 0.76] {
        s.ball([w * x, h * 0.3, d * 0.25], [w * (x + 0.24), h * 0.6, d * 0.5], 8);
    }
    s.paint(plain(0x1d120a));
    for x in [0.38, 0.55] {
        s.ball([w * x, h * 0.28, d * 0.76], [w * (x + 0.07), h * 0.36, d * 0.81], 6);
    }
    s.paint(plain(0xe6cfa8));
    s.ball([w * 0.4, h * 0.2, d * 0.6], [w * 0.6, h * 0.45, d * 0.73], 8);
}

/// Upright, its strings to the front.
fn guitar(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(wood(0xc67b30));
    let rounded = |cz: f64, rx: f64, rz: f64| -> Vec<[f64; 2]> {
        arc([w / 2.0, 0.0, cz], [rx, rz], 0.0, 5.9, 15).into_iter().map(|p| [p[0], p[2]]).collect()
    };
    s.prism(1, &rounded(d * 0.19, w / 2.0, d * 0.19), [h * 0.2, h]);
    s.prism(1, &rounded(d * 0.4, w * 0.38, d * 0.14), [h * 0.2, h]);
    s.paint(plain(0x1c120b));
    s.rod([w / 2.0, h * 0.2, d * 0.32], [w / 2.0, h * 0.15, d * 0.32], w * 0.14, 14);
    s.paint(wood(0x4b2e17));
    s.block([w * 0.44, h * 0.05, d * 0.4], [w * 0.56, h * 0.35, d * 0.88]);
    s.block([w * 0.4, 0.0, d * 0.88], [w * 0.6, h * 0.3, d]);
}

fn chessboard(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(checked(0xf0d9b5, 0x6d4526, w / 8.0));
    s.block([0.0; 3], [w, h, d]);
    s.top("top", [0.0; 3], [w, h, d], None);
}

/// Spout to −x, handle to +x.
fn watering_can(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (x, y, r) = (w * 0.55, h / 2.0, h / 2.0);
    s.paint(plain(0x3f9c5a));
    s.cylinder([x, y], r, [0.0, d * 0.68], 16);
    s.tube(
        &[
            ([x - r * 0.8, y, d * 0.2], 0.015),
            ([0.04, y, d * 0.75], 0.01),
            ([0.0, y, d * 0.8], 0.025),
        ],
        8,
    );
    let grip: Vec<_> =
        arc([x + r * 0.3, y, d * 0.6], [w - x - r * 0.3 - 0.008, d * 0.4 - 0.008], -0.9, 2.2, 8)
            .into_iter()
            .map(|at| (at, 0.008))
            .collect();
    s.tube(&grip, 6);
}
