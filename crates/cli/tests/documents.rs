//! The documents are true: crates/README.md names files and items that exist, every section and
//! figure of RR-3008, and every choice that the code marks.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

fn crates() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

fn readme() -> String {
    fs::read_to_string(crates().join("README.md")).unwrap()
}

/// Rows of the table whose header starts with `first`, by columns.
fn table(text: &str, first: &str) -> Vec<Vec<String>> {
    let rows = text.lines().skip_while(|line| !line.starts_with(&format!("| {first}"))).skip(2);
    let cells =
        |line: &str| line.trim_matches('|').split('|').map(|c| c.trim().to_owned()).collect();
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
    let readme = readme();
    for row in table(&readme, "RR-3008").into_iter().chain(table(&readme, "what | file")) {
        let source = fs::read_to_string(crates().join(&row[1])).unwrap_or_default();
        assert!(defines(&source, &row[2]), "{} is not in crates/{}", row[2], row[1]);
    }
}

#[test]
fn the_map_names_all_of_the_paper() {
    let rows = table(&readme(), "RR-3008");
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
    let listed: BTreeSet<String> = table(&readme(), "choice")
        .into_iter()
        .filter_map(|row| row[0].split(' ').next().map(str::to_owned))
        .collect();
    let mut files = Vec::new();
    for entry in fs::read_dir(crates()).unwrap() {
        let source = entry.unwrap().path().join("src");
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

/// `cargo test` leaves no crate out but the one that compares with other programs.
#[test]
fn every_crate_is_built_by_default() {
    let manifest = fs::read_to_string(crates().join("../Cargo.toml")).unwrap();
    for entry in fs::read_dir(crates()).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        if crates().join(&name).join("Cargo.toml").exists() {
            let listed = manifest.contains(&format!("    \"crates/{name}\",\n"));
            assert_eq!(listed, name != "peers", "default-members and {name}");
        }
    }
}

/// The table in the README is the one in results/table1, and so is the summary.
#[test]
fn the_readme_tells_the_results() {
    let readme = fs::read_to_string(crates().join("../README.md")).unwrap();
    let csv = fs::read_to_string(crates().join("../results/table1/runs.csv")).unwrap();
    let mut lines = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let names = lines.next().unwrap();
    let runs: Vec<_> = lines.collect();
    let told = table(&readme, "procs");
    assert_eq!((told.len(), runs.len()), (8, 24));
    let mut logarithms = 0.0;
    for row in &told {
        let mut expected = vec![row[0].clone()];
        for scene in ["office", "rooms", "building"] {
            let run = runs.iter().find(|run| run[0] == scene && run[1] == row[0]).unwrap();
            let number = |name: &str| -> f64 {
                run[names.iter().position(|n| *n == name).unwrap()].parse().unwrap()
            };
            let ratio = number("speed_up") / number("paper_speed_up");
            logarithms += ratio.ln().abs();
            let ratio = match row[0].as_str() {
                "1" => format!("({:.2})", number("time_s") / number("paper_time_s")),
                _ => format!("{ratio:.2}"),
            };
            let cells = ["time_s", "speed_up", "paper_speed_up"];
            expected.extend(cells.map(|name| format!("{:.2}", number(name))));
            expected.push(ratio);
        }
        assert_eq!(*row, expected);
    }
    let summary = format!("is **{:.3}**", (logarithms / 21.0_f64).exp());
    assert!(readme.contains(&summary), "{summary}");
}

/// The table of the scale experiment is the one in results/scale.
#[test]
fn the_readme_tells_what_scales() {
    let readme = fs::read_to_string(crates().join("../README.md")).unwrap();
    let csv = fs::read_to_string(crates().join("../results/scale/runs.csv")).unwrap();
    let mut lines = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let names = lines.next().unwrap();
    let runs: Vec<_> = lines.collect();
    let cell = |run: &[&str], name| run[names.iter().position(|n| *n == name).unwrap()].to_owned();
    let told = table(&readme, "floors");
    assert_eq!(told.len() * 3, runs.len());
    for (row, runs) in told.iter().zip(runs.chunks(3)) {
        let scene =
            if row[0] == "5" { "building".to_owned() } else { format!("building-{}", row[0]) };
        let counts = ["patches", "local_shots"].map(|name| cell(&runs[0], name));
        assert_eq!(runs[0][0], scene);
        assert_eq!([&row[1], &row[2]].map(|count| count.replace(',', "")), counts);
        let times = runs.iter().map(|run| cell(run, "time_s").parse::<f64>().unwrap());
        let times: Vec<String> = times.map(|time| format!("{time:.1}")).collect();
        assert_eq!(row[3..6], times, "{scene}");
    }
}
