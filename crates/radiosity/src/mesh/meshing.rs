//! Meshing of a local environment: divides its polygons into quad-trees of patches.

use glam::DVec3;

use super::environment::LocalEnvironment;
use super::grid::Block;
use super::patch::{Patch, PatchSize};
use super::piece::{Leaf, Piece};
use super::space::Space;
use crate::geometry::{Bounds, BoxTree, area_and_centroid, clip_to_box, clip_to_slab};
use crate::scene::{Polygon, Rgb};

/// How often a slot must be halved, as a function of its polygon, its corners and its edge lengths.
pub(crate) type Depth<'a> = dyn Fn(u32, &[DVec3], [f64; 2]) -> u32 + 'a;

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
            // The polygon ends within the tolerance of the boundary. By rounding, a ray may still
            // end here, so a patch is needed, even without area.
            piece = clip_to_box(&corners, &bounds.widened(space.scene.tolerance()));
            piece.iter_mut().for_each(|p| *p = p.clamp(bounds.min, bounds.max));
        }
        self.add_piece(id, &piece, &corners, polygon.plane.normal, size, depth);
    }

    /// Meshes one convex piece: halves its sides until they are no longer than `size`, and then
    /// each slot as often as `depth` requires.
    fn add_piece(
        &mut self,
        id: u32,
        piece: &[DVec3],
        corners: &[DVec3],
        n: DVec3,
        size: f64,
        depth: Option<&Depth>,
    ) {
        let u = (corners[1] - corners[0]).normalize();
        let v = n.cross(u);
        let flat = area_and_centroid(piece).0 == 0.0;
        let size = if flat { f64::INFINITY } else { size };
        let (u0, u_length) = extent(piece, u);
        let (v0, v_length) = extent(piece, v);
        let (nu, nv) = (halvings(u_length, size), halvings(v_length, size));
        let row = |j: u32, nv: u32| {
            let (low, high) = slice(v0, v_length, j, nv);
            if nv > 1 { clip_to_slab(piece, v, low, high) } else { piece.to_vec() }
        };
        let part_of = |row: &[DVec3], i: u32, nu: u32| {
            let (low, high) = slice(u0, u_length, i, nu);
            if nu > 1 { clip_to_slab(row, u, low, high) } else { row.to_vec() }
        };
        let slots = || (0..nv).flat_map(|j| (0..nu).map(move |i| [i, j]));
        let edges = [u_length / f64::from(nu), v_length / f64::from(nv)];
        let depth_of = |[i, j]: [u32; 2]| {
            depth.map_or(0, |depth| depth(id, &part_of(&row(j, nv), i, nu), edges))
        };
        let depths: Vec<u32> = slots().map(depth_of).collect();
        let deepest = depths.iter().fold(0, |deepest, &depth| deepest.max(depth));
        let (nu, nv) = (nu << deepest, nv << deepest);
        let mut leaves = Vec::with_capacity((nu * nv) as usize);
        let mut of_row = ([u32::MAX; 2], Vec::new());
        for (slot, depth) in slots().zip(depths) {
            let (along, side) = (1 << depth, 1 << (deepest - depth));
            for place in (0..along).flat_map(|j| (0..along).map(move |i| [i, j])) {
                let at = [0, 1].map(|axis| slot[axis] * along + place[axis]);
                if of_row.0 != [at[1], side] {
                    of_row = ([at[1], side], row(at[1], nv / side));
                }
                let (area, centre) = area_and_centroid(&part_of(&of_row.1, at[0], nu / side));
                let keep = area > 0.0 || nu * nv == 1;
                let patch = keep.then_some(Patch { centre, area, polygon: id });
                leaves.push((Leaf { first: at.map(|i| i * side), side }, patch));
            }
        }
        let first_slot = self.slots.len() as u32;
        self.push_leaves(&leaves, [nu, nv], depth.is_some());
        let scale = |n: u32, length: f64| if length > 0.0 { f64::from(n) / length } else { 0.0 };
        let (su, sv) = (scale(nu, u_length), scale(nv, v_length));
        self.pieces.push(Piece {
            polygon: id,
            u: u * su,
            u0: u0 * su,
            nu,
            v: v * sv,
            v0: v0 * sv,
            nv,
            first_slot,
        });
    }

    /// Adds the patches of leaves and enters them in their slots. Other slots get the nearest one.
    fn push_leaves(&mut self, leaves: &[(Leaf, Option<Patch>)], [nu, nv]: [u32; 2], kept: bool) {
        let first = self.patches.len() as u32;
        let mut of_slot = vec![None; (nu * nv) as usize];
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
        let full: Vec<(u32, u32)> =
            (0..).zip(&of_slot).filter_map(|(slot, patch)| Some((slot, (*patch)?))).collect();
        self.slots.extend((0..).zip(of_slot).map(|(slot, patch): (u32, _)| {
            let away = |other: u32| {
                (slot % nu).abs_diff(other % nu).pow(2) + (slot / nu).abs_diff(other / nu).pow(2)
            };
            let nearest = || full.iter().min_by_key(|(other, _)| away(*other));
            patch.unwrap_or_else(|| nearest().map_or(first, |&(_, patch)| patch))
        }));
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

/// Start and length of the points' extent along a unit direction.
pub(crate) fn extent(points: &[DVec3], direction: DVec3) -> (f64, f64) {
    let along = points.iter().map(|p| p.dot(direction));
    let (low, high) =
        along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    (low, high - low)
}

/// The smallest power of two that divides `length` into parts no longer than `size`.
fn halvings(length: f64, size: f64) -> u32 {
    let mut parts = 1;
    while length > size * f64::from(parts) * (1.0 + 1e-9) && parts < MOST_PARTS {
        parts *= 2;
    }
    parts
}

/// Largest number of parts along a side of a piece.
const MOST_PARTS: u32 = 1 << 12;

/// Part `i` of `n` equal parts of an interval.
fn slice(start: f64, length: f64, i: u32, n: u32) -> (f64, f64) {
    let at = |i: u32| start + length * (f64::from(i) / f64::from(n));
    (at(i), at(i + 1))
}
