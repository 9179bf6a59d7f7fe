//! A local environment: a block of cells, its pieces of polygons, their quad-trees of patches.

use glam::DVec3;

use super::grid::{Block, Side};
use super::space::Space;
use crate::geometry::{Bounds, Tree, area_and_centroid, clip_to_box, clip_to_slab};
use crate::scene::{Polygon, Rgb};

/// Edge lengths that a quad-tree of patches goes down to, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PatchSize {
    /// For polygons that only reflect.
    pub reflector: f64,
    /// For polygons that emit.
    pub emitter: f64,
}

/// A patch: what receives, keeps and shoots light as one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patch {
    /// Centroid: where its rays start.
    pub centre: DVec3,
    /// Area in m²; zero where a polygon only touches the environment.
    pub area: f64,
    /// The polygon that it belongs to.
    pub polygon: u32,
}

/// The part of one polygon inside an environment, and its quad-tree: 2^i by 2^j slots, as fine as its
/// finest leaves, each with its patch; a larger leaf has several. Unless the mesh is refined all leaves
/// are alike. None of it is left of a polygon that shows the environment only its back.
#[derive(Default)]
pub(crate) struct Piece {
    polygon: u32,
    /// `point · u - u0` runs from 0 to `nu` over the piece; likewise v.
    pub(crate) u: DVec3,
    pub(crate) u0: f64,
    pub(crate) nu: u32,
    pub(crate) v: DVec3,
    pub(crate) v0: f64,
    pub(crate) nv: u32,
    pub(crate) first_slot: u32,
}

impl Piece {
    /// Whether its polygon shows the environment only its back.
    pub(crate) fn is_back(&self) -> bool {
        self.nu == 0
    }
}

/// One part of space between virtual interfaces, with the patches in it (§3, §4.2.1).
#[doc(alias = "LE")]
pub struct LocalEnvironment {
    /// Its cells in the global grid.
    pub block: Block,
    /// Its patches.
    pub patches: Vec<Patch>,
    /// By rising polygon.
    pub(crate) pieces: Vec<Piece>,
    /// Patch of each slot of each piece; a slot outside its polygon names the nearest patch.
    pub(crate) slots: Vec<u32>,
    /// Of each patch the slots that it was cut from, where they may be several: in a refined mesh.
    pub(crate) leaves: Vec<Leaf>,
    /// Over the boxes of its pieces.
    pub(crate) tree: Tree,
    /// The area that a patch counts for when its radiosity is told: a sliver's radiosity, a few
    /// rays over hardly any area, would mean nothing.
    least_area: f64,
    whole: Block,
}

/// A leaf of a piece's quad-tree: a square of slots.
#[derive(Clone, Copy)]
pub(crate) struct Leaf {
    /// The first of them along u and v.
    pub(crate) first: [u32; 2],
    /// How many there are along each.
    pub(crate) side: u32,
}

/// How often a slot is to be halved, by its polygon, its corners and the lengths of its edges.
pub(crate) type Depth<'a> = dyn Fn(u32, &[DVec3], [f64; 2]) -> u32 + 'a;

/// Fraction of a full-sized patch's area below which a sliver counts as that large.
const SLIVER: f64 = 1e-3;

impl LocalEnvironment {
    /// Cut the polygons of a block of cells out of the scene and mesh them.
    #[doc(alias = "§4.2.1")]
    pub fn new(space: &Space, block: Block, size: PatchSize) -> LocalEnvironment {
        LocalEnvironment::meshed(space, block, size, None)
    }

    /// The same with slots halved further where `depth` says so.
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
            tree: Tree::default(),
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
        // Wider than what rounding and the tolerance of hits can put outside.
        let widen = 8.0 * space.scene.tolerance();
        let around = space.grid.bounds(&block);
        let boxed = |&id: &u32| {
            let corners = space.scene.corners(&space.scene.polygons[id as usize]);
            Bounds::of(corners).widened(widen).intersection(&around.widened(widen))
        };
        environment.tree = Tree::new(&met.iter().map(boxed).collect::<Vec<_>>());
        // It stays as it is: what growing lists kept in reserve is a third of them.
        environment.patches.shrink_to_fit();
        environment.pieces.shrink_to_fit();
        environment.slots.shrink_to_fit();
        environment.leaves.shrink_to_fit();
        environment
    }

    /// Whether another environment lies behind this side.
    pub fn has_neighbour(&self, side: Side) -> bool {
        if side.upper {
            self.block.high[side.axis] < self.whole.high[side.axis]
        } else {
            self.block.low[side.axis] > self.whole.low[side.axis]
        }
    }

    /// The patch of a polygon at a point where a ray hit its front. Every point that a ray's passage
    /// through this environment can hit has one.
    pub fn patch_at(&self, polygon: u32, point: DVec3) -> Option<u32> {
        self.patch_of(self.piece(polygon)?, point)
    }

    /// How many polygons reach into it, those that show it only their backs included.
    pub fn polygons(&self) -> usize {
        self.pieces.len()
    }

    /// The number of a polygon among those of this environment.
    pub fn piece(&self, polygon: u32) -> Option<u32> {
        let found = self.pieces.binary_search_by_key(&polygon, |piece| piece.polygon);
        found.ok().map(|piece| piece as u32)
    }

    /// The polygon of a piece.
    pub(crate) fn polygon(&self, piece: u32) -> u32 {
        self.pieces[piece as usize].polygon
    }

    /// The patch of a piece at a point where a ray hit its front.
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

    /// The area over which a patch's power is spread when its radiosity is asked for, m².
    pub fn radiosity_area(&self, patch: u32) -> f64 {
        self.patches[patch as usize].area.max(self.least_area)
    }

    /// Power that a patch emits of itself, W.
    pub fn emitted_power(&self, space: &Space, patch: u32) -> Rgb {
        let Patch { area, polygon, .. } = self.patches[patch as usize];
        space.scene.material(&space.scene.polygons[polygon as usize]).emission * area
    }

    fn add_polygon(&mut self, space: &Space, id: u32, size: PatchSize, depth: Option<&Depth>) {
        let polygon = &space.scene.polygons[id as usize];
        let bounds = space.grid.bounds(&self.block);
        let corners: Vec<DVec3> = space.scene.corners(polygon).collect();
        if lies_behind(polygon, &corners, bounds.min, bounds.max) {
            self.pieces.push(Piece { polygon: id, ..Piece::default() });
            return;
        }
        let emits = space.scene.material(polygon).emission != Rgb::ZERO;
        let size = if emits { size.emitter } else { size.reflector };
        let mut piece = clip_to_box(&corners, &bounds);
        if piece.is_empty() {
            // The polygon reaches the boundary to within the tolerance and no farther. Rounding may
            // still end a ray here, so its light needs a patch, be it one without area.
            let widen = DVec3::splat(space.scene.tolerance());
            let near = Bounds { min: bounds.min - widen, max: bounds.max + widen };
            piece = clip_to_box(&corners, &near);
            piece.iter_mut().for_each(|p| *p = p.clamp(bounds.min, bounds.max));
        }
        self.add_piece(id, &piece, &corners, polygon.plane.normal, size, depth);
    }

    /// Mesh one convex piece: halve each side until it is no longer than `size`, and then each slot of that
    /// as often as `depth` says.
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

    /// Number the leaves that hold something as patches, which their slots name; the other slots name
    /// the nearest that does.
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

/// Whether a polygon lies in a side of the box and shows the box its back. Rays inside meet only
/// that back, and its front belongs to the neighbour.
fn lies_behind(polygon: &Polygon, corners: &[DVec3], low: DVec3, high: DVec3) -> bool {
    (0..3).any(|axis| {
        let normal = polygon.plane.normal[axis];
        let in_plane = |plane: f64| corners.iter().all(|p| p[axis] == plane);
        (normal == 1.0 && in_plane(high[axis])) || (normal == -1.0 && in_plane(low[axis]))
    })
}

/// Where the points begin along a unit direction, and over what length they reach.
pub(crate) fn extent(points: &[DVec3], direction: DVec3) -> (f64, f64) {
    let along = points.iter().map(|p| p.dot(direction));
    let (low, high) =
        along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    (low, high - low)
}

/// The least power of two that cuts `length` into parts no longer than `size`.
fn halvings(length: f64, size: f64) -> u32 {
    let mut parts = 1;
    while length > size * f64::from(parts) * (1.0 + 1e-9) && parts < MOST_PARTS {
        parts *= 2;
    }
    parts
}

/// The most parts that a side of a piece is cut into.
const MOST_PARTS: u32 = 1 << 12;

/// Part `i` of `n` of an interval.
fn slice(start: f64, length: f64, i: u32, n: u32) -> (f64, f64) {
    let at = |i: u32| start + length * (f64::from(i) / f64::from(n));
    (at(i), at(i + 1))
}
