//! Level boxes turned about z, and how deep they reach into each other: [`Block`].

use crate::geometry::Pose;

use super::mesh::Mesh;

/// A box with a level floor, turned about z. World frame, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    /// Middle of its footprint.
    pub centre: [f64; 2],
    /// Direction of its first axis, a unit vector; the second is a quarter turn to the left.
    pub along: [f64; 2],
    /// Half extents along its axes.
    pub half: [f64; 2],
    /// Lowest and highest point.
    pub z: [f64; 2],
}

impl Block {
    /// The box between two corners of the frame that `pose` places. If it is tilted, the upright
    /// box around it that is aligned with the world.
    pub fn of(pose: &Pose, min: [f64; 3], max: [f64; 3]) -> Self {
        let isometry = pose.isometry();
        let turn = isometry.rotation.to_rotation_matrix();
        let half: [f64; 3] = std::array::from_fn(|k| (max[k] - min[k]) / 2.0);
        let centre = isometry * nalgebra::Point3::from(std::array::from_fn(|k| min[k] + half[k]));
        let reach = |row: usize| (0..3).map(|k| turn[(row, k)].abs() * half[k]).sum::<f64>();
        let z = [centre.z - reach(2), centre.z + reach(2)];
        let upright = (0..3).rev().find(|k| turn[(2, *k)].abs() > 1.0 - 1e-6);
        let (along, half) = match upright {
            Some(axis) => {
                let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
                (unit([turn[(0, a)], turn[(1, a)]]), [half[a], half[b]])
            }
            None => ([1.0, 0.0], [reach(0), reach(1)]),
        };
        Self { centre: [centre.x, centre.y], along, half, z }
    }

    /// Corners of its footprint, counter-clockwise.
    pub fn corners(&self) -> [[f64; 2]; 4] {
        let ([x, y], [c, s], [a, b]) = (self.centre, self.along, self.half);
        [(a, b), (-a, b), (-a, -b), (a, -b)].map(|(u, v)| [x + u * c - v * s, y + u * s + v * c])
    }

    /// How deep two boxes reach into each other, metres: the least shift that parts them;
    /// negative if they are apart.
    ///
    /// Separating axes of two rectangles (C. Ericson, "Real-Time Collision Detection", 2005,
    /// section 4.4, in the plane), and of their heights.
    pub fn depth(&self, other: &Self) -> f64 {
        let mut least = self.z[1].min(other.z[1]) - self.z[0].max(other.z[0]);
        let [dx, dy] = [other.centre[0] - self.centre[0], other.centre[1] - self.centre[1]];
        for [c, s] in [self.along, other.along] {
            for axis in [[c, s], [-s, c]] {
                let apart = (dx * axis[0] + dy * axis[1]).abs();
                least = least.min(self.reach(axis) + other.reach(axis) - apart);
            }
        }
        least
    }

    /// How far it reaches from its centre along an axis.
    fn reach(&self, [x, y]: [f64; 2]) -> f64 {
        let ([c, s], [a, b]) = (self.along, self.half);
        a * (c * x + s * y).abs() + b * (c * y - s * x).abs()
    }
}

fn unit([x, y]: [f64; 2]) -> [f64; 2] {
    let length = libm::hypot(x, y);
    [x / length, y / length]
}

/// How deep two sets of boxes reach into each other at most.
pub fn depth(a: &[Block], b: &[Block]) -> f64 {
    let pairs = a.iter().flat_map(|a| b.iter().map(|b| a.depth(b)));
    pairs.fold(f64::NEG_INFINITY, f64::max)
}

/// Parts beyond this number are too many to look at one by one.
const PARTS_MAX: usize = 120;

/// Lowest and highest corners of the parts of a mesh: of what hangs together by its triangles.
/// A table is its board and its legs. One box around all if there are very many.
pub fn parts(mesh: &Mesh) -> Vec<([f64; 3], [f64; 3])> {
    let mut leader: Vec<u32> = (0..mesh.vertices.len() as u32).collect();
    for [a, b, c] in &mesh.triangles {
        for other in [b, c] {
            let (x, y) = (find(&mut leader, *a), find(&mut leader, *other));
            leader[x.max(y) as usize] = x.min(y);
        }
    }
    let mut boxes = std::collections::BTreeMap::new();
    for (n, vertex) in mesh.vertices.iter().enumerate() {
        let part = find(&mut leader, n as u32);
        let entry = boxes.entry(part).or_insert(([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]));
        around(entry, vertex.map(f64::from));
    }
    if boxes.len() <= PARTS_MAX {
        return boxes.into_values().collect();
    }
    let mut all = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    mesh.vertices.iter().for_each(|vertex| around(&mut all, vertex.map(f64::from)));
    vec![all]
}

fn around((low, high): &mut ([f64; 3], [f64; 3]), point: [f64; 3]) {
    for k in 0..3 {
        low[k] = low[k].min(point[k]);
        high[k] = high[k].max(point[k]);
    }
}

fn find(leader: &mut [u32], mut n: u32) -> u32 {
    while leader[n as usize] != n {
        leader[n as usize] = leader[leader[n as usize] as usize];
        n = leader[n as usize];
    }
    n
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(at: [f64; 3], yaw: f64, size: [f64; 3]) -> Block {
        let pose = Pose::new(at, [libm::cos(yaw / 2.0), 0.0, 0.0, libm::sin(yaw / 2.0)]).unwrap();
        Block::of(&pose, size.map(|side| -side / 2.0), size.map(|side| side / 2.0))
    }

    #[track_caller]
    fn check_depth(a: &Block, b: &Block, expected: f64) {
        assert!((a.depth(b) - expected).abs() < 1e-5, "{}", a.depth(b));
        assert!((b.depth(a) - expected).abs() < 1e-5, "{}", b.depth(a));
    }

    #[test]
    fn boxes_reach_into_each_other_by_the_least_shift_that_parts_them() {
        let unit = block([0.0; 3], 0.0, [1.0; 3]);
        check_depth(&unit, &block([0.9, 0.0, 0.0], 0.0, [1.0; 3]), 0.1);
        check_depth(&unit, &block([0.2, 0.0, 1.0], 0.0, [1.0; 3]), 0.0);
        check_depth(&unit, &block([2.0, 0.0, 0.0], 0.0, [1.0; 3]), -1.0);
        // A corner that points at a side: half the diagonal reaches 0.707.
        let eighth = std::f64::consts::FRAC_PI_4;
        check_depth(&unit, &block([1.1, 0.0, 0.0], eighth, [1.0; 3]), 0.5 + 0.707_107 - 1.1);
    }

    #[test]
    fn a_box_that_lies_on_its_side_keeps_its_yaw() {
        // Turned by 90° about x: what was deep is high.
        let lying = Pose::new([0.0; 3], [1.0, 1.0, 0.0, 0.0]).unwrap();
        let block = Block::of(&lying, [-1.0, -2.0, -3.0], [1.0, 2.0, 3.0]);
        assert!((block.z[1] - 2.0).abs() < 1e-6);
        let mut half = block.half;
        half.sort_by(f64::total_cmp);
        assert_eq!(half, [1.0, 3.0]);
    }

    #[test]
    fn a_table_is_a_board_and_four_legs() {
        let size = crate::geometry::Size::new(1.2, 0.8, 0.74).unwrap();
        assert_eq!(parts(&crate::simulation::shapes::shape("table", size)).len(), 5);
    }
}
