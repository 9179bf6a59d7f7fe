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
    let mut point = [distance; 3];
    for (axis, point) in point.iter_mut().enumerate() {
        *point = rays.origin[axis] + rays.direction[axis][chunk].load(simd) * distance;
    }
    let [u_rounding, v_rounding] = piece.rounding;
    let u = (along(point, piece.u) - piece.u0).max(0.0);
    let v = (along(point, piece.v) - piece.v0).max(0.0);
    let (mut i, mut j) = (u.floor(), v.floor());
    let near = off_border(u, i).simd_le(u_rounding) | off_border(v, j).simd_le(v_rounding);
    if !near.all_false() {
        let direction = std::array::from_fn(|axis| rays.direction[axis][chunk].load(simd));
        i = by_direction(u, i, along(direction, piece.u), u_rounding);
        j = by_direction(v, j, along(direction, piece.v), v_rounding);
    }
    i = i.min(f64::from(piece.nu - 1));
    j = j.min(f64::from(piece.nv - 1));
    f64::from(piece.first_slot) + (j * f64::from(piece.nu) + i)
}

/// How far places in slots are from the nearest border. Exact, since they are so near.
#[inline(always)]
fn off_border<S: Simd>(place: f64x8<S>, slot: f64x8<S>) -> f64x8<S> {
    let above = place - slot;
    above.min(1.0 - above)
}

/// The slots of places, where those within `rounding` of a border belong to the slot that the ray comes from.
#[inline(always)]
fn by_direction<S: Simd>(
    place: f64x8<S>,
    slot: f64x8<S>,
    direction: f64x8<S>,
    rounding: f64,
) -> f64x8<S> {
    let border = (place + 0.5).floor();
    let owner = direction.simd_gt(rounding).select(border - 1.0, border);
    off_border(place, slot).simd_le(rounding).select(owner, slot).max(0.0)
}

/// A function, since closures that are not inlined compute without the processor's vectors.
#[inline(always)]
fn along<S: Simd>([x, y, z]: [f64x8<S>; 3], axis: DVec3) -> f64x8<S> {
    x * axis.x + y * axis.y + z * axis.z
}
