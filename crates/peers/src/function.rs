//! Names of functions.

/// `a::b::run::run_avx2_fma_version` is `a::b::run`: valgrind and the host may run
/// different versions of a function, since valgrind supports fewer instructions.
pub fn plain_name(function: &str) -> String {
    let name = match function.rsplit_once("::") {
        Some((name, last)) if last.ends_with("_version") => name,
        _ => function,
    };
    name.replace("_avx512_", "_").replace("_avx_", "_")
}

#[cfg(test)]
mod tests {
    use super::plain_name;

    #[test]
    fn versions_of_a_function_have_its_name() {
        for name in ["a::walk::run::run_avx2_fma_version", "a::walk::run"] {
            assert_eq!(plain_name(name), "a::walk::run");
        }
        assert_eq!(plain_name("__memmove_avx512_unaligned_erms"), "__memmove_unaligned_erms");
        assert_eq!(plain_name("__memmove_avx_unaligned_erms"), "__memmove_unaligned_erms");
    }
}
