//! Gauss–Legendre quadrature over an interval and over a triangle.

use std::sync::LazyLock;

use radiosity::glam::DVec3;

/// The number of points of a rule along each side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Order {
    Two,
    Four,
    Eight,
}

/// A point of the unit square and its weight.
type Point = (f64, f64, f64);

/// The points of each order.
static RULES: LazyLock<[Vec<Point>; 3]> = LazyLock::new(|| [2, 4, 8].map(collapsed));

/// The integral of `f` over a triangle, m² times its unit.
pub(crate) fn over_triangle([a, b, c]: [DVec3; 3], order: Order, f: impl Fn(DVec3) -> f64) -> f64 {
    let points = &RULES[order as usize];
    let twice_area = (b - a).cross(c - a).length();
    let sum = points.iter().map(|&(u, v, w)| w * f(a + ((b - a) + (c - b) * v) * u)).sum::<f64>();
    twice_area * sum
}

/// `n` × `n` points of the unit square, one side of which is collapsed into a corner of a triangle. The weights
/// include the factor u of that map.
fn collapsed(n: u32) -> Vec<Point> {
    let rule = interval(n);
    let point = |&(u, wu): &(f64, f64)| rule.iter().map(move |&(v, wv)| (u, v, u * wu * wv));
    rule.iter().flat_map(point).collect()
}

/// Nodes and weights of the Gauss–Legendre rule of `n` points on [0, 1].
fn interval(n: u32) -> Vec<(f64, f64)> {
    let node = |i: u32| {
        // Newton's iteration from Tricomi's approximation converges to the last bit in a few steps.
        let mut x = libm::cos(std::f64::consts::PI * (f64::from(i) + 0.75) / (f64::from(n) + 0.5));
        for _ in 0..8 {
            let (value, slope) = legendre(n, x);
            x -= value / slope;
        }
        let slope = legendre(n, x).1;
        (0.5 + 0.5 * x, 1.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..n).map(node).collect()
}

/// Legendre's polynomial of degree `n` and its derivative, inside (−1, 1).
fn legendre(n: u32, x: f64) -> (f64, f64) {
    let (mut before, mut value) = (1.0, x);
    for k in 2..=n {
        let k = f64::from(k);
        (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
    }
    (value, f64::from(n) * (x * value - before) / (x * x - 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫ x^p y^q over the triangle (0,0), (1,0), (0,1) is p! q! / (p + q + 2)!.
    #[test]
    fn polynomials_are_exact() {
        let factorial = |n: i32| (1..=n).map(f64::from).product::<f64>();
        let triangle = [DVec3::X, DVec3::Y, DVec3::ZERO];
        for (order, degree) in [(Order::Two, 2), (Order::Four, 6), (Order::Eight, 14)] {
            for (p, q) in (0..=degree).flat_map(|p| (0..=degree - p).map(move |q| (p, q))) {
                let value = over_triangle(triangle, order, |at| at.x.powi(p) * at.y.powi(q));
                let exact = factorial(p) * factorial(q) / factorial(p + q + 2);
                assert!((value / exact - 1.0).abs() < 1e-12, "{order:?} {p} {q}: {value} {exact}");
            }
        }
    }
}
