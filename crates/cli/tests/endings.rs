//! How runs end, seen from outside: too early, wasteful, without end, later than virtual time lasts.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

#[path = "../../lab/tests/common/mod.rs"]
mod common;

use std::process::{Command, Output};

use common::Project;
use lab::Table;

/// The exit status of a run, what it writes to standard error, and its table.
fn run(project: &Project, arguments: &[&str]) -> (Option<i32>, String, Option<Table>) {
    let command = &mut Command::new(env!("CARGO_BIN_EXE_virtwall"));
    let always = ["run", "experiments/x.json", "--viewer", "none", "--out", "r"];
    let command = command.current_dir(project.path("")).args(always).args(arguments);
    let Output { status, stderr, .. } = command.output().unwrap();
    let table = std::fs::read(project.path("r/runs.csv")).ok();
    let table = table.map(|bytes| Table::from_csv(&bytes).unwrap());
    (status.code(), String::from_utf8(stderr).unwrap(), table)
}

/// Runs that end, with the columns that are asked for.
fn cells(table: &Table, column: &str) -> Vec<String> {
    table.rows.iter().map(|row| table.cell(row, column).to_owned()).collect()
}

/// Masks as long as the buffers of a link wait in the network, off their senders' hands, while the token passes
/// on other links.
const TOO_EARLY: &str = r#"{
  "title": "an end that is announced too early",
  "scene": "cornell", "processors": 9, "local_environments": 18,
  "hemisphere": { "pixels": 2048 }, "mapping": "random", "seed": 860973,
  "radiosity_updates": false,
  "stop": { "patch_threshold": "50 %", "collect_every": "1000 s" },
  "machine": {
    "extends": "paragon-xps",
    "compute_nodes": 9, "service_nodes": 1,
    "mesh": { "width": 2, "height": 6, "hop_time": "10 ns" },
    "processor": { "clock": "3 GHz", "scale": 1 },
    "network": {
      "model": "wormhole",
      "parameters": {
        "send_overhead": "1 us", "latency": "10 ns", "receive_overhead": "1 us", "gap": "0 us", "bandwidth": "1 MB/s"
      },
      "links": { "bandwidth": "1000100 B/s", "flit": "64 B", "buffer_flits": 64 }
    }
  }
}"#;

#[test]
fn an_end_that_is_announced_too_early() {
    let (status, stderr, table) = run(&Project::new(TOO_EARLY), &[]);
    let table = table.unwrap();
    assert_eq!(status, Some(0), "{stderr}");
    assert_eq!(cells(&table, "ending"), ["too_early"]);
    assert_eq!(cells(&table, "energy_lost"), ["2.929687499999806e-3"]);
    assert_eq!(cells(&table, "in_transit"), ["0.002929687"]);
}

const ROOM: &str = r#"{
  "title": "test", "scene": "room4", "processors": [1, 8], "local_environments": 8, "cut": "2x2x2",
  "hemisphere": { "pixels": 64 }, "stop": { "patch_threshold": "0.00001 %" }
}"#;

#[test]
fn many_more_shots_than_on_one_processor_give_a_warning() {
    let project = Project::new(ROOM);
    let (status, stderr, table) = run(&project, &[]);
    let shots = cells(&table.unwrap(), "local_shots");
    let expected = format!("room4, 8 processors: {} shots of patches, ", shots[1]);
    assert_eq!(status, Some(0), "{stderr}");
    let warnings: Vec<&str> = stderr.lines().filter(|l| l.starts_with("warning: ")).collect();
    assert_eq!(warnings.len(), 1, "{stderr}");
    assert!(warnings[0].contains(&expected), "{stderr}");
    assert!(warnings[0].contains(&format!("times the {} on one processor", shots[0])), "{stderr}");

    let (status, stderr, _) = run(&project, &["--replace", "--set", "stop.patch_threshold=1 %"]);
    assert_eq!((status, stderr.contains("warning")), (Some(0), false), "{stderr}");
}

#[test]
fn shots_that_grow_without_bound_fail() {
    let project = Project::new(ROOM);
    let without_end = ["stop.patch_threshold=1e-20 %", "stop.shots_without_progress=10000"];
    let arguments = without_end.map(|set| ["--set", set]);
    let (status, stderr, table) = run(&project, arguments.as_flattened());
    let table = table.unwrap();
    assert_eq!(status, Some(1), "{stderr}");
    assert!(stderr.contains("error: 1 of 2 runs failed"), "{stderr}");
    assert_eq!(cells(&table, "ending"), ["agreed", "failed"]);
    let failure = &cells(&table, "failure")[1];
    assert!(failure.starts_with("no progress after "), "{failure}");
    assert!(failure.contains("the last 10000 of them carried "), "{failure}");
    assert!(failure.contains("try a higher \"stop.patch_threshold\""), "{failure}");
}

/// Virtual time ends after 213 days: no figure says that a run takes exactly so long.
#[test]
fn what_is_later_than_virtual_time_lasts_is_said_in_words() {
    for (base, changes, expected) in [
        (
            "paragon-xps",
            r#""processor": { "scale": 1e300 }"#,
            "waits for a time later than virtual time lasts",
        ),
        (
            "paragon-display",
            r#""start_up": { "bandwidth": "1e-9 B/s" }"#,
            "the start-up of the machine takes longer than virtual time lasts (213 days)",
        ),
    ] {
        let machine = format!(r#"{{ "extends": "{base}", {changes} }}"#);
        let project = Project::new(&ROOM.replacen('{', &format!(r#"{{ "machine": {machine},"#), 1));
        let (status, stderr, table) = run(&project, &[]);
        assert_eq!(status, Some(1), "{stderr}");
        let failure = &cells(&table.unwrap(), "failure")[0];
        assert!(failure.contains(expected), "{failure}");
        assert!(!failure.contains("18446744"), "{failure}");
    }
}
