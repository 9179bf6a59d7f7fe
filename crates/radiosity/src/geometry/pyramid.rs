//! A pyramid around a bundle of rays with a common origin.

use glam::DVec3;

/// Four planes through the origin of the rays. All rays run between them.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pyramid {
    pub(crate) apex: DVec3,
    /// Outward unit normals of the planes. All zero if the bundle is too wide for a pyramid.
    pub(crate) outwards: [DVec3; 4],
}

impl Pyramid {
    /// The pyramid around unit directions, with its apex at the origin.
    pub(crate) fn around(directions: &[DVec3]) -> Pyramid {
        let axis = directions.iter().sum::<DVec3>().normalize_or_zero();
        let u = axis.any_orthonormal_vector();
        let v = axis.cross(u);
        let mut reach = [f64::NEG_INFINITY; 4];
        let mut narrow = f64::INFINITY;
        for d in directions {
            let ahead = d.dot(axis);
            narrow = narrow.min(ahead);
            let (x, y) = (d.dot(u) / ahead, d.dot(v) / ahead);
            for (reach, value) in reach.iter_mut().zip([x, -x, y, -y]) {
                *reach = reach.max(value);
            }
        }
        let mut outwards = [DVec3::ZERO; 4];
        if narrow > 0.1 {
            for ((plane, side), reach) in outwards.iter_mut().zip([u, -u, v, -v]).zip(reach) {
                *plane = (side - axis * (reach + 1e-6)).normalize();
            }
        }
        Pyramid { apex: DVec3::ZERO, outwards }
    }

    /// The same pyramid, moved to `apex` and rotated into a frame.
    pub(crate) fn over(&self, apex: DVec3, [tangent, bitangent, normal]: [DVec3; 3]) -> Pyramid {
        let turn = |d: DVec3| tangent * d.x + bitangent * d.y + normal * d.z;
        Pyramid { apex, outwards: self.outwards.map(turn) }
    }
}
