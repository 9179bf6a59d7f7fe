//! Two lamps in the plane of a ceiling that overlap: every command has one answer, whatever the order of faces.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// Red, of all surfaces; and W/m² of the lamps.
const REFLECTANCE: f64 = 0.5;
const EMISSION: f64 = 10.0;
/// Two squares of 0.7 m that share one of 0.3 m, m².
const LAMPS: f64 = 2.0 * 0.49 - 0.09;

const VERTICES: &str = "mtllib m.mtl
v 0 0 0\nv 3 0 0\nv 3 3 0\nv 0 3 0\nv 0 0 3\nv 3 0 3\nv 3 3 3\nv 0 3 3
v 1 1 3\nv 1.7 1 3\nv 1.7 1.7 3\nv 1 1.7 3\nv 1.4 1.4 3\nv 2.1 1.4 3\nv 2.1 2.1 3\nv 1.4 2.1 3\n";

/// Faces by object, and the material.
const FACES: [(&str, &str, &str); 5] = [
    ("floor", "white", "f 1 2 3 4\n"),
    ("walls", "white", "f 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n"),
    ("ceiling", "white", "f 8 7 6 5\n"),
    ("left", "lamp", "f 12 11 10 9\n"),
    ("right", "lamp", "f 16 15 14 13\n"),
];

/// Writes the room with its faces in this order.
fn write_room(folder: &Path, name: &str, order: [usize; 5]) {
    let face = |i: usize| {
        let (object, material, faces) = FACES[i];
        format!("o {object}\nusemtl {material}\n{faces}")
    };
    let write = |file: &str, text: &str| fs::write(folder.join(file), text).unwrap();
    write(&format!("{name}.obj"), &(VERTICES.to_owned() + &order.map(face).concat()));
    write(
        &format!("{name}.json"),
        &format!(
            r#"{{ "obj": "{name}.obj", "patch_size": "0.8 m", "emitter_patch_size": "0.4 m" }}"#
        ),
    );
    let run = r#"{ "title": "t", "scene": "SCENE.json", "machine": "paragon-xps", "processors": 2,
        "local_environments": 8, "stop": { "patch_threshold": "0.1 %" }, "reference": "dense" }"#;
    write(&format!("{name}-run.json"), &run.replace("SCENE", name));
}

/// What a command prints. It warns of the overlaps, with their area, once.
fn virtwall(folder: &Path, arguments: &str) -> String {
    let command = &mut Command::new(env!("CARGO_BIN_EXE_virtwall"));
    let output = command.current_dir(folder).args(arguments.split(' ')).output();
    let Output { status, stdout, stderr } = output.unwrap();
    let [stdout, stderr] = [stdout, stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert!(status.success(), "{arguments}: {stderr}");
    let warnings: Vec<&str> = stderr.lines().filter(|l| l.starts_with("warning: ")).collect();
    let [warning] = warnings[..] else { panic!("{arguments}: {stderr}") };
    assert!(warning.contains("3 overlaps of faces in one plane, 1.0700 m² in all"), "{warning}");
    stdout
}

/// The cells of a column of a CSV file.
fn column(csv: &str, name: &str) -> Vec<f64> {
    let mut lines = csv.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let place = lines.next().unwrap().iter().position(|column| *column == name).unwrap();
    lines.map(|cells| cells[place].parse().unwrap()).collect()
}

/// Form factors by a method: rows sum to 1, and A F is the same there and back.
fn form_factors_close(folder: &Path, name: &str, method: &str, within: f64) {
    let text = virtwall(folder, &format!("formfactors {name}.obj --method {method} --format json"));
    let found: serde_json::Value = serde_json::from_str(&text).unwrap();
    let areas: Vec<f64> = found["objects"]
        .as_array()
        .unwrap()
        .iter()
        .map(|object| object["area_m2"].as_f64().unwrap())
        .collect();
    assert!((areas.iter().sum::<f64>() - 54.0).abs() < 1e-9, "{areas:?}");
    let all: Vec<f64> = found["form_factors"]
        .as_array()
        .unwrap()
        .iter()
        .map(|one| one["form_factor"].as_f64().unwrap())
        .collect();
    for (from, row) in all.chunks(5).enumerate() {
        assert!((row.iter().sum::<f64>() - 1.0).abs() < 1e-5, "{method} {from}: {row:?}");
        for (to, there) in row.iter().enumerate() {
            let [one, other] = [areas[from] * there, areas[to] * all[5 * to + from]];
            assert!((one - other).abs() <= within * one, "{method} {from} {to}: {one} {other}");
        }
    }
}

#[test]
fn every_method_has_one_answer() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    // In a closed room of one reflectance ρ all surfaces together send out Φ / (1 − ρ).
    let sent = EMISSION * LAMPS / (1.0 - REFLECTANCE);
    fs::write(folder.join("m.mtl"), "newmtl white\nKd 0.5\nnewmtl lamp\nKd 0.5\nKe 10 9 8\n")
        .unwrap();
    let mut pictures = Vec::new();
    for (name, order) in [("a", [0, 1, 2, 3, 4]), ("b", [4, 2, 3, 1, 0])] {
        write_room(folder, name, order);
        virtwall(folder, &format!("check {name}.obj"));
        let shown = virtwall(folder, &format!("scene show {name}.json"));
        assert!(shown.contains("8.9 8.0 7.1 W"), "{shown}");
        form_factors_close(folder, name, "exact", 1e-5);
        form_factors_close(folder, name, "rays", 0.05);
        for (method, within) in [("dense", 1e-4), ("paths", 0.01)] {
            let csv = folder.join("r.csv");
            virtwall(
                folder,
                &format!("reference {name}.json --method {method} --format csv --output r.csv"),
            );
            let csv = fs::read_to_string(csv).unwrap();
            let areas = column(&csv, "area_m2");
            let found: f64 = areas.iter().zip(column(&csv, "red")).map(|(a, b)| a * b).sum();
            assert!((found / sent - 1.0).abs() < within, "{method}: {found} {sent}");
        }
        virtwall(folder, &format!("run {name}-run.json --viewer none --out {name}"));
        let csv = fs::read_to_string(folder.join(name).join("runs.csv")).unwrap();
        let error = column(&csv, "error_l2")[0];
        assert!(error < 0.03, "{error}");
        virtwall(folder, &format!("render {name}.json -o {name}.png --size 90x60"));
        pictures.push(fs::read(folder.join(format!("{name}.png"))).unwrap());
    }
    assert!(pictures[0] == pictures[1], "the same picture to the byte");
}
