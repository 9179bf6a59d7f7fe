//! A homogeneous medium that absorbs light, and the optical depth along a ray.

use crate::geometry::{Bounds, Ray};

/// A homogeneous medium that fills a box. It absorbs all colours alike and does not scatter. Where
/// several media overlap, their absorption coefficients add up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Medium {
    /// Its box, in coordinates local to the origin of the scene.
    pub bounds: Bounds,
    /// Absorption coefficient σ, 1/m: exp(-σd) of the light is left after d metres.
    pub absorption: f64,
}

/// Optical depth of all media along a ray, up to `limit` metres and only inside the box `within`.
/// If boxes partition a space, the depths inside them add up to the depth in the whole space.
pub fn optical_depth(media: &[Medium], ray: &Ray, within: &Bounds, limit: f64) -> f64 {
    let [start, end] = passage(ray, within, true);
    let (start, end) = (start.max(0.0), end.min(limit));
    let depth = |medium: &Medium| {
        let [enters, leaves] = passage(ray, &medium.bounds, false);
        medium.absorption * (leaves.min(end) - enters.max(start)).max(0.0)
    };
    media.iter().map(depth).sum()
}

/// Distances at which a ray enters and leaves a box, metres; if it misses the box the first is
/// larger. A ray inside the plane of an upper side is in the box only if `closed`.
fn passage(ray: &Ray, around: &Bounds, closed: bool) -> [f64; 2] {
    let (mut enters, mut leaves) = (f64::NEG_INFINITY, f64::INFINITY);
    for axis in 0..3 {
        let (low, high) = (around.min[axis], around.max[axis]);
        if ray.direction[axis] == 0.0 {
            let at = ray.origin[axis];
            if !(low <= at && (at < high || closed && at == high)) {
                return [f64::INFINITY, f64::NEG_INFINITY];
            }
            continue;
        }
        let crosses = |plane: f64| (plane - ray.origin[axis]) * ray.inverse[axis];
        let (one, other) = (crosses(low), crosses(high));
        enters = enters.max(one.min(other));
        leaves = leaves.min(one.max(other));
    }
    [enters, leaves]
}
