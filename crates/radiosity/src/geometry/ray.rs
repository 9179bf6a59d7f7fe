//! A ray, with the reciprocal of its direction.

use glam::DVec3;

/// A ray. Distances along it are in metres.
#[derive(Clone, Copy, Debug)]
pub struct Ray {
    /// Starting point.
    pub origin: DVec3,
    /// Unit direction.
    pub direction: DVec3,
    /// 1 / direction, for each component. Infinite where the direction is zero.
    pub inverse: DVec3,
}

impl Ray {
    /// A ray. Direction components below `LEAST` are set to zero, so that a ray that starts on a
    /// plane of the grid never multiplies zero by infinity.
    pub fn new(origin: DVec3, direction: DVec3) -> Ray {
        let direction = direction.map(|d| if d.abs() < Ray::LEAST { 0.0 } else { d });
        Ray { origin, direction, inverse: direction.recip() }
    }

    /// The point at a distance from the origin.
    #[inline]
    pub fn at(&self, distance: f64) -> DVec3 {
        self.origin + self.direction * distance
    }

    /// Smaller components of a direction count as zero.
    pub(crate) const LEAST: f64 = 1e-100;
}
