//! The rays of a bundle: 64 neighbouring rays from one emitter, one for each bit of a word of a
//! mask.
//!
//! The arithmetic of each ray is that of [`Ray`] and [`Facets::hit`](crate::Facets::hit) to the
//! bit, but done on eight rays at a time with the best vector instructions of the host. Sets of
//! rays are words, with one bit for each ray.

use fearless_simd::f64x8;
use fearless_simd::prelude::*;
use glam::DVec3;

use crate::geometry::{Pyramid, Ray};

/// Number of rays in a bundle: the bits of a word of a mask.
pub(crate) const WIDTH: usize = 64;

/// Number of rays that are computed at a time: a chunk.
pub(crate) const LANES: usize = 8;

/// Number of chunks in a bundle.
pub(crate) const CHUNKS: usize = WIDTH / LANES;

/// A number for each ray of a chunk.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(crate) struct Lanes(pub(crate) [f64; LANES]);

/// A number for each ray of a bundle.
pub(crate) type Column = [Lanes; CHUNKS];

impl Lanes {
    const ZERO: Lanes = Lanes([0.0; LANES]);

    #[inline(always)]
    pub(crate) fn load<S: Simd>(&self, simd: S) -> f64x8<S> {
        f64x8::load_array_ref(simd, &self.0)
    }
}

/// The bits of a word that belong to a chunk, in the lowest bits.
#[inline(always)]
pub(crate) fn of_chunk(word: u64, chunk: usize) -> u64 {
    word >> (chunk * LANES) & 0xff
}

/// Directions in the frame of an emitter, by coordinate, and a pyramid around each bundle.
#[derive(Clone, Debug)]
pub(crate) struct Bundles {
    directions: Vec<[Column; 3]>,
    pyramids: Vec<Pyramid>,
}

impl Bundles {
    /// Bundles of directions in their order. The last bundle is filled with its last direction.
    pub(crate) fn new(directions: &[DVec3]) -> Bundles {
        let fill = |bundle: &[DVec3]| {
            let at = |lane: usize| bundle[lane.min(bundle.len() - 1)];
            let column = |axis: usize| -> Column {
                std::array::from_fn(|c| Lanes(std::array::from_fn(|l| at(c * LANES + l)[axis])))
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

/// The rays of a bundle, from the centre of an emitter.
pub(crate) struct Rays {
    pub(crate) origin: DVec3,
    frame: [DVec3; 3],
    pub(crate) direction: [Column; 3],
    pub(crate) inverse: [Column; 3],
    /// For each axis, the rays whose direction is positive.
    pub(crate) up: [u64; 3],
    /// For each axis, the rays perpendicular to it.
    pub(crate) level: [u64; 3],
    pub(crate) pyramid: Pyramid,
}

impl Rays {
    /// Rays without directions.
    pub(crate) fn from(origin: DVec3, frame: [DVec3; 3]) -> Rays {
        let zero = [Lanes::ZERO; CHUNKS];
        Rays {
            origin,
            frame,
            direction: [zero; 3],
            inverse: [zero; 3],
            up: [0; 3],
            level: [0; 3],
            pyramid: Pyramid::around(&[]),
        }
    }

    /// Sets the directions to those of a bundle, as [`Ray::new`] does.
    #[inline(always)]
    pub(crate) fn aim<S: Simd>(&mut self, simd: S, bundles: &Bundles, bundle: usize) {
        self.pyramid = bundles.pyramids[bundle].over(self.origin, self.frame);
        let [tangent, bitangent, normal] = self.frame;
        for axis in 0..3 {
            let (t, b, n) = (tangent[axis], bitangent[axis], normal[axis]);
            let (mut up, mut level) = (0, 0);
            for chunk in 0..CHUNKS {
                let [x, y, z] = &bundles.directions[bundle];
                let turned =
                    t * x[chunk].load(simd) + b * y[chunk].load(simd) + n * z[chunk].load(simd);
                let tiny = turned.abs().simd_lt(Ray::LEAST);
                let direction = tiny.select(f64x8::splat(simd, 0.0), turned);
                direction.store_array(&mut self.direction[axis][chunk].0);
                (1.0 / direction).store_array(&mut self.inverse[axis][chunk].0);
                up |= direction.simd_gt(0.0).to_bitmask() << (chunk * LANES);
                level |= tiny.to_bitmask() << (chunk * LANES);
            }
            (self.up[axis], self.level[axis]) = (up, level);
        }
    }

    /// One of the rays.
    pub(crate) fn ray(&self, lane: usize) -> Ray {
        let at = |of: &[Column; 3]| {
            let [x, y, z] = of;
            let (c, l) = (lane / LANES, lane % LANES);
            DVec3::new(x[c].0[l], y[c].0[l], z[c].0[l])
        };
        Ray { origin: self.origin, direction: at(&self.direction), inverse: at(&self.inverse) }
    }
}
