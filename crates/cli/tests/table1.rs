//! `virtwall run experiments/table1.json`: the reproduction of RR-3008's Table 1, whole.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Run the experiment on so many threads into `out`; what it printed.
fn table1(out: &Path, threads: &str) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_virtwall"))
        .current_dir(root())
        .args(["run", "experiments/table1.json", "--threads", threads, "--out"])
        .arg(out)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

struct Cell {
    scene: String,
    processors: u32,
    time_ratio: f64,
    speed_up_ratio: f64,
    energy_error: f64,
    ending: String,
}

fn cells(csv: &str) -> Vec<Cell> {
    let mut lines = csv.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    lines
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            let text = |name: &str| cells[names.iter().position(|n| *n == name).unwrap()];
            let number = |name: &str| text(name).parse::<f64>().unwrap();
            Cell {
                scene: text("scene").to_owned(),
                processors: text("processors").parse().unwrap(),
                time_ratio: number("time_s") / number("paper_time_s"),
                speed_up_ratio: number("speed_up") / number("paper_speed_up"),
                energy_error: number("energy_error"),
                ending: text("ending").to_owned(),
            }
        })
        .collect()
}

/// The factor by which a ratio is off, whichever way.
fn off(ratio: f64) -> f64 {
    ratio.max(1.0 / ratio)
}

#[test]
fn it_stands_beside_the_papers() {
    let folder = tempfile::tempdir().unwrap();
    let (one, two) = (folder.path().join("one"), folder.path().join("two"));
    table1(&one, "1");
    table1(&two, "2");
    for file in ["runs.csv", "manifest.json"] {
        let read = |out: &Path| fs::read(out.join(file)).unwrap();
        assert_eq!(read(&one), read(&two), "{file} depends on the number of threads");
    }

    // All 24 runs can be looked at, in a page that loads at once.
    let report = fs::read_to_string(one.join("report.html")).unwrap();
    assert!(report.len() <= 20_000_000, "report.html has {} bytes", report.len());
    assert!(report.contains("All that was recorded is here") && report.contains("id=\"run-23\""));

    let csv = fs::read_to_string(one.join("runs.csv")).unwrap();
    let committed = fs::read_to_string(root().join("results/table1/runs.csv")).unwrap();
    assert!(csv == committed, "results/table1 is not what the program finds: run the experiment");
    let cells = cells(&csv);
    assert_eq!(cells.len(), 24);
    let mut logarithms = 0.0;
    for cell in &cells {
        let name = format!("{} on {}", cell.scene, cell.processors);
        assert!(cell.energy_error <= 1e-9, "{name}: energy error {}", cell.energy_error);
        assert_eq!(cell.ending, "agreed", "{name}");
        if cell.processors == 1 {
            assert!((cell.time_ratio - 1.0).abs() <= 0.15, "{name}: time {}", cell.time_ratio);
            continue;
        }
        logarithms += off(cell.speed_up_ratio).ln();
        let bound = match (cell.scene.as_str(), cell.processors) {
            ("rooms", _) => 1.3,
            // A finding, not a success: the paper is slower on 2 processors than on 1.
            ("building", 2 | 4) => f64::INFINITY,
            _ => 1.5,
        };
        assert!(off(cell.speed_up_ratio) <= bound, "{name}: speed-up {}", cell.speed_up_ratio);
    }
    assert!((logarithms / 21.0).exp() <= 1.25, "{}", (logarithms / 21.0).exp());
}
