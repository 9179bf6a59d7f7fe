//! The experiments and results in this repository, read back by the program that wrote them.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::fs;
use std::path::{Path, PathBuf};

use desim::Time;
use lab::{Stage, Which};

/// Results whose runs take minutes in a test: they are opened, and their first run is not made.
const LONG: [&str; 5] =
    ["accuracy-large", "exhaustive-building", "paging", "paging-sizes", "scale"];

/// What a folder of the repository holds, in order of names.
fn listed(folder: &str) -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    std::env::set_current_dir(root).unwrap();
    let mut paths: Vec<PathBuf> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

/// Opens the first run of an experiment or of results, and makes it if that takes seconds.
fn open(path: &Path) -> Stage {
    let name = path.file_stem().unwrap().to_str().unwrap();
    // Settings for a smaller scene are found sooner.
    let set = if name == "accuracy-large" { vec!["scene=room4".to_owned()] } else { Vec::new() };
    let which = Which { set: &set, row: Some(1) };
    let stage = Stage::open(path.to_str().unwrap(), &which)
        .unwrap_or_else(|fault| panic!("{}: {fault}", path.display()));
    if !LONG.contains(&name) {
        let (light, end) = stage.light_at(&[Time::ZERO]).unwrap();
        assert!(light.len() == 1 && end > Time::ZERO, "{name}");
    }
    stage
}

#[test]
fn runs_of_committed_results_can_be_drawn() {
    let mut opened = 0;
    for folder in listed("results") {
        if folder.join("manifest.json").is_file() {
            let changed = open(&folder).run.unwrap().changed;
            let set = folder.ends_with("accuracy-large");
            assert!(set || changed.is_empty(), "{}: {changed:?}", folder.display());
            opened += 1;
        }
    }
    assert!(opened >= 17, "{opened}");
}

#[test]
fn runs_of_shipped_experiments_can_be_drawn() {
    let files = listed("experiments").into_iter();
    let experiments: Vec<PathBuf> =
        files.filter(|path| path.extension().is_some_and(|ending| ending == "json")).collect();
    assert!(experiments.len() >= 17, "{experiments:?}");
    experiments.iter().for_each(|path| _ = open(path));
}
