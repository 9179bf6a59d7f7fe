//! `virtwall run experiments/figure11.json`: what §5.2 says of one processor and several local environments,
//! where a hemisphere has 4,096 pixels.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::fs;
use std::path::Path;
use std::process::Command;

/// The gain over one environment by environments, of a fresh run.
fn gains(scene: &str, environments: &[u32]) -> Vec<f64> {
    let out = tempfile::tempdir().unwrap();
    let [scene, environments] =
        [format!("scene={scene}"), format!("local_environments={environments:?}")];
    let output = Command::new(env!("CARGO_BIN_EXE_virtwall"))
        .current_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join("../.."))
        .args(["run", "experiments/figure11.json", "--viewer", "none", "--out"])
        .arg(out.path())
        .args(["--set", &scene, "--set", &environments, "--set", "hemisphere.pixels=4096"])
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let runs = fs::read_to_string(out.path().join("runs.csv")).unwrap();
    let mut rows = runs.lines().map(|line| line.split(',').collect::<Vec<&str>>());
    let names = rows.next().unwrap();
    let gain = names.iter().position(|&name| name == "gain").unwrap();
    rows.map(|row| row[gain].parse().unwrap()).collect()
}

#[test]
fn office_gains_nothing_and_slows_down_from_16_environments_on() {
    let gains = gains("office", &[1, 2, 16, 56]);
    assert_eq!((gains.len(), gains[0]), (4, 1.0));
    assert!(gains[1] < 1.05 && gains[2] < 0.9 && gains[3] < 0.9, "{gains:?}");
}

#[test]
fn rooms_gain() {
    let gains = gains("rooms", &[1, 16]);
    assert!(gains.len() == 2 && gains[1] > 1.1, "{gains:?}");
}
