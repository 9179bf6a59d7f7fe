//! Digests, by which results name the files that they come from.

use sha2::{Digest, Sha256};

/// SHA-256 of some bytes, in hexadecimal.
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// A text after a line with the digest of it and of what it is about, so that damage is noticed.
pub fn sealed(about: &str, text: &str) -> String {
    format!("{}\n{text}", sha256(format!("{about}\n{text}").as_bytes()))
}

/// The text that was sealed; none if it was damaged, or is about something else.
pub fn unsealed<'a>(about: &str, sealed_text: &'a str) -> Option<&'a str> {
    let (_, text) = sealed_text.split_once('\n')?;
    (sealed(about, text) == sealed_text).then_some(text)
}

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FileDigest {
    /// What results call the file.
    pub label: String,
    pub sha256: String,
}

impl FileDigest {
    /// The digest of a file's bytes; results call the file `label`.
    pub fn of(bytes: &[u8], label: &str) -> FileDigest {
        FileDigest { label: label.replace('\\', "/"), sha256: sha256(bytes) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_digest_is_sha_256() {
        // FIPS 180-2, appendix B.1.
        let abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(sha256(b"abc"), abc);
    }

    #[test]
    fn damage_breaks_a_seal() {
        let whole = sealed("x", "one\ntwo");
        assert_eq!(unsealed("x", &whole), Some("one\ntwo"));
        assert_eq!(unsealed("y", &whole), None);
        for damaged in ["", "one", &whole.replace("two", "six"), &whole[1..], &whole[..70]] {
            assert_eq!(unsealed("x", damaged), None);
        }
    }
}
