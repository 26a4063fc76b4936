//! Where a log-likelihood is largest, and how far from there it stays credible.

use super::sigmoid::Curve;

/// How far ln L may fall within a 95 % interval: half the 95 % point of χ² with one degree of
/// freedom (profile likelihood; Wilks, "The large-sample distribution of the likelihood ratio",
/// 1938).
pub(super) const DROP_95: f64 = 1.920_729_410_347_062;

/// Newton steps until one is shorter than this.
const SHORT: f64 = 1e-10;

/// The maximum of a curve with one maximum in `lo..hi`: Newton's method, kept within a bracket
/// that each slope narrows. At an end if it rises to there.
pub(super) fn maximum(at: impl Fn(f64) -> Curve, lo: f64, hi: f64) -> f64 {
    let (mut lo, mut hi) = (lo, hi);
    let mut theta = f64::midpoint(lo, hi);
    for _ in 0..200 {
        let curve = at(theta);
        if curve.slope > 0.0 { lo = theta } else { hi = theta }
        let newton = theta - curve.slope / curve.bend;
        let inside = curve.bend < 0.0 && newton > lo && newton < hi;
        let next = if inside { newton } else { f64::midpoint(lo, hi) };
        let moved = (next - theta).abs();
        theta = next;
        if moved < SHORT {
            break;
        }
    }
    theta
}

/// Where the curve has fallen by `drop` from its value at `top`, below and above; an end of
/// `lo..hi` where it never does. Newton's method again, within a bracket.
pub(super) fn interval(
    at: impl Fn(f64) -> Curve,
    top: f64,
    (lo, hi): (f64, f64),
    drop: f64,
) -> (f64, f64) {
    let peak = at(top);
    let level = peak.value - drop;
    // Where a parabola would have fallen so far.
    let guess = libm::sqrt(2.0 * drop / (-peak.bend).max(1e-6));
    let search = |end: f64| {
        let (mut inside, mut outside) = (top, end);
        let mut theta = if end > top { (top + guess).min(end) } else { (top - guess).max(end) };
        for _ in 0..100 {
            let curve = at(theta);
            let over = curve.value - level;
            if over > 0.0 { inside = theta } else { outside = theta }
            if (inside - end).abs() < SHORT {
                return end;
            }
            let newton = theta - over / curve.slope;
            let within = (newton - inside) * (newton - outside) < 0.0;
            let next = if within { newton } else { f64::midpoint(inside, outside) };
            let moved = (next - theta).abs();
            theta = next;
            if moved < 1e-6 {
                break;
            }
        }
        theta
    };
    (search(lo), search(hi))
}

/// The largest value of `value` near `start`, in as many dimensions as that has: the simplex
/// search of Nelder and Mead, "A simplex method for function minimization", 1965.
pub(super) fn simplex<const N: usize>(
    value: impl Fn(&[f64; N]) -> f64,
    start: [f64; N],
    size: f64,
    steps: usize,
) -> [f64; N] {
    let mut points = vec![(value(&start), start)];
    for n in 0..N {
        let mut corner = start;
        corner[n] += size;
        points.push((value(&corner), corner));
    }
    for _ in 0..steps {
        points.sort_by(|a, b| b.0.total_cmp(&a.0));
        if points[0].0 - points[N].0 < 1e-9 {
            break;
        }
        step(&value, &mut points);
    }
    points.sort_by(|a, b| b.0.total_cmp(&a.0));
    points[0].1
}

/// One step: the worst point of a sorted simplex is reflected, stretched, drawn in, or all are
/// drawn to the best.
fn step<const N: usize>(value: &impl Fn(&[f64; N]) -> f64, points: &mut [(f64, [f64; N])]) {
    let mut centre = [0.0; N];
    for (_, point) in &points[..N] {
        for (sum, x) in centre.iter_mut().zip(point) {
            *sum += x / N as f64;
        }
    }
    let worst = points[N];
    let towards = |by: f64| {
        let point: [f64; N] = std::array::from_fn(|n| centre[n] + by * (worst.1[n] - centre[n]));
        (value(&point), point)
    };
    let reflected = towards(-1.0);
    if reflected.0 > points[0].0 {
        let stretched = towards(-2.0);
        points[N] = if stretched.0 > reflected.0 { stretched } else { reflected };
    } else if reflected.0 > points[N - 1].0 {
        points[N] = reflected;
    } else {
        let drawn = towards(if reflected.0 > worst.0 { -0.5 } else { 0.5 });
        if drawn.0 > worst.0.max(reflected.0) {
            points[N] = drawn;
            return;
        }
        let best = points[0].1;
        for (found, point) in &mut points[1..] {
            *point = std::array::from_fn(|n| f64::midpoint(point[n], best[n]));
            *found = value(point);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parabola(theta: f64) -> Curve {
        Curve { value: -(theta - 2.0) * (theta - 2.0), slope: 4.0 - 2.0 * theta, bend: -2.0 }
    }

    #[test]
    fn the_top_of_a_parabola_and_its_interval_are_found() {
        let top = maximum(parabola, -10.0, 10.0);
        assert!((top - 2.0).abs() < 1e-9, "{top}");
        let (lo, hi) = interval(parabola, top, (-10.0, 10.0), 4.0);
        assert!(lo.abs() < 1e-6 && (hi - 4.0).abs() < 1e-6, "{lo} {hi}");
    }

    #[test]
    fn what_rises_to_an_end_ends_there() {
        let rising = |theta| Curve { value: theta, slope: 1.0, bend: 0.0 };
        let top = maximum(rising, -5.0, 5.0);
        assert!(top > 4.999, "{top}");
        let (_, hi) = interval(rising, top, (-5.0, 5.0), 1.0);
        assert!(hi > 4.999, "{hi}");
    }

    #[test]
    fn a_simplex_climbs_a_bent_ridge() {
        // The valley of Rosenbrock, upside down.
        let ridge = |[x, y]: &[f64; 2]| {
            let (a, b) = (1.0 - x, y - x * x);
            -(a * a + 100.0 * b * b)
        };
        let [x, y] = simplex(ridge, [-1.0, 1.0], 0.5, 400);
        assert!((x - 1.0).abs() < 1e-2 && (y - 1.0).abs() < 2e-2, "{x} {y}");
    }
}
