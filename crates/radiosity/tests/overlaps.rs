//! Faces of one plane that overlap: the answer does not depend on their order.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use radiosity::glam::DVec3;
use radiosity::{Face, Material, Polygon, Rgb, Scene, WarningKind, Warnings};

/// White, a lamp, and black.
fn materials() -> Vec<Material> {
    let material = |name: &str, reflectance, emission| Material {
        name: name.to_owned(),
        reflectance: Rgb::splat(reflectance),
        emission: Rgb::splat(emission),
        two_sided: false,
    };
    vec![material("white", 0.8, 0.0), material("lamp", 0.0, 9.0), material("black", 0.1, 0.0)]
}

/// A rectangle in a slanted or a level plane, seen from below.
fn face(slope: f64, [x0, x1]: [f64; 2], [y0, y1]: [f64; 2], material: u32) -> Face {
    let corners = [[x0, y0], [x0, y1], [x1, y1], [x1, y0]];
    let points = corners.map(|[x, y]| DVec3::new(x, y, 3.0 + slope * x)).to_vec();
    Face { points, material, object: material }
}

fn scene(faces: &[Face]) -> (Scene, Warnings) {
    let objects = ["ceiling", "lamp", "sign"].map(str::to_owned).to_vec();
    Scene::new(faces, materials(), objects).unwrap()
}

/// The material of the polygon with the lowest number at a point: what is seen there.
fn seen(scene: &Scene, x: f64, y: f64) -> String {
    let at = DVec3::new(x, y, 0.0) - scene.origin;
    let inside = |polygon: &&Polygon| {
        let corners: Vec<DVec3> = scene.corners(polygon).collect();
        let next = corners.iter().cycle().skip(1);
        corners
            .iter()
            .zip(next)
            .all(|(a, b)| (*b - *a).truncate().perp_dot((at - *a).truncate()) < 0.0)
    };
    scene.material(scene.polygons.iter().find(inside).unwrap()).name.clone()
}

#[test]
fn a_lamp_in_a_ceiling_is_seen_whatever_the_order_of_faces() {
    for slope in [0.0, 0.37] {
        let faces = [
            face(slope, [0.0, 4.0], [0.0, 4.0], 0),
            face(slope, [1.0, 2.0], [1.0, 2.0], 1),
            face(slope, [1.5, 3.0], [1.5, 3.0], 2),
        ];
        for order in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
            let (scene, warnings) = scene(&order.map(|i| faces[i].clone()));
            let seen = |x, y| seen(&scene, x, y);
            assert_eq!(seen(1.2, 1.2), "lamp", "{order:?}");
            assert_eq!(seen(1.7, 1.7), "lamp", "where three overlap, {order:?}");
            assert_eq!(seen(2.5, 2.5), "black", "the smaller one, {order:?}");
            assert_eq!(seen(3.5, 0.5), "white");
            let found = warnings.iter().find(|w| w.kind == WarningKind::Overlap).unwrap();
            let area = (1.0 + 2.25 + 0.25) * f64::hypot(1.0, slope);
            assert!(found.count == 3 && (found.area - area).abs() < 1e-9, "{found:?}");
        }
    }
}

#[test]
fn the_warning_names_both_objects_and_the_area() {
    let faces = [face(0.0, [0.0, 4.0], [0.0, 4.0], 0), face(0.0, [1.0, 1.5], [1.0, 2.0], 1)];
    let (_, warnings) = scene(&faces);
    let text = warnings.iter().map(ToString::to_string).collect::<String>();
    assert!(text.starts_with("1 overlap of faces in one plane, 0.5000 m² in all"), "{text}");
    assert!(text.ends_with("(first: \"lamp\" over \"ceiling\")"), "{text}");
}

#[test]
fn of_two_faces_with_the_same_corners_the_lamp_is_kept() {
    let same = [0, 1].map(|material| face(0.0, [0.0, 1.0], [0.0, 1.0], material));
    for faces in [same.clone(), [same[1].clone(), same[0].clone()]] {
        let (scene, warnings) = scene(&faces);
        assert_eq!(warnings.count(WarningKind::Duplicate), 1);
        assert_eq!(scene.material(&scene.polygons[0]).name, "lamp");
    }
}

#[test]
fn neighbours_and_faces_back_to_back_do_not_overlap() {
    let mut back = face(0.0, [0.0, 1.0], [0.0, 1.0], 0);
    back.points.reverse();
    let faces = [
        face(0.0, [0.0, 1.0], [0.0, 1.0], 0),
        face(0.0, [1.0, 2.0], [0.0, 1.0], 0),
        face(0.0, [0.0, 1.0], [1.0, 2.0], 1),
        back,
    ];
    assert!(scene(&faces).1.is_empty());
    let numbers: Vec<u32> = scene(&faces).0.polygons.iter().map(|p| p.object).collect();
    assert_eq!(numbers, [0, 0, 1, 0], "other polygons keep their places");
}
