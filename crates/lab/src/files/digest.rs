//! Digests, by which results name the files that they come from.

use std::fmt::Write;
use std::path::Path;

use config::Fault;
use sha2::{Digest, Sha256};

use crate::files::file;

/// SHA-256 of some bytes, in hexadecimal.
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().fold(String::new(), |mut text, byte| {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
        text
    })
}

/// A file and the digest of what it says.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct FileDigest {
    /// What results call the file.
    pub label: String,
    pub sha256: String,
}

impl FileDigest {
    pub fn of(path: &Path, label: &str) -> Result<FileDigest, Fault> {
        Ok(FileDigest::of_bytes(&file::read(path)?, label))
    }

    pub fn of_bytes(bytes: &[u8], label: &str) -> FileDigest {
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
}
