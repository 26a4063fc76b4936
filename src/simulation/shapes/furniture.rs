//! Tables, seats, beds, cupboards.

use super::paint::{cloth, plain, wood};
use super::sketch::Sketch;
use super::{Class, class};

pub const CLASSES: &[Class] = &[
    class("table", [1.2, 0.8, 0.74], "furniture", table),
    class("coffee table", [1.0, 0.55, 0.42], "furniture", coffee_table),
    class("desk", [1.4, 0.65, 0.74], "furniture", desk),
    class("nightstand", [0.45, 0.4, 0.5], "furniture", nightstand),
    class("chair", [0.45, 0.48, 0.9], "furniture", chair),
    class("stool", [0.35, 0.35, 0.6], "furniture", stool),
    class("bench", [1.1, 0.38, 0.45], "furniture", bench),
    class("armchair", [0.85, 0.85, 0.9], "furniture", armchair),
    class("sofa", [2.0, 0.9, 0.85], "furniture", sofa),
    class("bed", [1.6, 2.05, 0.95], "furniture", bed),
    class("wardrobe", [1.2, 0.6, 2.0], "furniture", wardrobe),
    class("dresser", [1.0, 0.48, 0.85], "furniture", dresser),
    class("bookshelf", [0.9, 0.32, 1.8], "furniture", bookshelf),
    class("wall shelf", [0.8, 0.22, 0.04], "furniture", wall_shelf),
    class("tv stand", [1.4, 0.42, 0.5], "furniture", tv_stand),
    class("shoe rack", [0.8, 0.32, 0.55], "furniture", shoe_rack),
];

/// Four upright legs from the floor to `z`, `inset` from the edges.
fn legs(s: &mut Sketch, thick: f64, inset: f64, z: f64) {
    let [w, h, _] = s.size;
    for x in [inset, w - inset - thick] {
        for y in [inset, h - inset - thick] {
            s.block([x, y, 0.0], [x + thick, y + thick, z]);
        }
    }
}

/// A board on four legs.
fn board_on_legs(s: &mut Sketch, board: f64, leg: f64, inset: f64) {
    let [w, h, d] = s.size;
    s.block([0.0, 0.0, d - board], [w, h, d]);
    s.top("top", [0.0; 3], [w, h, d], None);
    legs(s, leg, inset, d - board);
}

fn table(s: &mut Sketch) {
    s.paint(wood(0xb07a44));
    board_on_legs(s, 0.04, 0.07, 0.03);
}

fn coffee_table(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(wood(0x7a4f2c));
    board_on_legs(s, 0.035, 0.05, 0.02);
    let z = d * 0.3;
    s.block([0.03, 0.03, z - 0.02], [w - 0.03, h - 0.03, z]);
    s.top("shelf", [0.07, 0.07, 0.0], [w - 0.07, h - 0.07, z], Some(d - 0.035 - z));
}

fn desk(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(wood(0xd3b48a));
    s.block([0.0, 0.0, d - 0.03], [w, h, d]);
    s.top("top", [0.0; 3], [w, h, d], None);
    s.paint(plain(0x3a3f45));
    s.block([0.02, 0.03, 0.0], [0.06, h - 0.03, d - 0.03]);
    s.block([0.06, h - 0.06, d * 0.4], [w * 0.68, h - 0.03, d - 0.03]);
    s.paint(plain(0xe9e4da));
    s.block([w * 0.68, 0.02, 0.0], [w - 0.02, h - 0.02, d - 0.03]);
    s.paint(plain(0x3a3f45));
    for n in 0..3 {
        let z = d * (0.2 + 0.27 * f64::from(n));
        s.block([w * 0.79, 0.0, z], [w * 0.89, 0.02, z + 0.02]);
    }
}

fn nightstand(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(wood(0x94633a));
    s.block([0.0, 0.02, d * 0.24], [w, h, d]);
    s.top("top", [0.0, 0.02, 0.0], [w, h, d], None);
    legs(s, 0.04, 0.02, d * 0.24);
    drawers(s, [0.02, w - 0.02], [d * 0.3, d * 0.94], 2, 0xa9754a);
}

/// Fronts of drawers with a knob each, on the front of a carcass that begins at y = 0.02.
fn drawers(s: &mut Sketch, x: [f64; 2], z: [f64; 2], count: u32, front: u32) {
    let step = (z[1] - z[0]) / f64::from(count);
    for n in 0..count {
        let low = z[0] + step * f64::from(n);
        s.paint(wood(front));
        s.block([x[0], 0.008, low + 0.01], [x[1], 0.02, low + step - 0.01]);
        s.paint(plain(0x2e2a26));
        let (middle, z) = (f64::midpoint(x[0], x[1]), low + step / 2.0);
        s.block([middle - 0.05, 0.0, z - 0.01], [middle + 0.05, 0.008, z + 0.01]);
    }
}

fn chair(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let seat = d * 0.5;
    s.paint(wood(0xc2894e));
    s.block([0.0, 0.0, seat - 0.04], [w, h, seat]);
    s.surface("seat", [0.01, 0.01], [w - 0.01, h - 0.05], seat, None);
    legs(s, 0.04, 0.0, seat - 0.04);
    for x in [0.0, w - 0.04] {
        s.block([x, h - 0.035, seat], [x + 0.04, h, d]);
    }
    for z in [0.66, 0.85] {
        s.block([0.04, h - 0.03, d * z], [w - 0.04, h - 0.005, d * (z + 0.11)]);
    }
}

fn stool(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let middle = [w / 2.0, h / 2.0];
    s.paint(wood(0xd9b27c));
    s.cylinder(middle, w / 2.0, [d - 0.04, d], 20);
    s.surface("top", [w * 0.2, h * 0.2], [w * 0.8, h * 0.8], d, None);
    s.paint(wood(0x9b6b3a));
    for (x, y) in [(0.1, 0.1), (0.9, 0.1), (0.1, 0.9), (0.9, 0.9)] {
        let top = [w * (0.5 + (x - 0.5) * 0.5), h * (0.5 + (y - 0.5) * 0.5), d - 0.04];
        s.rod([w * x, h * y, 0.0], top, 0.018, 8);
    }
}

fn bench(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(wood(0xa86f3d));
    s.block([0.0, 0.0, d - 0.05], [w, h, d]);
    s.top("top", [0.0; 3], [w, h, d], None);
    for x in [0.08, w - 0.13] {
        s.block([x, 0.02, 0.0], [x + 0.05, h - 0.02, d - 0.05]);
    }
}

fn armchair(s: &mut Sketch) {
    upholstered(s, 0xa8442f, 0xb95640, 1);
}

fn sofa(s: &mut Sketch) {
    upholstered(s, 0x3f5d7d, 0x4b6d92, 2);
}

/// A seat with arms and a back; the arms are flat and wide enough to put something on.
fn upholstered(s: &mut Sketch, frame: u32, cushions: u32, places: u32) {
    let [w, h, d] = s.size;
    let arm = (w * 0.16).min(0.22);
    let (back, seat, arm_top) = (h * 0.26, d * 0.5, d * 0.72);
    s.paint(cloth(frame));
    s.block([0.0, 0.0, 0.06], [w, h, seat * 0.72]);
    s.block([arm, h - back * 0.6, seat * 0.72], [w - arm, h, d]);
    for x in [0.0, w - arm] {
        s.block([x, 0.0, seat * 0.72], [x + arm, h, arm_top]);
    }
    s.top("left arm", [0.0; 3], [arm, h, arm_top], None);
    s.top("right arm", [w - arm, 0.0, 0.0], [w, h, arm_top], None);
    s.surface("seat", [arm + 0.02, 0.03], [w - arm - 0.02, h - back - 0.02], seat, None);
    s.paint(cloth(cushions));
    let width = (w - 2.0 * arm) / f64::from(places);
    for n in 0..places {
        let x = arm + width * f64::from(n);
        s.block([x + 0.006, 0.01, seat * 0.72], [x + width - 0.006, h - back, seat]);
        s.block([x + 0.01, h - back, seat], [x + width - 0.01, h - back * 0.6, d * 0.96]);
    }
    s.paint(wood(0x4a3222));
    legs(s, 0.05, 0.03, 0.06);
}

/// Head at +y, with a headboard and two pillows; the blanket covers the foot.
fn bed(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (rail, top) = (d * 0.3, d * 0.55);
    s.paint(wood(0x8a5a33));
    s.block([0.0, h - 0.06, 0.0], [w, h, d]);
    s.block([0.0, 0.0, rail * 0.4], [w, h - 0.06, rail]);
    legs(s, 0.07, 0.0, rail * 0.4);
    s.paint(plain(0xf2efe8));
    s.block([0.02, 0.02, rail], [w - 0.02, h - 0.06, top * 0.97]);
    s.paint(cloth(0x5d7f9c));
    s.block([0.005, 0.005, top * 0.7], [w - 0.005, h * 0.66, top]);
    s.surface("top", [0.03, 0.03], [w - 0.03, h * 0.66 - 0.02], top, None);
    s.paint(plain(0xffffff));
    let pillow = w * 0.42;
    for x in [w * 0.05, w * 0.53] {
        s.cushion([x, h * 0.7, top * 0.96], [x + pillow, h - 0.1, top * 0.96 + 0.13], 12);
    }
}

fn wardrobe(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(wood(0xa98254));
    s.block([0.0, 0.025, 0.0], [w, h, d]);
    s.top("top", [0.0, 0.025, 0.0], [w, h, d], None);
    s.paint(wood(0xc09a6a));
    for x in [0.0, w / 2.0] {
        s.block([x + 0.01, 0.012, 0.06], [x + w / 2.0 - 0.01, 0.025, d - 0.03]);
    }
    s.paint(plain(0x55504a));
    for x in [w / 2.0 - 0.05, w / 2.0 + 0.03] {
        s.block([x, 0.0, d * 0.42], [x + 0.02, 0.012, d * 0.56]);
    }
}

fn dresser(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(wood(0x6d4427));
    s.block([0.0, 0.02, 0.0], [w, h, d]);
    s.top("top", [0.0, 0.02, 0.0], [w, h, d], None);
    drawers(s, [0.02, w / 2.0 - 0.01], [0.05, d - 0.03], 3, 0x855735);
    drawers(s, [w / 2.0 + 0.01, w - 0.02], [0.05, d - 0.03], 3, 0x855735);
}

/// Sides, a back and boards with free space between them.
fn shelves(s: &mut Sketch, count: u32, side: f64) {
    let [w, h, d] = s.size;
    s.block([0.0, 0.0, 0.0], [side, h, d]);
    s.block([w - side, 0.0, 0.0], [w, h, d]);
    s.block([side, h - 0.012, 0.0], [w - side, h, d]);
    let step = (d - side) / f64::from(count);
    for n in 0..=count {
        let low = step * f64::from(n);
        s.block([side, 0.0, low], [w - side, h - 0.012, low + side]);
        let free = (n < count).then_some(step - side);
        let name = if n < count { format!("shelf {}", n + 1) } else { "top".to_owned() };
        let max = [w - side - 0.01, h - 0.02];
        s.surface(&name, [side + 0.01, 0.01], max, low + side, free);
    }
}

fn bookshelf(s: &mut Sketch) {
    s.paint(wood(0xcaa472));
    shelves(s, 5, 0.025);
    // Some books fill the left of two boards: the surfaces begin to their right.
    let [w, _, d] = s.size;
    let step = (d - 0.025) / 5.0;
    for (row, colours) in [(1, [0x8c2f39, 0x2f5d8c, 0xd9a441]), (3, [0x3c7a4a, 0xefe6d2, 0x5a3d7a])]
    {
        let z = step * f64::from(row) + 0.025;
        let mut x = 0.03;
        for (n, colour) in colours.into_iter().enumerate() {
            let wide = w * 0.05;
            s.paint(plain(colour));
            let high = (step - 0.025) * (0.72 + 0.08 * n as f64);
            s.block([x, 0.03, z], [x + wide, s.size[1] * 0.8, z + high]);
            x += wide + 0.004;
        }
        s.narrow(&format!("shelf {}", row + 1), x + 0.01);
    }
}

fn wall_shelf(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(wood(0xe0c9a0));
    s.block([0.0; 3], [w, h, d]);
    s.top("top", [0.0; 3], [w, h, d], None);
}

fn tv_stand(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(wood(0x4b3a30));
    let (low, side) = (d * 0.12, 0.03);
    s.block([0.0, 0.0, d - side], [w, h, d]);
    s.top("top", [0.0; 3], [w, h, d], None);
    s.block([0.0, 0.0, low], [w, h, low + side]);
    for x in [0.0, w / 3.0, w * 2.0 / 3.0 - side, w - side] {
        s.block([x, 0.0, low + side], [x + side, h, d - side]);
    }
    let free = Some(d - low - 2.0 * side);
    let (from, to) = ([w / 3.0 + side + 0.01, 0.01], [w * 2.0 / 3.0 - side - 0.01, h - 0.01]);
    s.surface("shelf", from, to, low + side, free);
    s.paint(wood(0x5d4a3e));
    s.block([side, 0.0, low + side], [w / 3.0, 0.02, d - side]);
    s.block([w * 2.0 / 3.0, 0.0, low + side], [w - side, 0.02, d - side]);
    s.paint(plain(0x202020));
    legs(s, 0.05, 0.04, low);
}

fn shoe_rack(s: &mut Sketch) {
    s.paint(wood(0x8d7a66));
    shelves(s, 2, 0.02);
}
