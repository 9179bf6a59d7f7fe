//! Valid, unusual and broken OBJ files.

use std::fs;
use std::path::{Path, PathBuf};

use glam::DVec3;
use proptest::prelude::*;
use radiosity::{DEFAULT_REFLECTANCE, Scene, SceneError, WarningKind, Warnings, load_obj};
use tempfile::TempDir;

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

/// Loads an OBJ text, with an MTL text as `a.mtl`.
fn load(obj: impl AsRef<[u8]>, mtl: Option<&str>) -> Result<(Scene, Warnings), SceneError> {
    let folder = TempDir::new().expect("a temporary folder");
    if let Some(mtl) = mtl {
        fs::write(folder.path().join("a.mtl"), mtl).expect("a temporary file");
    }
    let path = folder.path().join("a.obj");
    fs::write(&path, obj).expect("a temporary file");
    load_obj(&path)
}

/// The error message for a broken OBJ text, without the folder.
fn error_message(obj: impl AsRef<[u8]>, mtl: Option<&str>) -> String {
    let message = load(obj, mtl).expect_err("an error").to_string();
    let file = message.rfind("a.obj").or(message.rfind("a.mtl")).expect("a file is named");
    message[file..].to_owned()
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn a_box_loads_exactly() {
    let (scene, warnings) = load_obj(&data("box.obj")).unwrap();
    assert!(warnings.is_empty(), "{warnings:?}");
    assert_eq!(scene.origin, DVec3::new(500_001.0, 4_000_000.5, 10.5));
    assert_eq!(scene.bounds.size(), DVec3::new(2.0, 1.0, 1.0));
    assert_eq!(scene.objects, ["floor", "walls", "lamp", "screen"]);
    assert_eq!(scene.polygons.len(), 8);
    assert_eq!(scene.vertices.len(), 12);

    let floor = &scene.polygons[0];
    assert_eq!(floor.vertices.len(), 4, "a corner on an edge is removed");
    assert_eq!((floor.plane.normal, floor.plane.offset), (DVec3::Z, -0.5));
    assert_eq!(floor.area, 2.0);
    assert_eq!(scene.material(floor).reflectance, DVec3::splat(0.7));

    let lamp = &scene.polygons[5];
    assert_eq!(lamp.plane.normal, DVec3::NEG_Z);
    assert_eq!(scene.emitted_power(), DVec3::new(200.0, 180.0, 160.0));

    let [front, back] = &scene.polygons[6..] else { panic!("a screen has two sides") };
    assert_eq!(front.plane, back.plane.reversed());
    assert!(front.vertices.iter().eq(back.vertices.iter().rev()));
}

#[test]
fn unusual_faces_are_repaired_and_counted() {
    let (scene, warnings) = load_obj(&data("odd.obj")).unwrap();
    let counts: Vec<_> = warnings.iter().map(|w| (w.kind, w.count)).collect();
    let expected = [
        (WarningKind::MissingMaterialFile, 1),
        (WarningKind::MissingMaterial, 9),
        (WarningKind::ZeroArea, 3),
        (WarningKind::NonPlanar, 1),
        (WarningKind::Concave, 2),
        (WarningKind::SelfCrossing, 1),
        (WarningKind::Duplicate, 1),
        (WarningKind::Overlap, 2),
    ];
    assert_eq!(counts, expected);
    let lines: Vec<String> = warnings.iter().map(ToString::to_string).collect();
    assert!(lines[1].contains("line 20 asks for \"nowhere\""), "{}", lines[1]);
    assert_eq!(lines[2], "3 faces without area dropped (first: object \"flat\", face 1)");
    assert!(scene.polygons.iter().all(|p| scene.material(p).reflectance == DEFAULT_REFLECTANCE));

    let area_of = |name: &str| -> f64 {
        let own = |p: &&radiosity::Polygon| scene.objects[p.object as usize] == name;
        scene.polygons.iter().filter(own).map(|p| p.area).sum()
    };
    assert_eq!(area_of("sound"), 1.75, "two sides, one of them without what the chevron covers");
    assert_eq!(area_of("chevron"), 0.25);
    assert!(area_of("warped") > 1.0);
}

#[test]
fn messages_name_file_line_value_and_what_was_expected() {
    let face = |line: &str| error_message(format!("{SQUARE}{line}\n"), None);
    assert_eq!(face("f 1 2 9"), "a.obj:5: vertex \"9\" of a face; expected 1 to 4 here");
    assert_eq!(face("f 1 2 0"), "a.obj:5: vertex \"0\" of a face; expected 1 to 4 here");
    assert_eq!(face("f 1 2 -5"), "a.obj:5: vertex \"-5\" of a face; expected 1 to 4 here");
    assert!(face("f 1 2 /3").starts_with("a.obj:5: \"f 1 2 /3\": face parse error"));
    assert_eq!(
        face("f 1 2 x"),
        "a.obj:5: \"f 1 2 x\": face parse error; expected numbers of vertices: \
         f 1 2 3, or f 1/1/1 2/2/2 3/3/3"
    );
    assert_eq!(
        error_message("v 0 0 0\nv 0 zero 0\n", None),
        "a.obj:2: \"v 0 zero 0\": position parse error; expected three numbers: v X Y Z"
    );
    assert!(error_message("v 0 0\n", None).starts_with("a.obj:1: \"v 0 0\": position"));
    for (word, value) in [("nan", "NaN"), ("inf", "inf"), ("1e400", "inf"), ("2e12", "2e12")] {
        let message = error_message(format!("{SQUARE}v 0 0 {word}\nf 1 2 5\n"), None);
        assert!(message.starts_with("a.obj:5: "), "{message}");
        assert!(message.contains(value) && message.contains("expected finite"), "{message}");
    }
    assert!(error_message("", None).starts_with("a.obj: no surface"));
    assert!(error_message(SQUARE, None).contains("expected at least one"));
    assert!(error_message(format!("{SQUARE}f 1 2 2"), None).contains("1 faces, none with an area"));

    let nowhere = load_obj(Path::new("no/such.obj")).expect_err("there is none").to_string();
    assert!(nowhere.starts_with("no/such.obj: cannot be read: "), "{nowhere}");
}

#[test]
fn impossible_materials_are_rejected() {
    let material = |lines: &str| {
        let obj = format!("mtllib a.mtl\n{SQUARE}usemtl m\nf 1 2 3 4\n");
        error_message(obj, Some(&format!("newmtl m\n{lines}\n")))
    };
    let kd = |value: &str| {
        format!(
            "a.mtl:2: material \"m\": reflectance (Kd) is {value}; \
             expected 0 to 1"
        )
    };
    assert_eq!(material("Kd 0.5 1.01 0.5"), kd("0.5 1.01 0.5"));
    let white = material("Kd 0.5 1 0.5");
    assert!(
        white.contains("every face reflects all light of a colour (Kd 1, first: \"m\")"),
        "{white}"
    );
    assert_eq!(material("Kd -0.1"), kd("-0.1 -0.1 -0.1"));
    assert_eq!(material("Kd nan"), kd("NaN NaN NaN"));
    for line in ["Ke 0 -1 0", "Ke inf 0 0"] {
        assert!(material(line).contains("emission (Ke)"));
    }
    assert_eq!(
        material("Kd 0.5 0.5"),
        "a.mtl:2: Kd is \"0.5 0.5\"; expected numbers: red green blue"
    );
    assert!(material("Ke bright").contains("\"bright\"; expected numbers"));
    assert!(material("virtwall_two_sided yes").contains("expected 0 or 1"));
    assert!(material("newmtl").contains("expected newmtl NAME"));
}

/// Only what a face uses can be wrong.
#[test]
fn materials_that_no_face_uses_may_be_impossible() {
    let mtl = "newmtl m\nKd 0.5\nnewmtl white\nKd 1 1 1\nnewmtl odd\nKd bright\nKe -1 0 0\n\
               virtwall_two_sided yes\nKa 1 1 1\nmap_Kd a.png\nd 0.5\n";
    let obj = |name: &str| format!("mtllib a.mtl\n{SQUARE}usemtl {name}\nf 1 2 3 4\n");
    let (scene, warnings) = load(obj("m"), Some(mtl)).unwrap();
    assert!(warnings.is_empty(), "{warnings:?}");
    assert_eq!(scene.materials.len(), 3);
    assert!(scene.materials.iter().all(|material| material.check().is_ok()));
    let white =
        "a.obj: every face reflects all light of a colour (Kd 1, first: \"white\"); expected";
    assert!(error_message(obj("white"), Some(mtl)).starts_with(white));
    assert!(error_message(obj("odd"), Some(mtl)).starts_with("a.mtl:6: Kd is \"bright\""));
}

/// Powers, and squares of them, stay finite.
#[test]
fn emissions_that_would_overflow_or_vanish_are_rejected() {
    let obj = format!("mtllib a.mtl\n{SQUARE}usemtl m\nf 1 2 3 4\n");
    for (value, shown) in [("1e308", "1e308 1e308 1e308"), ("0 1e31 0", "0 1e31 0")] {
        assert_eq!(
            error_message(&obj, Some(&format!("newmtl m\nKd 0.5\nKe {value}\n"))),
            format!(
                "a.mtl:3: material \"m\": emission (Ke) is {shown}; \
                 expected 0, or 1e-30 to 1e30 W/m²"
            )
        );
    }
    assert!(error_message(&obj, Some("newmtl m\nKe 1e-320\n")).contains("1e-320"));
    assert!(load(&obj, Some("newmtl m\nKd 0.5\nKe 1e30 0 1e-30\n")).is_ok());
}

/// Programs write an empty `usemtl` for "no material", and empty `g`, `o` and `mtllib`.
#[test]
fn empty_names_are_accepted() {
    let obj = format!("mtllib\nmtllib a.mtl\n{SQUARE}usemtl m\no\nf 1 2 3\ng \nusemtl \nf 1 3 4\n");
    let (scene, warnings) = load(obj, Some("newmtl m\nKd 0.25\n")).unwrap();
    assert_eq!(scene.objects, ["unnamed_object"]);
    let grey = |polygon: usize| scene.material(&scene.polygons[polygon]).reflectance.x;
    assert_eq!([grey(0), grey(1)], [0.25, 0.5]);
    let warnings: Vec<String> = warnings.iter().map(ToString::to_string).collect();
    let first = "(first: object \"unnamed_object\")";
    assert_eq!(warnings, [format!("1 face without a material: default grey taken {first}")]);
}

/// A `#` in a name may begin a comment or be part of the name.
#[test]
fn names_lose_their_comments() {
    let mtl = "newmtl wall # white\nKd 0.1\nnewmtl lamp #2\nKd 0.2\nnewmtl lamp #3\nKd 0.3\n\
               newmtl a#b\nKd 0.4\n";
    let used = |name: &str| {
        let obj = format!("mtllib a.mtl # colours\n{SQUARE}o chair #2\nusemtl {name}\nf 1 2 3 4\n");
        let (scene, warnings) = load(obj, Some(mtl)).unwrap();
        assert_eq!(scene.objects, ["chair #2"]);
        warnings.is_empty().then(|| scene.material(&scene.polygons[0]).reflectance.x)
    };
    for (name, reflectance) in [
        ("wall", 0.1),
        ("wall\t# bright", 0.1),
        ("wall #bright", 0.1),
        ("wall # white", 0.1),
        ("lamp #2", 0.2),
        ("lamp #3", 0.3),
        ("lamp #3   # bright", 0.3),
        ("a#b # c", 0.4),
    ] {
        assert_eq!(used(name), Some(reflectance), "{name}");
    }
    assert_eq!(used("floor # x"), None);
    let (scene, _) = load(format!("{SQUARE}o lamp # ceiling\nf 1 2 3 4\n"), None).unwrap();
    assert_eq!(scene.objects, ["lamp"]);
}

/// Names of files on one line: one with spaces, several, some of them missing.
#[test]
fn a_line_names_several_material_files() {
    let folder = TempDir::new().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("my walls.mtl", "newmtl wall\nKd 0.6\n");
    write("lamps.mtl", "newmtl lamp\nKd 0.3\nKe 12\n");
    write("#1.mtl", "newmtl wall\nKd 0.7\nnewmtl lamp\nKd 0.3\nKe 9\n");
    let warned = |names: &str| {
        let faces = "usemtl wall\nf 1 2 3\nusemtl lamp\nf 1 3 4\n";
        write("a.obj", &format!("{SQUARE}{faces}mtllib {names}\n"));
        let (scene, warnings) = load_obj(&folder.path().join("a.obj")).unwrap();
        let warnings: Vec<String> = warnings.iter().map(ToString::to_string).collect();
        let warnings = warnings.join("; ").replace(&format!("{}/", folder.path().display()), "");
        (scene.emitted_power().x, warnings)
    };
    for names in
        ["my walls.mtl lamps.mtl", "lamps.mtl my walls.mtl # both", "lamps.mtl my walls.mtl"]
    {
        assert_eq!(warned(names), (6.0, String::new()), "{names}");
    }
    assert_eq!(warned("#1.mtl"), (4.5, String::new()));
    let (power, warnings) = warned("my walls.mtl gone.mtl lamps.mtl");
    assert_eq!(power, 6.0);
    assert!(warnings.starts_with("1 material file not read (first: gone.mtl: "), "{warnings}");
    let (_, warnings) = warned("no such.mtl");
    assert!(warnings.starts_with("1 material file not read (first: no such.mtl: "), "{warnings}");
    fs::create_dir(folder.path().join("b.mtl")).unwrap();
    for name in ["b.mtl", "/dev/zero"] {
        assert!(warned(name).1.contains(&format!("{name}: not a regular file")), "{name}");
    }
}

/// What is not modelled is said, with what is left of the material.
#[test]
fn textures_and_transparency_give_warnings() {
    let warned = |lines: &str| {
        let obj = format!("mtllib a.mtl\n{SQUARE}usemtl m\nf 1 2 3 4\n");
        let (_, warnings) = load(obj, Some(&format!("newmtl m\n{lines}\n"))).unwrap();
        warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
    };
    assert_eq!(
        warned("Kd 0 0 0\nmap_Kd -s 1 1 1 wood.png"),
        "1 material with a texture (map_Kd), which is not read (first: \"m\", its Kd is 0 0 0)"
    );
    assert_eq!(
        warned("Kd 0.5\nmap_Ke glow.png"),
        "1 material with a texture of emission (map_Ke), which is not read \
         (first: \"m\", its Ke is 0 0 0)"
    );
    let glass = "1 transparent material taken as opaque (first: \"m\", ";
    for statement in ["d 0.3", "Tr 0.7", "Tf 0.9 1 1"] {
        let expected = format!("{glass}{statement}, Kd 0 0 0)");
        assert_eq!(warned(&format!("Kd 0\n{statement}")), expected);
    }
    for opaque in ["d 1", "Tr 0", "Tr 1", "Tf 1 1 1", "Tf 0 0 0", "illum 4", "map_bump a.png"] {
        assert_eq!(warned(&format!("Kd 0\n{opaque}")), "", "{opaque}");
    }
}

#[test]
fn weights_and_colours_of_vertices_are_ignored() {
    let square = |rest: &str| SQUARE.replace('\n', &format!(" {rest}\n")) + "f 1 2 3 4\n";
    let warned = |rest: &str| {
        let (scene, warnings) = load(square(rest), None).unwrap();
        assert_eq!(scene.area(), 1.0, "{rest}");
        warnings.iter().find(|w| w.kind == WarningKind::Weight).map(ToString::to_string)
    };
    let first = "with a fourth coordinate other than 1: ignored (first: line 1, ";
    assert_eq!(warned("0.25"), Some(format!("4 vertices {first}0.25)")));
    assert_eq!(warned("0"), Some(format!("4 vertices {first}0)")));
    for rest in ["", "1", "1.0 # weight", "0.2 0.3 0.4", "1 0.2 0.3 0.4", "0.1 0.2 0.3 0.4"] {
        assert_eq!(warned(rest), None, "{rest}");
    }
    for rest in ["0.5 0.5", "heavy", "1 2 3 4 5"] {
        assert!(error_message(square(rest), None).contains("expected three numbers"), "{rest}");
    }
}

/// Negative numbers count back from the face, positive ones from the start of the file.
#[test]
fn vertices_may_follow_the_faces_that_use_them() {
    let obj = format!("o a\nf 5/x 6 7\no b\n{SQUARE}f -4// -3 -2\nv 0 0 1\nv 2 0 1\nv 0 2 1\n");
    let (scene, _) = load(obj, None).unwrap();
    let areas: Vec<f64> = scene.polygons.iter().map(|polygon| polygon.area).collect();
    assert_eq!((areas, scene.objects), (vec![2.0, 0.5], vec!["a".to_owned(), "b".to_owned()]));
}

#[test]
fn old_encodings_and_vertex_colours_are_accepted() {
    let obj = b"\xef\xbb\xbfo caf\xe9\nv 0 0 0 1 0 0\nv 1 0 0\r\nv 0 1 0 1\nf 1/7/8 2 3\n";
    let (scene, _) = load(obj, None).unwrap();
    assert_eq!(scene.objects, ["caf\u{fffd}"]);
    assert_eq!(scene.area(), 0.5);
}

/// An OBJ file with random edits, mostly broken.
fn mutated() -> impl Strategy<Value = Vec<u8>> {
    let good = fs::read(data("odd.obj")).expect("test data");
    let length = good.len();
    let edit = (0..length, 0..4usize, prop::collection::vec(any::<u8>(), 0..4));
    prop::collection::vec(edit, 0..12).prop_map(move |edits| {
        let mut text = good.clone();
        for (at, gone, new) in edits {
            let at = at.min(text.len());
            let end = (at + gone).min(text.len());
            text.splice(at..end, new);
        }
        text
    })
}

/// Lines of random words of the formats.
fn random_words() -> impl Strategy<Value = String> {
    let words = "v f o g usemtl mtllib newmtl Kd Ke l \\ # a.mtl m 0 1 2 3 4 -1 -2 0.5 1e-9 1e308 \
                 nan 1/2/3 2//1 9223372036854775807 -9223372036854775808";
    let words: Vec<&str> = words.split(' ').collect();
    let line = prop::collection::vec(prop::sample::select(words), 0..7);
    prop::collection::vec(line, 0..30)
        .prop_map(|lines| lines.iter().map(|words| words.join(" ") + "\n").collect())
}

/// Faces over few points, so that corners, edges and planes coincide.
fn coincident() -> impl Strategy<Value = String> {
    let place = prop::array::uniform3(prop::sample::select(vec![0.0, 1e-10, 0.3, 0.5, 1.0]));
    let face = prop::collection::vec(1..13u32, 1..9);
    (prop::collection::vec(place, 12), prop::collection::vec(face, 1..12)).prop_map(
        |(places, faces)| {
            let vertices = places.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n"));
            let faces = faces.iter().map(|face| {
                face.iter().fold("f".to_owned(), |line, v| format!("{line} {v}")) + "\n"
            });
            vertices.chain(faces).collect()
        },
    )
}

/// Checks the properties of a clean scene.
fn assert_clean(scene: &Scene) {
    for polygon in &scene.polygons {
        let corners: Vec<DVec3> = scene.corners(polygon).collect();
        let normal = polygon.plane.normal;
        assert!(corners.len() >= 3 && polygon.area > 0.0);
        assert!((normal.length() - 1.0).abs() < 1e-12);
        let size = scene.bounds.size().length();
        for (i, &corner) in corners.iter().enumerate() {
            assert!((normal.dot(corner) - polygon.plane.offset).abs() <= 1e-6 * size);
            let next = corners[(i + 1) % corners.len()];
            for &other in &corners {
                let inside = (next - corner).cross(other - corner).dot(normal);
                assert!(inside >= -1e-9 * size * size, "{corners:?} is not convex");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, ..ProptestConfig::default() })]

    #[test]
    fn mutations_never_panic(text in mutated()) {
        let _ = load(text, None);
    }

    #[test]
    fn random_words_never_panic(obj in random_words(), mtl in random_words()) {
        let _ = load(obj, Some(&mtl));
    }

    #[test]
    fn random_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let _ = load(&bytes, Some(&String::from_utf8_lossy(&bytes)));
    }

    #[test]
    fn coincident_faces_give_a_clean_scene(text in coincident()) {
        if let Ok((scene, _)) = load(text, None) {
            assert_clean(&scene);
        }
    }
}
