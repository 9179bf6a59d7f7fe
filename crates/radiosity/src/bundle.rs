//! Bundles of 64 neighbouring rays from one source, one for each word of a mask: the fast path.
//!
//! The arithmetic of each ray is that of [`Facets::hit`] to the bit, only done on several rays at a
//! time; loops are written so that the compiler turns them into vector instructions, and the best
//! that the host has are chosen when the program runs.

#![allow(clippy::needless_range_loop, reason = "plain loops become vector instructions")]

use glam::DVec3;
use multiversion::multiversion;

use crate::bounds::Bounds;
use crate::facets::{Facet, Facets, Ray};
use crate::pyramid::Pyramid;

/// Rays in a bundle: bits in a word of a mask.
pub(crate) const WIDTH: usize = 64;

/// Rays done at a time.
pub(crate) const LANES: usize = 8;

/// A number for each ray of a bundle, those done at a time together.
type Column = [[f64; LANES]; WIDTH / LANES];

/// The bit of each ray in a word.
pub(crate) const BIT: [[u64; LANES]; WIDTH / LANES] = {
    let mut bit = [[0; LANES]; WIDTH / LANES];
    let mut lane = 0;
    while lane < WIDTH {
        bit[lane / LANES][lane % LANES] = 1 << lane;
        lane += 1;
    }
    bit
};

/// The bits of all lanes in one word.
#[inline(always)]
pub(crate) fn united(lanes: [u64; LANES]) -> u64 {
    let mut word = 0;
    for l in 0..LANES {
        word |= lanes[l];
    }
    word
}

/// Unit directions in a source's frame, coordinate by coordinate, and a pyramid around each bundle.
#[derive(Clone, Debug)]
pub(crate) struct Bundles {
    directions: Vec<[Column; 3]>,
    pyramids: Vec<Pyramid>,
}

impl Bundles {
    /// Bundles of directions in their order; the last one is filled up with its last direction.
    pub(crate) fn new(directions: &[DVec3]) -> Bundles {
        let fill = |bundle: &[DVec3]| {
            let at = |lane: usize| bundle[lane.min(bundle.len() - 1)];
            let column = |axis: usize| -> Column {
                std::array::from_fn(|c| std::array::from_fn(|l| at(c * LANES + l)[axis]))
            };
            [column(0), column(1), column(2)]
        };
        let bundles = directions.chunks(WIDTH);
        Bundles {
            directions: bundles.clone().map(fill).collect(),
            pyramids: bundles.map(Pyramid::around).collect(),
        }
    }
}

/// A bundle of rays over a source, and the nearest hit of each found so far.
pub(crate) struct Rays {
    pub(crate) origin: DVec3,
    frame: [DVec3; 3],
    pub(crate) direction: [Column; 3],
    pub(crate) inverse: [Column; 3],
    /// By axis, the rays that go up it and those at right angles to it.
    pub(crate) up: [u64; 3],
    pub(crate) level: [u64; 3],
    /// Metres to the nearest hit; before there is one, to the end of the environment.
    pub(crate) distance: Column,
    /// The hit polygon, by its number in the environment, with [`BACK`] for a back; of hits at the
    /// same distance the lowest goes first.
    pub(crate) hit: [[u64; LANES]; WIDTH / LANES],
    /// The greatest distance that a ray may still go.
    pub(crate) limit: f64,
    pub(crate) pyramid: Pyramid,
}

/// Marks a hit on the back of a polygon.
pub(crate) const BACK: u64 = 1 << 32;
const NOTHING: u64 = u64::MAX;

impl Rays {
    /// Rays from a source, not aimed yet.
    pub(crate) fn from(origin: DVec3, frame: [DVec3; 3]) -> Rays {
        let zero = [[0.0; LANES]; WIDTH / LANES];
        Rays {
            origin,
            frame,
            direction: [zero; 3],
            inverse: [zero; 3],
            up: [0; 3],
            level: [0; 3],
            distance: zero,
            hit: [[NOTHING; LANES]; WIDTH / LANES],
            limit: 0.0,
            pyramid: Pyramid::around(&[]),
        }
    }

    /// Aim them as a bundle, those without their bit in `word` ended before they start; each reaches
    /// to the end of the box `bounds`.
    pub(crate) fn aim(&mut self, bundles: &Bundles, bundle: usize, word: u64, bounds: &Bounds) {
        self.pyramid = bundles.pyramids[bundle].over(self.origin, self.frame);
        turn(self, &bundles.directions[bundle], bounds, word);
        self.limit = farthest(&self.distance);
    }

    /// One of the rays.
    #[inline]
    pub(crate) fn ray(&self, lane: usize) -> Ray {
        let at = |of: &[Column; 3]| {
            let [x, y, z] = of;
            let (c, l) = (lane / LANES, lane % LANES);
            DVec3::new(x[c][l], y[c][l], z[c][l])
        };
        Ray { origin: self.origin, direction: at(&self.direction), inverse: at(&self.inverse) }
    }

    /// The rays that hit something.
    pub(crate) fn hits(&self) -> u64 {
        hits(&self.hit)
    }

    /// Test all rays against a polygon, number `piece` in the environment.
    pub(crate) fn meet(&mut self, facets: &Facets, polygon: u32, piece: u32) {
        if meet(self, facets, polygon, piece) {
            self.limit = farthest(&self.distance);
        }
    }
}

// The functions below are plain loops over arrays of known length: a closure would be compiled
// without the vector instructions that are chosen for them.

#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw",
    "x86_64+avx2",
    "aarch64+neon"
))]
fn turn(rays: &mut Rays, local: &[Column; 3], bounds: &Bounds, word: u64) {
    let [tangent, bitangent, normal] = rays.frame;
    let (mut up, mut level) = ([[0; LANES]; 3], [[0; LANES]; 3]);
    for chunk in 0..WIDTH / LANES {
        let bit = &BIT[chunk];
        let mut nearest = [f64::INFINITY; LANES];
        for axis in 0..3 {
            let (t, b, n) = (tangent[axis], bitangent[axis], normal[axis]);
            let (low, high) =
                (bounds.min[axis] - rays.origin[axis], bounds.max[axis] - rays.origin[axis]);
            let (x, y, z) = (&local[0][chunk], &local[1][chunk], &local[2][chunk]);
            let mut direction = [0.0; LANES];
            let mut inverse = [0.0; LANES];
            for l in 0..LANES {
                let d: f64 = t * x[l] + b * y[l] + n * z[l];
                direction[l] = if d.abs() < Ray::LEAST { 0.0 } else { d };
            }
            for l in 0..LANES {
                inverse[l] = 1.0 / direction[l];
                // Where the ray crosses the side of the box ahead, as the grid computes it.
                let ahead = if direction[l] > 0.0 { high } else { low };
                let crossing = if direction[l] == 0.0 { f64::INFINITY } else { ahead * inverse[l] };
                nearest[l] = if crossing < nearest[l] { crossing } else { nearest[l] };
                up[axis][l] |= if direction[l] > 0.0 { bit[l] } else { 0 };
                level[axis][l] |= if direction[l] == 0.0 { bit[l] } else { 0 };
            }
            rays.direction[axis][chunk] = direction;
            rays.inverse[axis][chunk] = inverse;
        }
        for l in 0..LANES {
            nearest[l] = if word & bit[l] != 0 { nearest[l] } else { f64::NEG_INFINITY };
        }
        rays.distance[chunk] = nearest;
        rays.hit[chunk] = [NOTHING; LANES];
    }
    (rays.up, rays.level) = (up.map(united), level.map(united));
}

#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw",
    "x86_64+avx2",
    "aarch64+neon"
))]
fn hits(hit: &[[u64; LANES]; WIDTH / LANES]) -> u64 {
    let mut hits = [0; LANES];
    for chunk in 0..WIDTH / LANES {
        for l in 0..LANES {
            hits[l] |= if hit[chunk][l] == NOTHING { 0 } else { BIT[chunk][l] };
        }
    }
    united(hits)
}

#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw",
    "x86_64+avx2",
    "aarch64+neon"
))]
fn meet(rays: &mut Rays, facets: &Facets, polygon: u32, piece: u32) -> bool {
    let facet = facets.facet(polygon);
    let above = facet.offset - facet.normal.dot(rays.origin);
    let (front, back) = (u64::from(piece), u64::from(piece) | BACK);
    let mut any = [0u64; LANES];
    for chunk in 0..WIDTH / LANES {
        let (slope, t) = distances(rays, facet, above, chunk);
        let margin = margins(rays, facets, facet, &t, chunk);
        let (mut distance, mut hit) = (rays.distance[chunk], rays.hit[chunk]);
        for l in 0..LANES {
            let key = if slope[l] < 0.0 { front } else { back };
            let ahead =
                (slope[l] != 0.0) & (t[l] > facets.tolerance) & (margin[l] >= -facets.tolerance);
            let nearer = (t[l] < distance[l]) | ((t[l] == distance[l]) & (key < hit[l]));
            // All ones where this hit replaces the nearest one so far: selection without a branch.
            let replaces = u64::from(ahead & nearer).wrapping_neg();
            any[l] |= replaces;
            let bits = (t[l].to_bits() & replaces) | (distance[l].to_bits() & !replaces);
            distance[l] = f64::from_bits(bits);
            hit[l] = (key & replaces) | (hit[l] & !replaces);
        }
        rays.distance[chunk] = distance;
        rays.hit[chunk] = hit;
    }
    any != [0; LANES]
}

/// Slope of each ray towards a facet's plane, and the distance at which it meets the plane.
#[inline(always)]
fn distances(rays: &Rays, facet: &Facet, above: f64, chunk: usize) -> ([f64; LANES], [f64; LANES]) {
    let (nx, ny, nz) = (facet.normal.x, facet.normal.y, facet.normal.z);
    let (x, y, z) =
        (&rays.direction[0][chunk], &rays.direction[1][chunk], &rays.direction[2][chunk]);
    let (mut slope, mut t) = ([0.0; LANES], [0.0; LANES]);
    if let Some((axis, sign)) = facet.axis {
        // In an axis-aligned plane both are known, to the bit.
        let (direction, inverse) = (&rays.direction[axis][chunk], &rays.inverse[axis][chunk]);
        for l in 0..LANES {
            slope[l] = sign * direction[l];
            t[l] = above * (sign * inverse[l]);
        }
    } else {
        for l in 0..LANES {
            slope[l] = nx * x[l] + ny * y[l] + nz * z[l];
            t[l] = above * (1.0 / slope[l]);
        }
    }
    (slope, t)
}

/// How far inside the nearest edge each ray meets a facet's plane, metres of the flattened plane.
#[inline(always)]
fn margins(
    rays: &Rays,
    facets: &Facets,
    facet: &Facet,
    t: &[f64; LANES],
    chunk: usize,
) -> [f64; LANES] {
    let (i, j) = facet.kept;
    let (oi, oj) = (rays.origin[i], rays.origin[j]);
    let (di, dj) = (&rays.direction[i][chunk], &rays.direction[j][chunk]);
    let (mut p, mut q) = ([0.0; LANES], [0.0; LANES]);
    for l in 0..LANES {
        p[l] = oi + di[l] * t[l];
    }
    for l in 0..LANES {
        q[l] = oj + dj[l] * t[l];
    }
    let mut margin = [f64::INFINITY; LANES];
    if let Some([(p0, p1), (q0, q1)]) = facet.rectangle {
        // What the edges come to, to the bit, where their normals are axes.
        for l in 0..LANES {
            let (a, b) = (p[l] - p0, p1 - p[l]);
            let (c, d) = (q[l] - q0, q1 - q[l]);
            let (a, c) = (if a < b { a } else { b }, if c < d { c } else { d });
            margin[l] = if a < c { a } else { c };
        }
    } else {
        for e in facets.edges(facet) {
            for l in 0..LANES {
                let inside = e.a * p[l] + e.b * q[l] + e.c;
                margin[l] = if inside < margin[l] { inside } else { margin[l] };
            }
        }
    }
    margin
}

/// The greatest distance that a ray of a bundle may still go.
#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw",
    "x86_64+avx2",
    "aarch64+neon"
))]
fn farthest(distance: &Column) -> f64 {
    let mut farthest = distance[0];
    for lanes in distance {
        for l in 0..LANES {
            farthest[l] = if lanes[l] > farthest[l] { lanes[l] } else { farthest[l] };
        }
    }
    let mut most = farthest[0];
    for other in farthest {
        most = if other > most { other } else { most };
    }
    most
}
