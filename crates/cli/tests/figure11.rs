//! `virtwall run experiments/figure11.json`: what §5.2 says of one processor and 1 to 56 environments.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Rows of a runs.csv as far as the column of operations, which holds no commas.
fn rows(csv: &str) -> Vec<Vec<String>> {
    csv.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect()
}

/// Gains over one environment by rising environments, for a scene and pixels of the hemisphere.
fn gains(scene: &str, pixels: &str) -> Vec<(u32, f64)> {
    let rows = rows(&fs::read_to_string(root().join("results/figure11/runs.csv")).unwrap());
    let place = |name: &str| rows[0].iter().position(|column| column == name).unwrap();
    let [by_scene, by_pixels] = ["scene", "hemisphere.pixels"].map(place);
    let [environments, gain] = ["local_environments", "gain"].map(place);
    let chosen = rows.iter().filter(|row| row[by_scene] == scene && row[by_pixels] == pixels);
    let found = chosen.map(|row| (row[environments].parse().unwrap(), row[gain].parse().unwrap()));
    let found: Vec<(u32, f64)> = found.collect();
    assert_eq!(found.iter().map(|(n, _)| *n).collect::<Vec<_>>(), [1, 2, 4, 8, 16, 28, 56]);
    found
}

#[test]
fn office_gains_nothing_and_slows_down_from_16_environments_on() {
    for pixels in ["30976", "4096"] {
        for (environments, gain) in gains("office", pixels) {
            assert!(gain < 1.005, "{pixels} pixels, {environments} environments: {gain}");
            assert!(environments < 16 || gain < 0.95, "{pixels}, {environments}: {gain}");
        }
    }
}

#[test]
fn rooms_and_building_gain_and_the_larger_scene_more() {
    for pixels in ["30976", "4096"] {
        let best = |scene| gains(scene, pixels).iter().map(|(_, gain)| *gain).fold(0.0, f64::max);
        let [office, rooms, building] = ["office", "rooms", "building"].map(best);
        assert!(office < rooms && 1.01 < rooms && rooms < building, "{office} {rooms} {building}");
    }
    for scene in ["rooms", "building"] {
        assert!(gains(scene, "4096").iter().all(|&(n, gain)| n == 1 || gain > 1.0), "{scene}");
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
    let fresh = rows(&fs::read_to_string(out.path().join("runs.csv")).unwrap());
    let kept = rows(&fs::read_to_string(root().join("results/figure11/runs.csv")).unwrap());
    for column in ["time_s", "missing_s", "gain"] {
        let value = |table: &[Vec<String>], environments: &str| {
            let place = |name: &str| table[0].iter().position(|column| column == name).unwrap();
            let is_it = |row: &&Vec<String>| {
                let pixels = table[0].iter().position(|name| name == "hemisphere.pixels");
                row[place("scene")] == "office"
                    && row[place("local_environments")] == environments
                    && pixels.is_none_or(|pixels| row[pixels] == "4096")
            };
            table.iter().find(is_it).unwrap()[place(column)].clone()
        };
        for environments in ["1", "56"] {
            assert_eq!(value(&fresh, environments), value(&kept, environments), "{column}");
        }
    }
}
