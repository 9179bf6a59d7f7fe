//! The part of a polygon in a local environment, with its quad-tree of patches.

use glam::DVec3;

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
    /// Index of its first slot in the environment.
    pub(crate) first_slot: u32,
}

impl Piece {
    /// Whether only the back of its polygon faces the environment.
    pub(crate) fn is_back(&self) -> bool {
        self.nu == 0
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
