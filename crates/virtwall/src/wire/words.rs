//! The words of a mask as bytes.

use std::borrow::Cow;

use zerocopy::IntoBytes;

/// The bytes of words, little-endian: on most hosts the words as they are in memory.
pub(crate) fn little_endian(words: &[u64]) -> Cow<'_, [u8]> {
    if cfg!(target_endian = "little") {
        Cow::Borrowed(words.as_bytes())
    } else {
        words.iter().flat_map(|word| word.to_le_bytes()).collect()
    }
}
