//! Scenes that cannot be meant: what is wrong, how much of the light it concerns, and that the remedy works.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

#[path = "../../lab/tests/common/mod.rs"]
mod common;

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use common::{Project, SWEEP};

/// What a command that succeeds writes to standard output and standard error.
fn virtwall(folder: &Path, arguments: &str) -> (String, String) {
    let command = &mut Command::new(env!("CARGO_BIN_EXE_virtwall"));
    let output = command.current_dir(folder).args(arguments.split(' ')).output();
    let Output { status, stdout, stderr } = output.unwrap();
    let [stdout, stderr] = [stdout, stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert!(status.success(), "{arguments}: {stderr}");
    (stdout, stderr)
}

/// The shares of the light of the lamps on fronts, on backs and out of the scene, in per cent; and warnings.
fn shares(project: &Project, scene: &str) -> ([f64; 3], String) {
    let (shown, warnings) = virtwall(&project.path(""), &format!("scene show {scene}"));
    let line = shown.lines().find(|line| line.starts_with("light of lamps")).unwrap();
    let mut numbers = line.split(' ').filter_map(|word| word.parse().ok());
    ([(); 3].map(|()| numbers.next().unwrap()), warnings)
}

fn text(project: &Project, name: &str) -> String {
    fs::read_to_string(project.path(name)).unwrap()
}

/// The text of an OBJ file with the corners of chosen faces, by number, in reverse.
fn turned(obj: &str, chosen: impl Fn(usize) -> bool) -> String {
    let mut face = 0;
    let line = |line: &str| match line.strip_prefix("f ") {
        Some(corners) => {
            face += 1;
            let mut corners: Vec<&str> = corners.split(' ').collect();
            if chosen(face - 1) {
                corners.reverse();
            }
            format!("f {}\n", corners.join(" "))
        }
        None => format!("{line}\n"),
    };
    obj.lines().map(line).collect()
}

/// The box of the project with all its walls the wrong way round, but not the lamp.
fn inside_out() -> Project {
    let project = Project::new(SWEEP);
    let obj = turned(&text(&project, "scenes/box.obj"), |face| face < 6);
    project.write("scenes/box.obj", &obj);
    project
}

/// The form factor from a point that looks down to a rectangle on the floor, `height` below it, whose sides
/// are at these distances before, behind, left and right of it (Howell's B-4, of four parts).
fn down(height: f64, [before, behind, left, right]: [f64; 4]) -> f64 {
    let part = |a: f64, b: f64| {
        let (a, b) = (a / height, b / height);
        let (ra, rb) = ((1.0 + a * a).sqrt(), (1.0 + b * b).sqrt());
        (a / ra * (b / ra).atan() + b / rb * (a / rb).atan()) / std::f64::consts::TAU
    };
    part(before, left) + part(before, right) + part(behind, left) + part(behind, right)
}

/// The share of the light of the lamp of the box that falls on the floor, in per cent.
fn on_floor() -> f64 {
    let steps = (0..20).map(|i| 1.0 + 0.2 * (f64::from(i) + 0.5) / 20.0);
    let points = steps.clone().flat_map(|x| steps.clone().map(move |y| (x, y)));
    let sum: f64 = points.map(|(x, y)| down(1.9, [x, 4.0 - x, y, 2.0 - y])).sum();
    100.0 * sum / 400.0
}

#[test]
fn the_share_of_light_on_a_back_is_the_form_factor() {
    let project = Project::new(SWEEP);
    assert_eq!(shares(&project, "box"), ([100.0, 0.0, 0.0], String::new()));
    let obj = text(&project, "scenes/box.obj");
    project.write("scenes/box.obj", &turned(&obj, |face| face == 0));
    let ([fronts, backs, leaves], warnings) = shares(&project, "box");
    let expected = on_floor();
    assert!((backs - expected).abs() < 0.5, "{backs} instead of {expected}");
    assert!((fronts + backs - 100.0).abs() < 0.11 && leaves == 0.0, "{fronts} {leaves}");
    let said = format!(
        "box.obj: {backs:.1} % of the light of the lamps falls on backs, which absorb all light (1 of 7"
    );
    assert!(warnings.contains(&said) && warnings.contains("virtwall scene flip"), "{warnings}");
    for command in ["check scenes/box.obj", "run experiments/x.json --viewer none -o r"] {
        let (_, stderr) = virtwall(&project.path(""), command);
        assert_eq!(stderr.matches(&said).count(), 1, "{command}: {stderr}");
    }
    // An open side is a fact, not a fault.
    project.write("scenes/box.obj", &obj.replacen("f 1 2 3 4\n", "", 1));
    let ([_, backs, leaves], warnings) = shares(&project, "box");
    assert!((leaves - expected).abs() < 0.5 && backs == 0.0, "{leaves} instead of {expected}");
    assert_eq!(warnings, "");
}

/// What a flip writes is the scene as it was meant: the same numbers, and the same light to the bit.
#[test]
fn a_flip_turns_an_inside_out_scene() {
    let right = Project::new(SWEEP);
    let wrong = inside_out();
    let (said, _) = virtwall(&wrong.path("scenes"), "scene flip box.obj -o right.obj");
    let expected =
        "6 of 7 faces turned over\nlight of the lamps on backs: 100 % before, 0 % in right.obj\n";
    assert_eq!(said, expected);
    let pictures = [(&right, "box.obj"), (&wrong, "right.obj")].map(|(project, scene)| {
        let shown =
            virtwall(&project.path("scenes"), &format!("scene show {scene} -o a.png --size 60x40"));
        (shown, fs::read(project.path("scenes/a.png")).unwrap())
    });
    assert!(pictures[0] == pictures[1], "{:?} {:?}", pictures[0].0, pictures[1].0);
    // Nothing is left to be turned.
    let (said, _) = virtwall(&wrong.path("scenes"), "scene flip right.obj -o again.obj");
    assert!(said.starts_with("0 of 7 faces turned over\n"), "{said}");
    assert_eq!(text(&wrong, "scenes/again.obj"), text(&wrong, "scenes/right.obj"));
}

/// Of a furnished office any faces are turned over: a flip turns back those that light reaches.
#[test]
fn a_flip_finds_any_faces_that_are_turned() {
    let project = Project::new(SWEEP);
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let office = fs::read_to_string(scenes.join("office.obj")).unwrap();
    fs::copy(scenes.join("office.mtl"), project.path("office.mtl")).unwrap();
    // Lamps are the measure of the rest.
    let mut lamp = false;
    let mut lamps = Vec::new();
    for line in office.lines() {
        lamp = if line.starts_with("usemtl") {
            line.contains("light") || line.contains("lamp")
        } else {
            lamp
        };
        if line.starts_with("f ") {
            lamps.push(lamp);
        }
    }
    let few = |face: usize| !lamps[face] && (face * 7919) % 13 < 4;
    project.write("office.obj", &office);
    project.write("wrong.obj", &turned(&office, few));
    let flip = |name: &str| {
        virtwall(&project.path(""), &format!("scene flip {name}.obj -o {name}-flipped.obj")).0
    };
    let (untouched, said) = (flip("office"), flip("wrong"));
    assert!(untouched.starts_with("0 of "), "{untouched}");
    assert!(said.contains(", 0 % in wrong-flipped.obj"), "{said}");
    let faces = |text: &str| {
        text.lines().filter(|l| l.starts_with("f ")).map(str::to_owned).collect::<Vec<_>>()
    };
    let (meant, found) = (faces(&office), faces(&text(&project, "wrong-flipped.obj")));
    let unlit = untouched
        .split("; ")
        .nth(1)
        .map_or(0, |rest| rest.split(' ').next().unwrap().parse().unwrap());
    let differ = meant.iter().zip(&found).filter(|(a, b)| a != b).count();
    assert!(differ <= unlit, "{differ} faces differ, {unlit} are in the dark");
    assert!(unlit < meant.len() / 10, "{unlit}");
}

#[test]
fn a_lamp_that_shines_out_of_the_scene_is_turned() {
    let project = Project::new(SWEEP);
    let ground = "mtllib box.mtl\nv 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 1 1 2\nv 2 1 2\nv 2 2 2\nv 1 2 2\n\
                  usemtl wall\nf 1 2 3 4\nusemtl lamp\nf 5 6 7 8\n";
    project.write("scenes/up.obj", ground);
    let (shares, warning) = shares(&project, "scenes/up.obj");
    assert_eq!(shares, [0.0, 0.0, 100.0]);
    assert!(warning.contains("100 % of the light of the lamps leaves the scene"), "{warning}");
    let (said, _) = virtwall(&project.path("scenes"), "scene flip up.obj -o down.obj");
    assert!(said.starts_with("1 of 2 faces turned over\n"), "{said}");
    assert_eq!(virtwall(&project.path(""), "check scenes/down.obj").1, "");
}

#[test]
fn what_cannot_be_flipped_is_refused() {
    let project = inside_out();
    project.write("dark.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    project.write("made.json", r#"{ "made": { "building_floors": 2 }, "patch_size": "1 m" }"#);
    for (arguments, message) in [
        ("dark.obj -o a.obj", "dark.obj: no polygon emits light; expected a lamp"),
        ("made.json -o a.obj", "made.json: \"made\"; expected a scene of an OBJ file"),
        (
            "box -o scenes/box.obj",
            "scenes/box.obj: the OBJ file of the scene; expected another one",
        ),
        ("box -o a.json", "expected a file name that ends in .obj"),
        ("box -o no/a.obj", "no/a.obj: cannot be written"),
        ("box", "required arguments were not provided"),
    ] {
        let command = &mut Command::new(env!("CARGO_BIN_EXE_virtwall"));
        let arguments: Vec<&str> =
            ["scene", "flip"].into_iter().chain(arguments.split(' ')).collect();
        let output = command.current_dir(project.path("")).args(&arguments).output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert!(
            output.status.code() == Some(2) && stderr.contains(message),
            "{arguments:?}: {stderr}"
        );
        assert!(!project.path("a.obj").exists());
    }
}

/// Both sides of the walls reflect, but the lamp emits what it did.
#[test]
fn two_sided_walls_need_no_flip() {
    let project = inside_out();
    let scene = text(&project, "scenes/box.json");
    let shown = |scene: &str| virtwall(&project.path(""), &format!("scene show {scene}")).0;
    let power =
        |shown: &str| shown.lines().find(|line| line.starts_with("emitted")).map(str::to_owned);
    let one_sided = shown("box");
    project.write(
        "scenes/box.json",
        &scene.replace('{', r#"{ "two_sided": true, "#).replacen(
            r#""cuts": { "two_sided": true, "#,
            r#""cuts": {"#,
            1,
        ),
    );
    assert_eq!(shares(&project, "box"), ([100.0, 0.0, 0.0], String::new()));
    assert!(shown("box").contains("polygons        13, 1 of them lights"));
    assert_eq!(power(&shown("box")), power(&one_sided));
    // What a material says goes before what the scene says.
    let walls = r#"{ "two_sided": true, "materials": { "wall": { "two_sided": false } }, "obj""#;
    project.write("scenes/box.json", &scene.replacen("{ \"obj\"", walls, 1));
    assert_eq!(shares(&project, "box").0, [0.0, 100.0, 0.0]);
}

/// The box of the project with all coordinates multiplied.
fn scaled(factor: f64) -> Project {
    let project = Project::new(SWEEP);
    let line = |line: &str| match line.strip_prefix("v ") {
        Some(numbers) => {
            let numbers =
                numbers.split(' ').map(|n| (n.parse::<f64>().unwrap() * factor).to_string());
            format!("v {}\n", numbers.collect::<Vec<_>>().join(" "))
        }
        None => format!("{line}\n"),
    };
    let obj: String = text(&project, "scenes/box.obj").lines().map(line).collect();
    project.write("scenes/big.obj", &obj);
    project
}

#[test]
fn a_scene_in_another_unit_is_warned_of_and_read() {
    let metres = virtwall(&scaled(1.0).path(""), "scene show box");
    assert_eq!(metres.1, "");
    let of_unit = |project: &Project, unit: &str| {
        let file = text(project, "scenes/box.json")
            .replace("\"box.obj\"", &format!("\"big.obj\", \"unit\": \"{unit}\""));
        project.write("scenes/big.json", &file);
    };
    for (unit, factor) in
        [("mm", 1000.0), ("cm", 100.0), ("in", 1.0 / 0.0254), ("ft", 1.0 / 0.3048), ("km", 0.001)]
    {
        let project = scaled(factor);
        of_unit(&project, unit);
        assert_eq!(virtwall(&project.path(""), "scene show big"), metres, "{unit}");
    }
    let millimetres = scaled(1000.0);
    for command in ["scene show scenes/big.obj", "check scenes/big.obj"] {
        let (_, warning) = virtwall(&millimetres.path(""), command);
        assert!(
            warning.contains("in 4000 x 2000 x 2000 m: lengths are metres")
                && warning.contains("\"unit\": \"mm\""),
            "{warning}"
        );
    }
    // Where the way of the light has a closed form: from a sphere's inside it is 4 V / A on average, but the
    // lamp of the box is small. A hall of 160 m is none of these.
    assert_eq!(virtwall(&scaled(80.0).path(""), "check scenes/big.obj").1, "");
    of_unit(&millimetres, "yd");
    let command = &mut Command::new(env!("CARGO_BIN_EXE_virtwall"));
    let output = command
        .current_dir(millimetres.path(""))
        .args(["check", "scenes/big.json"])
        .output()
        .unwrap();
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(
        output.status.code() == Some(2) && stderr.contains("yd") && stderr.contains("mm"),
        "{stderr}"
    );
}

/// Kilometres of land under a sky are meant, whether the sky is a lamp above it or all around it.
#[test]
fn outdoor_scenes_give_no_warnings() {
    let project = Project::new(SWEEP);
    let corners = "mtllib box.mtl\nv 0 0 0\nv 9000 0 0\nv 9000 9000 0\nv 0 9000 0\nv 0 0 3000\nv 9000 0 3000\n\
                   v 9000 9000 3000\nv 0 9000 3000\nusemtl wall\nf 1 2 3 4\nusemtl lamp\nf 8 7 6 5\n";
    let around = "f 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n";
    for (sky, open) in [("", true), (around, false)] {
        project.write("scenes/land.obj", &format!("{corners}{sky}"));
        let ([_, backs, leaves], warnings) = shares(&project, "scenes/land.obj");
        assert_eq!((warnings.as_str(), backs, leaves > 1.0), ("", 0.0, open));
    }
}

/// No shipped scene is warned of: all that is lost of the first light is lost to the sky.
#[test]
fn no_shipped_scene_is_warned_of() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    for folder in ["scenes", "experiments/stability/scenes"] {
        let command = &mut Command::new(env!("CARGO_BIN_EXE_virtwall"));
        let output = command.current_dir(&root).args(["check", folder]).output().unwrap();
        let stderr = String::from_utf8(output.stderr).unwrap();
        for words in ["of the light of the lamps", "lengths are metres"] {
            assert!(!stderr.contains(words), "{folder}: {stderr}");
        }
    }
}
