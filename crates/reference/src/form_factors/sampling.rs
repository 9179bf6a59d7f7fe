//! Points of surfaces from numbers in [0, 1).

use radiosity::glam::DVec3;

use crate::form_factors::clipping::fan;

/// Maps two numbers to a point of a convex polygon; equal parts of the unit square give equal areas.
pub(crate) fn point_of(ring: &[DVec3], u: f64, v: f64) -> DVec3 {
    let areas = fan(ring).map(|[a, b, c]| (b - a).cross(c - a).length());
    let (triangle, u) = choose(areas, u);
    let [a, b, c] = fan(ring).nth(triangle).unwrap_or([ring[0]; 3]);
    let root = u.sqrt();
    a + ((b - a) + (c - b) * v) * root
}

/// Chooses a weight in proportion; also returns the position within it, in [0, 1).
pub(crate) fn choose(weights: impl Iterator<Item = f64> + Clone, number: f64) -> (usize, f64) {
    let mut left = number * weights.clone().sum::<f64>();
    let mut last = (0, 0.0);
    for (i, weight) in weights.enumerate().filter(|&(_, weight)| weight > 0.0) {
        if left < weight {
            return (i, left / weight);
        }
        left -= weight;
        // The result if rounding leaves a remainder.
        last = (i, 1.0 - f64::EPSILON);
    }
    last
}

/// Point `i` of a low-discrepancy sequence over the unit square: the Kronecker sequence of the plastic number
/// (Roberts 2018), shifted.
pub(crate) fn spread(i: u32, [s, t]: [f64; 2]) -> [f64; 2] {
    const STEPS: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];
    [(s + STEPS[0] * f64::from(i)).fract(), (t + STEPS[1] * f64::from(i)).fract()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_chosen_in_proportion() {
        let weights = [0.0, 1.0, 3.0, 0.0];
        let at = |number| choose(weights.into_iter(), number);
        assert_eq!(at(0.0), (1, 0.0));
        assert_eq!(at(0.125), (1, 0.5));
        assert_eq!(at(0.25), (2, 0.0));
        assert_eq!(at(1.0).0, 2);
    }

    #[test]
    fn points_are_even_over_a_polygon() {
        let ring =
            [[0.0, 0.0], [3.0, 0.0], [2.0, 1.0], [1.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 0.0));
        let points = (0..10_000).map(|i| spread(i, [0.1, 0.2])).map(|[u, v]| point_of(&ring, u, v));
        let (mut mean, mut below) = (DVec3::ZERO, 0);
        for point in points {
            assert!(point.y <= point.x && point.y <= 3.0 - point.x, "{point}");
            mean += point / 10_000.0;
            below += u32::from(point.y < 0.5);
        }
        assert!(mean.distance(DVec3::new(1.5, 5.0 / 12.0, 0.0)) < 1e-3, "{mean}");
        assert!((f64::from(below) / 10_000.0 - 0.625).abs() < 1e-3, "{below}");
    }
}
