//! The files that arguments name: files, folders, and patterns that the shell did not expand.

use std::fs;
use std::path::{Path, PathBuf};

use glob::{MatchOptions, glob_with};

/// The files that an argument means, in the order of their names. In place of a folder, the files in it
/// that `wanted` accepts; a pattern has `*` or `?` in it.
///
/// # Errors
/// A folder that cannot be read, or a pattern or folder without files.
pub fn files(argument: &Path, wanted: impl Fn(&Path) -> bool) -> Result<Vec<PathBuf>, String> {
    let is_pattern = argument.to_string_lossy().contains(['*', '?']) && !argument.exists();
    let found = if is_pattern { expanded(argument) } else { vec![argument.to_owned()] };
    if found.is_empty() {
        return Err(format!("{}: no file has such a name", argument.display()));
    }
    let mut files = Vec::new();
    for path in found {
        if path.is_dir() {
            files.extend(files_of(&path, &wanted)?);
        } else {
            files.push(path);
        }
    }
    Ok(files)
}

fn files_of(folder: &Path, wanted: impl Fn(&Path) -> bool) -> Result<Vec<PathBuf>, String> {
    let refused = |error| format!("{}: cannot be read: {error}", folder.display());
    fs::read_dir(folder).map_err(refused)?;
    let paths = names(folder).into_iter().map(|name| folder.join(name));
    let files: Vec<PathBuf> = paths.filter(|path| path.is_file() && wanted(path)).collect();
    if files.is_empty() {
        let message = "a folder without files to check; those of folders in it are not looked for";
        return Err(format!("{}: {message}", folder.display()));
    }
    Ok(files)
}

/// As in a shell, hidden names are matched only by patterns that begin with a dot.
const AS_IN_A_SHELL: MatchOptions = MatchOptions {
    case_sensitive: true,
    require_literal_separator: true,
    require_literal_leading_dot: true,
};

/// The paths that match a pattern, in the order of their names. `*` is any text and `?` any character of a name.
fn expanded(pattern: &Path) -> Vec<PathBuf> {
    let found = glob_with(&plain(&pattern.to_string_lossy()), AS_IN_A_SHELL);
    found.into_iter().flatten().flatten().collect()
}

/// The pattern without meanings that it does not have here: of brackets, and of several stars.
fn plain(pattern: &str) -> String {
    let mut plain = pattern.replace('[', "[[]");
    while plain.contains("**") {
        plain = plain.replace("**", "*");
    }
    plain
}

/// The names in a folder, in order; none if it cannot be read.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<String> =
        entries.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    names.sort();
    names
}

#[cfg(test)]
mod tests {
    use glob::Pattern;

    use super::{AS_IN_A_SHELL, plain};

    fn matches(pattern: &str, name: &str) -> bool {
        Pattern::new(&plain(pattern)).unwrap().matches_with(name, AS_IN_A_SHELL)
    }

    #[test]
    fn patterns_match_as_in_a_shell() {
        for (pattern, name, expected) in [
            ("*", "a.json", true),
            ("*.json", "a.json", true),
            ("*.json", "a.jso", false),
            ("a?b*c", "axbc", true),
            ("a?b*c", "abc", false),
            ("*a*b", "aabab", true),
            ("*", ".git", false),
            (".*", ".git", true),
            ("é?", "éa", true),
        ] {
            assert_eq!(matches(pattern, name), expected, "{pattern} {name}");
        }
        let (many, long) = ("*a".repeat(60) + "b", "a".repeat(250));
        assert!(!matches(&many, &long), "in a time that does not grow with the power of the stars");
    }
}
