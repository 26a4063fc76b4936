//! Plain vectors of three floats: what is computed per pixel stays readable and quick.

/// (x, y, z).
pub(in crate::simulation) type V3 = [f32; 3];

pub(super) fn add(a: V3, b: V3) -> V3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn sub(a: V3, b: V3) -> V3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn scale(a: V3, by: f32) -> V3 {
    [a[0] * by, a[1] * by, a[2] * by]
}

/// Component by component.
pub(super) fn times(a: V3, b: V3) -> V3 {
    [a[0] * b[0], a[1] * b[1], a[2] * b[2]]
}

pub(super) fn dot(a: V3, b: V3) -> f32 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: V3, b: V3) -> V3 {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

pub(super) fn mix(a: V3, b: V3, share_of_b: f32) -> V3 {
    add(scale(a, 1.0 - share_of_b), scale(b, share_of_b))
}

/// Of length one; zero stays zero.
pub(super) fn unit(a: V3) -> V3 {
    let length = dot(a, a).sqrt();
    if length > 0.0 { scale(a, 1.0 / length) } else { [0.0; 3] }
}

/// The whole number below. Quicker than `f32::floor`, which is a call on most machines; for what
/// fits 32 bits.
pub(super) fn floor(a: f32) -> f32 {
    let cut = a as i32 as f32;
    if cut > a { cut - 1.0 } else { cut }
}

/// A rigid motion: `parent_from_child`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    /// Rows of the rotation matrix.
    rows: [V3; 3],
    shift: V3,
}

impl Motion {
    pub fn of(isometry: &nalgebra::Isometry3<f64>) -> Self {
        let matrix = isometry.rotation.to_rotation_matrix();
        let rows = [0, 1, 2].map(|row| [0, 1, 2].map(|column| matrix[(row, column)] as f32));
        Self { rows, shift: isometry.translation.vector.map(|it| it as f32).into() }
    }

    /// A point of the child in the parent.
    pub fn point(&self, at: V3) -> V3 {
        add(self.direction(at), self.shift)
    }

    /// A direction of the child in the parent.
    pub fn direction(&self, along: V3) -> V3 {
        [dot(self.rows[0], along), dot(self.rows[1], along), dot(self.rows[2], along)]
    }

    /// A point of the parent in the child.
    pub fn point_back(&self, at: V3) -> V3 {
        self.direction_back(sub(at, self.shift))
    }

    /// A direction of the parent in the child.
    pub fn direction_back(&self, along: V3) -> V3 {
        let [x, y, z] = self.rows;
        add(add(scale(x, along[0]), scale(y, along[1])), scale(z, along[2]))
    }
}
