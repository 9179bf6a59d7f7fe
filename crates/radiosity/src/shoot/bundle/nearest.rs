//! The nearest polygon that each ray of a bundle hits.

use fearless_simd::prelude::*;
use fearless_simd::{f64x8, mask64x8};

use super::rays::{CHUNKS, Column, LANES, Lanes, Rays, of_chunk};
use crate::mesh::{Facet, Facets};

/// The nearest hit found so far of each ray of a bundle.
pub(crate) struct Nearest {
    /// Distance of the hit, metres. Infinite without a hit, negative for rays not cast.
    pub(crate) distance: Column,
    /// The polygons that are the nearest for some rays.
    pub(crate) hits: Vec<Hit>,
    /// The largest distance at which a polygon could still be the nearest for a ray.
    pub(crate) limit: f64,
}

/// Rays that hit one side of a polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Hit {
    /// Whether it is the back. Of hits at the same distance, a front precedes a back.
    pub(crate) back: bool,
    /// Index of the piece in the environment. Then the lowest index precedes.
    pub(crate) piece: u32,
    pub(crate) rays: u64,
}

/// Rays that hit a polygon not farther away than their nearest hit so far.
struct Reach {
    nearer: u64,
    as_near: u64,
    /// The rays that come from its front.
    front: u64,
}

impl Nearest {
    pub(crate) fn new() -> Nearest {
        let distance = [Lanes([0.0; LANES]); CHUNKS];
        Nearest { distance, hits: Vec::new(), limit: 0.0 }
    }

    /// Removes all hits, and starts with the rays `cast`.
    #[inline(always)]
    pub(crate) fn clear<S: Simd>(&mut self, simd: S, cast: u64) {
        for chunk in 0..CHUNKS {
            let cast = mask64x8::from_bitmask(simd, of_chunk(cast, chunk));
            let (far, near) = (f64x8::splat(simd, f64::INFINITY), f64x8::splat(simd, -1.0));
            cast.select(far, near).store_array(&mut self.distance[chunk].0);
        }
        self.hits.clear();
        self.limit = f64::INFINITY;
    }

    /// The rays that hit something.
    pub(crate) fn found(&self) -> u64 {
        self.hits.iter().fold(0, |rays, hit| rays | hit.rays)
    }

    /// Tests all rays against a polygon, which is piece `piece` of the environment.
    #[inline(always)]
    pub(crate) fn meet<S: Simd>(
        &mut self,
        simd: S,
        rays: &Rays,
        facets: &Facets,
        polygon: u32,
        piece: u32,
    ) {
        let facet = facets.facet(polygon);
        let reach = match (facet.axis, facet.rectangle) {
            (Some(axis), Some(sides)) => {
                self.meet_rectangle(simd, rays, facets, facet, axis, sides)
            }
            _ => self.meet_any(simd, rays, facets, facet),
        };
        if reach.nearer | reach.as_near != 0 {
            self.record(&reach, piece);
            self.limit = farthest(simd, &self.distance);
        }
    }

    /// Tests rays against an axis-aligned rectangle. The result equals that of the general case to
    /// the bit, since all factors are one or zero there.
    #[inline(always)]
    fn meet_rectangle<S: Simd>(
        &mut self,
        simd: S,
        rays: &Rays,
        facets: &Facets,
        facet: &Facet,
        (axis, sign): (usize, f64),
        [(p0, p1), (q0, q1)]: [(f64, f64); 2],
    ) -> Reach {
        let above = sign * facets.above(facet, rays.origin);
        let (i, j) = facet.axes;
        let (oi, oj) = (rays.origin[i], rays.origin[j]);
        let (mut nearer, mut as_near) = (0, 0);
        for chunk in 0..CHUNKS {
            let t = above * rays.inverse[axis][chunk].load(simd);
            let p = oi + rays.direction[i][chunk].load(simd) * t;
            let q = oj + rays.direction[j][chunk].load(simd) * t;
            let margin = (p - p0).min(p1 - p).min((q - q0).min(q1 - q));
            let kept = self.keep(simd, facets.tolerance, chunk, t, margin);
            nearer |= kept.0 << (chunk * LANES);
            as_near |= kept.1 << (chunk * LANES);
        }
        let down = !rays.up[axis] & !rays.level[axis];
        Reach { nearer, as_near, front: if sign > 0.0 { down } else { rays.up[axis] } }
    }

    /// Tests rays against any polygon, as [`Facets::hit`] does.
    #[inline(always)]
    fn meet_any<S: Simd>(&mut self, simd: S, rays: &Rays, facets: &Facets, facet: &Facet) -> Reach {
        let above = facets.above(facet, rays.origin);
        let normal = facet.normal.to_array();
        let (i, j) = facet.axes;
        let (oi, oj) = (rays.origin[i], rays.origin[j]);
        let mut reach = Reach { nearer: 0, as_near: 0, front: 0 };
        for chunk in 0..CHUNKS {
            let [x, y, z] = &rays.direction;
            let slope = normal[0] * x[chunk].load(simd)
                + normal[1] * y[chunk].load(simd)
                + normal[2] * z[chunk].load(simd);
            let t = above * (1.0 / slope);
            let p = oi + rays.direction[i][chunk].load(simd) * t;
            let q = oj + rays.direction[j][chunk].load(simd) * t;
            let mut margin = f64x8::splat(simd, f64::INFINITY);
            for edge in facets.edges(facet) {
                margin = margin.min(edge.a * p + edge.b * q + edge.c);
            }
            let kept = self.keep(simd, facets.tolerance, chunk, t, margin);
            reach.nearer |= kept.0 << (chunk * LANES);
            reach.as_near |= kept.1 << (chunk * LANES);
            reach.front |= slope.simd_lt(0.0).to_bitmask() << (chunk * LANES);
        }
        reach
    }

    /// Stores the distances `t` of the rays of a chunk that are positive, inside the polygon
    /// (`margin` is the distance to the nearest edge) and nearer than the stored ones. Returns
    /// these rays, and the rays for which it is equally near.
    #[inline(always)]
    fn keep<S: Simd>(
        &mut self,
        simd: S,
        tolerance: f64,
        chunk: usize,
        t: f64x8<S>,
        margin: f64x8<S>,
    ) -> (u64, u64) {
        let Lanes(kept) = &mut self.distance[chunk];
        let distance = f64x8::load_array_ref(simd, kept);
        let ahead = t.simd_gt(tolerance) & margin.simd_ge(-tolerance);
        let reached = ahead & t.simd_le(distance);
        if reached.all_false() {
            return (0, 0);
        }
        let nearer = ahead & t.simd_lt(distance);
        nearer.select(t, distance).store_array(kept);
        (nearer.to_bitmask(), (reached & !nearer).to_bitmask())
    }

    /// Makes a polygon the nearest one of rays that it is nearest to, or equally near and first.
    fn record(&mut self, reach: &Reach, piece: u32) {
        let mut wins = reach.nearer;
        let mut tied = reach.as_near & self.found();
        while tied != 0 {
            let ray = tied & tied.wrapping_neg();
            let mine = (reach.front & ray == 0, piece);
            let before = |hit: &Hit| hit.rays & ray != 0 && mine < (hit.back, hit.piece);
            if self.hits.iter().any(before) {
                wins |= ray;
            }
            tied &= !ray;
        }
        for hit in &mut self.hits {
            hit.rays &= !wins;
        }
        for (back, rays) in [(false, wins & reach.front), (true, wins & !reach.front)] {
            if rays != 0 {
                self.hits.push(Hit { back, piece, rays });
            }
        }
    }
}

/// The largest distance of all rays.
#[inline(always)]
fn farthest<S: Simd>(simd: S, distance: &Column) -> f64 {
    let mut farthest = distance[0].load(simd);
    for lanes in &distance[1..] {
        farthest = farthest.max(lanes.load(simd));
    }
    farthest.reduce_max()
}
