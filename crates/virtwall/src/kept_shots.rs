//! Shots kept for use again, within a run and across processor counts.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use radiosity::{Mask, Shot};

use crate::message::Parcel;

/// Shots of one problem by environment, source and mask. What a shot does depends on geometry
/// alone, so a kept one is the shot itself: results with and without keeping are the same.
pub struct KeptShots {
    budget: usize,
    kept: Mutex<Kept>,
}

#[derive(Default)]
struct Kept {
    shots: BTreeMap<Key, Arc<OnceLock<Arc<Shot>>>>,
    bytes: usize,
}

/// Environment, source's environment and patch, and the mask by a 128-bit digest.
type Key = (u32, u32, u32, u128);

impl KeptShots {
    /// Keep shots until they fill `budget` bytes; those that come later are cast each time.
    pub fn new(budget: usize) -> KeptShots {
        KeptShots { budget, kept: Mutex::default() }
    }

    /// The shot of a parcel: a kept one, or cast now.
    pub(crate) fn shot(&self, parcel: &Parcel, cast: impl FnOnce() -> Shot) -> Arc<Shot> {
        let source = &parcel.source;
        let key = (parcel.environment, source.environment, source.patch, digest(&parcel.mask));
        let cell = {
            let mut kept = self.kept.lock().unwrap_or_else(PoisonError::into_inner);
            if kept.bytes < self.budget {
                Arc::clone(kept.shots.entry(key).or_default())
            } else {
                kept.shots.get(&key).map(Arc::clone).unwrap_or_default()
            }
        };
        let mut bytes = 0;
        // Whoever asks for a shot that another thread is casting waits for it.
        let shot = Arc::clone(cell.get_or_init(|| {
            let shot = cast();
            bytes = size_in_bytes(&shot);
            Arc::new(shot)
        }));
        if bytes > 0 {
            self.kept.lock().unwrap_or_else(PoisonError::into_inner).bytes += bytes;
        }
        shot
    }
}

/// What keeping a shot takes, its place in the table included.
fn size_in_bytes(shot: &Shot) -> usize {
    let masks = shot.outgoing.iter().flatten().map(|o| size_of_val(o.mask.words()));
    size_of::<Key>() + size_of::<Shot>() + size_of_val(&shot.hits[..]) + masks.sum::<usize>()
}

/// Two independent 64-bit multiplicative hashes of the mask's words; among 10⁹ masks two share both
/// with a probability below 10⁻²⁰.
fn digest(mask: &Mask) -> u128 {
    let (mut a, mut b) = (0x243f_6a88_85a3_08d3u64, 0x1319_8a2e_0370_7344u64);
    for &word in mask.words() {
        a = (a ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        a ^= a >> 32;
        b = (b.rotate_left(23) ^ word).wrapping_mul(0xd6e8_feb8_6659_fd93);
        b ^= b >> 29;
    }
    u128::from(a) << 64 | u128::from(b)
}
