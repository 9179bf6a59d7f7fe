//! Named random streams.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// The stream of that name under that seed. Seed and name (its first 24 bytes) are the cipher's
/// key, so streams of different names are independent and adding one disturbs no other.
pub fn stream(seed: u64, name: &str) -> ChaCha8Rng {
    let mut key = [0; 32];
    key[..8].copy_from_slice(&seed.to_le_bytes());
    for (slot, byte) in key[8..].iter_mut().zip(name.bytes()) {
        *slot = byte;
    }
    ChaCha8Rng::from_seed(key)
}
