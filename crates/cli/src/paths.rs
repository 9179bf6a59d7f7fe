//! The files that arguments name: files, folders, and patterns that the shell did not expand.

use std::fs;
use std::path::{Component, Path, PathBuf};

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

/// The paths that match a pattern, component by component.
fn expanded(pattern: &Path) -> Vec<PathBuf> {
    let mut found = vec![PathBuf::new()];
    for part in pattern.components() {
        let text = part.as_os_str().to_string_lossy();
        let next = |path: PathBuf| -> Vec<PathBuf> {
            if !matches!(part, Component::Normal(_)) || !text.contains(['*', '?']) {
                let path = path.join(part);
                return if path.exists() { vec![path] } else { Vec::new() };
            }
            let here = if path == Path::new("") { Path::new(".") } else { &path };
            let all = names(here).into_iter().filter(|name| matches(&text, name));
            all.map(|name| path.join(name)).collect()
        };
        found = found.into_iter().flat_map(next).collect();
    }
    found
}

/// The names in a folder, in order; none if it cannot be read.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let mut names: Vec<String> =
        entries.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    names.sort();
    names
}

/// Whether a name matches a pattern, in which `*` is any text and `?` is any character. As in a shell, hidden
/// names are matched only by patterns that begin with a dot.
fn matches(pattern: &str, name: &str) -> bool {
    if name.starts_with('.') && !pattern.starts_with('.') {
        return false;
    }
    let (pattern, name): (Vec<char>, Vec<char>) =
        (pattern.chars().collect(), name.chars().collect());
    let (mut p, mut n) = (0, 0);
    // The last star, and where the text ends that it stands for so far.
    let mut star: Option<(usize, usize)> = None;
    while n < name.len() {
        match pattern.get(p) {
            Some('*') => {
                star = Some((p, n));
                p += 1;
            }
            Some(&c) if c == '?' || c == name[n] => (p, n) = (p + 1, n + 1),
            _ => {
                let Some((at, end)) = star else { return false };
                star = Some((at, end + 1));
                (p, n) = (at + 1, end + 1);
            }
        }
    }
    pattern[p..].iter().all(|&c| c == '*')
}

#[cfg(test)]
mod tests {
    use super::matches;

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
