//! Moves the corners of polygons onto their planes.
//!
//! Files round coordinates, so that the corners of a face are beside its plane. Rays meet the plane. Where it is outside
//! of the box around the corners, a ray would leave the scene, or a cell, before it meets the polygon.

use glam::DVec3;

use super::scene::Plane;

/// Distance of a corner from its plane that is rounding, as a fraction of the tolerance.
const ROUNDING: f64 = 1e-3;

/// Corners moved onto a plane, and that plane; none if they are on `plane`. Corners within `slack` of a plane across
/// an axis are moved onto that one.
pub(crate) fn flattened(
    corners: &[DVec3],
    plane: Plane,
    slack: f64,
    tolerance: f64,
) -> Option<(Vec<DVec3>, Plane)> {
    let above = |p: DVec3| plane.normal.dot(p) - plane.offset;
    let axis = plane.normal.abs().max_position();
    let level = height(corners, axis);
    // A normal so near an axis that it is rounded to it has no tilt.
    let exact = plane.normal[axis].abs() < 1.0 || corners.iter().all(|p| p[axis] == level);
    if exact && corners.iter().all(|&p| above(p).abs() <= ROUNDING * tolerance) {
        return None;
    }
    if corners.iter().any(|p| (p[axis] - level).abs() > slack) {
        return Some((corners.iter().map(|&p| p - plane.normal * above(p)).collect(), plane));
    }
    let mut flat = corners.to_vec();
    flat.iter_mut().for_each(|p| p[axis] = level);
    let side = plane.normal[axis].signum();
    Some((flat, Plane { normal: DVec3::AXES[axis] * side, offset: level * side }))
}

/// The height of most corners along an axis, where level neighbours meet them; of several the lowest.
fn height(corners: &[DVec3], axis: usize) -> f64 {
    let count = |height: f64| corners.iter().filter(|p| p[axis] == height).count();
    let heights = corners.iter().map(|p| p[axis]);
    heights.max_by(|&a, &b| count(a).cmp(&count(b)).then(b.total_cmp(&a))).unwrap_or_default()
}
