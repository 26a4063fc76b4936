//! Laws of the shapes.

use std::collections::BTreeMap;

use proptest::prelude::*;

use super::*;

/// Most triangles of a thing whose longest side is below half a metre, and of any.
const SMALL_MAX: usize = 700;
const MAX: usize = 1_200;

fn usual(class: &Class) -> Size {
    let [w, h, d] = class.usual_m;
    Size::new(w, h, d).unwrap()
}

fn corners(mesh: &Mesh, triangle: [u32; 3]) -> [[f64; 3]; 3] {
    triangle.map(|n| mesh.vertices[n as usize].map(f64::from))
}

fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let (u, v): ([f64; 3], [f64; 3]) =
        (std::array::from_fn(|k| b[k] - a[k]), std::array::from_fn(|k| c[k] - a[k]));
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

#[track_caller]
fn check_mesh(class: &str, size: Size) {
    let mesh = shape(class, size);
    for k in 0..3 {
        let half = (size.metres()[k] / 2.0) as f32;
        let low = mesh.vertices.iter().map(|v| v[k]).fold(f32::INFINITY, f32::min);
        let high = mesh.vertices.iter().map(|v| v[k]).fold(f32::NEG_INFINITY, f32::max);
        assert_eq!([low, high], [-half, half], "{class}: axis {k} of {size:?}");
    }
    assert_eq!(mesh.triangles.len(), mesh.material_of.len());
    for (triangle, material) in mesh.triangles.iter().zip(&mesh.material_of) {
        assert!(usize::from(*material) < mesh.materials.len());
        let n = normal(corners(&mesh, *triangle));
        assert!(n.iter().any(|c| *c != 0.0), "{class}: {triangle:?} is a line");
    }
}

/// Six times the volume inside the triangles: positive if they face outwards.
fn volume(mesh: &Mesh) -> f64 {
    let part = |triangle: &[u32; 3]| {
        let all = corners(mesh, *triangle);
        let n = normal(all);
        (0..3).map(|k| all[0][k] * n[k]).sum::<f64>()
    };
    mesh.triangles.iter().map(part).sum()
}

#[test]
fn there_are_many_classes() {
    assert!(classes().count() >= 100, "{}", classes().count());
}

#[test]
fn every_shape_fills_its_box_with_proper_triangles() {
    for class in classes() {
        check_mesh(class.name, usual(class));
    }
    check_mesh("flux capacitor", Size::new(0.3, 0.2, 0.1).unwrap());
}

#[test]
fn every_shape_is_closed_and_faces_outwards() {
    for class in classes() {
        let mesh = shape(class.name, usual(class));
        assert!(volume(&mesh) > 0.0, "{}", class.name);
        // Every edge is walked as often one way as the other; corners at one place are one.
        let place = |n: u32| mesh.vertices[n as usize].map(f32::to_bits);
        let mut edges: BTreeMap<_, i32> = BTreeMap::new();
        for [a, b, c] in &mesh.triangles {
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let (from, to) = (place(*from), place(*to));
                *edges.entry((from.min(to), from.max(to))).or_default() +=
                    if from < to { 1 } else { -1 };
            }
        }
        let open = edges.values().filter(|count| **count != 0).count();
        assert_eq!(open, 0, "{}", class.name);
    }
}

#[test]
fn shapes_are_light() {
    for class in classes() {
        let triangles = shape(class.name, usual(class)).triangles.len();
        let small = class.usual_m.iter().all(|side| *side < 0.5);
        let most = if small { SMALL_MAX } else { MAX };
        assert!(triangles <= most, "{}: {triangles}", class.name);
    }
}

#[test]
fn classes_look_unlike() {
    for a in classes() {
        let looks = shape(a.name, usual(a)).materials;
        assert!(!looks.is_empty());
        for b in classes().filter(|b| b.name != a.name && b.usual_m == a.usual_m) {
            let same = shape(b.name, usual(b)).materials == looks;
            let twins = (a.draw as usize) == (b.draw as usize);
            assert!(!same || twins, "{} and {} look alike", a.name, b.name);
        }
    }
}

/// Whether some triangle that faces up lies at `z` over or under the point.
fn held_up(mesh: &Mesh, [x, y]: [f64; 2], z: f64) -> bool {
    mesh.triangles.iter().any(|triangle| {
        let all = corners(mesh, *triangle);
        let n = normal(all);
        let level = all.iter().all(|corner| (corner[2] - z).abs() < 0.012);
        let flat = all.map(|[x, y, _]| [x, y]);
        let inside = (0..3).all(|k| polygon::side(flat[k], flat[(k + 1) % 3], [x, y]) >= -1e-9);
        n[2] > 0.0 && level && inside
    })
}

#[test]
fn surfaces_lie_on_faces_of_the_mesh() {
    for class in classes() {
        let mesh = shape(class.name, usual(class));
        for surface in surfaces(class.name, usual(class)) {
            let Surface { name, min, max, z, .. } = &surface;
            assert!(min[0] < max[0] && min[1] < max[1], "{}: {name}", class.name);
            for share in [[0.03, 0.03], [0.97, 0.06], [0.06, 0.97], [0.96, 0.96], [0.53, 0.41]] {
                let at = [0, 1].map(|k| min[k] + share[k] * (max[k] - min[k]));
                assert!(held_up(&mesh, at, *z), "{}: {name} at {at:?}, {z}", class.name);
            }
        }
    }
}

#[test]
fn paint_changes_the_main_colour_only() {
    let size = Size::new(0.125, 0.09, 0.1).unwrap();
    let paint = Material { colour: [0.1, 0.2, 0.3], texture: super::super::mesh::Texture::Plain };
    let (plain, painted) = (shape("kettle", size), shape_painted("kettle", size, paint));
    assert_eq!(painted.materials[0], paint);
    assert_eq!(painted.materials[1..], plain.materials[1..]);
    assert_eq!(painted.vertices, plain.vertices);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]
    #[test]
    fn any_size_is_filled(
        which in any::<prop::sample::Index>(),
        sides in prop::array::uniform3(1_000..6_000_000_i64),
    ) {
        let all: Vec<&Class> = classes().collect();
        let class = all[which.index(all.len())].name;
        check_mesh(class, Size::from_micrometres(sides).unwrap());
    }
}
