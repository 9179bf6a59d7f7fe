//! This program, by the name under which it saves and keeps things.

use std::fs;
use std::sync::OnceLock;

use xxhash_rust::xxh3::xxh3_128;

/// A digest of this program's own file: what another build has saved or kept is not this one's. Where
/// the program cannot read itself, its version must do.
pub fn program() -> &'static str {
    static PROGRAM: OnceLock<String> = OnceLock::new();
    PROGRAM.get_or_init(|| {
        let bytes = std::env::current_exe().and_then(fs::read);
        let digest = |bytes: Vec<u8>| format!("{:032x}", xxh3_128(&bytes));
        bytes.map_or_else(|_| env!("CARGO_PKG_VERSION").to_owned(), digest)
    })
}
