//! A local environment: a block of cells, and the patches of the polygons in it.

use glam::DVec3;

use super::grid::{Block, Side};
use super::patch::Patch;
use super::piece::{Leaf, Piece};
use super::space::Space;
use crate::geometry::{BoxTree, Ray};
use crate::scene::Rgb;

/// A part of space bounded by virtual interfaces, with the patches in it.
///
/// Paper: §3, Figure 1.
#[doc(alias = "LE")]
pub struct LocalEnvironment {
    /// Its cells in the global grid.
    pub block: Block,
    /// Its patches.
    pub patches: Vec<Patch>,
    /// The parts of polygons in it, sorted by polygon.
    pub(crate) pieces: Vec<Piece>,
    /// Patch of each slot of each piece. A slot outside its polygon has the nearest patch.
    pub(crate) slots: Vec<u32>,
    /// The slots of each patch. Only in a refined mesh, where a patch can have several.
    pub(crate) leaves: Vec<Leaf>,
    /// Hierarchy over the bounds of the pieces.
    pub(crate) tree: BoxTree,
    /// Smallest area by which a patch's power is divided to get its radiosity, m². The radiosity of
    /// a sliver, from a few rays over hardly any area, would be meaningless.
    pub(super) least_area: f64,
    pub(super) whole: Block,
}

impl LocalEnvironment {
    /// Whether there is another environment behind this side.
    pub fn has_neighbour(&self, side: Side) -> bool {
        if side.upper {
            self.block.high[side.axis] < self.whole.high[side.axis]
        } else {
            self.block.low[side.axis] > self.whole.low[side.axis]
        }
    }

    /// The patch of a piece whose front a ray hits at a distance.
    #[inline]
    pub fn patch_hit(&self, piece: u32, ray: &Ray, distance: f64) -> Option<u32> {
        let piece = &self.pieces[piece as usize];
        if piece.is_back() {
            return None;
        }
        let [i, j] = piece.slot_hit(ray, distance);
        Some(self.slots[(piece.first_slot + j * piece.nu + i) as usize])
    }

    /// Whether a polygon only touches this environment. A ray hits it in another one.
    pub(crate) fn only_touches(&self, polygon: u32) -> bool {
        self.piece(polygon).is_some_and(|piece| self.pieces[piece as usize].touches)
    }

    /// The first side to a neighbour that a ray crosses at a distance or before, to within rounding.
    pub(crate) fn side_crossed(&self, space: &Space, ray: &Ray, distance: f64) -> Option<Side> {
        let sides = Side::ALL.into_iter().filter(|&side| self.has_neighbour(side));
        let crossed = sides
            .filter_map(|side| Some((space.grid.crosses(&self.block, side, ray, distance)?, side)));
        let first = crossed.min_by(|(one, _), (other, _)| one.total_cmp(other))?;
        Some(first.1)
    }

    /// The patch of a polygon at a point on its front.
    pub fn patch_at(&self, polygon: u32, point: DVec3) -> Option<u32> {
        self.patch_of(self.piece(polygon)?, point)
    }

    /// Number of polygons in it, including those of which only the back faces it.
    pub fn polygons(&self) -> usize {
        self.pieces.len()
    }

    /// The index of a polygon's piece in this environment.
    pub fn piece(&self, polygon: u32) -> Option<u32> {
        let found = self.pieces.binary_search_by_key(&polygon, |piece| piece.polygon);
        found.ok().map(|piece| piece as u32)
    }

    /// The patch of a piece at a point on its front.
    pub fn patch_of(&self, piece: u32, point: DVec3) -> Option<u32> {
        let piece = &self.pieces[piece as usize];
        if piece.is_back() {
            return None;
        }
        let slot = |along: DVec3, start: f64, n: u32| {
            ((point.dot(along) - start).max(0.0) as u32).min(n - 1)
        };
        let (i, j) = (slot(piece.u, piece.u0, piece.nu), slot(piece.v, piece.v0, piece.nv));
        Some(self.slots[(piece.first_slot + j * piece.nu + i) as usize])
    }

    /// The area by which the power of a patch is divided to get its radiosity, m².
    pub fn radiosity_area(&self, patch: u32) -> f64 {
        self.patches[patch as usize].area.max(self.least_area)
    }

    /// Power that a patch emits, without reflections, W.
    pub fn emitted_power(&self, space: &Space, patch: u32) -> Rgb {
        let Patch { area, polygon, .. } = self.patches[patch as usize];
        space.scene.material_of(polygon).emission * area
    }
}
