//! Finds the patches that the rays of a bundle hit.

use fearless_simd::f64x8;
use fearless_simd::prelude::*;
use glam::DVec3;

use super::nearest::Nearest;
use super::rays::{CHUNKS, LANES, Rays, of_chunk};
use crate::mesh::{LocalEnvironment, Piece};

/// Calls `report` with the patch (`None` for a back) and the rays that hit it, for all rays that
/// `ended`. A patch can be reported several times.
#[inline(always)]
pub(crate) fn find_patches<S: Simd>(
    simd: S,
    rays: &Rays,
    nearest: &Nearest,
    environment: &LocalEnvironment,
    ended: u64,
    mut report: impl FnMut(Option<u32>, u64),
) {
    for hit in &nearest.hits {
        let there = hit.rays & ended;
        let piece = &environment.pieces[hit.piece as usize];
        if hit.back || piece.is_back() {
            report(None, there);
            continue;
        }
        for chunk in (0..CHUNKS).filter(|&chunk| of_chunk(there, chunk) != 0) {
            let slots = slots(simd, rays, nearest, chunk, piece);
            let mut rest = of_chunk(there, chunk);
            while rest != 0 {
                let slot = slots[rest.trailing_zeros() as usize];
                let alike = slots.simd_eq(slot).to_bitmask() & rest;
                rest &= !alike;
                let patch = environment.slots[slot as usize];
                report(Some(patch), alike << (chunk * LANES));
            }
        }
    }
}

/// The slots in which the rays of a chunk hit a piece, as [`Piece::slot_hit`] finds them. Slots are integers,
/// which f64 represents exactly.
#[inline(always)]
fn slots<S: Simd>(
    simd: S,
    rays: &Rays,
    nearest: &Nearest,
    chunk: usize,
    piece: &Piece,
) -> f64x8<S> {
    let distance = nearest.distance[chunk].load(simd);
    let mut direction = [distance; 3];
    let mut point = [distance; 3];
    for axis in 0..3 {
        direction[axis] = rays.direction[axis][chunk].load(simd);
        point[axis] = rays.origin[axis] + direction[axis] * distance;
    }
    let [u_rounding, v_rounding] = piece.rounding;
    let i = slot(point, direction, piece.u, (piece.u0, piece.nu, u_rounding));
    let j = slot(point, direction, piece.v, (piece.v0, piece.nv, v_rounding));
    f64::from(piece.first_slot) + (j * f64::from(piece.nu) + i)
}

/// The slot of points along one direction.
#[inline(always)]
fn slot<S: Simd>(
    point: [f64x8<S>; 3],
    direction: [f64x8<S>; 3],
    axis: DVec3,
    (start, n, rounding): (f64, u32, f64),
) -> f64x8<S> {
    let place = (along(point, axis) - start).max(0.0);
    let border = (place + 0.5).floor();
    let mut slot = place.floor();
    let off = place - border;
    let near = off.max(-off).simd_le(rounding);
    if !near.all_false() {
        let rising = along(direction, axis).simd_gt(rounding);
        slot = near.select(rising.select(border - 1.0, border), slot);
    }
    slot.max(0.0).min(f64::from(n - 1))
}

/// A function, since closures that are not inlined compute without the processor's vectors.
#[inline(always)]
fn along<S: Simd>([x, y, z]: [f64x8<S>; 3], axis: DVec3) -> f64x8<S> {
    x * axis.x + y * axis.y + z * axis.z
}
