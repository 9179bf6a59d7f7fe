//! `virtwall run` where the host sets limits: few threads, folders that cannot be written, other runs.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

#[path = "../../lab/tests/common/mod.rs"]
mod common;

use std::fs;
use std::process::{Child, Command, Output, Stdio};

use common::{Project, SWEEP};

const PROGRAM: &str = env!("CARGO_BIN_EXE_virtwall");

/// Starts the command of a shell in a project's folder; the program is `$0`.
fn start(project: &Project, command: &str) -> Child {
    let shell = &mut Command::new("sh");
    let shell = shell.args(["-c", command, PROGRAM]).current_dir(project.path(""));
    shell.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap()
}

/// The exit code of a child, and what it says on standard error.
fn end(child: Child) -> (i32, String) {
    let Output { status, stderr, .. } = child.wait_with_output().unwrap();
    (status.code().unwrap_or(-1), String::from_utf8(stderr).unwrap())
}

fn run(project: &Project, command: &str) -> (i32, String) {
    end(start(project, command))
}

fn table(project: &Project, folder: &str) -> String {
    fs::read_to_string(project.path(folder).join("runs.csv")).unwrap()
}

/// Each thread takes 2 MB of the program's addresses, and some of them much more.
#[test]
fn threads_that_cannot_be_started_are_done_without() {
    let project = Project::new(SWEEP);
    assert_eq!(run(&project, "$0 run experiments/x.json --out free --threads 2").0, 0);
    let command = "ulimit -v 2000000 && exec $0 run experiments/x.json --out limited --threads 1024 --memory 50MB";
    let (code, stderr) = run(&project, command);
    if stderr.contains("ulimit") || stderr.is_empty() {
        eprintln!("skipped: this host does not limit a program's addresses: {stderr}");
        return;
    }
    assert_eq!(code, 0, "{stderr}");
    assert!(stderr.starts_with("note: ") && stderr.lines().count() == 1, "{stderr}");
    assert!(stderr.contains(" threads wanted, "), "{stderr}");
    assert_eq!(table(&project, "limited"), table(&project, "free"));
}

#[test]
fn folders_that_cannot_be_written_are_refused_before_anything_is_computed() {
    let project = Project::new(SWEEP);
    fs::create_dir(project.path("taken")).unwrap();
    for (file, out, named) in [
        ("file", "file", "file: cannot be written: "),
        ("file", "file/inside/it", "file: cannot be written: "),
        ("taken/.partial", "taken", "taken/.partial: cannot be written: "),
    ] {
        fs::write(project.path(file), "").unwrap();
        // A scene that is not there would be met next.
        let command = format!("$0 run experiments/x.json --set scene=none --out {out}");
        let (code, stderr) = run(&project, &command);
        assert_eq!(code, 2, "{stderr}");
        assert!(stderr.starts_with(&format!("error: {named}")), "{stderr}");
    }
    let refused = "$0 run experiments/x.json --out new/folder --set scene=none";
    assert_eq!(run(&project, refused).0, 2);
    assert!(!project.path("new").exists());
}

#[test]
fn of_runs_into_one_folder_one_writes_and_the_others_say_who() {
    let sweep = SWEEP.replace("[64, 256]", "[64, 128, 256, 512, 1024, 2048, 4096]");
    let project = Project::new(&sweep);
    let mut written = 0;
    for _ in 0..3 {
        let all = [(); 4].map(|()| start(&project, "exec $0 run experiments/x.json --out o -q"));
        let ids = all.each_ref().map(|child| format!("(process {})", child.id()));
        for (code, stderr) in all.map(end) {
            if code == 0 {
                assert_eq!(stderr, "");
                written += 1;
                continue;
            }
            assert_eq!(code, 2, "{stderr}");
            assert!(
                stderr.starts_with("error: o: another run") && stderr.contains("o/.partial/lock")
            );
            assert!(!stderr.contains("(process") || ids.iter().any(|id| stderr.contains(id)));
        }
        assert!(!project.path("o/.partial").exists());
        assert_eq!(table(&project, "o").lines().count(), 1 + 3 * 7);
    }
    assert!(written >= 3, "{written}");
}

/// A run that was killed leaves its lock file behind, and what others put there stays.
#[test]
fn what_is_left_of_a_killed_run_stops_no_other() {
    let project = Project::new(SWEEP);
    project.write("o/.partial/lock", "1");
    project.write("o/.partial/notes.txt", "mine");
    for more in ["", " --fresh"] {
        let (code, stderr) = run(&project, &format!("$0 run experiments/x.json --out o -q{more}"));
        assert_eq!((code, stderr.as_str()), (0, ""));
        let entries = fs::read_dir(project.path("o/.partial")).unwrap();
        let names: Vec<_> = entries.map(|entry| entry.unwrap().file_name()).collect();
        assert_eq!(names, ["notes.txt"]);
    }
}
