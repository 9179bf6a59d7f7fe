//! Meshing of a local environment: divides its polygons into quad-trees of patches.

use glam::DVec3;

use super::environment::LocalEnvironment;
use super::facets::ROUNDING;
use super::grid::Block;
use super::nearest_slots::nearest_full;
use super::patch::{Patch, PatchSize};
use super::piece::{Leaf, Piece};
use super::shape::{Depth, Shape};
use super::space::Space;
use crate::geometry::{Bounds, BoxTree, area_and_centroid, clip_to_box};
use crate::scene::{Polygon, Rgb};

/// Smallest area used to compute a radiosity, as a fraction of the area of a full-sized patch.
const SLIVER: f64 = 1e-3;

impl LocalEnvironment {
    /// Cuts the polygons of a block of cells out of the scene and meshes them.
    ///
    /// Paper: §4.2.1.
    #[doc(alias = "§4.2.1")]
    pub fn new(space: &Space, block: Block, size: PatchSize) -> LocalEnvironment {
        LocalEnvironment::meshed(space, block, size, None)
    }

    /// The same, with slots halved further as `depth` requires.
    pub(crate) fn meshed(
        space: &Space,
        block: Block,
        size: PatchSize,
        depth: Option<&Depth>,
    ) -> LocalEnvironment {
        let mut environment = LocalEnvironment {
            block,
            patches: Vec::new(),
            pieces: Vec::new(),
            slots: Vec::new(),
            leaves: Vec::new(),
            tree: BoxTree::default(),
            least_area: SLIVER * size.reflector * size.reflector,
            whole: space.grid.whole(),
        };
        let mut met: Vec<u32> =
            block.cells().flat_map(|cell| space.grid.polygons(cell).iter().copied()).collect();
        met.sort_unstable();
        met.dedup();
        for &id in &met {
            environment.add_polygon(space, id, size, depth);
        }
        // Wide enough for rounding and for the tolerance of hits.
        let widen = 8.0 * space.scene.tolerance();
        let around = space.grid.bounds(&block);
        let boxed = |&id: &u32| {
            let corners = space.scene.corners(&space.scene.polygons[id as usize]);
            Bounds::of(corners).widened(widen).intersection(&around.widened(widen))
        };
        environment.tree = BoxTree::new(&met.iter().map(boxed).collect::<Vec<_>>());
        // The lists grow no further. Their spare capacity would be a third of the memory.
        environment.patches.shrink_to_fit();
        environment.pieces.shrink_to_fit();
        environment.slots.shrink_to_fit();
        environment.leaves.shrink_to_fit();
        environment
    }

    fn add_polygon(&mut self, space: &Space, id: u32, size: PatchSize, depth: Option<&Depth>) {
        let polygon = &space.scene.polygons[id as usize];
        let bounds = space.grid.bounds(&self.block);
        let corners: Vec<DVec3> = space.scene.corners(polygon).collect();
        if shows_only_its_back(polygon, &corners, bounds.min, bounds.max) {
            self.pieces.push(Piece { polygon: id, ..Piece::default() });
            return;
        }
        let emits = space.scene.material(polygon).emission != Rgb::ZERO;
        let size = if emits { size.emitter } else { size.reflector };
        let mut piece = clip_to_box(&corners, &bounds);
        if piece.is_empty() {
            // The polygon ends within the tolerance of the boundary. It has a patch, without area.
            piece = clip_to_box(&corners, &bounds.widened(space.scene.tolerance()));
            piece.iter_mut().for_each(|p| *p = p.clamp(bounds.min, bounds.max));
        }
        let shape = Shape::of_piece(&space.scene, polygon, &piece);
        self.add_piece(id, &shape, size, depth);
    }

    /// Meshes one convex piece: halves its sides until they are no longer than `size`, and then
    /// each slot as often as `depth` requires.
    fn add_piece(&mut self, id: u32, shape: &Shape, size: f64, depth: Option<&Depth>) {
        let (area, centre) = area_and_centroid(shape.corners);
        let touches = !shape.is_wide(area, shape.lengths);
        let (slots, leaves) = shape.leaves(id, if touches { f64::INFINITY } else { size }, depth);
        // In a strip that crosses many slots each part can be narrower than the tolerance.
        let none = leaves.iter().all(|(_, patch)| patch.is_none());
        let (slots, leaves) = if none {
            let area = if touches { 0.0 } else { area };
            (
                [1, 1],
                vec![(Leaf { first: [0, 0], side: 1 }, Some(Patch { centre, area, polygon: id }))],
            )
        } else {
            (slots, leaves)
        };
        let first_slot = self.slots.len() as u32;
        self.push_leaves(&leaves, slots, depth.is_some());
        let [su, sv] = [0, 1].map(|axis| {
            let length = shape.lengths[axis];
            if length > 0.0 { f64::from(slots[axis]) / length } else { 0.0 }
        });
        self.pieces.push(Piece {
            polygon: id,
            u: shape.axes[0] * su,
            u0: shape.starts[0] * su,
            nu: slots[0],
            v: shape.axes[1] * sv,
            v0: shape.starts[1] * sv,
            nv: slots[1],
            rounding: [su, sv].map(|scale| scale * shape.tolerance * ROUNDING),
            touches,
            first_slot,
        });
    }

    /// Adds the patches of leaves and enters them in their slots. Other slots get the nearest one.
    fn push_leaves(&mut self, leaves: &[(Leaf, Option<Patch>)], [nu, nv]: [u32; 2], kept: bool) {
        let mut of_slot = vec![None; nu as usize * nv as usize];
        for (leaf, patch) in leaves {
            let Some(patch) = patch else { continue };
            let number = self.patches.len() as u32;
            self.patches.push(*patch);
            self.leaves.extend(Some(*leaf).filter(|_| kept));
            let [i, j] = leaf.first;
            for row in j..j + leaf.side {
                let start = (row * nu + i) as usize;
                of_slot[start..start + leaf.side as usize].fill(Some(number));
            }
        }
        if of_slot.iter().all(Option::is_some) {
            self.slots.extend(of_slot.into_iter().flatten());
            return;
        }
        let full: Vec<bool> = of_slot.iter().map(Option::is_some).collect();
        let nearest = nearest_full(&full, nu as usize).unwrap_or_default();
        self.slots.extend(nearest.into_iter().filter_map(|slot| of_slot[slot as usize]));
    }
}

/// Whether a polygon is in a side of the box and faces outwards. Rays inside the box can only hit
/// its back; its front belongs to the neighbour.
fn shows_only_its_back(polygon: &Polygon, corners: &[DVec3], low: DVec3, high: DVec3) -> bool {
    (0..3).any(|axis| {
        let normal = polygon.plane.normal[axis];
        let in_plane = |plane: f64| corners.iter().all(|p| p[axis] == plane);
        (normal == 1.0 && in_plane(high[axis])) || (normal == -1.0 && in_plane(low[axis]))
    })
}
