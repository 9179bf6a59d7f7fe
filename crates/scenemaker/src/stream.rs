//! Named, independent random streams.

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// A random stream for a seed and a name (its first 24 bytes). Streams with different names are
/// independent, and a new one does not change the others.
pub fn stream(seed: u64, name: &str) -> ChaCha8Rng {
    let mut key = [0; 32];
    key[..8].copy_from_slice(&seed.to_le_bytes());
    for (slot, byte) in key[8..].iter_mut().zip(name.bytes()) {
        *slot = byte;
    }
    ChaCha8Rng::from_seed(key)
}
