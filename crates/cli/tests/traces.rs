//! Traces of runs: what stands in them is what stands in runs.csv, and writing them changes nothing.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

#[path = "../../lab/tests/common/mod.rs"]
mod common;
#[path = "../../traces/tests/reader/mod.rs"]
mod reader;

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use common::{Project, SWEEP};
use reader::{Read, read};

fn virtwall(project: &Project, arguments: &[&str]) -> (i32, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_virtwall"));
    let command = command.current_dir(project.path("")).args(arguments).stdin(Stdio::null());
    let output = command.output().unwrap();
    (output.status.code().unwrap(), String::from_utf8(output.stderr).unwrap())
}

/// Runs the project's experiment and says where its results are.
fn run(project: &Project, out: &str, more: &[&str]) {
    let arguments = [&["run", "experiments/x.json", "--out", out, "--replace"], more].concat();
    assert_eq!(virtwall(project, &arguments), (0, String::new()), "{arguments:?}");
}

fn files(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let name = |path: &Path| path.file_name().unwrap().to_str().unwrap().to_owned();
    let mut files: Vec<_> = entries.map(|path| (name(&path), fs::read(&path).unwrap())).collect();
    files.sort();
    files
}

/// Every row of runs.csv is found again in the trace of its run.
#[test]
fn traces_tell_what_the_results_tell() {
    let project = Project::new(&SWEEP.replace("[64, 256]", "256"));
    for network in [&[][..], &["--network", "wormhole"], &["--network", "auto"]] {
        run(&project, "out", &[network, &["--trace", "traces"]].concat());
        let csv = fs::read_to_string(project.path("out/runs.csv")).unwrap();
        let mut rows = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
        let columns = rows.next().unwrap();
        let traces = files(&project.path("traces"));
        let names: Vec<_> = traces.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["1-box-1.pftrace", "2-box-2.pftrace", "3-box-4.pftrace"]);
        for ((_, bytes), row) in traces.iter().zip(rows) {
            let place = |name: &str| columns.iter().position(|column| *column == name).unwrap();
            compare(&read(bytes), |name| row[place(name)].to_owned());
        }
    }
}

fn compare(trace: &Read, cell: impl Fn(&str) -> String) {
    let number = |name: &str| cell(name).parse::<f64>().unwrap();
    let slices = |name: &'static str| trace.slices.iter().filter(move |s| s.name == name);
    assert_eq!(slices("local shot").count().to_string(), cell("local_shots"));
    assert_eq!(slices("received shot").count().to_string(), cell("received_shots"));
    let sent = |name: &'static str| trace.departures.iter().filter(move |d| d.name == name);
    let bytes = |name| sent(name).map(|departure| departure.bytes).sum::<u64>().to_string();
    assert_eq!(sent("send source").count().to_string(), cell("messages"));
    assert_eq!(bytes("send source"), cell("message_bytes"));
    assert_eq!(sent("send update").count().to_string(), cell("update_messages"));
    assert_eq!(bytes("send update"), cell("update_bytes"));
    let control = ["send sums", "send token", "send done"].map(|name| sent(name).count());
    assert_eq!(control.iter().sum::<usize>().to_string(), cell("control_messages"));
    let computing = trace.slices.iter().filter(|slice| slice.category == "compute");
    let busy: u64 = computing.map(|slice| slice.to - slice.from).sum();
    let fraction = busy as f64 / 1e9 / number("time_s") / number("processors");
    // Half of the table's last digit, of the fraction and of the time; a nanosecond a slice.
    let rounding = 0.5e-6 + (0.5e-6 + 1e-9 * trace.slices.len() as f64) / number("time_s");
    assert!((fraction - number("busy_fraction")).abs() < rounding, "{fraction} {rounding}");
}

/// Results are the same with traces and without, and traces whatever the threads.
#[test]
fn traces_change_no_byte() {
    let project = Project::new(SWEEP);
    run(&project, "plain", &[]);
    run(&project, "one", &["--threads", "1", "--trace", "a"]);
    run(&project, "two", &["--threads", "2", "--trace", "b"]);
    let results = |out: &str| {
        let files = files(&project.path(out)).into_iter();
        files.filter(|(name, _)| name != "host-times.json").collect::<Vec<_>>()
    };
    assert!(results("plain") == results("one") && results("one") == results("two"));
    let traces = files(&project.path("a"));
    assert_eq!(traces.len(), 6);
    assert!(traces == files(&project.path("b")));
    run(&project, "plain", &["--trace", "c", "--trace-format", "paje", "--trace-sample", "5"]);
    let (name, text) = &files(&project.path("c"))[0];
    assert_eq!(name, "1-box-1.trace");
    assert!(text.starts_with(b"%EventDef PajeDefineContainerType 0\n"));
}

#[test]
fn what_cannot_be_traced_is_refused() {
    let project = Project::new(SWEEP);
    for (arguments, expected) in [
        (&["--trace", "t", "--on", "threads"][..], "--on threads"),
        (&["--trace", "experiments/x.json"], "experiments/x.json: cannot make a folder for traces"),
        (&["--trace-sample", "2"], "--trace <DIR>"),
        (&["--trace-format", "paje"], "--trace <DIR>"),
        (&["--trace", "t", "--trace-sample", "0"], "--trace-sample"),
        (&["--trace", "t", "--trace-format", "otf"], "otf"),
    ] {
        let (code, stderr) =
            virtwall(&project, &[&["run", "experiments/x.json"], arguments].concat());
        assert_eq!(code, 2, "{stderr}");
        assert!(stderr.contains(expected), "{stderr}");
        assert!(!project.path("results").exists() && !project.path("t").exists());
    }
}
