//! Large things of a kitchen: machines, counters, the pantry.

use super::paint::{plain, wood};
use super::sketch::Sketch;
use super::{Class, class};

pub const CLASSES: &[Class] = &[
    class("refrigerator", [0.7, 0.68, 1.8], "furniture", refrigerator),
    class("pantry", [0.9, 0.45, 2.0], "furniture", pantry),
    class("stove", [0.6, 0.62, 0.92], "furniture", stove),
    class("counter", [1.6, 0.62, 0.92], "furniture", counter),
    class("sink", [0.8, 0.62, 1.15], "furniture", sink),
    class("dishwasher", [0.6, 0.6, 0.86], "furniture", dishwasher),
    class("washing machine", [0.6, 0.58, 0.85], "furniture", washing_machine),
    class("wall cabinet", [0.9, 0.34, 0.65], "furniture", wall_cabinet),
    class("extractor hood", [0.6, 0.45, 0.5], "furniture", extractor_hood),
    class("microwave", [0.48, 0.36, 0.28], "appliance", microwave),
    class("toaster", [0.3, 0.18, 0.19], "appliance", toaster),
    class("coffee machine", [0.2, 0.3, 0.34], "appliance", coffee_machine),
    class("bin", [0.3, 0.3, 0.45], "appliance", bin),
    class("radiator", [1.0, 0.1, 0.6], "furniture", radiator),
];

const STEEL: u32 = 0xaeb6bd;
const DARK: u32 = 0x24282c;

fn refrigerator(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xd8dde1));
    s.block([0.0, 0.06, 0.0], [w, h, d]);
    s.top("top", [0.0, 0.06, 0.0], [w, h, d], None);
    s.block([0.0, 0.025, 0.05], [w, 0.06, d * 0.36]);
    s.block([0.0, 0.025, d * 0.37], [w, 0.06, d]);
    s.paint(plain(0x6a727a));
    s.block([w * 0.06, 0.0, d * 0.2], [w * 0.1, 0.025, d * 0.34]);
    s.block([w * 0.06, 0.0, d * 0.4], [w * 0.1, 0.025, d * 0.62]);
}

/// Doors below, open boards above.
fn pantry(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (side, low) = (0.03, d * 0.42);
    s.paint(wood(0xe6d3b0));
    s.block([0.0, 0.02, 0.0], [w, h, low]);
    s.block([0.0, 0.02, low], [side, h, d]);
    s.block([w - side, 0.02, low], [w, h, d]);
    s.block([side, h - 0.02, low], [w - side, h, d - side]);
    s.block([side, 0.02, d - side], [w - side, h, d]);
    let step = (d - low) / 3.0;
    for n in 0..3 {
        let z = low + step * f64::from(n);
        if n > 0 {
            s.block([side, 0.03, z - 0.02], [w - side, h - 0.02, z]);
        }
        let free = step - if n == 2 { side } else { 0.02 };
        let (min, max) = ([side + 0.01, 0.04], [w - side - 0.01, h - 0.03]);
        s.surface(&format!("shelf {}", n + 1), min, max, z, Some(free));
    }
    s.paint(wood(0x7d9a74));
    for x in [0.0, w / 2.0] {
        s.block([x + 0.008, 0.01, 0.05], [x + w / 2.0 - 0.008, 0.02, low - 0.015]);
    }
    s.paint(plain(DARK));
    for x in [w / 2.0 - 0.05, w / 2.0 + 0.03] {
        s.block([x, 0.0, low * 0.6], [x + 0.02, 0.01, low * 0.8]);
    }
}

fn stove(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xe8e8e6));
    s.block([0.0, 0.03, 0.0], [w, h, d - 0.012]);
    s.paint(plain(DARK));
    s.block([0.0, 0.03, d - 0.012], [w, h, d - 0.006]);
    s.surface("top", [0.03, 0.05], [w - 0.03, h - 0.03], d, None);
    s.block([w * 0.1, 0.02, d * 0.25], [w * 0.9, 0.03, d * 0.66]);
    s.paint(plain(0x8b3a2e));
    for (x, y, r) in
        [(0.27, 0.3, 0.09), (0.73, 0.3, 0.075), (0.27, 0.73, 0.075), (0.73, 0.73, 0.09)]
    {
        s.cylinder([w * x, 0.03 + (h - 0.03) * y], r, [d - 0.006, d], 16);
    }
    s.paint(plain(0x55595d));
    s.block([w * 0.12, 0.0, d * 0.7], [w * 0.88, 0.02, d * 0.725]);
    for n in 0..4 {
        let x = w * (0.2 + 0.2 * f64::from(n));
        s.rod([x, 0.03, d * 0.86], [x, 0.008, d * 0.86], 0.02, 8);
    }
}

/// Cupboards under a worktop that reaches over them.
fn cupboards(s: &mut Sketch, top: f64) {
    let [w, h, _] = s.size;
    s.paint(plain(0xdfe5df));
    s.block([0.0, 0.08, 0.0], [w, h, 0.09]);
    s.block([0.0, 0.04, 0.09], [w, h, top - 0.04]);
    let doors = (w / 0.5).round().max(1.0);
    let wide = w / doors;
    for n in 0..doors as u32 {
        let x = wide * f64::from(n);
        s.paint(plain(0xf3f5f1));
        s.block([x + 0.008, 0.03, 0.11], [x + wide - 0.008, 0.04, top - 0.06]);
        s.paint(plain(0x4b5055));
        s.block([x + wide * 0.75, 0.015, top * 0.72], [x + wide * 0.9, 0.03, top * 0.74]);
    }
}

fn counter(s: &mut Sketch) {
    let [w, h, d] = s.size;
    cupboards(s, d);
    s.paint(wood(0x8c6a48));
    s.block([0.0, 0.0, d - 0.04], [w, h, d]);
    s.top("top", [0.0; 3], [w, h, d], None);
}

/// A basin let into a worktop, with a tap behind it.
fn sink(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (top, floor) = (d * 0.8, d * 0.66);
    cupboards(s, floor);
    s.paint(plain(STEEL));
    let [left, right, front, back] = [w * 0.15, w * 0.85, h * 0.16, h * 0.74];
    s.block([0.0, 0.0, floor], [w, front, top]);
    s.block([0.0, back, floor], [w, h, top]);
    s.block([0.0, front, floor], [left, back, top]);
    s.block([right, front, floor], [w, back, top]);
    s.paint(plain(0x7e878e));
    s.block([left, front, floor - 0.02], [right, back, floor + 0.004]);
    let (min, max) = ([left + 0.02, front + 0.02], [right - 0.02, back - 0.02]);
    s.surface("basin", min, max, floor + 0.004, Some(d - floor));
    tap(s, [w / 2.0, h * 0.88, top], h * 0.35, d - top);
}

/// A tap that rises from a point, bends over and ends `reach` further to the front.
fn tap(s: &mut Sketch, [x, y, z]: [f64; 3], reach: f64, high: f64) {
    s.paint(plain(0xe3e8ec));
    let path: Vec<([f64; 3], f64)> = (0..=6)
        .map(|n| {
            let angle = std::f64::consts::PI * f64::from(n) / 6.0;
            let (along, up) = (1.0 - libm::cos(angle), libm::sin(angle));
            ([x, y - reach * along / 2.0, z + high * 0.55 + (high * 0.45 - 0.012) * up], 0.012)
        })
        .collect();
    let mut all = vec![([x, y, z], 0.014)];
    all.extend(path);
    s.tube(&all, 8);
}

fn dishwasher(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(STEEL));
    s.block([0.0, 0.02, 0.0], [w, h, d]);
    s.top("top", [0.0, 0.02, 0.0], [w, h, d], None);
    s.paint(plain(0xc7cdd2));
    s.block([0.01, 0.01, 0.09], [w - 0.01, 0.02, d * 0.84]);
    s.paint(plain(DARK));
    s.block([0.01, 0.01, d * 0.86], [w - 0.01, 0.02, d - 0.01]);
    s.block([w * 0.2, 0.0, d * 0.78], [w * 0.8, 0.01, d * 0.81]);
}

fn washing_machine(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xf4f4f2));
    s.block([0.0, 0.03, 0.0], [w, h, d]);
    s.top("top", [0.0, 0.03, 0.0], [w, h, d], None);
    s.paint(plain(0x9aa4ad));
    let (middle, r) = ([w / 2.0, d * 0.45], w * 0.3);
    disc(s, middle, r, [0.012, 0.03]);
    s.paint(plain(0x223344));
    disc(s, middle, r * 0.75, [0.0, 0.012]);
    s.paint(plain(0x40505e));
    s.block([w * 0.5, 0.018, d * 0.86], [w * 0.94, 0.03, d * 0.95]);
}

/// A disc that faces the front, between two y.
fn disc(s: &mut Sketch, [x, z]: [f64; 2], r: f64, y: [f64; 2]) {
    s.rod([x, y[1], z], [x, y[0], z], r, 20);
}

fn wall_cabinet(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xf3f5f1));
    s.block([0.0, 0.02, 0.0], [w, h, d]);
    s.paint(plain(0xd4dcd4));
    for x in [0.0, w / 2.0] {
        s.block([x + 0.01, 0.01, 0.01], [x + w / 2.0 - 0.01, 0.02, d - 0.01]);
    }
    s.paint(plain(0x4b5055));
    for x in [w / 2.0 - 0.06, w / 2.0 + 0.04] {
        s.block([x, 0.0, 0.04], [x + 0.02, 0.01, 0.16]);
    }
}

fn extractor_hood(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(STEEL));
    s.prism(
        0,
        &[[0.0, 0.0], [h, 0.0], [h, d * 0.45], [h * 0.5, d * 0.45], [0.0, d * 0.15]],
        [0.0, w],
    );
    s.block([w * 0.3, h * 0.45, d * 0.45], [w * 0.7, h, d]);
}

fn microwave(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xcfd3d6));
    s.block([0.0, 0.02, 0.0], [w, h, d]);
    s.top("top", [0.0, 0.02, 0.0], [w, h, d], None);
    s.paint(plain(0x15181b));
    s.block([0.02, 0.01, 0.03], [w * 0.7, 0.02, d - 0.03]);
    s.paint(plain(0x3a4046));
    s.block([w * 0.74, 0.01, 0.03], [w - 0.02, 0.02, d - 0.03]);
    s.paint(plain(0x6fe08a));
    s.block([w * 0.77, 0.005, d * 0.72], [w - 0.05, 0.01, d * 0.85]);
    s.paint(plain(0xe8ecef));
    s.block([w * 0.66, 0.0, 0.05], [w * 0.69, 0.01, d - 0.05]);
}

fn toaster(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xc23b32));
    let (r, slot) = (d * 0.25, h * 0.12);
    let outline = [
        [0.0, 0.0],
        [h, 0.0],
        [h, d - r],
        [h - r * 0.4, d * 0.97],
        [r * 0.4, d * 0.97],
        [0.0, d - r],
    ];
    s.prism(0, &outline, [0.02, w]);
    s.paint(plain(DARK));
    for y in [0.3, 0.58] {
        s.block([w * 0.15, h * y, d * 0.96], [w * 0.85, h * y + slot, d]);
    }
    s.block([0.0, h * 0.4, d * 0.55], [0.02, h * 0.6, d * 0.65]);
}

fn coffee_machine(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0x2b2522));
    s.block([0.0, 0.0, 0.0], [w, h, d * 0.12]);
    s.block([0.0, h * 0.6, d * 0.12], [w, h, d]);
    s.block([0.0, 0.0, d * 0.68], [w, h * 0.6, d]);
    s.paint(plain(0xb98a4e));
    s.lathe(
        [w / 2.0, h * 0.3],
        &[
            (0.0, d * 0.12),
            (w * 0.34, d * 0.12),
            (w * 0.38, d * 0.3),
            (w * 0.26, d * 0.5),
            (0.0, d * 0.5),
        ],
        12,
    );
    s.paint(plain(0xd23b2f));
    s.block([w * 0.42, -0.006, d * 0.8], [w * 0.58, 0.0, d * 0.87]);
}

fn bin(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (middle, r) = ([w / 2.0, h / 2.0], w / 2.0);
    s.paint(plain(0x5b6770));
    s.lathe(middle, &[(0.0, 0.0), (r * 0.8, 0.0), (r * 0.98, d * 0.82), (0.0, d * 0.82)], 18);
    s.paint(plain(0x2f363b));
    s.lathe(middle, &[(0.0, d * 0.82), (r, d * 0.82), (r, d * 0.9), (r * 0.5, d), (0.0, d)], 18);
}

fn radiator(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xf7f7f4));
    let count = 10;
    let step = w / f64::from(count);
    for n in 0..count {
        let x = step * f64::from(n);
        s.block([x, 0.0, 0.0], [x + step * 0.7, h, d]);
    }
    for z in [0.1, 0.82] {
        s.block([0.01, h * 0.3, d * z], [w - 0.01, h * 0.7, d * (z + 0.08)]);
    }
}
