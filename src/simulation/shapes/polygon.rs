//! Simple polygons in the plane: area, triangles, what lies inside.

/// Twice-signed half: the area, positive if the corners run counter-clockwise.
pub fn area(outline: &[[f64; 2]]) -> f64 {
    edges(outline).map(|([ax, ay], [bx, by])| ax * by - ay * bx).sum::<f64>() / 2.0
}

/// The edges, from each corner to the next.
pub fn edges(outline: &[[f64; 2]]) -> impl Iterator<Item = ([f64; 2], [f64; 2])> {
    outline.iter().zip(outline.iter().cycle().skip(1)).map(|(a, b)| (*a, *b))
}

/// Whether a point lies inside; on the edge either answer may come.
pub fn contains(outline: &[[f64; 2]], [x, y]: [f64; 2]) -> bool {
    let crosses = |([ax, ay], [bx, by]): &([f64; 2], [f64; 2])| {
        (*ay > y) != (*by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax)
    };
    edges(outline).filter(crosses).count() % 2 == 1
}

/// Splits a simple polygon into counter-clockwise triangles by clipping ears; corners by number.
pub fn triangles(outline: &[[f64; 2]]) -> Vec<[usize; 3]> {
    let mut left: Vec<usize> = (0..outline.len()).collect();
    let forward = area(outline) >= 0.0;
    if !forward {
        left.reverse();
    }
    let mut found = Vec::new();
    while left.len() > 3 {
        let n = left.len();
        let corner = |k: usize| [left[(k + n - 1) % n], left[k], left[(k + 1) % n]];
        // A polygon that crosses itself has no ear: any corner ends the search then.
        let ear = (0..n).find(|k| is_ear(outline, &left, corner(*k))).unwrap_or(0);
        found.push(corner(ear));
        left.remove(ear);
    }
    if let [a, b, c] = left[..] {
        found.push([a, b, c]);
    }
    if !forward {
        // The caller's corners run clockwise: so do its triangles.
        found.iter_mut().for_each(|triangle| triangle.reverse());
    }
    found
}

fn is_ear(outline: &[[f64; 2]], left: &[usize], ear: [usize; 3]) -> bool {
    let [a, b, c] = ear.map(|n| outline[n]);
    let inside = |p: [f64; 2]| side(a, b, p) >= 0.0 && side(b, c, p) >= 0.0 && side(c, a, p) >= 0.0;
    side(a, b, c) > 1e-12 && !left.iter().any(|n| !ear.contains(n) && inside(outline[*n]))
}

/// Positive if `p` is to the left of the way from `a` to `b`: twice the triangle's area.
pub fn side(a: [f64; 2], b: [f64; 2], p: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNER: [[f64; 2]; 6] =
        [[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 2.0], [2.0, 4.0], [0.0, 4.0]];

    #[test]
    fn triangles_cover_the_polygon() {
        for outline in [CORNER.to_vec(), CORNER.iter().rev().copied().collect()] {
            let found = triangles(&outline);
            assert_eq!(found.len(), 4);
            let sum: f64 = found.iter().map(|t| area(&t.map(|n| outline[n]))).sum();
            assert!((sum - area(&outline)).abs() < 1e-12);
            assert!(found.iter().all(|t| area(&t.map(|n| outline[n])).abs() > 1e-9));
        }
    }

    #[test]
    fn what_lies_inside_is_told_from_what_does_not() {
        for (point, inside) in
            [([1.0, 1.0], true), ([3.0, 1.0], true), ([3.0, 3.0], false), ([-1.0, 1.0], false)]
        {
            assert_eq!(contains(&CORNER, point), inside, "{point:?}");
        }
    }
}
