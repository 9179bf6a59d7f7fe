//! Every case is right, and its naive method is not.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::fs;
use std::path::{Path, PathBuf};

use stability::{Said, Verdict, cases, csv, page, svg, try_case};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn verdicts() -> Vec<Verdict> {
    let paths = cases(&root().join("experiments/stability")).unwrap();
    paths.iter().map(|path| try_case(path).unwrap()).collect()
}

#[test]
fn every_case_is_right() {
    let verdicts = verdicts();
    for verdict in &verdicts {
        println!("{} {:?}", verdict.name, verdict.findings);
    }
    let wrong: Vec<_> =
        verdicts.iter().filter(|v| !v.holds()).map(|v| (&v.name, &v.findings)).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");
}
