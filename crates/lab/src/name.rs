//! Names that become files in the folder of results.

/// What a plain name is, for messages.
pub const PLAIN: &str = "letters, digits, \"-\", \"_\" and \".\", the first one no \".\"";

/// Whether a name is one file in the folder where it is put, and no hidden one.
pub fn is_plain(name: &str) -> bool {
    let plain = |c: char| c.is_alphanumeric() || "-_.".contains(c);
    !name.is_empty() && name.len() <= 100 && !name.starts_with('.') && name.chars().all(plain)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_plain_leads_elsewhere() {
        for name in ["table1", "speed_up-by-stop.patch_threshold", "größe"] {
            assert!(is_plain(name), "{name}");
        }
        for name in ["", ".", "..", "../x", "/etc/x", "a/b", "a\\b", "C:x", ".partial", "a b"] {
            assert!(!is_plain(name), "{name}");
        }
    }
}
