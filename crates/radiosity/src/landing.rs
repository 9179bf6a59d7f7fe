//! Which patches the rays of a bundle end on.

#![allow(clippy::needless_range_loop, reason = "plain loops become vector instructions")]

use multiversion::multiversion;

use crate::bundle::{BACK, BIT, LANES, Rays, WIDTH, united};
use crate::environment::{LocalEnvironment, Piece};

/// Tell, a few rays of the bundle at a time, on the front of which patch those that have `ended` did,
/// or that it was on a back.
pub(crate) fn land(
    rays: &Rays,
    environment: &LocalEnvironment,
    ended: u64,
    mut told: impl FnMut(Option<u32>, u64),
) {
    for chunk in 0..WIDTH / LANES {
        let mut rest = ended & 0xff << (chunk * LANES);
        while rest != 0 {
            // Those on the same polygon as the first.
            let hit = rays.hit[chunk][rest.trailing_zeros() as usize % LANES];
            let piece = &environment.pieces[hit as u32 as usize];
            let (alike, slots) = slots(rays, chunk, hit, piece);
            let mut on_piece = rest & alike;
            rest &= !alike;
            if hit & BACK != 0 || piece.is_back() {
                told(None, on_piece);
                continue;
            }
            while on_piece != 0 {
                let slot = slots[on_piece.trailing_zeros() as usize % LANES];
                let mut in_slot = 0;
                for l in 0..LANES {
                    in_slot |= if slots[l] == slot { BIT[chunk][l] } else { 0 };
                }
                told(Some(environment.slots[slot as usize]), on_piece & in_slot);
                on_piece &= !in_slot;
            }
        }
    }
}

/// Of a chunk of rays those whose hit is `hit`, and the slot of its polygon's piece in which each is.
#[multiversion(targets(
    "x86_64+avx512f+avx512dq+avx512vl+avx512bw",
    "x86_64+avx2",
    "aarch64+neon"
))]
fn slots(rays: &Rays, chunk: usize, hit: u64, piece: &Piece) -> (u64, [u32; LANES]) {
    let mut alike = [0; LANES];
    for l in 0..LANES {
        alike[l] = if rays.hit[chunk][l] == hit { BIT[chunk][l] } else { 0 };
    }
    let mut point = [[0.0; LANES]; 3];
    for axis in 0..3 {
        for l in 0..LANES {
            point[axis][l] =
                rays.origin[axis] + rays.direction[axis][chunk][l] * rays.distance[chunk][l];
        }
    }
    let [x, y, z] = &point;
    let (mut i, mut j) = ([0; LANES], [0; LANES]);
    for l in 0..LANES {
        let along = x[l] * piece.u.x + y[l] * piece.u.y + z[l] * piece.u.z - piece.u0;
        i[l] = slot(along, piece.nu);
        let along = x[l] * piece.v.x + y[l] * piece.v.y + z[l] * piece.v.z - piece.v0;
        j[l] = slot(along, piece.nv);
    }
    let mut slots = [0; LANES];
    for l in 0..LANES {
        slots[l] = piece.first_slot + j[l] * piece.nu + i[l];
    }
    (united(alike), slots)
}

#[inline(always)]
fn slot(along: f64, n: u32) -> u32 {
    let last = f64::from(n) - 1.0;
    let along = if along > 0.0 { along } else { 0.0 };
    (if along < last { along } else { last }) as i32 as u32
}
