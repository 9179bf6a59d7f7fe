//! A ray.

use glam::DVec3;

/// A ray from the centre of a source; distances along it are metres.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Where it starts.
    pub origin: DVec3,
    /// Unit direction.
    pub direction: DVec3,
    /// 1 / direction, by component; infinite where the direction is zero.
    pub inverse: DVec3,
}

impl Ray {
    /// A ray. Components of the direction too small to matter count as zero, so that no product of
    /// zero and infinity arises where the ray starts on a plane of the grid.
    pub fn new(origin: DVec3, direction: DVec3) -> Ray {
        let direction = direction.map(|d| if d.abs() < Ray::LEAST { 0.0 } else { d });
        Ray { origin, direction, inverse: direction.recip() }
    }

    /// The point at a distance.
    #[inline]
    pub fn at(&self, distance: f64) -> DVec3 {
        self.origin + self.direction * distance
    }

    /// A component of a direction smaller than this is zero.
    pub(crate) const LEAST: f64 = 1e-100;
}
