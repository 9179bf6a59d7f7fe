//! The shape of a piece of a polygon, and its division into slots.

use glam::DVec3;

use super::patch::Patch;
use super::piece::Leaf;
use crate::geometry::{area_and_centroid, clip_to_slab};
use crate::scene::{Polygon, Scene};

/// How often a slot must be halved, as a function of its polygon, its corners and its edge lengths.
pub(crate) type Depth<'a> = dyn Fn(u32, &[DVec3], [f64; 2]) -> u32 + 'a;

/// A convex piece of a polygon, with the two directions in which it is divided.
pub(crate) struct Shape<'a> {
    pub(crate) corners: &'a [DVec3],
    pub(crate) axes: [DVec3; 2],
    /// Start and length of its extent along each axis.
    pub(crate) starts: [f64; 2],
    pub(crate) lengths: [f64; 2],
    pub(crate) tolerance: f64,
}

impl<'a> Shape<'a> {
    /// A piece of a polygon, whose first edge gives the directions.
    pub(crate) fn of_piece(scene: &Scene, polygon: &Polygon, corners: &'a [DVec3]) -> Shape<'a> {
        let mut all = scene.corners(polygon);
        let edge = all.next().zip(all.next()).map_or(DVec3::X, |(first, second)| second - first);
        let u = edge.normalize();
        let axes = [u, polygon.plane.normal.cross(u)];
        let [(u0, u_length), (v0, v_length)] = axes.map(|axis| extent(corners, axis));
        let (starts, lengths) = ([u0, v0], [u_length, v_length]);
        Shape { corners, axes, starts, lengths, tolerance: scene.tolerance() }
    }

    /// Whether a part with these edges is wider than the tolerance. Others have no patch of their own.
    pub(crate) fn is_wide(&self, area: f64, [u, v]: [f64; 2]) -> bool {
        area > self.tolerance * u.max(v)
    }

    /// The part between two of `n` slices along an axis.
    fn part(&self, corners: &[DVec3], axis: usize, place: u32, n: u32) -> Vec<DVec3> {
        if n == 1 {
            return corners.to_vec();
        }
        let (low, high) = slice(self.starts[axis], self.lengths[axis], place, n);
        clip_to_slab(corners, self.axes[axis], low, high)
    }

    /// The numbers of slots along u and v that are no longer than `size`.
    pub(crate) fn slots(&self, size: f64) -> [u32; 2] {
        self.lengths.map(|length| halvings(length, size))
    }

    /// How often each of these slots must be halved.
    pub(crate) fn depths(
        &self,
        id: u32,
        size: f64,
        depth: Option<&Depth>,
    ) -> impl Iterator<Item = u32> {
        let [nu, nv] = self.slots(size);
        let edges = [self.lengths[0] / f64::from(nu), self.lengths[1] / f64::from(nv)];
        (0..nv).flat_map(move |j| (0..nu).map(move |i| (i, j))).map(move |(i, j)| {
            let part = || self.part(&self.part(self.corners, 1, j, nv), 0, i, nu);
            depth.map_or(0, |depth| depth(id, &part(), edges))
        })
    }

    /// The numbers of slots along u and v, and the leaves with the patches of those that are wide enough.
    pub(crate) fn leaves(
        &self,
        id: u32,
        size: f64,
        depth: Option<&Depth>,
    ) -> ([u32; 2], Vec<(Leaf, Option<Patch>)>) {
        let [nu, nv] = self.slots(size);
        let slots = || (0..nv).flat_map(|j| (0..nu).map(move |i| [i, j]));
        let edges = [self.lengths[0] / f64::from(nu), self.lengths[1] / f64::from(nv)];
        let depths: Vec<u32> = self.depths(id, size, depth).collect();
        let deepest = depths.iter().fold(0, |deepest, &depth| deepest.max(depth));
        let (nu, nv) = (nu << deepest, nv << deepest);
        let mut leaves = Vec::with_capacity(depths.len());
        let mut of_row = ([u32::MAX; 2], Vec::new());
        for (slot, depth) in slots().zip(depths) {
            let (along, side) = (1 << depth, 1 << (deepest - depth));
            for place in (0..along).flat_map(|j| (0..along).map(move |i| [i, j])) {
                let at = [0, 1].map(|axis| slot[axis] * along + place[axis]);
                if of_row.0 != [at[1], side] {
                    of_row = ([at[1], side], self.part(self.corners, 1, at[1], nv / side));
                }
                let (area, centre) = area_and_centroid(&self.part(&of_row.1, 0, at[0], nu / side));
                let wide = self.is_wide(area, edges.map(|edge| edge / f64::from(along)));
                let patch = wide.then_some(Patch { centre, area, polygon: id });
                leaves.push((Leaf { first: at.map(|i| i * side), side }, patch));
            }
        }
        ([nu, nv], leaves)
    }
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
