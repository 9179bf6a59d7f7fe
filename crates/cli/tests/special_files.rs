//! The command and what is no regular file: links, named pipes and folders as inputs and outputs, full devices,
//! folders of other files. And scenes of a size that the usual decimals do not show.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

#[path = "../../lab/tests/common/mod.rs"]
mod common;

use std::fs::{self, File};
use std::os::unix::fs::{FileTypeExt, symlink};
use std::path::Path;
use std::process::{Command, Output, Stdio};

use common::{Project, SWEEP};

const PROGRAM: &str = env!("CARGO_BIN_EXE_virtwall");

fn output(project: &Project, arguments: &[&str]) -> (i32, String, String) {
    let mut command = Command::new(PROGRAM);
    let command = command.current_dir(project.path("")).args(arguments).stdin(Stdio::null());
    let Output { status, stdout, stderr } = command.output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (status.code().unwrap_or(-1), text(stdout), text(stderr))
}

fn pipe(project: &Project, name: &str) {
    assert!(Command::new("mkfifo").arg(project.path(name)).status().unwrap().success());
}

fn is_pipe(project: &Project, name: &str) -> bool {
    fs::symlink_metadata(project.path(name)).unwrap().file_type().is_fifo()
}

#[test]
fn no_output_replaces_a_pipe_or_a_link() {
    let project = Project::new(SWEEP);
    project.write("target.csv", "");
    for name in ["p.png", "p.csv", "p.glb"] {
        pipe(&project, name);
    }
    symlink(project.path("nowhere"), project.path("dangling.csv")).unwrap();
    symlink(project.path("p.csv"), project.path("to-pipe.csv")).unwrap();
    symlink(project.path("target.csv"), project.path("link.csv")).unwrap();
    for (arguments, refused) in [
        (
            &["formfactors", "box", "--output", "p.csv"][..],
            "p.csv: cannot be written: not a regular file",
        ),
        (
            &["formfactors", "box", "--output", "to-pipe.csv"],
            "to-pipe.csv: cannot be written: not a regular file",
        ),
        (
            &["formfactors", "box", "--output", "dangling.csv"],
            "dangling.csv: cannot be written: a link that leads to no file",
        ),
        (
            &["formfactors", "box", "--output", "scenes"],
            "scenes: cannot be written: it is a folder",
        ),
        (&["render", "box", "--output", "p.png"], "p.png: cannot be written: not a regular file"),
        (&["render", "box", "--gltf", "p.glb"], "p.glb: cannot be written: not a regular file"),
        (
            &["scene", "show", "box", "--png", "p.png"],
            "p.png: cannot be written: not a regular file",
        ),
    ] {
        // A scene that is not there would be met next.
        let missing: Vec<&str> =
            arguments.iter().map(|&a| if a == "box" { "none" } else { a }).collect();
        let (code, stdout, stderr) = output(&project, &missing);
        assert_eq!((code, stdout.as_str()), (2, ""), "{stderr}");
        assert_eq!(stderr, format!("error: {refused}\n"));
    }
    assert!(["p.png", "p.csv", "p.glb"].iter().all(|name| is_pipe(&project, name)));
    let (code, _, stderr) = output(&project, &["formfactors", "box", "--output", "link.csv"]);
    assert_eq!(code, 0, "{stderr}");
    assert!(fs::symlink_metadata(project.path("link.csv")).unwrap().is_symlink());
    assert!(!fs::read(project.path("target.csv")).unwrap().is_empty());
}

/// A link to a folder is a folder; the files in it are those that are replaced, or not.
#[test]
fn results_go_where_links_lead_and_replace_no_pipe() {
    let project = Project::new(SWEEP);
    fs::create_dir(project.path("far")).unwrap();
    symlink(project.path("far"), project.path("near")).unwrap();
    let run = ["run", "experiments/x.json", "--quiet", "--out"];
    assert_eq!(output(&project, &[&run[..], &["near"]].concat()).0, 0);
    assert!(project.path("far/runs.csv").exists());
    fs::create_dir(project.path("o")).unwrap();
    pipe(&project, "o/report.html");
    let (code, _, stderr) = output(&project, &[&run[..], &["o", "--replace"]].concat());
    let refused = "error: o/report.html: cannot be written: not a regular file\n";
    assert_eq!((code, stderr.as_str()), (2, refused));
    assert!(is_pipe(&project, "o/report.html") && !project.path("o/runs.csv").exists());
}

/// `/dev/full` is a device on which every write fails. Nothing is written to it but through standard output.
#[test]
fn what_cannot_be_printed_is_a_failure_and_a_closed_pipe_is_none() {
    let project = Project::new(SWEEP);
    for arguments in
        [&["list"][..], &["--help"], &["list", "--help"], &["--version"], &["scene", "show", "box"]]
    {
        let started = |stdout: Stdio| {
            Command::new(PROGRAM)
                .current_dir(project.path(""))
                .args(arguments)
                .stdout(stdout)
                .output()
                .unwrap()
        };
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let closed = started(writer.into());
        assert_eq!((closed.status.code(), closed.stderr.len()), (Some(0), 0), "{arguments:?}");
        if !Path::new("/dev/full").exists() {
            continue;
        }
        let full = started(File::options().write(true).open("/dev/full").unwrap().into());
        let stderr = String::from_utf8(full.stderr).unwrap();
        assert_eq!(full.status.code(), Some(1), "{arguments:?}: {stderr}");
        let message = "error: standard output: No space left on device";
        assert!(stderr.starts_with(message) && stderr.lines().count() == 1, "{stderr}");
    }
}

#[test]
fn files_that_no_run_wrote_are_not_replaced() {
    let project = Project::new(SWEEP);
    let run = ["run", "experiments/x.json", "--quiet", "--out"];
    let more = |more: &[&str]| output(&project, &[&run[..], more].concat());
    let expected = "another folder by --out, or --replace\n";
    let wrote = "expected results that `run` wrote";
    for name in ["runs.csv", "report.html", "operations.csv", "speed_up-by-processors.svg"] {
        let file = format!("{name}-there/{name}");
        project.write(&file, "mine");
        let (code, _, stderr) = more(&[&format!("{name}-there")]);
        let message = format!(
            "error: {file}: not from a run: no manifest.json beside it; {wrote}, {expected}"
        );
        assert_eq!((code, stderr), (2, message));
        assert_eq!(fs::read_to_string(project.path(&file)).unwrap(), "mine");
    }
    assert_eq!(more(&["runs.csv-there", "--replace"]).0, 0);
    // Files of other names are in nobody's way.
    project.write("notes/notes.txt", "mine");
    assert_eq!(more(&["notes"]).0, 0);
    for (manifest, message) in [
        ("{}", "f/manifest.json: no \"experiment\""),
        ("[1]", "f/manifest.json: no \"experiment\""),
        (r#"{ "experiment": 7 }"#, "f/manifest.json: no \"experiment\""),
        ("{", "f/manifest.json:1:"),
    ] {
        project.write("f/manifest.json", manifest);
        let (code, _, stderr) = more(&["f"]);
        assert_eq!(code, 2, "{stderr}");
        let end = format!("; expected a manifest that `run` wrote, {expected}");
        assert!(
            stderr.starts_with(&format!("error: {message}")) && stderr.ends_with(&end),
            "{stderr}"
        );
        assert_eq!(fs::read_to_string(project.path("f/manifest.json")).unwrap(), manifest);
    }
    project.write("f/manifest.json", r#"{ "experiment": {} }"#);
    let (code, _, stderr) = more(&["f"]);
    assert!(code == 2 && stderr.contains("f: has results of another configuration: "), "{stderr}");
    assert!(stderr.len() < 600, "{stderr}");
    assert_eq!(more(&["f", "--replace"]).0, 0);
}

#[test]
fn what_is_there_and_no_regular_file_is_called_so() {
    let project = Project::new(SWEEP);
    for name in ["p.obj", "p.json", "plain", "scenes/piped.json"] {
        pipe(&project, name);
    }
    fs::create_dir(project.path("folder.json")).unwrap();
    let machine = ["run", "experiments/x.json", "--set", "machine=../p.json"];
    let reference = ["run", "experiments/x.json", "--set", "reference=../p.json"];
    let compare = ["run", "experiments/x.json", "--set", "compare_with=../p.json"];
    project.write("scenes/through.json", r#"{ "obj": "../p.obj", "patch_size": "1 m" }"#);
    for arguments in [
        &["scene", "show", "p.obj"][..],
        &["scene", "show", "through"],
        &["scene", "show", "piped"],
        &["scene", "show", "plain"],
        &["scene", "show", "/dev/zero"],
        &["scene", "show", "/dev/stdin"],
        &["show", "p.obj"],
        &["show", "plain"],
        &["render", "p.json", "--output", "x.png"],
        &["run", "p.json"],
        &["run", "folder.json"],
        &["run", "/dev/zero"],
        &["machine", "show", "p.json"],
        &["check", "p.json"],
        &["stability", "p.json"],
        &machine,
        &reference,
        &compare,
    ] {
        let (code, _, stderr) = output(&project, arguments);
        assert_eq!(code, 2, "{arguments:?}: {stderr}");
        assert!(stderr.contains("not a regular file"), "{arguments:?}: {stderr}");
    }
    let (_, _, stderr) = output(&project, &["scene", "show", "none.obj"]);
    assert!(stderr.contains("\"none.obj\": no such file"), "{stderr}");
}

/// The same numbers as of the box in metres, at another scale.
#[test]
fn small_numbers_are_shown_with_their_digits() {
    let project = Project::new(SWEEP);
    let obj = fs::read_to_string(project.path("scenes/box.obj")).unwrap();
    let scaled = |line: &str| match line.strip_prefix("v ") {
        None => format!("{line}\n"),
        Some(place) => {
            let scaled: Vec<String> = place.split(' ').map(|c| format!("{c}e-6")).collect();
            format!("v {}\n", scaled.join(" "))
        }
    };
    project.write("scenes/tiny.obj", &obj.lines().map(scaled).collect::<String>());
    project.write("scenes/tiny.json", r#"{ "obj": "tiny.obj", "patch_size": "1e-6 m" }"#);
    let (code, stdout, stderr) = output(&project, &["scene", "show", "tiny"]);
    assert_eq!(code, 0, "{stderr}");
    let fact = |name: &str| {
        let line = stdout.lines().find(|line| line.starts_with(name)).unwrap();
        line[name.len()..].trim().to_owned()
    };
    assert_eq!(fact("bounds"), "0.00 0.00 0.00 to 4.00e-6 2.00e-6 2.00e-6 m");
    assert_eq!(fact("area"), "4.0e-11 m²");
    assert!(fact("patch size").starts_with("1.000e-6 m"), "{stdout}");
    let power: Vec<f64> =
        fact("emitted power").split(' ').filter_map(|watts| watts.parse().ok()).collect();
    // 0.04 µm² of 100, 90 and 80 W/m².
    assert_eq!(power, [4e-12, 3.6e-12, 3.2e-12]);

    let dim = fs::read_to_string(project.path("scenes/box.mtl")).unwrap();
    project.write("scenes/box.mtl", &dim.replace("Ke 100 90 80", "Ke 1e-30 1e-30 1e-30"));
    let picture = ["render", "box", "--output", "x.png", "--size", "60x40", "--exposure", "1e-30"];
    let (code, stdout, stderr) = output(&project, &picture);
    assert_eq!(code, 0, "{stderr}");
    assert!(stdout.contains("middle grey is 1.0000e-30 W/m²"), "{stdout}");
}

#[test]
fn no_frame_replaces_a_pipe() {
    let project = Project::new(&SWEEP.replace("[64, 256]", "64"));
    pipe(&project, "x-003.png");
    let arguments = ["render", "experiments/x.json", "--output", "x.png", "--frames", "4"];
    let (code, stdout, stderr) = output(&project, &arguments);
    let refused = "error: x-003.png: cannot be written: not a regular file\n";
    assert_eq!((code, stdout.as_str(), stderr.as_str()), (2, "", refused));
    assert!(is_pipe(&project, "x-003.png") && !project.path("x-001.png").exists());
}
