//! Table 1 of the paper as a user runs it, from reading the experiment to writing the report.

#![allow(missing_docs, reason = "a benchmark has no users")]

use std::process::{Command, Stdio};

fn main() {
    divan::main();
}

/// Carry the experiment out on one thread, with nothing kept from before.
fn table1(arguments: &[&str]) {
    let folder = tempfile::tempdir().expect("there is room for the results");
    let status = Command::new(env!("CARGO_BIN_EXE_virtwall"))
        .current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
        .args(["run", "experiments/table1.json", "--threads", "1", "--out"])
        .arg(folder.path())
        .args(arguments)
        .stdout(Stdio::null())
        .status();
    assert!(status.is_ok_and(|status| status.success()), "Table 1 was not made");
}

#[divan::bench(sample_count = 5)]
fn office() {
    table1(&["--set", "scene=office"]);
}

#[divan::bench(sample_count = 3)]
fn whole() {
    table1(&[]);
}
