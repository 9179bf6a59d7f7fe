//! The form factor from an element of area to a polygon.

use std::f64::consts::TAU;

use libm::atan2;
use radiosity::glam::DVec3;

use crate::ring::above;

/// From an element of area at `point` with this unit normal to a planar polygon that shows it its
/// front: Lambert's contour integral (1760) over what is above the element's horizon, exact to
/// rounding. Negative for a polygon that shows its back.
pub fn element_to_polygon(point: DVec3, normal: DVec3, corners: &[DVec3]) -> f64 {
    let ring: Vec<DVec3> = corners.iter().map(|&corner| corner - point).collect();
    contour(normal, &above(&ring, |p| normal.dot(p)))
}

/// Lambert's contour integral over a ring of corners seen from the origin, all above the horizon.
pub(crate) fn contour(normal: DVec3, ring: &[DVec3]) -> f64 {
    let Some(&last) = ring.last() else { return 0.0 };
    let mut before = last;
    let mut sum = 0.0;
    for &here in ring {
        let across = here.cross(before);
        let sine = across.length();
        if sine > 0.0 {
            sum += atan2(sine, here.dot(before)) / sine * normal.dot(across);
        }
        before = here;
    }
    sum / TAU
}
