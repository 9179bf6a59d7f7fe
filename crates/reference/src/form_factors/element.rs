//! The form factor from an element of area to a polygon.

use std::f64::consts::TAU;

use libm::atan2;
use radiosity::glam::DVec3;

use crate::form_factors::clipping::above;

/// From an element of area at `point` with this unit normal to a planar polygon that faces it:
/// Lambert's contour integral (1760) over the part above the element's horizon, exact to rounding. Negative
/// for a polygon that faces away.
pub fn element_to_polygon(point: DVec3, normal: DVec3, corners: &[DVec3]) -> f64 {
    let ring: Vec<DVec3> = corners.iter().map(|&corner| corner - point).collect();
    contour(normal, &above(&ring, |p| normal.dot(p)))
}

/// Lambert's contour integral over a ring of corners relative to the element, all above the horizon.
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
