//! Every command that reads a scene prints its warnings, once, to standard error; pictures follow "up".

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

#[path = "../../lab/tests/common/mod.rs"]
mod common;

use std::fs;
use std::process::{Command, Output};

use common::Project;

const EXPERIMENT: &str = r#"{
  "title": "test", "scene": "box", "processors": [1, 2], "local_environments": 2,
  "hemisphere": { "pixels": 64 }, "patch_size": "1 m"
}"#;

/// What a command that succeeds writes to standard output and standard error.
fn virtwall(project: &Project, arguments: &str) -> (String, String) {
    let command = &mut Command::new(env!("CARGO_BIN_EXE_virtwall"));
    let output = command.current_dir(project.path("")).args(arguments.split(' ')).output();
    let Output { status, stdout, stderr } = output.unwrap();
    let [stdout, stderr] = [stdout, stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert!(status.success(), "{arguments}: {stderr}");
    (stdout, stderr)
}

#[test]
fn every_command_prints_warnings_once() {
    let project = Project::new(EXPERIMENT);
    let obj = fs::read_to_string(project.path("scenes/box.obj")).unwrap();
    project.write("scenes/box.obj", &obj.replace("mtllib box.mtl", "mtllib box.mtl gone.mtl"));
    for command in [
        "scene show box",
        "check scenes/box.json",
        "check scenes/box.json scenes/box.obj",
        "check experiments/x.json",
        "render box -o a.png --size 30x20",
        "run experiments/x.json --viewer none --out r",
        "render r -o b.png --size 30x20",
        "formfactors box --method rays --rays 64",
        "reference box --method paths --paths 64 --output r.json",
        "bench rays scenes/box.obj --sources 1 --rays 64",
    ] {
        let (stdout, stderr) = virtwall(&project, command);
        let warnings: Vec<&str> = stderr.lines().filter(|l| l.starts_with("warning: ")).collect();
        assert_eq!(warnings.len(), 1, "{command}: {stderr}");
        assert!(warnings[0].contains("scenes/box.obj: 1 material file not read"), "{stderr}");
        assert!(!stdout.contains("warning"), "{command}: {stdout}");
    }
    let (_, stderr) = virtwall(&project, "run experiments/x.json --viewer none --out q --quiet");
    assert_eq!(stderr, "");
}

#[test]
fn a_run_without_light_says_so() {
    let project = Project::new(EXPERIMENT);
    project.write("scenes/box.mtl", "newmtl wall\nKd 0.5\nnewmtl lamp\nKd 0.5\nKa 15 15 15\n");
    let (_, stderr) = virtwall(&project, "run experiments/x.json --viewer none --out r");
    let expected = "warning: scenes/box.obj: no polygon emits light, so that all is dark (Ka is above 1 in \"lamp\"";
    assert!(stderr.contains(expected), "{stderr}");
    let (_, stderr) = virtwall(&project, "formfactors box --method rays --rays 64");
    assert_eq!(stderr, "", "light does not matter for form factors");
}

/// Without light nothing is computed, so that nothing is sped up; and what a run would be compared with
/// is refused before the run.
#[test]
fn a_run_without_light_has_no_speed_up() {
    let project = Project::new(common::SWEEP);
    project.write("scenes/box.mtl", "newmtl wall\nKd 0.5\nnewmtl lamp\nKd 0.5\n");
    let (stdout, _) = virtwall(&project, "run experiments/x.json --out r");
    let csv = fs::read_to_string(project.path("r/runs.csv")).unwrap();
    let cells = |row: &str| row.split(',').map(str::to_owned).collect::<Vec<_>>();
    let header = cells(csv.lines().next().unwrap());
    for name in ["speed_up", "efficiency"] {
        let Some(place) = header.iter().position(|column| column == name) else { continue };
        assert!(csv.lines().skip(1).all(|row| cells(row)[place].is_empty()), "{name}: {csv}");
    }
    assert!(!stdout.contains("1.00"), "{stdout}");
    let command = &mut Command::new(env!("CARGO_BIN_EXE_virtwall"));
    let arguments = ["run", "experiments/x.json", "--set", "reference=dense", "--out", "q"];
    let output = command.current_dir(project.path("")).args(arguments).output().unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{stderr}");
    assert!(stderr.contains("the reference is dark: no light is reflected"), "{stderr}");
    assert!(!project.path("q").exists());
}

/// Light that falls on nothing that reflects is found by the solution, before the run.
#[test]
fn a_lamp_that_lights_nothing_has_no_reference() {
    let project = Project::new(EXPERIMENT);
    // The walls absorb all; what reflects is the lamp, which does not see itself.
    project.write("scenes/box.mtl", "newmtl wall\nKd 0 0 0\nnewmtl lamp\nKd 0.5\nKe 9 9 9\n");
    let command = &mut Command::new(env!("CARGO_BIN_EXE_virtwall"));
    let arguments = ["run", "experiments/x.json", "--set", "reference=dense", "--out", "q"];
    let output = command.current_dir(project.path("")).args(arguments).output().unwrap();
    let stdout = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(1), "{stdout}");
    assert!(stdout.contains("failed: the reference is dark"), "{stdout}");
    assert!(stdout.contains("Shots: 0 asked for"), "{stdout}");
}

/// Names are shortened in messages and tables, whatever their length, and numbers have exponents.
#[test]
fn no_message_is_long() {
    let project = Project::new(EXPERIMENT);
    let long = "x".repeat(200_000);
    let obj = fs::read_to_string(project.path("scenes/box.obj")).unwrap();
    let named = obj.replacen("usemtl wall", &format!("o {long}\nusemtl {long}"), 1);
    project.write("long.obj", &named);
    project.write("far.obj", &obj.replacen("v 4 ", "v 1e308 ", 1));
    project.write("field.json", &format!(r#"{{ "obj": "scenes/box.obj", "{long}": 1 }}"#));
    for command in [
        "check long.obj far.obj field.json",
        "scene show long.obj",
        "formfactors long.obj --method rays --rays 64",
        "render box -o a.png --size 30x20 --exposure 1e300",
    ] {
        let virtwall = &mut Command::new(env!("CARGO_BIN_EXE_virtwall"));
        let output = virtwall.current_dir(project.path("")).args(command.split(' ')).output();
        let Output { stdout, stderr, .. } = output.unwrap();
        for line in [stdout, stderr].map(|bytes| String::from_utf8(bytes).unwrap()).concat().lines()
        {
            assert!(line.chars().count() < 1_000, "{command}: {line}");
            assert!(!line.contains("00000000000") && !line.contains("panic"), "{command}: {line}");
        }
    }
}

/// A scene whose y points up is drawn and exported as its twin whose z does.
#[test]
fn pictures_follow_what_is_up() {
    let project = Project::new(EXPERIMENT);
    let obj = fs::read_to_string(project.path("scenes/box.obj")).unwrap();
    let turned = obj.lines().map(|line| {
        let words: Vec<&str> = line.split(' ').collect();
        match words[..] {
            ["v", x, y, z] => format!("v {x} {z} -{y}\n"),
            _ => format!("{line}\n"),
        }
    });
    project.write("scenes/lying.obj", &turned.collect::<String>());
    let lying = r#"{ "obj": "lying.obj", "patch_size": "1 m", "cells": "8x4x4", "up": "y" }"#;
    project.write("scenes/lying.json", lying);
    let bytes = |name: &str| fs::read(project.path(name)).unwrap();
    for (command, file) in [
        ("scene show SCENE --png FILE --cut-above 1.5 --emitted", "a.png"),
        ("render SCENE -o FILE --exposure 5 --size 60x40 --shading flat --cut-above 1.5", "b.png"),
        ("render SCENE -o FILE --exposure 5 --size 60x40 --camera inside", "c.png"),
    ] {
        let draw = |scene: &str| {
            virtwall(&project, &command.replace("SCENE", scene).replace("FILE", file));
            let decoder = png::Decoder::new(std::io::Cursor::new(bytes(file)));
            let mut reader = decoder.read_info().unwrap();
            let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
            reader.next_frame(&mut pixels).unwrap();
            pixels
        };
        let upright = draw("box");
        // A solved scene has other patches as a bare OBJ file.
        let bare = Some("scenes/lying.obj --up 0,1,0").filter(|_| command.starts_with("scene"));
        for scene in ["lying"].into_iter().chain(bare) {
            let drawn = draw(scene);
            // The light differs a little, since rays do.
            let differences = upright.iter().zip(&drawn).map(|(a, b)| f64::from(a.abs_diff(*b)));
            let mean = differences.sum::<f64>() / upright.len() as f64;
            assert!(mean < 6.0, "{command}, {scene}: {mean}");
        }
        assert!(draw("scenes/lying.obj") != upright, "{command}: z is up by default");
    }
    for (scene, up) in [("box", ""), ("lying", ""), ("scenes/lying.obj", " --up 0,2,0")] {
        virtwall(&project, &format!("render {scene} --gltf a.glb --unshot 90%{up}"));
        let file = gltf::Gltf::from_slice(&bytes("a.glb")).unwrap();
        let node = file.scenes().next().unwrap().nodes().next().unwrap();
        let child = node.children().next().unwrap();
        let [turn, shift] = [&node, &child].map(|node| node.transform().matrix());
        let [turn, shift] =
            [turn, shift].map(|matrix| radiosity::glam::Mat4::from_cols_array_2d(&matrix));
        let primitive = child.mesh().unwrap().primitives().next().unwrap();
        let reader = primitive.reader(|_| file.blob.as_deref());
        let heights = reader.read_positions().unwrap();
        let highest = heights.map(|at| (turn * shift).transform_point3(at.into()).y);
        let highest = highest.fold(f32::MIN, f32::max);
        assert!((highest - 2.0).abs() < 1e-5, "{scene}: {highest} m high");
    }
}
