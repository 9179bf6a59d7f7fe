//! Clipping of convex polygons by planes (Sutherland and Hodgman 1974).

use glam::DVec3;

use super::bounds::Bounds;

/// The part of a convex polygon where `distance` is at least zero. Points on the plane are kept.
/// `place` corrects each new point, for example to move it exactly onto the plane.
fn clip(
    points: &[DVec3],
    distance: impl Fn(DVec3) -> f64,
    place: impl Fn(DVec3) -> DVec3,
) -> Vec<DVec3> {
    let mut kept = Vec::with_capacity(points.len() + 1);
    for (i, &here) in points.iter().enumerate() {
        let next = points[(i + 1) % points.len()];
        let (d0, d1) = (distance(here), distance(next));
        if d0 >= 0.0 {
            kept.push(here);
        }
        if (d0 > 0.0 && d1 < 0.0) || (d0 < 0.0 && d1 > 0.0) {
            kept.push(place(here + (next - here) * (d0 / (d0 - d1))));
        }
    }
    kept
}

/// The part of a convex polygon inside a closed box. New corners are exactly on its planes.
pub(crate) fn clip_to_box(points: &[DVec3], bounds: &Bounds) -> Vec<DVec3> {
    let mut points = points.to_vec();
    for axis in 0..3 {
        let (low, high) = (bounds.min[axis], bounds.max[axis]);
        let onto = |plane: f64| {
            move |mut p: DVec3| {
                p[axis] = plane;
                p
            }
        };
        if points.iter().any(|p| p[axis] < low) {
            points = clip(&points, |p| p[axis] - low, onto(low));
        }
        if points.iter().any(|p| p[axis] > high) {
            points = clip(&points, |p| high - p[axis], onto(high));
        }
    }
    points
}

/// The part of a convex polygon where `low <= p · direction <= high`.
pub(crate) fn clip_to_slab(points: &[DVec3], direction: DVec3, low: f64, high: f64) -> Vec<DVec3> {
    let above = clip(points, |p| p.dot(direction) - low, |p| p);
    clip(&above, |p| high - p.dot(direction), |p| p)
}

/// The part of a convex polygon where the linear function `height` is not negative.
pub(crate) fn clip_to_half(points: &[DVec3], height: impl Fn(DVec3) -> f64) -> Vec<DVec3> {
    clip(points, height, |p| p)
}

/// The two parts of a convex polygon left and right of the line through an edge of its plane, seen from the
/// front. Corners within `tolerance` of the line count as on it. New corners are exactly on it if it is
/// parallel to an axis. A part without corners off the line is empty.
pub(crate) fn cut_by_edge(
    points: &[DVec3],
    [from, to]: [DVec3; 2],
    normal: DVec3,
    tolerance: f64,
) -> [Vec<DVec3>; 2] {
    let inwards = normal.cross(to - from).normalize_or_zero();
    let height = |p: DVec3| {
        let height = inwards.dot(p - from);
        if height.abs() <= tolerance { 0.0 } else { height }
    };
    let onto = |p: DVec3| DVec3::select(from.cmpeq(to), from, p);
    [1.0, -1.0].map(|side| {
        let beyond = points.iter().any(|&p| side * height(p) > 0.0);
        if beyond { clip(points, |p| side * height(p), onto) } else { Vec::new() }
    })
}

/// Area (m²) and centroid of a convex planar polygon. Without an area, the mean of its points.
pub(crate) fn area_and_centroid(points: &[DVec3]) -> (f64, DVec3) {
    let mean = points.iter().sum::<DVec3>() / points.len().max(1) as f64;
    let Some((&apex, rest)) = points.split_first() else { return (0.0, mean) };
    let mut area = 0.0;
    let mut moment = DVec3::ZERO;
    for edge in rest.windows(2) {
        let triangle = 0.5 * (edge[0] - apex).cross(edge[1] - apex).length();
        area += triangle;
        moment += triangle * ((edge[0] - apex) + (edge[1] - apex)) / 3.0;
    }
    if area > 0.0 { (area, apex + moment / area) } else { (0.0, mean) }
}
