//! Scenes that people have: what descriptions change, which files are found, what is warned of.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use common::Project;
use lab::{Checked, OpenScene, Solved, check};
use radiosity::Rgb;
use radiosity::glam::DVec3;

/// The box of the project with this text of its description after "patch_size".
fn described(fields: &str) -> (Project, Result<OpenScene, String>) {
    let project = Project::new("{}");
    let file = format!("{{ \"obj\": \"box.obj\",\n\"patch_size\": \"1 m\"{fields} }}");
    project.write("scenes/box.json", &file);
    let opened = open(&project, "scenes/box.json");
    (project, opened)
}

fn open(project: &Project, name: &str) -> Result<OpenScene, String> {
    OpenScene::load(&project.path(name).display().to_string())
        .map_err(|fault| fault.to_string().replace(&project.path("").display().to_string(), ""))
}

/// Materials of a lamp and of a wall.
const MATERIALS: &str = "newmtl wall\nKd 0.5 0.5 0.5\nnewmtl lamp\nKd 0 0 0\nKe 100 90 80\n";

#[test]
fn a_description_changes_materials_and_objects() {
    let (_, scene) = described(r#", "materials": {"lamp": {"Ke": [1, 2, 3], "two_sided": true}}"#);
    let scene = scene.unwrap().scene;
    assert_eq!(scene.polygons.len(), 8);
    assert!(scene.emitted_power().distance(Rgb::new(1.0, 2.0, 3.0) * 0.08) < 1e-12);

    let (project, _) = described("");
    project.write("scenes/box.obj", &two_objects());
    let file =
        r#"{"obj": "box.obj", "patch_size": "1 m", "objects": {"floor": {"Kd": [0.1, 0.2, 0.3]}}}"#;
    project.write("scenes/box.json", file);
    let scene = open(&project, "scenes/box.json").unwrap().scene;
    let [floor, rest] = [0, 1].map(|polygon| scene.material(&scene.polygons[polygon]));
    assert_eq!((floor.name.as_str(), floor.reflectance), ("wall", Rgb::new(0.1, 0.2, 0.3)));
    assert_eq!(rest.reflectance, Rgb::splat(0.5), "another object keeps the material");
}

fn two_objects() -> String {
    "mtllib box.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nusemtl wall\n\
     o floor\nf 1 2 3 4\no wall\nf 1 5 6 2\nusemtl lamp\nf 8 7 6 5\n"
        .to_owned()
}

/// White walls are taken as they are, unless nothing else absorbs light.
#[test]
fn white_walls_are_taken_clamped_or_replaced() {
    let scene = |fields: &str| {
        let (project, _) = described(fields);
        project.write("scenes/box.mtl", &MATERIALS.replace("0.5 0.5 0.5", "1 1.0 0.95"));
        open(&project, "scenes/box.json")
    };
    let white = scene("").unwrap().scene;
    assert_eq!(white.material(&white.polygons[0]).reflectance, Rgb::new(1.0, 1.0, 0.95));
    let refused = scene(r#", "materials": {"lamp": {"Kd": [0, 1, 0]}}"#).err().unwrap();
    let expected = "every face reflects all light of a colour (Kd 1, first: \"wall\"); expected some \
                    that absorb; \"clamp_reflectance\" in a scene file lowers reflectances";
    assert!(refused.ends_with(expected), "{refused}");
    let clamped = scene(r#", "clamp_reflectance": 0.9"#).unwrap();
    let warning = "scenes/box.obj: 1 material with a clamped reflectance \
                   (first: \"wall\", Kd 1 1 0.95 taken as 0.9 0.9 0.9)";
    assert!(clamped.warnings.len() == 1 && clamped.warnings[0].ends_with(warning));
    let polygon = &clamped.scene.polygons[0];
    assert_eq!(clamped.scene.material(polygon).reflectance, Rgb::splat(0.9));
    let replaced = scene(r#", "materials": {"wall": {"Kd": [0.7, 0.7, 0.7]}}"#).unwrap();
    assert_eq!(replaced.warnings, Vec::<String>::new());
}

#[test]
fn descriptions_are_refused_with_place_and_value() {
    for (fields, expected) in [
        (
            r#"\n"materials": {"lampe": {"Ke": [1, 1, 1]}}"#,
            "scenes/box.json:3: materials.lampe: unknown material \"lampe\", did you mean \"lamp\"? \
             (there are: wall, lamp)",
        ),
        (
            r#"\n"objects": {"shell": {"Ke": [1, 1, 1]}}"#,
            "scenes/box.json:3: objects.shell: unknown object \"shell\" (there are: unnamed_object)",
        ),
        (
            r#"\n"materials": {"wall": {"Kd": [2, 0, 0]}}"#,
            "scenes/box.json:3: materials.wall.Kd: material \"wall\": reflectance (Kd) is 2 0 0; \
             expected 0 to 1",
        ),
        (
            r#"\n"objects": {"unnamed_object": {"Ke": [1e300, 0, 0]}}"#,
            "scenes/box.json:3: objects.unnamed_object.Ke: material \"unnamed_object\": emission (Ke) \
             is 1e300 0 0; expected 0, or 1e-30 to 1e30 W/m²",
        ),
        (
            r#"\n"clamp_reflectance": 1"#,
            "scenes/box.json:3: clamp_reflectance: 1; expected 0 or more and less than 1",
        ),
        (
            r#"\n"up": "above""#,
            "scenes/box.json:3: up: unknown value \"above\" (there are: x, -x, y, -y, z, -z)",
        ),
    ] {
        let (_, opened) = described(&format!(", {fields}").replace("\\n", "\n"));
        assert_eq!(opened.err().as_deref(), Some(expected));
    }
}

#[test]
fn a_description_says_what_is_up() {
    let up = |fields: &str| described(fields).1.unwrap().scene.up;
    assert_eq!(up(""), DVec3::Z);
    assert_eq!(up(r#", "up": "y""#), DVec3::Y);
    assert_eq!(up(r#", "up": "-x""#), DVec3::NEG_X);
}

/// Endings are compared without regard to case, and a file that exists is found.
#[test]
fn files_are_found_whatever_the_case_of_their_endings() {
    let project = Project::new(
        r#"{"title": "t", "scene": "../scenes/BOX.OBJ", "processors": 1, "local_environments": 1}"#,
    );
    let text = |name: &str| std::fs::read_to_string(project.path(name)).unwrap();
    for (from, to) in [("box.obj", "BOX.OBJ"), ("box.obj", "box.Obj"), ("box.json", "box.JSON")] {
        project.write(&format!("scenes/{to}"), &text(&format!("scenes/{from}")));
        let opened = open(&project, &format!("scenes/{to}")).unwrap();
        assert_eq!(opened.scene.polygons.len(), 7, "{to}");
        assert!(check(&project.path(&format!("scenes/{to}"))).is_ok(), "{to}");
    }
    assert!(check(&project.path("experiments/x.json")).is_ok());
}

fn warning(project: &Project) -> Option<String> {
    let Checked { warnings, .. } = check(&project.path("scenes/box.json")).unwrap();
    assert!(warnings.len() <= 1, "{warnings:?}");
    warnings.first().map(|warning| warning[warning.find("box.obj: ").unwrap() + 9..].to_owned())
}

#[test]
fn dark_scenes_are_warned_of() {
    let project = Project::new("{}");
    assert_eq!(warning(&project), None);
    let dark = "no polygon emits light, so that all is dark";
    let what_to_do = "give a material Ke in its MTL file, or in a scene file";
    project.write("scenes/box.mtl", "newmtl wall\nKd 0.5\nnewmtl lamp\nKd 0.5\nKa 1 1 1\n");
    assert_eq!(warning(&project), Some(format!("{dark}: {what_to_do}")));
    project.write("scenes/box.mtl", "newmtl wall\nKd 0.5\nnewmtl lamp\nKd 0.5\nKa 15 15 9\n");
    let meant = " (Ka is above 1 in \"lamp\", perhaps meant as lamps)";
    assert_eq!(warning(&project), Some(format!("{dark}{meant}: {what_to_do}")));
}

#[test]
fn scenes_that_are_inside_out_are_warned_of() {
    let inside_out = |lines: &str| {
        let project = Project::new("{}");
        let text = std::fs::read_to_string(project.path("scenes/box.obj")).unwrap();
        let turned = text
            .replace("f 1 2 3 4\n", "f 4 3 2 1\n")
            .replace("f 8 7 6 5\n", "f 5 6 7 8\n")
            .replace("f 1 5 6 2\n", "f 2 6 5 1\n")
            .replace("f 2 6 7 3\n", "f 3 7 6 2\n")
            .replace("f 3 7 8 4\n", "f 4 8 7 3\n")
            .replace("f 4 8 5 1\n", "f 1 5 8 4\n");
        project.write("scenes/box.obj", &(turned + lines));
        project
    };
    let warned = warning(&inside_out("")).unwrap();
    let expected = "100 % of the light of the lamps falls on backs, which absorb all light (6 of 7 polygons face out \
                    of the scene and have no patches): fronts";
    assert!(warned.starts_with(expected), "{warned}");
    // A table under the lamp, which shows its front, does not hide it.
    let table =
        "v 0.9 0.9 0.5\nv 1.4 0.9 0.5\nv 1.4 1.4 0.5\nv 0.9 1.4 0.5\nusemtl wall\nf 13 14 15 16\n";
    assert!(warning(&inside_out(table)).unwrap().contains("6 of 8 polygons face out"));
    // Both sides of the walls are fronts.
    let project = inside_out("");
    project.write(
        "scenes/box.mtl",
        &MATERIALS.replace("\nnewmtl lamp", "\nvirtwall_two_sided 1\nnewmtl lamp"),
    );
    assert_eq!(warning(&project), None);
}

#[test]
fn a_solution_that_stops_early_names_what_helps() {
    let solved = |left| Solved { light: Vec::new(), left, shots: 100_000 };
    assert_eq!(solved(0.1).warning(0.1), None);
    let warning = solved(0.696).warning(0.1).unwrap();
    assert!(warning.starts_with("69.6 % of the light is unshot after 100000 shots"), "{warning}");
    assert!(warning.contains("\"patch_size\", \"clamp_reflectance\" of a scene file"), "{warning}");
}
