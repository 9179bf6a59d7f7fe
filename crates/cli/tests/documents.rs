//! The documents are true: their numbers are those of the committed results, their links and names exist,
//! and crates/README.md lists every section and figure of RR-3008 and every choice that the code marks.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

#[path = "documents/claims.rs"]
mod claims;
#[path = "documents/expression.rs"]
mod expression;
#[path = "documents/source.rs"]
mod source;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use crate::claims::cells;
use crate::source::Sources;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// The names in a folder, sorted.
fn names(folder: &str) -> BTreeSet<String> {
    let entries = fs::read_dir(root().join(folder)).unwrap();
    entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

/// All documents in Markdown, except those that programs write.
fn documents() -> Vec<String> {
    let folders = ["experiments", "machines", "scenes", "results", "crates"];
    let files = ["README", "CONTRIBUTING", "CHANGELOG"].map(|name| format!("{name}.md"));
    let crates = names("crates").into_iter().map(|name| format!("crates/{name}"));
    let pages = folders.map(str::to_owned).into_iter().chain(crates);
    let pages = pages.map(|folder| format!("{folder}/README.md"));
    files.into_iter().chain(pages).filter(|page| root().join(page).exists()).collect()
}

/// Rows of the table whose header starts with `first`, by columns.
fn table(text: &str, first: &str) -> Vec<Vec<String>> {
    let rows = text.lines().skip_while(|line| !line.starts_with(&format!("| {first}"))).skip(2);
    rows.take_while(|line| line.starts_with('|')).map(cells).collect()
}

fn defines(source: &str, item: &str) -> bool {
    let starts = ["fn", "struct", "enum", "trait", "const", "type"].map(|k| format!("{k} {item}"));
    let field = format!("pub {item}:");
    source.lines().any(|line| {
        let ends = |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_');
        line.trim_start().starts_with(&field)
            || starts
                .iter()
                .any(|s| line.split_once(s.as_str()).is_some_and(|(_, rest)| ends(rest)))
    })
}

#[test]
fn the_map_names_what_exists() {
    for page in documents().iter().filter(|page| page.starts_with("crates/")) {
        let text = read(page);
        for row in table(&text, "RR-3008").into_iter().chain(table(&text, "what | file")) {
            let folders = [root().join("crates"), root().join(page).with_file_name("")];
            let file = folders.map(|folder| folder.join(&row[1])).into_iter().find(|f| f.exists());
            let source = file.map_or(String::new(), |file| fs::read_to_string(file).unwrap());
            assert!(defines(&source, &row[2]), "{page}: {} is not in {}", row[2], row[1]);
        }
    }
}

#[test]
fn the_map_names_all_of_the_paper() {
    let rows = table(&read("crates/README.md"), "RR-3008");
    let figures = (1..=12).map(|i| format!("Figure {i}"));
    let sections = [
        "§3", "§3.1", "§3.2", "§3.3", "§3.4", "§4", "§4.1", "§4.2", "§4.2.1", "§4.2.2", "§4.2.3",
        "§4.2.4", "§5.1", "§5.2", "§5.3", "Table 1",
    ];
    for part in figures.chain(sections.map(str::to_owned)) {
        let named = |row: &Vec<String>| {
            row[0]
                .strip_prefix(&part)
                .is_some_and(|rest| rest.is_empty() || rest.starts_with([' ', ',']))
        };
        assert!(rows.iter().any(named), "{part} is not in the map");
    }
}

fn rust_files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            rust_files(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn every_choice_in_the_code_is_listed() {
    let listed: BTreeSet<String> = table(&read("crates/README.md"), "choice")
        .into_iter()
        .filter_map(|row| row[0].split(' ').next().map(str::to_owned))
        .collect();
    let mut files = Vec::new();
    for name in names("crates") {
        let source = root().join("crates").join(name).join("src");
        if source.is_dir() {
            rust_files(&source, &mut files);
        }
    }
    let mut marked = BTreeSet::new();
    for file in files {
        let text = fs::read_to_string(&file).unwrap();
        for rest in text.split("Choice C").skip(1) {
            let number: String = rest.chars().take_while(char::is_ascii_digit).collect();
            if !number.is_empty() {
                marked.insert(format!("C{number}"));
            }
        }
    }
    assert_eq!(marked, listed);
}

/// `cargo test` builds all crates except the one that compares with other programs.
#[test]
fn every_crate_is_built_by_default() {
    let manifest = read("Cargo.toml");
    for name in names("crates") {
        if root().join("crates").join(&name).join("Cargo.toml").exists() {
            let listed = manifest.contains(&format!("    \"crates/{name}\",\n"));
            assert_eq!(listed, name != "peers", "default-members and {name}");
        }
    }
}

/// A document without its comments, in one line.
fn flat(text: &str) -> String {
    let shown = text.split("<!--").map(|part| part.rsplit("-->").next().unwrap_or_default());
    shown.collect::<String>().split_whitespace().collect::<Vec<_>>().join(" ")
}

/// What is wrong with the claims of a document.
fn mistakes(text: &str, sources: &mut Sources) -> Vec<String> {
    let mut wrong = Vec::new();
    let shown = flat(text);
    for part in format!("\n{text}").split("\n<!-- from ").skip(1) {
        let (comment, after) = part.split_once("-->").unwrap();
        let claims = match claims::compute(comment, sources) {
            Ok(claims) => claims,
            Err(why) => {
                wrong.push(why);
                continue;
            }
        };
        let missing = claims.phrases.iter().filter(|phrase| !shown.contains(phrase.as_str()));
        wrong.extend(missing.map(|phrase| format!("not found: {phrase}")));
        let rows: Vec<_> =
            after.trim_start().lines().take_while(|line| line.starts_with('|')).collect();
        let rows: Vec<_> = rows.into_iter().skip(2).map(cells).collect();
        if !claims.rows.is_empty() && rows != claims.rows {
            let line = |row: &Vec<String>| format!("| {} |", row.join(" | "));
            let lines: Vec<_> = claims.rows.iter().map(line).collect();
            wrong.push(format!("a table should be\n{}", lines.join("\n")));
        }
    }
    wrong
}

/// Numbers and phrases whose source a document names follow from that source.
#[test]
fn documents_tell_the_results() {
    let mut sources = Sources::new(root());
    let wrong = |page: String| {
        let wrong = mistakes(&read(&page), &mut sources);
        wrong.into_iter().map(|mistake| format!("{page}: {mistake}")).collect::<Vec<_>>()
    };
    let wrong: Vec<_> = documents().into_iter().flat_map(wrong).collect();
    assert!(wrong.is_empty(), "\n{}\n", wrong.join("\n"));
}

/// The check itself: a wrong cell, a wrong phrase, a missing row and an unknown column are found.
#[test]
fn wrong_claims_are_found() {
    let mut sources = Sources::new(root());
    let comment = "<!-- from results/table1/runs.csv\nfor processors = 1, 2:\n\
                   | {processors} | {time_s[scene=office] : .1} |\n-->\n";
    let head = "| procs | time |\n|---|---|\n";
    let right = format!("{comment}{head}| 1 | 147.6 |\n| 2 | 74.7 |\n");
    assert_eq!(mistakes(&right, &mut sources), Vec::<String>::new());
    assert_eq!(mistakes(&right.replace("74.7", "74.8"), &mut sources).len(), 1);
    assert_eq!(mistakes(&right.replace("| 2 | 74.7 |\n", ""), &mut sources).len(), 1);
    assert_eq!(mistakes(&right.replace("time_s", "hours"), &mut sources).len(), 1);
    let phrase = "\n<!-- from results/table1/runs.csv\n{max(processors) : .0} nodes\n-->";
    assert!(mistakes(&format!("on 56\nnodes {phrase}"), &mut sources).is_empty());
    assert_eq!(mistakes(&format!("on 55 nodes {phrase}"), &mut sources).len(), 1);
}

/// A table with decimals says where they come from: a comment above it begins with `from`, or with
/// `by hand` and a date where no committed result holds them.
#[test]
fn tables_of_numbers_name_their_source() {
    let digit = |byte: &u8| byte.is_ascii_digit();
    let decimal = |part: &[u8]| digit(&part[0]) && part[1] == b'.' && digit(&part[2]);
    for page in documents() {
        let text = read(&page);
        for (before, table) in text.split("\n\n").filter_map(|part| part.split_once("|---")) {
            let rows = table.lines().filter(|row| !row.contains('§'));
            let numbers = rows.filter(|row| row.as_bytes().windows(3).any(decimal)).count();
            let named =
                ["<!-- from ", "<!-- by hand, 20"].iter().any(|start| before.contains(start));
            assert!(numbers < 2 || named, "{page}: no source of a table: {before}");
        }
    }
}

/// Every relative link leads to a file, and to a heading of it.
#[test]
fn links_lead_somewhere() {
    let mut wrong = Vec::new();
    for page in documents() {
        let text = flat(&read(&page));
        for link in text.split("](").skip(1).filter_map(|rest| rest.split(')').next()) {
            let (file, heading) = link.split_once('#').unwrap_or((link, ""));
            let here = root().join(&page);
            let target = if file.is_empty() { here } else { here.with_file_name("").join(file) };
            let found = match fs::read_to_string(&target) {
                _ if file.contains("://") => true,
                Ok(text) if !heading.is_empty() => {
                    let mut headings = text.lines().filter(|line| line.starts_with('#'));
                    headings.any(|line| anchor(line) == heading)
                }
                _ => target.exists(),
            };
            if !found {
                wrong.push(format!("{page}: {link}"));
            }
        }
    }
    assert!(wrong.is_empty(), "links that lead nowhere:\n{}", wrong.join("\n"));
}

/// The anchor that GitHub gives a heading.
fn anchor(heading: &str) -> String {
    let text = heading.trim_start_matches('#').trim().to_lowercase().replace(' ', "-");
    text.chars().filter(|c| c.is_alphanumeric() || "-_".contains(*c)).collect()
}

/// Each experiment, machine, scene, crate and committed folder of results is in its folder's README.
#[test]
fn folders_list_what_they_hold() {
    let files = ["experiments", "machines", "scenes"].into_iter().flat_map(|folder| {
        let files = names(folder).into_iter().filter(|name| name.ends_with(".json"));
        files.map(move |name| (folder, name))
    });
    let is_crate = |name: &String| root().join("crates").join(name).join("Cargo.toml").exists();
    let crates = names("crates").into_iter().filter(is_crate).map(|name| ("crates", name));
    let ignored = read(".gitignore");
    let committed =
        ignored.lines().filter_map(|line| line.strip_prefix("!/results/")?.strip_suffix('/'));
    let results = committed.map(|name| ("results", name.to_owned()));
    for (folder, name) in files.chain(crates).chain(results) {
        let page = read(&format!("{folder}/README.md"));
        assert!(page.contains(&format!("]({name}")), "{folder}/README.md has no link to {name}");
    }
}

/// The README is a front door: it fits a few screens.
#[test]
fn the_readme_is_short() {
    assert!(read("README.md").len() <= 9_000);
}
