//! `virtwall run experiments/figure11.json`: what §5.2 says of one processor and 1 to 56 environments.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A column of a runs.csv, of the rows with these values in other columns.
fn column(csv: &str, name: &str, chosen: &[(&str, &str)]) -> Vec<String> {
    let mut rows = csv.lines().map(|line| line.split(',').collect::<Vec<&str>>());
    let names = rows.next().unwrap();
    let place = |name: &str| names.iter().position(|other| *other == name).unwrap();
    let is_it = |row: &Vec<&str>| chosen.iter().all(|(name, value)| row[place(name)] == *value);
    rows.filter(is_it).map(|row| row[place(name)].to_owned()).collect()
}

fn kept() -> String {
    fs::read_to_string(root().join("results/figure11/runs.csv")).unwrap()
}

/// Numbers of environments, rising, and the gain of each over one, for a scene and pixels of the
/// hemisphere.
fn gains(scene: &str, pixels: &str) -> impl Iterator<Item = (u32, f64)> {
    let gains = column(&kept(), "gain", &[("scene", scene), ("hemisphere.pixels", pixels)]);
    assert_eq!(gains.len(), 7);
    [1, 2, 4, 8, 16, 28, 56].into_iter().zip(gains).map(|(n, gain)| (n, gain.parse().unwrap()))
}

#[test]
fn office_gains_nothing_and_slows_down_from_16_environments_on() {
    for pixels in ["30976", "4096"] {
        for (environments, gain) in gains("office", pixels) {
            assert!(gain < 1.01, "{pixels} pixels, {environments} environments: {gain}");
            assert!(environments < 16 || gain < 0.95, "{pixels}, {environments}: {gain}");
        }
    }
}

#[test]
fn rooms_and_building_gain_and_the_larger_scene_more() {
    for pixels in ["30976", "4096"] {
        let best = |scene| gains(scene, pixels).map(|(_, gain)| gain).fold(0.0, f64::max);
        let [office, rooms, building] = ["office", "rooms", "building"].map(best);
        assert!(office < rooms && 1.01 < rooms && rooms < building, "{office} {rooms} {building}");
    }
    for scene in ["rooms", "building"] {
        assert!(gains(scene, "4096").all(|(n, gain)| n == 1 || gain > 1.0), "{scene}");
    }
}

#[test]
fn a_fresh_run_finds_the_same() {
    let out = tempfile::tempdir().unwrap();
    let set = ["scene=office", "hemisphere.pixels=4096", "local_environments=[1,56]"];
    let output = Command::new(env!("CARGO_BIN_EXE_virtwall"))
        .current_dir(root())
        .args(["run", "experiments/figure11.json", "--out"])
        .arg(out.path())
        .args(set.iter().flat_map(|set| ["--set", set]))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let fresh = fs::read_to_string(out.path().join("runs.csv")).unwrap();
    for environments in ["1", "56"] {
        let here = [("scene", "office"), ("local_environments", environments)];
        let there = [&here[..], &[("hemisphere.pixels", "4096")]].concat();
        for name in ["time_s", "missing_s", "gain"] {
            let found = column(&fresh, name, &here);
            assert_eq!(found.len(), 1);
            assert_eq!(found, column(&kept(), name, &there), "{name}");
        }
    }
}
