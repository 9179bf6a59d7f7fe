//! Every case is right and its naive method is wrong; the committed page is up to date.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::fs;
use std::path::{Path, PathBuf};

use stability::{Finding, Quantity, cases, csv, page, run_case, svg};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Cases name machines relative to the root of the project.
fn enter_the_project() {
    std::env::set_current_dir(root()).unwrap();
}

/// Whether a naive method is right.
fn naive_holds(finding: &Finding) -> bool {
    match (&finding.bound, finding.naive.as_ref().unwrap()) {
        (Quantity::Count(most), Quantity::Count(naive)) => naive.wrong <= most.wrong,
        (Quantity::Number(most), Quantity::Number(naive)) => naive <= most,
        (right, naive) => right == naive,
    }
}

#[test]
fn every_case_is_right_and_its_naive_method_is_wrong() {
    enter_the_project();
    let paths = cases(Path::new("experiments/stability")).unwrap();
    let results: Vec<_> = paths.iter().map(|path| run_case(path).unwrap()).collect();
    for result in &results {
        assert!(result.holds(), "{}: {:#?}", result.name, result.findings);
        let naive = || result.findings.iter().filter(|finding| finding.naive.is_some());
        let expected = result.case.naive.is_some() || !result.case.naive_settings.is_empty();
        assert_eq!(naive().count() > 0, expected, "{}: the naive method is right", result.name);
        assert!(!naive().any(naive_holds), "{}: {:#?}", result.name, result.findings);
    }
    for (name, text) in [
        ("README.md", page(&results)),
        ("cases.csv", csv(&results).unwrap()),
        ("stability.svg", svg(&results)),
    ] {
        let committed = fs::read_to_string(root().join("results/stability").join(name)).unwrap();
        assert!(committed == text, "{name} is out of date: run `virtwall stability` again");
    }
}

/// The case `shared-edges` casts ten million rays in rotated rooms up to a thousand kilometres from the origin.
#[test]
fn leaks_are_tested_with_ten_million_rays() {
    let table = fs::read_to_string(root().join("results/stability/cases.csv")).unwrap();
    let line = table.lines().find(|line| line.starts_with("shared-edges,leaks,")).unwrap();
    let ours = line.split(',').nth(3).unwrap();
    let (wrong, of) = ours.split_once(" of ").unwrap();
    assert!(wrong == "0" && of.parse::<u64>().unwrap() >= 10_000_000, "{line}");
}

#[test]
fn bad_cases_are_refused() {
    enter_the_project();
    let folder = tempfile::tempdir().unwrap();
    let case = folder.path().join("case.json");
    let good = r#"{"title": "t", "failure": "f", "remedy": "r", "listed": "places",
        "experiment": {"scene": "no.obj", "processors": 1}, "right": {"leaks": 0}}"#;
    for (from, to, expected) in [
        ("", "", "case.json: scene: \"no.obj\": no such file"),
        (
            "\"leaks\"",
            "\"leeks\"",
            "case.json:2: right.leeks: unknown field \"leeks\", did you mean",
        ),
        ("\"places\"", "\"somewhere\"", "case.json:1: listed"),
        (
            "\"right\"",
            "\"naive\": \"closed_faces\", \"right\"",
            "it shows \"owners\"; expected that",
        ),
        ("{\"scene\": \"no.obj\", \"processors\": 1}", "3", "expected an object"),
        ("{\"leaks\": 0}", "3", "case.json:2: right"),
    ] {
        fs::write(&case, good.replacen(from, to, 1)).unwrap();
        let fault = run_case(&case).err().unwrap().to_string();
        assert!(fault.contains(expected), "{fault}");
    }
    assert!(cases(&folder.path().join("none")).is_err());
}

#[test]
fn the_schema_is_shipped() {
    let path = root().join("experiments/schemas/stability.json");
    let text = serde_json::to_string_pretty(&stability::case_schema()).unwrap() + "\n";
    if std::env::var_os("UPDATE_SCHEMAS").is_some() {
        fs::write(&path, &text).unwrap();
    }
    let shipped = fs::read_to_string(&path).unwrap_or_default();
    assert!(shipped == text, "out of date: run the test again with UPDATE_SCHEMAS=1");
}
