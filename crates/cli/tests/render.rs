//! `virtwall render`, from outside.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

#[path = "../../lab/tests/common/mod.rs"]
mod common;

use std::fs;
use std::process::{Command, Output};

use common::{Project, SWEEP};

/// The command's exit code and what it says, in a project.
fn virtwall(project: &Project, arguments: &str) -> (i32, String, String) {
    let command = &mut Command::new(env!("CARGO_BIN_EXE_virtwall"));
    // A space in an argument is written as ~.
    let arguments = arguments.split(' ').map(|argument| argument.replace('~', " "));
    let output = command.current_dir(project.path("")).args(arguments).output();
    let Output { status, stdout, stderr } = output.unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (status.code().unwrap(), text(stdout), text(stderr))
}

/// Runs `render`; returns what it says.
fn render(project: &Project, arguments: &str) -> String {
    let (code, said, stderr) = virtwall(project, &format!("render {arguments}"));
    assert_eq!((code, stderr.as_str()), (0, ""), "{arguments}");
    said
}

fn bytes(project: &Project, name: &str) -> Vec<u8> {
    fs::read(project.path(name)).unwrap()
}

const INSIDE: &str = "--camera inside --size 60x40 --exposure 5";

#[test]
fn a_scene_is_drawn_and_exported() {
    let project = Project::new(SWEEP);
    let said = render(&project, "box -o a.png --gltf a.glb --unshot 50~% --size 60x40");
    let (_, said_of_light) = said.split_once(" % of the light unshot after ").unwrap();
    assert!(said_of_light.contains(" shots; middle grey is "), "{said}");
    assert!(said.ends_with("\n60 x 40 pixels\n"), "{said}");
    assert!(bytes(&project, "a.glb").starts_with(b"glTF\x02\0\0\0"));
    let [smooth, flat, linear] = ["", "--shading flat", "--tone linear"].map(|how| {
        render(
            &project,
            format!("scenes/box.obj -o b.png --unshot 50~% {INSIDE} {how}").trim_end(),
        );
        bytes(&project, "b.png")
    });
    assert!(smooth != flat && smooth != linear);
    // A camera of one's own.
    let own = "--eye 0.2,0.2,1.7 --target 3.8,1.8,1 --field-of-view 60 --up 0,0,1";
    render(&project, &format!("box -o c.png --unshot 50~% {own} --size 60x40"));
    assert!(bytes(&project, "c.png").len() > 500);
}

/// A bare OBJ file has thousands of patches: more shots than those of the lights are needed.
#[test]
fn a_bare_obj_file_is_solved_as_far_as_promised() {
    let project = Project::new(SWEEP);
    let quad = |a: usize| format!("f {a} {} {} {}\n", a + 1, a + 2, a + 3);
    let mut obj = "mtllib room.mtl\no walls\nusemtl white\n".to_owned();
    let faces = [
        "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\n",
        "v 0 0 3\nv 0 4 3\nv 4 4 3\nv 4 0 3\n",
        "v 0 0 0\nv 0 0 3\nv 4 0 3\nv 4 0 0\n",
        "v 4 4 0\nv 4 4 3\nv 0 4 3\nv 0 4 0\n",
        "v 0 4 0\nv 0 4 3\nv 0 0 3\nv 0 0 0\n",
        "v 4 0 0\nv 4 0 3\nv 4 4 3\nv 4 4 0\n",
    ];
    for (number, face) in faces.into_iter().enumerate() {
        obj += &format!("{face}{}", quad(4 * number + 1));
    }
    obj += "o lamp\nusemtl lamp\nv 1 1 2.9\nv 1 3 2.9\nv 3 3 2.9\nv 3 1 2.9\nf 25 26 27 28\n";
    project.write("room.obj", &obj);
    project.write("room.mtl", "newmtl white\nKd 0.4 0.4 0.4\nnewmtl lamp\nKd 0 0 0\nKe 9 9 9\n");
    let (code, said, stderr) = virtwall(&project, "render room.obj --gltf a.glb");
    assert_eq!(code, 0, "{stderr}");
    let line = said.lines().nth(1).unwrap();
    let (left, rest) = line.split_once(" % of the light unshot after ").unwrap();
    let shots: u64 = rest.split(' ').next().unwrap().parse().unwrap();
    assert!(left.parse::<f64>().unwrap() <= 10.0 && shots > 5_000, "{said}");
}

#[test]
fn any_instant_of_a_run_is_drawn() {
    let project = Project::new(SWEEP);
    let (code, ..) = virtwall(&project, "run experiments/x.json");
    assert_eq!(code, 0);
    // A run made again is the same run, whoever asks for it, and nothing comes after its end.
    let pictures = [
        "results/x",
        "results/x --run 6",
        "experiments/x.json --run 6",
        "experiments/x.json --set hemisphere.pixels=256 --set processors=4",
        "results/x --at 1000~s",
    ]
    .map(|what| {
        render(&project, &format!("{what} -o end.png {INSIDE}"));
        bytes(&project, "end.png")
    });
    assert!(pictures.iter().all(|picture| *picture == pictures[0]));
    let said = render(&project, &format!("results/x -o start.png --at 0s {INSIDE}"));
    assert!(said.contains("run 6 at 0.000000 s of "), "{said}");
    assert_ne!(bytes(&project, "start.png"), pictures[0]);

    let said = render(&project, &format!("results/x -o film.png --frames 3 {INSIDE}"));
    assert!(said.contains("the last one is film-003.png\n"), "{said}");
    assert_eq!(bytes(&project, "film-001.png"), bytes(&project, "start.png"));
    assert_eq!(bytes(&project, "film-003.png"), pictures[0]);
    // Every instant has the exposure of the end.
    let auto = INSIDE.replace(" --exposure 5", "");
    render(&project, &format!("results/x -o film.png --frames 2 {auto}"));
    render(&project, &format!("results/x -o start.png --at 0s {auto}"));
    assert_eq!(bytes(&project, "film-001.png"), bytes(&project, "start.png"));
}

#[test]
fn results_whose_files_have_changed_are_not_drawn() {
    let project = Project::new(SWEEP);
    virtwall(&project, "run experiments/x.json");
    let materials = fs::read_to_string(project.path("scenes/box.mtl")).unwrap();
    project.write("scenes/box.mtl", &materials.replace("0.5", "0.6"));
    let (code, _, said) = virtwall(&project, &format!("render results/x -o a.png {INSIDE}"));
    assert_eq!(code, 2, "{said}");
    let place = "results/x/manifest.json: the results were made from another scenes/box.mtl";
    assert!(said.contains(place) && !project.path("a.png").exists(), "{said}");
    render(&project, &format!("experiments/x.json -o a.png {INSIDE}"));
}

/// Paths and names in an experiment start from its file, also where only its results are named; files of
/// the same names in the current folder are others.
#[test]
fn results_are_drawn_from_any_folder() {
    let project = Project::new(SWEEP);
    let experiment = SWEEP.replace("\"box\"", "\"../scenes/box.json\"");
    project.write("experiments/y.json", &experiment);
    let other = Project::new(SWEEP);
    let materials = fs::read_to_string(other.path("scenes/box.mtl")).unwrap();
    other.write("scenes/box.mtl", &materials.replace("0.5", "0.6"));
    for name in ["x", "y"] {
        virtwall(&project, &format!("run experiments/{name}.json"));
        render(&project, &format!("results/{name} -o a.png {INSIDE}"));
        let folder = project.path("results").join(name);
        render(&other, &format!("{} -o a.png {INSIDE}", folder.display()));
        assert_eq!(bytes(&other, "a.png"), bytes(&project, "a.png"));
    }
}

/// A picture that cannot be written is refused before the scene is read, let alone solved.
#[test]
fn a_place_that_cannot_be_written_is_refused_first() {
    let project = Project::new(SWEEP);
    for (arguments, message) in [
        ("nobox -o nowhere/a.png", "nowhere/a.png: cannot be written: its folder does not exist"),
        ("nobox --gltf scenes", "scenes: cannot be written: it is a folder"),
    ] {
        let (code, _, said) = virtwall(&project, &format!("render {arguments}"));
        assert!(code == 2 && said.contains(message), "{said}");
    }
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let project = Project::new(SWEEP);
    for (arguments, message) in [
        ("box", "required arguments were not provided"),
        ("boxes -o a.png", "unknown scene \"boxes\""),
        ("box -o a.png --at 3s", "box: a scene; expected an experiment or results for --at"),
        ("box -o a.png --unshot 10", "without a unit"),
        ("experiments/x.json -o a.png --run 7", "--run: 7; expected a row of runs.csv, 1 to 6"),
        ("experiments/x.json -o a.png --at soon", "expected a time such as"),
        ("experiments/x.json -o a.png --set processors=9", "processors"),
        ("experiments/x.json -o a.png --frames 1", "1 is not in 2..=10000"),
        ("scenes -o a.png", "manifest.json"),
        ("box -o a.png --eye 1,2", "found \"1,2\"; expected three numbers"),
        ("box -o a.png --eye 1,1,1 --target 1,1,1", "eye and target are the same point"),
        ("box -o a.png --size 60", "found \"60\"; expected pixels"),
        ("box -o a.png --size 0x9", "expected pixels, 1 to 8192 either way"),
        ("box -o a.png --exposure 0", "found \"0\"; expected a number above zero"),
        ("box -o a.png --field-of-view 180", "expected degrees, 0.1 to 179"),
        ("box -o nowhere/a.png", "nowhere/a.png"),
    ] {
        let (code, said, stderr) = virtwall(&project, &format!("render {arguments}"));
        assert_eq!((code, said.as_str()), (2, ""), "{arguments}: {stderr}");
        assert!(stderr.contains(message), "{arguments}: {stderr}");
        assert!(!project.path("a.png").exists(), "{arguments}");
    }
}
