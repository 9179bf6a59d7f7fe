//! The scenes as committed: what RR-3008, §5.1, says of its three is true of them.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::fs;
use std::path::{Path, PathBuf};

use lab::OpenScene;
use radiosity::{
    Hemisphere, HemisphereKind, LocalEnvironment, PatchSize, Scene, Space, load_obj, solve,
};
use scenemaker::{SceneKind, SceneText, make, make_building};

fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes")
}

fn open(name: &str) -> OpenScene {
    OpenScene::load(scenes().join(format!("{name}.json")).to_str().unwrap()).unwrap()
}

/// A scene in its grid, meshed as its description says, in one environment.
fn meshed(open: &OpenScene) -> (Space, LocalEnvironment) {
    let size = PatchSize { reflector: open.patch_size, emitter: open.emitter_patch_size };
    let space = Space::new(open.scene.clone(), open.cells);
    let environment = LocalEnvironment::new(&space, space.grid.whole(), size);
    (space, environment)
}

fn objects(scene: &Scene, prefix: &str) -> usize {
    scene.objects.iter().filter(|name| name.starts_with(prefix)).count()
}

#[test]
fn committed_scenes_are_the_generators() {
    for kind in SceneKind::all() {
        let made = make(kind, 1996);
        for (extension, text) in [("obj", made.obj), ("mtl", made.mtl)] {
            let path = scenes().join(format!("{kind}.{extension}"));
            assert!(
                fs::read_to_string(&path).unwrap() == text,
                "{} is not made so",
                path.display()
            );
        }
    }
}

/// A scene that is made when it is read is the one that `scene make` writes.
#[test]
fn a_made_scene_is_the_generators() {
    let SceneText { name, obj, mtl } = make_building(10, 1996).unwrap();
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join(format!("{name}.mtl")), mtl).unwrap();
    let path = folder.path().join(format!("{name}.obj"));
    fs::write(&path, obj).unwrap();
    let (written, _) = load_obj(&path).unwrap();
    let made = open("building-10").scene;
    assert!(made.vertices == written.vertices && made.polygons == written.polygons);
    assert!(made.materials == written.materials);
}

#[test]
fn meshes_are_as_large_as_the_papers() {
    for (name, patches) in [("office", 7_440.0), ("rooms", 17_280.0), ("building", 71_545.0)] {
        let (_, environment) = meshed(&open(name));
        let ratio = environment.patches.len() as f64 / patches;
        assert!((ratio - 1.0).abs() <= 0.02, "{name}: {} patches", environment.patches.len());
    }
}

#[test]
fn they_hold_what_the_paper_says() {
    let office = open("office").scene;
    assert!((550..650).contains(&office.polygons.len()), "{}", office.polygons.len());
    assert_eq!(objects(&office, "light"), 2);
    for furniture in ["table", "chair", "shelf"] {
        assert!(objects(&office, furniture) >= 3, "{furniture}");
    }
    let rooms = open("rooms").scene;
    assert_eq!(["room", "table", "light"].map(|name| objects(&rooms, name)), [32, 4 * 32, 32]);
    let building = open("building").scene;
    assert!((8_900..9_400).contains(&building.polygons.len()), "{}", building.polygons.len());
    assert_eq!(objects(&building, "light"), 1_000);
}

/// No gap anywhere: from the lights, and from what they light, nothing escapes.
#[test]
fn they_are_closed() {
    let hemisphere = Hemisphere::new(HemisphereKind::Fibonacci, 4_096, true).unwrap();
    for name in ["office", "rooms", "building", "room4", "corridor", "hole"] {
        let (space, environment) = meshed(&open(name));
        let (light, shots) = solve(&space, &environment, &hemisphere, 0.0, 1_500, |_| ());
        assert_eq!(shots, 1_500);
        assert_eq!(light.escaped.element_sum(), 0.0, "{name}");
    }
}
