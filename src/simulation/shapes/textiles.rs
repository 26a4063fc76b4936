//! Cloth, clothes, and things to wear or carry.

use super::paint::{checked, cloth, plain, striped};
use super::sketch::Sketch;
use super::tableware::arc;
use super::{Class, class};

pub const CLASSES: &[Class] = &[
    class("pillow", [0.5, 0.35, 0.14], "textile", pillow),
    class("blanket", [0.5, 0.4, 0.12], "textile", blanket),
    class("rug", [1.8, 1.2, 0.012], "furniture", rug),
    class("curtain", [1.2, 0.12, 2.1], "furniture", curtain),
    class("clothes", [0.4, 0.35, 0.12], "clothing", clothes),
    class("hanger", [0.42, 0.03, 0.22], "clothing", hanger),
    class("shoes", [0.22, 0.28, 0.11], "clothing", shoes),
    class("hat", [0.28, 0.28, 0.13], "clothing", hat),
    class("backpack", [0.32, 0.22, 0.45], "clothing", backpack),
    class("umbrella", [0.75, 0.09, 0.09], "clothing", umbrella),
];

fn pillow(s: &mut Sketch) {
    s.paint(cloth(0xd8a7b1));
    let max = s.size;
    s.cushion([0.0; 3], max, 12);
}

fn blanket(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(checked(0xb23a48, 0xf0e3d0, 0.06));
    let layer = d / 3.0;
    for n in 0..3 {
        let z = layer * f64::from(n);
        let inset = 0.01 * f64::from(n);
        s.block([inset, layer / 2.0, z], [w - inset, h, z + layer * 0.92]);
        s.rod(
            [inset, layer / 2.0, z + layer * 0.46],
            [w - inset, layer / 2.0, z + layer * 0.46],
            layer * 0.46,
            10,
        );
    }
}

fn rug(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(striped(0x8f3b3b, 0xd9b98a, 0, w / 6.0));
    s.block([0.0, 0.0, 0.0], [w, h, d * 0.9]);
    s.surface("top", [0.02, 0.02], [w - 0.02, h - 0.02], d, None);
    s.paint(cloth(0x5c2a3a));
    s.block([w * 0.12, h * 0.15, d * 0.9], [w * 0.88, h * 0.85, d]);
}

fn curtain(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(cloth(0xc9b458));
    let waves = 24;
    let edge = |n: u32, y: f64| {
        let share = f64::from(n) / f64::from(waves);
        [w * share, h * (y + 0.28 * libm::sin(share * 31.4))]
    };
    let front = (0..=waves).map(|n| edge(n, 0.4));
    let outline: Vec<[f64; 2]> = front.chain((0..=waves).rev().map(|n| edge(n, 0.6))).collect();
    s.prism(2, &outline, [0.0, d * 0.97]);
    s.paint(plain(0x4d3b2a));
    s.rod([0.0, h / 2.0, d * 0.985], [w, h / 2.0, d * 0.985], d * 0.015, 8);
}

fn clothes(s: &mut Sketch) {
    let [w, h, d] = s.size;
    for (n, colour) in [0x3a6ea5, 0xc44536, 0xe9d8a6].into_iter().enumerate() {
        let (z, inset) = (d / 3.0 * n as f64, 0.02 * n as f64);
        s.paint(cloth(colour));
        s.cushion([inset, inset, z], [w - inset, h - inset, z + d / 3.0], 8);
    }
}

fn hanger(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let r = h / 2.0;
    s.paint(plain(0xb58550));
    let corners = [[r, r, r], [w - r, r, r], [w / 2.0, r, d * 0.5], [r, r, r]];
    for pair in corners.windows(2) {
        s.rod(pair[0], pair[1], r * 0.8, 6);
    }
    s.paint(plain(0x8e99a1));
    let hook: Vec<_> = arc([w / 2.0, r, d * 0.78], [w * 0.09, d * 0.2], -1.57, 2.8, 8)
        .into_iter()
        .map(|at| (at, 0.004))
        .collect();
    s.tube(&hook, 6);
    s.rod([w / 2.0, r, d * 0.48], [w / 2.0, r, d * 0.6], r, 6);
}

/// A pair, toes to the front.
fn shoes(s: &mut Sketch) {
    let [w, h, d] = s.size;
    for x in [0.0, w * 0.54] {
        let wide = w * 0.46;
        s.paint(plain(0x2f5233));
        s.prism(
            0,
            &[
                [0.0, d * 0.15],
                [h, d * 0.15],
                [h, d],
                [h * 0.62, d],
                [h * 0.4, d * 0.6],
                [h * 0.05, d * 0.45],
            ],
            [x + wide * 0.05, x + wide * 0.95],
        );
        s.paint(plain(0xf2f2ee));
        s.block([x, 0.0, 0.0], [x + wide, h, d * 0.15]);
    }
}

fn hat(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (middle, r) = ([w / 2.0, h / 2.0], w / 2.0);
    s.paint(cloth(0x7a6a4f));
    s.lathe(
        middle,
        &[(0.0, 0.0), (r, 0.0), (r, d * 0.1), (r * 0.6, d * 0.12), (r * 0.52, d * 0.9), (0.0, d)],
        20,
    );
    s.paint(plain(0x30241a));
    s.ring(middle, [r * 0.5, r * 0.62], [d * 0.12, d * 0.32], 20);
}

fn backpack(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(cloth(0x2b4c7e));
    s.cushion([0.0, h * 0.2, 0.0], [w, h * 0.9, d * 0.95], 12);
    s.paint(cloth(0xe0a030));
    s.cushion([w * 0.15, 0.0, d * 0.08], [w * 0.85, h * 0.45, d * 0.5], 12);
    s.paint(plain(0x1a1a1a));
    let grip: Vec<_> = arc([w / 2.0, h * 0.6, d * 0.9], [w * 0.1, d * 0.09], 0.0, 3.14, 6)
        .into_iter()
        .map(|at| (at, d * 0.012))
        .collect();
    s.tube(&grip, 6);
    for x in [w * 0.2, w * 0.7] {
        s.block([x, h * 0.85, d * 0.15], [x + w * 0.1, h, d * 0.8]);
    }
}

/// Lying, closed, its grip at −x.
fn umbrella(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (y, z) = (h / 2.0, d / 2.0);
    s.paint(striped(0x6a2c70, 0xf08a5d, 0, w / 8.0));
    s.tube(
        &[([w * 0.25, y, z], d * 0.5), ([w * 0.4, y, z], d * 0.42), ([w * 0.95, y, z], 0.01)],
        12,
    );
    s.paint(plain(0x3c2a1e));
    s.rod([0.0, y, z], [w * 0.25, y, z], d * 0.14, 8);
    s.rod([w * 0.95, y, z], [w, y, z], 0.006, 6);
}
