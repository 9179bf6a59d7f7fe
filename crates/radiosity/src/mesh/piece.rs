//! The part of a polygon in a local environment, with its quad-tree of patches.

use glam::DVec3;

use crate::geometry::Ray;

/// The part of one polygon inside an environment, with its quad-tree of patches.
///
/// The tree is stored as 2^i × 2^j equal slots, as small as its smallest leaves. A larger leaf
/// covers several slots; without refinement all leaves are one slot. A polygon of which only the
/// back faces the environment has no slots.
#[derive(Default)]
pub(crate) struct Piece {
    pub(crate) polygon: u32,
    /// `point · u - u0` runs from 0 to `nu` over the piece, likewise for v.
    pub(crate) u: DVec3,
    pub(crate) u0: f64,
    pub(crate) nu: u32,
    pub(crate) v: DVec3,
    pub(crate) v0: f64,
    pub(crate) nv: u32,
    /// Rounding of a position, in slots along u and along v.
    pub(crate) rounding: [f64; 2],
    /// Whether the polygon only touches the environment: rays hit it in the environment that it is in.
    pub(crate) touches: bool,
    /// Index of its first slot in the environment.
    pub(crate) first_slot: u32,
}

impl Piece {
    /// Whether only the back of its polygon faces the environment.
    pub(crate) fn is_back(&self) -> bool {
        self.nu == 0
    }

    /// The slot, along u and along v, in which a ray hits it.
    ///
    /// A hit within rounding of a border between slots belongs to the slot that the ray comes from, so that
    /// it does not depend on where the polygon is cut; if the ray runs along the border, to the upper one.
    pub(crate) fn slot_hit(&self, ray: &Ray, distance: f64) -> [u32; 2] {
        let (point, [su, sv]) = (ray.at(distance), self.rounding);
        [(self.u, self.u0, self.nu, su), (self.v, self.v0, self.nv, sv)].map(
            |(along, start, n, rounding)| {
                let place = (point.dot(along) - start).max(0.0);
                let border = (place + 0.5).floor();
                let slot = if (place - border).abs() > rounding {
                    place.floor()
                } else if ray.direction.dot(along) > rounding {
                    border - 1.0
                } else {
                    border
                };
                (slot.max(0.0) as u32).min(n - 1)
            },
        )
    }
}

/// A leaf of a quad-tree: a square of slots.
#[derive(Clone, Copy)]
pub(crate) struct Leaf {
    /// Its first slot along u and v.
    pub(crate) first: [u32; 2],
    /// Number of slots along u, and along v.
    pub(crate) side: u32,
}
