//! The program says what there is: names, what each is, and which command was meant.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

#[path = "../../lab/tests/common/mod.rs"]
mod common;

use std::fs;
use std::path::Path;
use std::process::Command;

use common::{Project, SWEEP};
use serde_json::Value;

fn virtwall(folder: &Path, arguments: &str) -> (i32, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_virtwall"))
        .current_dir(folder)
        .args(arguments.split(' '))
        .output()
        .unwrap();
    let text = [output.stdout, output.stderr].concat();
    (output.status.code().unwrap(), String::from_utf8(text).unwrap())
}

fn says(folder: &Path, arguments: &str) -> String {
    let (code, text) = virtwall(folder, arguments);
    assert_eq!(code, 0, "{arguments}: {text}");
    text
}

fn refuses(folder: &Path, arguments: &str) -> String {
    let (code, text) = virtwall(folder, arguments);
    assert_eq!(code, 2, "{arguments}: {text}");
    text.strip_prefix("error: ").unwrap().trim_end().to_owned()
}

#[test]
fn all_names_are_listed_with_a_line() {
    let folder = tempfile::tempdir().unwrap();
    let list: Value = serde_json::from_str(&says(folder.path(), "list --format json")).unwrap();
    let kinds = [
        ("scenes", "office"),
        ("machines", "paragon-xps"),
        ("experiments", "table1"),
        ("network_models", "loggp"),
        ("columns", "time_s"),
        ("fields", "stop.patch_threshold"),
        ("choices", "C12"),
    ];
    assert_eq!(list.as_object().unwrap().len(), kinds.len());
    for (kind, name) in kinds {
        let rows = list[kind].as_array().unwrap();
        assert!(rows.iter().any(|row| row["name"] == name), "{kind}");
        assert!(rows.iter().all(|row| !row["title"].as_str().unwrap().is_empty()), "{kind}");
        let only = says(folder.path(), &format!("list {}", kind.replace('_', "-")));
        assert!(only.starts_with(&kind.replace('_', " ")), "{only}");
        assert!(only.contains(&format!("\n  {name} ")) && only.lines().count() == rows.len() + 2);
    }
}

/// The text with one space in place of several.
fn one_space(text: &str) -> String {
    let lines = text.lines().map(|line| line.split_whitespace().collect::<Vec<_>>().join(" "));
    lines.map(|line| line + "\n").collect()
}

#[test]
fn scenes_machines_and_experiments_are_shown() {
    let project = Project::new(SWEEP);
    let folder = project.path("");
    assert_eq!(says(&folder, "show office"), says(&folder, "scene show office"));
    assert_eq!(says(&folder, "show scenes/box.obj"), says(&folder, "scene show scenes/box.obj"));
    assert_eq!(says(&folder, "show ultra1"), says(&folder, "machine show ultra1"));
    let table1 = one_space(&says(&folder, "show table1"));
    for part in [
        "Table 1: times and speed-up\nDo we get the paper's Table 1?\n",
        "\nruns 24\nscene, swept office, rooms, building\n",
        "\nprocessors, swept 1, 2, 4, 7, 8, 14, 28, 56\n",
        "\nstop.patch_threshold 10 %\n",
        "speed_up by processors, a line for each scene (speed_up-by-processors.svg)\n",
    ] {
        assert!(table1.contains(part), "{part}: {table1}");
    }
    assert!(says(&folder, "show experiments/x.json").starts_with("test\n"));
    let found = one_space(&says(&folder, "show accuracy"));
    assert!(found.contains("stop.patch_threshold found"), "{found}");

    project.write("machines/box.json", "{\"extends\": \"paragon-xps\", \"title\": \"a machine\"}");
    assert_eq!(
        refuses(&folder, "show box"),
        "\"box\" is a scene and a machine; to choose: virtwall show box --as scene, machine or experiment"
    );
    assert!(says(&folder, "show box --as machine").starts_with("a machine\n"));
    assert!(refuses(&folder, "show offise").contains("did you mean \"office\"?"));
    assert!(refuses(&folder, "show scenes/box.mtl").contains("expected one of them"));
    assert!(refuses(&folder, "show experiments").contains("unknown"));
    project.write("experiments/bad.json", &SWEEP.replace("\"title\"", "\"titel\""));
    assert!(refuses(&folder, "show bad").contains("did you mean \"title\"?"));
}

#[test]
fn words_are_explained() {
    let folder = tempfile::tempdir().unwrap();
    let says = |word: &str| says(folder.path(), &format!("explain {word}"));
    assert_eq!(
        says("gain"),
        "gain: a column of results\n  Time with one local environment over time_s (Figure 11).\n  \
         unit     ratio\n  paper    Figure 11\n"
    );
    let threshold = says("stop.patch_threshold");
    assert!(threshold.contains("takes    a number with its unit (%)"), "{threshold}");
    assert!(threshold.contains("default  10 %") && threshold.contains("Choice C6"), "{threshold}");
    assert!(says("C12").starts_with("C12: a choice where the paper is silent\n  When a ray"));
    assert!(says("c12").ends_with("  paper    §4.2.3\n"));
    assert!(says("host.cpu_s").contains("unit     s\n"));
    assert_eq!(says("scene").matches("scene: a ").count(), 2);
    let refuses = |word: &str| refuses(folder.path(), &format!("explain {word}"));
    assert!(refuses("patch_treshold").contains("did you mean \"stop.patch_threshold\"?"));
    assert_eq!(refuses("office"), "\"office\" is a scene; to see it: virtwall show office");
    assert!(refuses("qqqqqqqq").starts_with("unknown word \"qqqqqqqq\" (virtwall list "));
}

/// A scene or a machine in place of an experiment is answered with commands that work.
#[test]
fn the_command_that_was_meant_is_named() {
    let project = Project::new(SWEEP);
    let folder = project.path("");
    let short = "--set local_environments=4 --set processors=1 --viewer none --out out --replace";
    for (file, kind, commands) in [
        ("scenes/box.json", "a scene", 2),
        ("scenes/box.obj", "the geometry of a scene", 2),
        ("box", "a scene", 2),
        ("machines/paragon-xps.json", "a machine", 2),
        ("paragon-xps", "a machine", 2),
    ] {
        let answer = refuses(&folder, &format!("run {file}"));
        assert!(answer.starts_with(&format!("{file} is {kind}; to ")), "{answer}");
        let meant: Vec<&str> =
            answer.split("virtwall ").skip(1).filter_map(|rest| rest.split(';').next()).collect();
        assert_eq!(meant.len(), commands, "{answer}");
        for command in meant {
            let rest =
                if command.starts_with("run ") { format!(" {short}") } else { String::new() };
            says(&folder, &format!("{command}{rest}"));
        }
    }
    // What is wrong with an experiment is said as before, though a scene has its name.
    project.write("experiments/box.json", &SWEEP.replace("\"title\"", "\"titel\""));
    assert!(refuses(&folder, "run box").contains("did you mean \"title\"?"));
    assert!(refuses(&folder, "run x --set processors=0").contains("processors"));
    assert!(refuses(&folder, "run y").contains("unknown experiment \"y\""));
}

#[test]
fn shells_complete_and_pages_are_written() {
    let folder = tempfile::tempdir().unwrap();
    for shell in ["bash", "zsh", "fish", "powershell"] {
        let script = says(folder.path(), &format!("completions {shell}"));
        assert!(script.contains("formfactors") && script.contains("keep-shots"), "{shell}");
    }
    let pages = says(folder.path(), "man pages/man1");
    for name in ["virtwall", "virtwall-run", "virtwall-machine-show", "virtwall-explain"] {
        let path = format!("pages/man1/{name}.1");
        assert!(pages.lines().any(|line| line == path), "{pages}");
        assert!(fs::read_to_string(folder.path().join(path)).unwrap().contains(".SH NAME"));
    }
    fs::write(folder.path().join("file"), "").unwrap();
    refuses(folder.path(), "man file");
}
