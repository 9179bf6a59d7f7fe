//! A small instance of experiments/scale.json: what must not depend on the number of nodes, and what
//! must grow no faster than the scene.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Runs the experiment into `out` with some values set.
fn run(out: &Path, values: &[&str]) {
    let output = Command::new(env!("CARGO_BIN_EXE_virtwall"))
        .current_dir(root())
        .args(["run", "experiments/scale.json", "--threads", "2", "--out"])
        .arg(out)
        .args(values.iter().flat_map(|value| ["--set", value]))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

/// The numbers of a run by their columns, each count of operations too.
type Numbers = BTreeMap<String, f64>;

fn runs(csv: &str) -> Vec<Numbers> {
    let mut lines = csv.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let numbers = |line: &str| {
        let mut numbers = Numbers::new();
        for (name, cell) in names.iter().zip(line.split(',')) {
            if let Ok(number) = cell.parse() {
                numbers.insert((*name).to_owned(), number);
            }
            for (operation, count) in cell.split(' ').filter_map(|count| count.split_once('=')) {
                numbers.insert(operation.to_owned(), count.parse().unwrap());
            }
        }
        numbers
    };
    lines.map(numbers).collect()
}

/// The cheapest row of the committed results is what the program finds.
#[test]
fn committed_results_are_the_programs() {
    let folder = tempfile::tempdir().unwrap();
    run(folder.path(), &["scene=building", "processors=256"]);
    let read = |out: &Path| fs::read_to_string(out.join("runs.csv")).unwrap();
    let (found, committed) = (read(folder.path()), read(&root().join("results/scale")));
    for line in found.lines() {
        assert!(committed.lines().any(|other| other == line), "not in results/scale: {line}");
    }
}

#[test]
fn a_small_instance_scales() {
    let folder = tempfile::tempdir().unwrap();
    let small = [
        r#"scene=["building","building-10"]"#,
        "processors=[16,64]",
        "local_environments=64",
        "hemisphere.pixels=256",
    ];
    run(folder.path(), &small);
    work_grows_with_the_scene_and_not_with_the_nodes(folder.path());
    plots_tell_exponents_and_the_report_nothing_of_the_host(folder.path());
}

fn work_grows_with_the_scene_and_not_with_the_nodes(out: &Path) {
    let runs = runs(&fs::read_to_string(out.join("runs.csv")).unwrap());
    let [small_on_16, small, large_on_16, large] = &runs[..] else { panic!("not four runs") };

    // Every environment shoots the same sources through the same masks, whoever owns it.
    let geometric = [
        "patches",
        "local_shots",
        "received_shots",
        "ray",
        "cell_step",
        "polygon_test",
        "hit",
        "plane_test",
        "pixel_test",
        "patch_update",
        "word_copied",
        "update_bytes",
    ];
    for (few, many) in [(small_on_16, small), (large_on_16, large)] {
        for name in geometric {
            assert_eq!(few[name], many[name], "{name}");
        }
        assert!(few["messages"] < many["messages"]);
        // With an environment a node each source handed on is a message.
        assert_eq!(many["messages"], many["received_shots"]);
        assert!(many["energy_error"] < 1e-12);
    }

    // Twice the floors: twice the patches and shots, so that a cost that followed either would have
    // the exponent 0.5 in patches × shots; the bar is 1.1.
    let growth = |name: &str| large[name] / small[name];
    for (name, low, high) in [
        ("patches", 1.9, 2.1),
        ("local_shots", 1.9, 2.1),
        ("ray", 1.7, 2.2),
        ("hit", 1.7, 2.2),
        ("received_shots", 1.0, 2.2),
        ("messages", 1.0, 2.2),
        ("message_bytes", 1.0, 2.2),
    ] {
        assert!((low..high).contains(&growth(name)), "{name} grows {} times", growth(name));
    }
    let control = large["control_messages"] / small["control_messages"];
    assert!(control < 4.0, "messages of control grow {control} times");
}

fn plots_tell_exponents_and_the_report_nothing_of_the_host(out: &Path) {
    let read = |name: &str| fs::read_to_string(out.join(name)).unwrap();
    for name in [
        "host.cpu_s-by-patches-x-local_shots.svg",
        "host.cpu_s-by-processors.svg",
        "host.set_up_s-by-patches.svg",
        "operations.ray-by-patches-x-local_shots.svg",
    ] {
        assert!(read(name).contains("exponent "), "{name}");
    }
    assert!(
        read("runs.csv").starts_with("scene,processors,") && !read("runs.csv").contains("host")
    );
    let report = read("report.html");
    assert!(report.contains("Rays counted by patches × local shots"));
    assert!(!report.contains("Host CPU"), "a report is the same on every host");
    assert!(read("host-times.json").contains("\"cpu_s\""));
}
