//! One language of commands: the same picture, the same names of arguments, whatever the command.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

#[path = "../../lab/tests/common/mod.rs"]
mod common;

use std::fs;
use std::process::{Command, Output};

use common::{Project, SWEEP};

/// The exit code and what is said, in a project. A space in an argument is written as ~.
fn virtwall(project: &Project, arguments: &str) -> (i32, String, String) {
    let command = &mut Command::new(env!("CARGO_BIN_EXE_virtwall"));
    let arguments = arguments.split(' ').map(|argument| argument.replace('~', " "));
    let Output { status, stdout, stderr } =
        command.current_dir(project.path("")).args(arguments).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (status.code().unwrap(), text(stdout), text(stderr))
}

fn works(project: &Project, arguments: &str) -> String {
    let (code, stdout, stderr) = virtwall(project, arguments);
    assert_eq!((code, stderr.as_str()), (0, ""), "{arguments}");
    stdout
}

#[test]
fn render_and_scene_show_draw_the_same_picture() {
    let project = Project::new(SWEEP);
    project.write("scenes/lying.json", r#"{ "obj": "box.obj", "patch_size": "0.5 m", "up": "y" }"#);
    for scene in ["box", "scenes/box.obj", "scenes/lying.json"] {
        for look in [
            "",
            " --size 90x60 --camera inside --shading flat",
            " --size 90x60 --up y --cut-above 1.5 --exposure 3 --tone linear",
        ] {
            let pictures = ["render", "scene show"].map(|command| {
                works(&project, &format!("{command} {scene} -o a.png{look}"));
                let picture = fs::read(project.path("a.png")).unwrap();
                fs::remove_file(project.path("a.png")).unwrap();
                picture
            });
            assert!(pictures[0] == pictures[1], "{scene}{look}");
        }
    }
    let axes = ["y", "0,2,0", "-y", "0,-1,0"].map(|up| {
        works(&project, &format!("scene show box -o a.png --emitted --size 90x60 --up {up}"));
        fs::read(project.path("a.png")).unwrap()
    });
    assert!(axes[0] == axes[1] && axes[2] == axes[3] && axes[0] != axes[2]);
    let (code, _, stderr) = virtwall(&project, "render box -o a.png --up w");
    assert!(
        code == 2 && stderr.contains("expected an axis, such as y or -z, or three"),
        "{stderr}"
    );
}

/// Every command that writes files is told where by -o or --output; older names are understood, not shown.
#[test]
fn output_has_one_name() {
    let project = Project::new(SWEEP);
    for (command, old) in [
        ("run", "--out"),
        ("render", "--png"),
        ("scene make", "--out"),
        ("scene show", "--png"),
        ("scene flip", "--out"),
        ("machine bench", "--out"),
        ("machine replay", "--out"),
        ("formfactors", "--out"),
        ("reference", "--out"),
        ("stability", "--out"),
        ("export", "[FOLDER]"),
        ("man", "[FOLDER]"),
    ] {
        let help = works(&project, &format!("{command} --help"));
        assert!(help.contains("-o, --output <"), "{command}: {help}");
        assert!(
            !help.contains(&format!("{old} ")) && !help.contains(&format!("{old}\n")),
            "{command}: {help}"
        );
    }
    let trace = r#"[{ "id": 1, "at": "0 s", "from": 0, "to": 1, "bytes": 8 }]"#;
    project.write("t.json", trace);
    for (command, outputs, written) in [
        ("run experiments/x.json --viewer none", ["-o", "--output", "--out"], "runs.csv"),
        ("scene make room4", ["-o", "--output", "--out"], "room4.obj"),
        ("export ultra1", ["-o", "--output", ""], "machines/ultra1.json"),
        ("man", ["-o", "--output", ""], "virtwall.1"),
    ] {
        for (number, output) in outputs.iter().enumerate() {
            let folder = format!("{}-{number}", command.split(' ').next().unwrap());
            works(&project, &format!("{command} {output} {folder}").replace("  ", " "));
            assert!(project.path(&folder).join(written).exists(), "{command} {output}");
        }
    }
    for (command, outputs, written) in [
        ("scene show box --size 60x40", ["-o", "--output", "--png"], "a.png"),
        ("machine replay t.json", ["-o", "--output", "--out"], "a.csv"),
        ("formfactors box --method rays --rays 64", ["-o", "--output", ""], "b.csv"),
        ("reference box --method paths --paths 64", ["-o", "--output", ""], "a.json"),
    ] {
        for output in outputs.iter().filter(|output| !output.is_empty()) {
            works(&project, &format!("{command} {output} {written}"));
            fs::remove_file(project.path(written)).unwrap();
        }
    }
}

#[test]
fn a_time_after_the_end_is_said_to_be_the_end() {
    let project = Project::new(SWEEP);
    let draw =
        |at: &str| works(&project, &format!("render experiments/x.json -o a.png --size 60x40{at}"));
    let end = draw("");
    let line = end.lines().nth(1).unwrap();
    let seconds = line.split(' ').nth(3).unwrap();
    let after = draw(" --at 1000~s");
    let expected = format!("run 6 at its end, {seconds} s, since --at 1000.000000 s is later; ");
    assert!(after.contains(&expected), "{after}");
    assert!(!draw(" --at 0s").contains("its end"));
}

#[test]
fn check_reads_folders_patterns_and_material_files() {
    let project = Project::new(SWEEP);
    project.write("scenes/schemas/scene.json", "{");
    project.write("scenes/other.json", r#"{ "type": "object" }"#);
    project.write("scenes/readme.md", "text");
    let scenes = "scenes/box.json: a scene, 7 polygons\nscenes/box.mtl: an MTL file, 2 materials\n\
                  scenes/box.obj: an OBJ file, 7 polygons\n";
    for arguments in ["scenes", "scenes/", "scenes/b*.*", "s*s/b?x.*", "./scenes", "scenes/box.*"] {
        let said = works(&project, &format!("check {arguments}"));
        assert_eq!(said.replace("./", "").replace("//", "/"), scenes, "{arguments}");
    }
    assert!(
        works(&project, "check machines experiments/*.json")
            .contains("experiments/x.json: an experiment")
    );
    project.write("one.mtl", "newmtl a\nKd 0.5\n");
    assert_eq!(works(&project, "check one.mtl"), "one.mtl: an MTL file, 1 material\n");
    project.write("bad.mtl", "newmtl a\nKd 2 2 2\n");
    project.write("empty/readme.md", "text");
    for (arguments, message) in [
        ("bad.mtl", "bad.mtl:2: "),
        ("nothing*.json", "nothing*.json: no file has such a name"),
        ("empty", "empty: a folder without files to check"),
        ("scenes/other.json", "scenes/other.json: neither an experiment"),
        ("gone.json", "gone.json"),
    ] {
        let (code, _, stderr) = virtwall(&project, &format!("check {arguments}"));
        assert!(code == 2 && stderr.contains(message), "{arguments}: {stderr}");
    }
}

/// On a terminal, which `script` of util-linux makes, long renders show how far they are.
#[test]
fn renders_show_progress_on_a_terminal() {
    let project = Project::new(SWEEP);
    let program = env!("CARGO_BIN_EXE_virtwall");
    for (arguments, expected) in [
        ("scenes/box.obj --size 60x40 --unshot 1%", "% of the light"),
        ("experiments/x.json --size 60x40", " shots, "),
        ("experiments/x.json --size 600x400 --frames 9", " of 9 pictures"),
    ] {
        let command = format!("{program} render {arguments} -o a.png");
        let script = Command::new("script")
            .current_dir(project.path(""))
            .args(["-qec", &command, "/dev/null"])
            .output();
        let Ok(output) = script else {
            println!("script is missing: progress is not tested");
            return;
        };
        let shown = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success() && shown.contains(expected), "{arguments}: {shown}");
    }
}
