//! Participating media that absorb light on its way (§3.2): how much of a ray's light is left.

use crate::geometry::{Bounds, Ray};

/// A homogeneous medium that fills a box, absorbs and does not scatter. Where several overlap, their
/// absorption adds up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Medium {
    /// Where it is, in coordinates local to its scene's origin.
    pub bounds: Bounds,
    /// The coefficient σ of Beer and Lambert's law, 1/m: of a ray's light exp(-σd) is left after d metres.
    pub absorption: f64,
}

/// Optical depth of all media along a ray, as far as `limit` metres and only inside `within`. Of a space
/// that boxes part among them, the depths inside each add up to that of the whole.
pub fn optical_depth(media: &[Medium], ray: &Ray, within: &Bounds, limit: f64) -> f64 {
    let [start, end] = passage(ray, within, true);
    let (start, end) = (start.max(0.0), end.min(limit));
    let depth = |medium: &Medium| {
        let [enters, leaves] = passage(ray, &medium.bounds, false);
        medium.absorption * (leaves.min(end) - enters.max(start)).max(0.0)
    };
    media.iter().map(depth).sum()
}

/// Where a ray enters a box and where it leaves, metres from its origin; a ray that misses it leaves before
/// it enters. Whether one that runs in an upper side is inside is up to `closed`.
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
