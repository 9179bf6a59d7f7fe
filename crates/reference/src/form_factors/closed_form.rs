//! Form factors with a closed form. Identifiers such as C-11 are those of Howell's catalogue of radiation
//! heat transfer configuration factors.
//!
//! Lengths are positive and in any one unit, unless a function says otherwise.

use std::f64::consts::PI;

use libm::{atan, log};

/// Extent of a rectangle along an axis: lower and upper bound.
pub type Span = [f64; 2];

/// C-11: between identical, directly opposed rectangles `a` × `b`, `c` apart.
pub fn opposed_rectangles(a: f64, b: f64, c: f64) -> f64 {
    let (x, y) = (a / c, b / c);
    let (rx, ry) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
    let logarithm = 0.5 * log((1.0 + x * x) * (1.0 + y * y) / (1.0 + x * x + y * y));
    let arcs = x * ry * atan(x / ry) + y * rx * atan(y / rx) - x * atan(x) - y * atan(y);
    2.0 / (PI * x * y) * (logarithm + arcs)
}

/// C-13: between parallel rectangles with parallel edges, `gap` apart, at any offset; each is
/// given by its spans along x and y.
pub fn parallel_rectangles(from: [Span; 2], to: [Span; 2], gap: f64) -> f64 {
    let g = |dx: f64, dy: f64| {
        let (p, q) = (dx.hypot(gap), dy.hypot(gap));
        let arcs = dy * p * atan(dy / p) + dx * q * atan(dx / q);
        (arcs - 0.5 * gap * gap * log(dx * dx + dy * dy + gap * gap)) / (2.0 * PI)
    };
    let sum = corners(|[i, j, k, l]| g(from[0][i] - to[0][l], from[1][j] - to[1][k]));
    sum / area(from)
}

/// C-14: between perpendicular rectangles with a common edge of length `l`, from that of width `w`
/// to that of height `h`.
pub fn adjacent_rectangles(w: f64, h: f64, l: f64) -> f64 {
    let (w, h) = (w / l, h / l);
    let (w2, h2) = (w * w, h * h);
    let s = w2 + h2;
    let arcs = w * atan(1.0 / w) + h * atan(1.0 / h) - s.sqrt() * atan(1.0 / s.sqrt());
    let logarithm = log((1.0 + w2) * (1.0 + h2) / (1.0 + s))
        + w2 * log(w2 * (1.0 + s) / ((1.0 + w2) * s))
        + h2 * log(h2 * (1.0 + s) / ((1.0 + h2) * s));
    (arcs + 0.25 * logarithm) / (PI * w)
}

/// Between perpendicular rectangles with parallel edges, at any position: from one in the plane
/// z = 0, given by its spans along x and y, to one in the plane x = 0, by its spans along z and y.
/// Neither reaches across the other's plane.
pub fn perpendicular_rectangles(from: [Span; 2], to: [Span; 2]) -> f64 {
    let g = |x: f64, z: f64, d: f64| {
        let r2 = x * x + z * z;
        let (r, d2) = (r2.sqrt(), d * d);
        // Both terms tend to 0 with the arguments of arc and logarithm.
        let arc = if r > 0.0 { d * r * atan(d / r) } else { 0.0 };
        let sum = r2 + d2;
        let logarithm = if sum > 0.0 { 0.25 * (r2 - d2) * log(sum) } else { 0.0 };
        (arc - logarithm) / (2.0 * PI)
    };
    let sum = corners(|[i, j, k, l]| g(from[0][i], to[0][l], from[1][j] - to[1][k]));
    sum.abs() / area(from)
}

/// C-40 and C-41: between parallel coaxial discs `h` apart, from that of radius `r1` to that of `r2`.
pub fn coaxial_discs(r1: f64, r2: f64, h: f64) -> f64 {
    let (a, b) = (r1 / h, r2 / h);
    let x = 1.0 + (1.0 + b * b) / (a * a);
    0.5 * (x - (x * x - 4.0 * (r2 / r1).powi(2)).sqrt())
}

/// From an element to a parallel rectangle `a` × `b` at distance `c`, one of whose corners is on
/// the element's normal.
pub fn element_to_parallel_rectangle(a: f64, b: f64, c: f64) -> f64 {
    let (a, b) = (a / c, b / c);
    let half = |a: f64, b: f64| a / a.hypot(1.0) * atan(b / a.hypot(1.0));
    (half(a, b) + half(b, a)) / (2.0 * PI)
}

/// From an element to a perpendicular rectangle of height `a` and width `b`. Its lower edge is in the plane of
/// the element; one end of that edge is at distance `c`, straight in front of the element.
pub fn element_to_perpendicular_rectangle(a: f64, b: f64, c: f64) -> f64 {
    let (x, y) = (a / b, c / b);
    let r = x.hypot(y);
    (atan(1.0 / y) - y / r * atan(1.0 / r)) / (2.0 * PI)
}

/// The sum over all combinations of the ends of four spans, with alternating signs.
fn corners(term: impl Fn([usize; 4]) -> f64) -> f64 {
    let ends = (0..16).map(|n| [n & 1, n >> 1 & 1, n >> 2 & 1, n >> 3]);
    let sign = |at: &[usize; 4]| if at.iter().sum::<usize>() % 2 == 0 { 1.0 } else { -1.0 };
    ends.map(|at| sign(&at) * term(at)).sum()
}

fn area([x, y]: [Span; 2]) -> f64 {
    (x[1] - x[0]) * (y[1] - y[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Equal to ten digits.
    fn same(value: f64, exact: f64) {
        assert!((value - exact).abs() < 6e-11, "{value} {exact}");
    }

    #[test]
    fn formulas_give_the_published_values() {
        same(opposed_rectangles(1.0, 1.0, 1.0), 0.199_824_895_7);
        same(opposed_rectangles(1.0, 1.0, 0.1), 0.826_994_522_4);
        same(adjacent_rectangles(1.0, 1.0, 1.0), 0.200_043_776_1);
        same(adjacent_rectangles(4.0, 3.0, 4.0), 0.179_316_803_2);
        let unit = [0.0, 1.0];
        same(parallel_rectangles([unit, unit], [[1.0, 2.0], unit], 1.0), 0.086_050_489_2);
        same(perpendicular_rectangles([[1.0, 2.0], unit], [unit, unit]), 0.032_808_826_7);
        same(coaxial_discs(1.0, 1.0, 1.0), 0.381_966_011_3);
        same(element_to_parallel_rectangle(1.0, 1.0, 1.0), 0.138_531_606_0);
        same(element_to_perpendicular_rectangle(1.0, 1.0, 1.0), 0.055_734_197_0);
    }

    #[test]
    fn the_general_formulas_agree_with_the_special_ones() {
        let unit = [0.0, 1.0];
        same(
            parallel_rectangles([unit, unit], [unit, unit], 0.1),
            opposed_rectangles(1.0, 1.0, 0.1),
        );
        let (floor, wall) = ([[0.0, 4.0], [0.0, 4.0]], [[0.0, 3.0], [0.0, 4.0]]);
        same(perpendicular_rectangles(floor, wall), adjacent_rectangles(4.0, 3.0, 4.0));
    }
}
