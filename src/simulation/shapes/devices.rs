//! Electric and electronic things, and books: what lies on desks.

use super::paint::{cloth, plain, striped, wood};
use super::sketch::Sketch;
use super::tableware::arc;
use super::{Class, class};

pub const CLASSES: &[Class] = &[
    class("tv", [1.1, 0.2, 0.68], "furniture", tv),
    class("tv remote", [0.19, 0.05, 0.022], "device", tv_remote),
    class("laptop", [0.34, 0.27, 0.23], "device", laptop),
    class("monitor", [0.55, 0.2, 0.45], "appliance", monitor),
    class("computer tower", [0.2, 0.42, 0.42], "appliance", computer_tower),
    class("keyboard", [0.44, 0.14, 0.03], "device", keyboard),
    class("mouse", [0.065, 0.11, 0.038], "device", mouse),
    class("mouse mat", [0.25, 0.21, 0.004], "device", mouse_mat),
    class("phone", [0.075, 0.15, 0.01], "device", phone),
    class("radio", [0.28, 0.1, 0.18], "device", radio),
    class("headphones", [0.19, 0.09, 0.2], "device", headphones),
    class("book", [0.15, 0.21, 0.03], "book", book),
    class("newspaper", [0.3, 0.21, 0.012], "book", newspaper),
    class("paper", [0.21, 0.297, 0.004], "book", paper),
    class("light switch", [0.09, 0.015, 0.09], "furniture", light_switch),
    class("power socket", [0.09, 0.015, 0.09], "furniture", light_switch),
    class("lamp", [0.28, 0.28, 0.5], "appliance", lamp),
    class("floor lamp", [0.38, 0.38, 1.6], "furniture", floor_lamp),
    class("ceiling lamp", [0.4, 0.4, 0.4], "furniture", ceiling_lamp),
    class("wall lamp", [0.2, 0.2, 0.25], "furniture", ceiling_lamp),
    class("fan", [0.36, 0.24, 0.5], "appliance", fan),
];

const BLACK: u32 = 0x17191c;

fn tv(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let low = d * 0.09;
    s.paint(plain(BLACK));
    s.block([0.0, h * 0.4, low], [w, h * 0.6, d]);
    s.block([w * 0.46, h * 0.42, 0.015], [w * 0.54, h * 0.58, low]);
    s.block([w * 0.28, 0.0, 0.0], [w * 0.72, h, 0.015]);
    s.paint(plain(0x274a63));
    s.block([0.02, h * 0.385, low + 0.02], [w - 0.02, h * 0.4, d - 0.02]);
}

fn tv_remote(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let top = d * 0.8;
    s.paint(plain(0x1f2226));
    s.prism(
        1,
        &[[0.0, d * 0.2], [w * 0.03, 0.0], [w * 0.97, 0.0], [w, d * 0.2], [w, top], [0.0, top]],
        [0.0, h],
    );
    for row in 0..4 {
        for column in 0..3 {
            let x = w * (0.1 + 0.12 * f64::from(row));
            let y = h * (0.16 + 0.26 * f64::from(column));
            s.paint(plain(0xd5d9dd));
            s.block([x, y, top], [x + w * 0.07, y + h * 0.16, d]);
        }
    }
    s.paint(plain(0x4a9bd4));
    s.cylinder([w * 0.72, h / 2.0], h * 0.3, [top, d * 0.95], 12);
    s.paint(plain(0xe0261b));
    s.block([w * 0.88, h * 0.36, top], [w * 0.95, h * 0.64, d]);
}

/// Open: the screen stands at the back.
fn laptop(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let base = d * 0.08;
    let hinge = h * 0.8;
    s.paint(plain(0xb4bac0));
    s.block([0.0, 0.0, 0.0], [w, hinge, base]);
    s.prism(0, &[[hinge, 0.0], [hinge + 0.012, 0.0], [h, d], [h - 0.012, d]], [0.0, w]);
    s.paint(plain(0x24272b));
    s.block([w * 0.06, h * 0.28, base], [w * 0.94, h * 0.7, base + 0.003]);
    s.block([w * 0.36, h * 0.04, base], [w * 0.64, h * 0.24, base + 0.002]);
    s.paint(plain(0x2d7dd2));
    let lean = |z: f64| hinge + (h - 0.012 - hinge) * z / d;
    let (low, high) = (d * 0.1, d * 0.95);
    s.prism(
        0,
        &[
            [lean(low) - 0.003, low],
            [lean(low), low],
            [lean(high), high],
            [lean(high) - 0.003, high],
        ],
        [w * 0.04, w * 0.96],
    );
}

fn monitor(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let low = d * 0.28;
    s.paint(plain(0x2a2d31));
    s.block([0.0, h * 0.4, low], [w, h * 0.6, d]);
    s.block([w * 0.44, h * 0.5, 0.012], [w * 0.56, h * 0.62, low]);
    s.cylinder([w / 2.0, h / 2.0], h / 2.0, [0.0, 0.012], 18);
    s.paint(plain(0x5fa8d3));
    s.block([0.015, h * 0.38, low + 0.02], [w - 0.015, h * 0.4, d - 0.015]);
}

fn computer_tower(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0x34383d));
    s.block([0.0, 0.008, 0.0], [w, h, d]);
    s.top("top", [0.0, 0.008, 0.0], [w, h, d], None);
    s.paint(plain(0x9aa1a8));
    s.block([w * 0.15, 0.0, d * 0.8], [w * 0.85, 0.008, d * 0.88]);
    s.paint(plain(0x35d0ff));
    s.block([w * 0.4, 0.0, d * 0.6], [w * 0.6, 0.008, d * 0.68]);
}

fn keyboard(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0x3b3f45));
    s.prism(0, &[[0.0, 0.0], [h, 0.0], [h, d * 0.8], [0.0, d * 0.45]], [0.0, w]);
    s.paint(plain(0xe6e8ea));
    for row in 0..4 {
        let y = h * (0.08 + 0.22 * f64::from(row));
        let z = d * (0.45 + 0.35 * y / h);
        s.block([w * 0.03, y, z * 0.9], [w * 0.72, y + h * 0.15, z + d * 0.12]);
        s.block([w * 0.77, y, z * 0.9], [w * 0.97, y + h * 0.15, z + d * 0.12]);
    }
}

fn mouse(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0x50565d));
    s.ball([0.0, 0.0, -d], [w, h, d], 14);
    s.cut_below(0.0);
    s.paint(plain(0xcfd4d9));
    s.block([w * 0.45, h * 0.15, d * 0.7], [w * 0.55, h * 0.3, d * 0.95]);
}

fn mouse_mat(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0x1d3557));
    s.block([0.0; 3], [w, h, d]);
    s.top("top", [0.0; 3], [w, h, d], None);
}

fn phone(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(BLACK));
    s.block([0.0; 3], [w, h, d * 0.9]);
    s.paint(plain(0x6ec1ff));
    s.block([w * 0.06, h * 0.06, d * 0.9], [w * 0.94, h * 0.94, d]);
}

fn radio(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(wood(0x8f4f2a));
    s.block([0.0, 0.012, 0.0], [w, h, d * 0.85]);
    s.paint(plain(0xe8d9b5));
    s.block([w * 0.05, 0.004, d * 0.08], [w * 0.58, 0.012, d * 0.78]);
    s.paint(plain(0x222222));
    s.rod([w * 0.78, 0.012, d * 0.3], [w * 0.78, 0.0, d * 0.3], w * 0.09, 14);
    s.block([w * 0.64, 0.004, d * 0.55], [w * 0.94, 0.012, d * 0.75]);
    s.tube(
        &arc([w / 2.0, h / 2.0, d * 0.85], [w * 0.4, d * 0.15 - 0.006], 0.0, 3.14, 8)
            .into_iter()
            .map(|at| (at, 0.006))
            .collect::<Vec<_>>(),
        6,
    );
}

fn headphones(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0x23262b));
    let band: Vec<_> =
        arc([w / 2.0, h / 2.0, d * 0.4], [w * 0.42, d * 0.6 - 0.01], 0.0, 3.1416, 10)
            .into_iter()
            .map(|at| (at, 0.01))
            .collect();
    s.tube(&band, 6);
    s.paint(plain(0xd04a3a));
    for x in [w * 0.08, w * 0.92] {
        s.ball([x - w * 0.08, 0.0, 0.0], [x + w * 0.08, h, d * 0.5], 12);
    }
}

/// Lying, its spine at −x.
fn book(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let cover = d * 0.12;
    s.paint(plain(0x7b1e3a));
    s.block([0.0, 0.0, 0.0], [w, h, cover]);
    s.block([0.0, 0.0, d - cover], [w, h, d]);
    s.block([0.0, 0.0, cover], [w * 0.04, h, d - cover]);
    s.paint(plain(0xf5efdc));
    s.block([w * 0.04, h * 0.02, cover], [w * 0.97, h * 0.98, d - cover]);
    s.paint(plain(0xe6c35c));
    s.block([w * 0.2, h * 0.6, d - cover * 0.5], [w * 0.85, h * 0.78, d + 0.0004]);
}

fn newspaper(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(striped(0xe6e4dd, 0x8f8f8c, 1, h / 7.0));
    s.block([0.0; 3], [w, h, d]);
}

fn paper(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xfdfdfb));
    s.block([0.0; 3], [w, h, d]);
}

fn light_switch(s: &mut Sketch) {
    let [w, h, d] = s.size;
    s.paint(plain(0xf5f5f0));
    s.block([0.0, h * 0.5, 0.0], [w, h, d]);
    s.paint(plain(0xd5d5cf));
    s.block([w * 0.25, 0.0, d * 0.25], [w * 0.75, h * 0.5, d * 0.75]);
}

fn lamp(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (middle, r) = ([w / 2.0, h / 2.0], w / 2.0);
    s.paint(cloth(0xf3d28b));
    shade(s, d * 0.55, d, r);
    s.paint(plain(0x3d5a6c));
    s.lathe(
        middle,
        &[
            (0.0, 0.0),
            (r * 0.5, 0.0),
            (r * 0.45, d * 0.06),
            (r * 0.14, d * 0.2),
            (r * 0.1, d * 0.6),
            (0.0, d * 0.6),
        ],
        14,
    );
}

/// A shade that is open below and above.
fn shade(s: &mut Sketch, low: f64, high: f64, r: f64) {
    let [w, h, _] = s.size;
    let profile = [(r * 0.92, low), (r, low), (r * 0.62, high), (r * 0.54, high), (r * 0.92, low)];
    s.lathe([w / 2.0, h / 2.0], &profile, 18);
}

fn floor_lamp(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (middle, r) = ([w / 2.0, h / 2.0], w / 2.0);
    s.paint(cloth(0xf6e7c1));
    shade(s, d * 0.8, d, r);
    s.paint(plain(0x2b2b2b));
    s.cylinder(middle, r * 0.7, [0.0, 0.03], 18);
    s.cylinder(middle, 0.015, [0.03, d * 0.85], 8);
}

fn ceiling_lamp(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let (middle, r) = ([w / 2.0, h / 2.0], w / 2.0);
    s.paint(plain(0xfbf3d6));
    s.lathe(
        middle,
        &[(0.0, 0.0), (r * 0.7, d * 0.1), (r, d * 0.35), (r * 0.5, d * 0.55), (0.0, d * 0.6)],
        18,
    );
    s.paint(plain(0x55504a));
    s.cylinder(middle, r * 0.06, [d * 0.55, d * 0.95], 8);
    s.cylinder(middle, r * 0.3, [d * 0.95, d], 14);
}

fn fan(s: &mut Sketch) {
    let [w, h, d] = s.size;
    let z = d - w / 2.0;
    s.paint(plain(0xdfe6ea));
    s.cylinder([w / 2.0, h / 2.0], h / 2.0, [0.0, 0.03], 16);
    s.cylinder([w / 2.0, h * 0.6], 0.018, [0.03, z], 8);
    s.rod([w / 2.0, h * 0.75, z], [w / 2.0, h * 0.35, z], w * 0.12, 12);
    let rim: Vec<_> = arc([w / 2.0, h * 0.4, z], [w / 2.0 - 0.01, w / 2.0 - 0.01], 0.0, 6.2832, 18)
        .into_iter()
        .map(|at| (at, 0.01))
        .collect();
    s.tube(&rim, 6);
    s.paint(plain(0x4aa3c7));
    for n in 0..3 {
        let angle = 2.0944 * f64::from(n) + 0.5;
        let (cos, sin) = (libm::cos(angle), libm::sin(angle));
        let tip = [w / 2.0 + cos * w * 0.42, h * 0.38, z + sin * w * 0.42];
        s.tube(&[([w / 2.0, h * 0.4, z], w * 0.05), (tip, w * 0.11)], 4);
    }
}
