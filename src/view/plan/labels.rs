//! Where labels go so that they can be read: [`Labels`].

use crate::view::svg::text_width;

/// A rectangle on the page: lowest x and y, highest x and y.
pub type Area = [f64; 4];

/// A label that found its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// Left end of the baseline; or its lower end if the text is turned.
    pub at: [f64; 2],
    /// Whether it runs upwards.
    pub upright: bool,
    /// Where a line to the thing begins, if it is not inside.
    pub leader: Option<[f64; 2]>,
    /// Size of the font.
    pub size: f64,
}

/// The page so far.
#[derive(Clone, Debug, Default)]
pub struct Labels {
    /// Never to be covered: other labels.
    taken: Vec<Area>,
    /// Better not covered: things, walls, with how bad it is.
    busy: Vec<(Area, f64)>,
    limits: Area,
    home: Option<Area>,
}

/// Distances of labels from the edge of their things that are tried, nearest first.
const RINGS: [f64; 7] = [3.0, 8.0, 14.0, 22.0, 32.0, 46.0, 62.0];
/// Directions that are tried, by what is easiest to read.
const DIRECTIONS: [[f64; 2]; 16] = [
    [1.0, 0.0],
    [-1.0, 0.0],
    [0.0, -1.0],
    [0.0, 1.0],
    [1.0, -0.6],
    [-1.0, -0.6],
    [1.0, 0.6],
    [-1.0, 0.6],
    [0.5, -1.0],
    [-0.5, -1.0],
    [0.5, 1.0],
    [-0.5, 1.0],
    [0.8, -0.9],
    [-0.8, -0.9],
    [0.8, 0.9],
    [-0.8, 0.9],
];

impl Labels {
    /// An empty page.
    pub fn new(limits: Area) -> Self {
        Self { limits, ..Self::default() }
    }

    /// Something that labels had better not cover; `cost` for each unit of area.
    pub fn avoid(&mut self, area: Area, cost: f64) {
        self.busy.push((area, cost));
    }

    /// Labels from now on had better stay in this area.
    pub fn stay_in(&mut self, home: Option<Area>) {
        self.home = home;
    }

    /// Something that labels must not cover.
    pub fn take(&mut self, area: Area) {
        self.taken.push(area);
    }

    /// Puts a label inside its thing, along its longer side, if it fits there.
    pub fn inside(&mut self, text: &str, thing: Area, sizes: &[f64]) -> Option<Placed> {
        let [w, h] = [thing[2] - thing[0], thing[3] - thing[1]];
        let middle = [f64::midpoint(thing[0], thing[2]), f64::midpoint(thing[1], thing[3])];
        for &size in sizes {
            let (long, high) = (text_width(text) * size, size * 0.95);
            let ways = if w >= h { [false, true] } else { [true, false] };
            for upright in ways {
                let (x, y) = if upright { (high, long) } else { (long, high) };
                if x > w - 3.0 || y > h - 2.0 {
                    continue;
                }
                // In the middle, or towards an end where the middle is taken.
                for shift in [0.0, -0.25, 0.25, -0.4, 0.4] {
                    let room = [w - x - 3.0, h - y - 2.0];
                    let centre = if w >= h {
                        [middle[0] + shift * room[0], middle[1]]
                    } else {
                        [middle[0], middle[1] + shift * room[1]]
                    };
                    for across in [0.0, -0.4, 0.4] {
                        let centre = if w >= h {
                            [centre[0], centre[1] + across * room[1]]
                        } else {
                            [centre[0] + across * room[0], centre[1]]
                        };
                        let area = around(centre, [x, y]);
                        if self.is_free(area) && self.cost(area, Some(thing)) < 0.15 * x * y {
                            return Some(self.put(area, upright, size, None));
                        }
                    }
                }
            }
        }
        None
    }

    /// Puts a label near its thing where it covers least, with a line if it is not close by.
    /// `None` if every place is taken.
    pub fn beside(&mut self, text: &str, thing: Area, size: f64) -> Option<Placed> {
        let [x, y] = [text_width(text) * size, size * 0.95];
        let middle = [f64::midpoint(thing[0], thing[2]), f64::midpoint(thing[1], thing[3])];
        let half = [(thing[2] - thing[0]) / 2.0, (thing[3] - thing[1]) / 2.0];
        let mut best: Option<(f64, Area, f64)> = None;
        for (far, ring) in RINGS.into_iter().enumerate() {
            for (order, [dx, dy]) in DIRECTIONS.into_iter().enumerate() {
                let centre = [
                    middle[0] + dx * (half[0] + ring + x / 2.0),
                    middle[1] + dy * (half[1] + ring + y / 2.0),
                ];
                let area = around(centre, [x, y]);
                if !self.is_free(area) {
                    continue;
                }
                let away = self.home.map_or(0.0, |home| x * y - shared(area, home));
                let trouble = self.cost(area, None) + away * 1.5 + ring * 2.2 + order as f64 * 0.4;
                if best.is_none_or(|(least, _, _)| trouble < least) {
                    best = Some((trouble, area, far as f64));
                }
            }
        }
        let (_, area, far) = best?;
        let leader = (far > 0.0).then(|| nearest(area, middle));
        Some(self.put(area, false, size, leader))
    }

    /// How much is covered, were something put there.
    pub fn trouble(&self, area: Area) -> f64 {
        let taken: f64 = self.taken.iter().map(|taken| shared(area, *taken) * 10.0).sum();
        taken + self.cost(area, None)
    }

    fn put(&mut self, area: Area, upright: bool, size: f64, leader: Option<[f64; 2]>) -> Placed {
        self.taken.push(area);
        // The baseline lies a fifth above the lower edge of the letters.
        let at = match upright {
            false => [area[0], area[3] - 0.18 * size],
            true => [area[2] - 0.18 * size, area[3]],
        };
        Placed { at, upright, leader, size }
    }

    fn is_free(&self, area: Area) -> bool {
        let [x0, y0, x1, y1] = self.limits;
        let inside = area[0] >= x0 && area[1] >= y0 && area[2] <= x1 && area[3] <= y1;
        inside && !self.taken.iter().any(|taken| shared(area, *taken) > 0.0)
    }

    fn cost(&self, area: Area, own: Option<Area>) -> f64 {
        let others = self.busy.iter().filter(|(busy, _)| Some(*busy) != own);
        others.map(|(busy, cost)| shared(area, *busy) * cost).sum()
    }
}

fn around([x, y]: [f64; 2], [w, h]: [f64; 2]) -> Area {
    [x - w / 2.0, y - h / 2.0, x + w / 2.0, y + h / 2.0]
}

/// Area that two rectangles share.
fn shared(a: Area, b: Area) -> f64 {
    let w = a[2].min(b[2]) - a[0].max(b[0]);
    let h = a[3].min(b[3]) - a[1].max(b[1]);
    if w > 0.0 && h > 0.0 { w * h } else { 0.0 }
}

/// The point of a rectangle nearest to another.
fn nearest(area: Area, [x, y]: [f64; 2]) -> [f64; 2] {
    [x.clamp(area[0], area[2]), y.clamp(area[1], area[3])]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_never_cover_each_other() {
        let mut labels = Labels::new([0.0, 0.0, 400.0, 400.0]);
        for n in 0..60 {
            let (x, y) = (180.0 + f64::from(n % 8) * 5.0, 190.0 + f64::from(n / 8) * 4.0);
            labels.beside("a label", [x, y, x + 3.0, y + 3.0], 9.0);
        }
        assert!(labels.taken.len() > 15, "{}", labels.taken.len());
        for (n, a) in labels.taken.iter().enumerate() {
            assert!(labels.taken[..n].iter().all(|b| shared(*a, *b) <= 0.0));
        }
    }

    #[test]
    fn a_label_goes_into_its_thing_if_it_fits() {
        let mut labels = Labels::new([0.0, 0.0, 400.0, 400.0]);
        let tall = labels.inside("wardrobe", [10.0, 10.0, 30.0, 120.0], &[10.0]).unwrap();
        assert!(tall.upright && tall.leader.is_none());
        assert!(labels.inside("wardrobe", [200.0, 200.0, 210.0, 210.0], &[10.0]).is_none());
    }
}
