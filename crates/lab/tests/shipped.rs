//! The experiments and results in this repository, read back by the program that wrote them.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::fs;
use std::path::{Path, PathBuf};

use desim::Time;
use lab::{Results, Stage, Which};

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
        let (light, end) = stage.light_at(&[Time::ZERO], || ()).unwrap();
        assert!(light.len() == 1 && end > Time::ZERO, "{name}");
    }
    stage
}

#[test]
fn runs_of_committed_results_can_be_drawn() {
    let mut opened = 0;
    for folder in listed("results") {
        if folder.join("manifest.json").is_file() {
            open(&folder);
            opened += 1;
        }
    }
    assert!(opened >= 17, "{opened}");
}

/// Figures are drawn from the tables beside them, as the experiment files ask for.
#[test]
fn committed_figures_are_those_of_their_data() {
    let mut other = Vec::new();
    for folder in listed("results") {
        let Ok(mut results) = Results::read(&folder) else { continue };
        let manifest = results.manifest.clone();
        let plots = results.take_present_plots(&folder).unwrap();
        assert!(plots.starts_with("Plots are those of experiments/"), "{plots}");
        assert_eq!(
            results.manifest,
            manifest,
            "{}: `virtwall plot` writes it again",
            folder.display()
        );
        let drawn = tempfile::tempdir().unwrap();
        let times = "host-times.json";
        if folder.join(times).is_file() {
            fs::copy(folder.join(times), drawn.path().join(times)).unwrap();
        }
        for name in results.draw(drawn.path()).unwrap() {
            let figure =
                name.ends_with(".svg").then(|| fs::read(folder.join(&name)).unwrap_or_default());
            if figure.is_some_and(|figure| figure != fs::read(drawn.path().join(&name)).unwrap()) {
                other.push(folder.join(name));
            }
        }
    }
    assert_eq!(other, [] as [PathBuf; 0], "`virtwall plot` draws these again");
}

#[test]
fn runs_of_experiments_without_results_can_be_drawn() {
    for path in listed("experiments") {
        let results = Path::new("results").join(path.file_stem().unwrap());
        if path.extension().is_some_and(|ending| ending == "json") && !results.exists() {
            open(&path);
        }
    }
}
