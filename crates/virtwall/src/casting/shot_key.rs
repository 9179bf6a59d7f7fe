//! The key of a shot: the inputs that determine it.

use radiosity::{Emitter, Mask};
use xxhash_rust::xxh3::Xxh3Default;

use crate::problem::Source;
use crate::wire::little_endian;

/// The inputs that determine a shot of a problem: environment, emitter, and mask, whose length says which
/// hemisphere. The mask and the start of its rays are represented by a 128-bit digest: the probability that two
/// of 10⁹ digests are equal is below 10⁻²⁰.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ShotKey {
    environment: u32,
    emitter_environment: u32,
    patch: u32,
    mask: u128,
}

impl ShotKey {
    /// Bytes of a key in a file.
    pub const BYTES: usize = 28;

    /// The key of a source's shot.
    pub fn of(source: &Source) -> ShotKey {
        let Source { environment, emitter, mask, .. } = source;
        ShotKey {
            environment: *environment,
            emitter_environment: emitter.environment,
            patch: emitter.patch,
            mask: digest(emitter, mask),
        }
    }

    /// The key as bytes, little-endian.
    pub fn to_bytes(self) -> [u8; ShotKey::BYTES] {
        let mut bytes = [0; ShotKey::BYTES];
        let numbers = [self.environment, self.emitter_environment, self.patch];
        for (place, number) in bytes.chunks_exact_mut(4).zip(numbers) {
            place.copy_from_slice(&number.to_le_bytes());
        }
        bytes[12..].copy_from_slice(&self.mask.to_le_bytes());
        bytes
    }

    /// Decodes a key.
    pub fn from_bytes(bytes: &[u8; ShotKey::BYTES]) -> ShotKey {
        let number = |at: usize| u32::from_le_bytes(std::array::from_fn(|i| bytes[at + i]));
        ShotKey {
            environment: number(0),
            emitter_environment: number(4),
            patch: number(8),
            mask: u128::from_le_bytes(std::array::from_fn(|i| bytes[12 + i])),
        }
    }
}

fn digest(emitter: &Emitter, mask: &Mask) -> u128 {
    let mut hasher = Xxh3Default::new();
    hasher.update(&mask.pixels().to_le_bytes());
    emitter.centre.to_array().iter().for_each(|x| hasher.update(&x.to_bits().to_le_bytes()));
    hasher.update(&little_endian(mask.words()));
    if let Some((steps, _)) = mask.steps() {
        let bytes: Vec<u8> = steps.iter().flat_map(|steps| steps.to_le_bytes()).collect();
        hasher.update(&bytes);
    }
    hasher.digest128()
}
