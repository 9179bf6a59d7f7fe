//! The program alone, in an empty folder.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::fs;
use std::path::Path;
use std::process::Command;

fn virtwall(folder: &Path, arguments: &str) -> (i32, String) {
    let arguments = arguments.split(' ');
    let output =
        Command::new(env!("CARGO_BIN_EXE_virtwall")).current_dir(folder).args(arguments).output();
    let output = output.unwrap();
    let text = [output.stdout, output.stderr].concat();
    (output.status.code().unwrap(), String::from_utf8(text).unwrap())
}

#[test]
fn everything_that_is_shipped_works_in_an_empty_folder() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let works = |arguments: &str| {
        let (code, text) = virtwall(folder, arguments);
        assert_eq!(code, 0, "{arguments}: {text}");
        text
    };
    let list = works("list");
    for name in ["\n  office ", "\n  paragon-xps ", "\n  table1 "] {
        assert!(list.contains(name), "{list}");
    }
    works("run quickstart --viewer none");
    works("run table1 --set scene=room4 --set processors=4 --viewer none");
    works("scene show rooms --png rooms.png");
    works("stability one-processor");
    assert_eq!(works("export paragon-xps"), "./machines/paragon-xps.json\n");
    assert!(works("list").contains("2 service nodes (in this folder)"));
    works("check machines/paragon-xps.json");
    let machine = folder.join("machines/paragon-xps.json");
    let text = fs::read_to_string(&machine).unwrap().replace("\"65 MB/s\"", "\"1 MB/s\"");
    fs::write(&machine, text).unwrap();
    works("run quickstart --viewer none --out slow");
    let table = |name: &str| fs::read_to_string(folder.join(name).join("runs.csv")).unwrap();
    assert_ne!(table("results/quickstart"), table("slow"), "the exported machine is used");
}

#[test]
fn unknown_names_are_refused_with_the_nearest_and_files_are_not_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let (code, text) = virtwall(folder.path(), "run tabel1");
    assert_eq!(code, 2);
    assert!(text.starts_with("error: unknown experiment \"tabel1\", did you mean \"table1\"?"));
    assert_eq!(virtwall(folder.path(), "export offise").0, 2);
    assert_eq!(virtwall(folder.path(), "export office").0, 0);
    let (code, text) = virtwall(folder.path(), "export office");
    assert_eq!(code, 2);
    assert!(text.contains("scenes/office.json: exists already"), "{text}");
}
