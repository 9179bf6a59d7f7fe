//! Properties of the scenes for any seed: valid polygons, no coincident ones, no gaps, equal
//! lights.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::collections::BTreeMap;
use std::fs;

use radiosity::glam::{DVec2, DVec3};
use radiosity::{Polygon, Scene, load_obj};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use scenemaker::{FLOORS, MOST_TABLES, SceneKind, SceneText, make, make_building, make_rooms};

const SEEDS: [u64; 3] = [1996, 7, u64::MAX];

/// Reads a scene as any program would, without warnings. World coordinates are local coordinates
/// plus the origin of the scene.
fn load(kind: SceneKind, seed: u64) -> Scene {
    read(&make(kind, seed))
}

fn read(SceneText { name, obj, mtl }: &SceneText) -> Scene {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(format!("{name}.obj"));
    fs::write(&path, obj).unwrap();
    fs::write(folder.path().join(format!("{name}.mtl")), mtl).unwrap();
    let (scene, warnings) = load_obj(&path).unwrap();
    assert!(warnings.is_empty(), "{name}: {:?}", warnings.iter().next());
    let faces = obj.lines().filter(|line| line.starts_with("f ")).count();
    assert_eq!(scene.polygons.len(), faces, "{name}");
    scene
}

/// Calls `check` with the three scenes for every seed, with other numbers of tables and floors (the
/// fewest floors, and a number that repeats the sequence of floors), and with small scenes.
fn each(mut check: impl FnMut(SceneKind, u64, &Scene)) {
    for kind in SceneKind::PAPER {
        for seed in SEEDS {
            check(kind, seed, &load(kind, seed));
        }
    }
    // The seed has no effect on rooms.
    for tables in [0, 1, 7, MOST_TABLES] {
        check(SceneKind::Rooms, 1, &read(&make_rooms(tables, 1)));
    }
    for kind in [SceneKind::Room4, SceneKind::Corridor, SceneKind::Hole] {
        check(kind, 1, &load(kind, 1));
    }
    for floors in [2, 7] {
        check(SceneKind::Building, 7, &read(&make_building(floors, 7).unwrap()));
    }
}

fn corners(scene: &Scene, polygon: &Polygon) -> Vec<DVec3> {
    scene.corners(polygon).map(|corner| corner + scene.origin).collect()
}

fn lights(scene: &Scene) -> impl Iterator<Item = &Polygon> {
    scene.polygons.iter().filter(|p| scene.material(p).emission != DVec3::ZERO)
}

fn centre(scene: &Scene, polygon: &Polygon) -> DVec3 {
    corners(scene, polygon).iter().sum::<DVec3>() / polygon.vertices.len() as f64
}

#[test]
fn same_seed_same_bytes() {
    for kind in SceneKind::PAPER {
        assert_eq!(make(kind, 5), make(kind, 5));
    }
    for kind in [SceneKind::Office, SceneKind::Building] {
        let faces = |seed| make(kind, seed).obj.lines().skip(3).collect::<String>();
        assert_ne!(faces(5), faces(6), "{kind}: the seed has no effect");
    }
}

#[test]
fn names_parse_to_their_scenes() {
    for kind in SceneKind::all() {
        assert_eq!(kind.name().parse(), Ok(kind));
    }
    let unknown = "offices".parse::<SceneKind>().unwrap_err().to_string();
    assert!(unknown.contains("\"offices\"") && unknown.contains("office, rooms, building, "));
}

/// Meshing then divides all polygons into equal rectangular patches.
#[test]
fn all_polygons_are_rectangles() {
    each(|kind, seed, scene| {
        for polygon in &scene.polygons {
            let points = corners(scene, polygon);
            assert_eq!(points.len(), 4, "{kind} {seed}");
            for i in 0..4 {
                let [a, b, c] = [0, 1, 2].map(|k| points[(i + k) % 4]);
                let (along, across) = ((b - a).normalize(), (c - b).normalize());
                assert!(along.dot(across).abs() < 1e-9, "{kind} {seed}: {points:?}");
            }
        }
    });
}

/// No two axis-aligned polygons in the same plane that face the same way overlap.
#[test]
fn no_polygons_coincide() {
    each(|kind, seed, scene| {
        let mut planes: BTreeMap<[i64; 4], Vec<[DVec2; 2]>> = BTreeMap::new();
        for polygon in &scene.polygons {
            let normal = polygon.plane.normal;
            let flat = |p: DVec3| match normal.abs().to_array() {
                [1.0, ..] => DVec2::new(p.y, p.z),
                [_, 1.0, _] => DVec2::new(p.x, p.z),
                _ => DVec2::new(p.x, p.y),
            };
            if normal.abs().max_element() < 1.0 {
                continue; // a ramp
            }
            let points: Vec<DVec2> = corners(scene, polygon).into_iter().map(flat).collect();
            let low = points.iter().copied().reduce(DVec2::min).unwrap();
            let high = points.iter().copied().reduce(DVec2::max).unwrap();
            let offset = (polygon.plane.offset * 1e5).round() as i64;
            let [x, y, z] = normal.to_array().map(|n| n as i64);
            planes.entry([x, y, z, offset]).or_default().push([low, high]);
        }
        for (plane, rectangles) in planes {
            for (i, a) in rectangles.iter().enumerate() {
                for b in &rectangles[..i] {
                    let common = a[1].min(b[1]) - a[0].max(b[0]);
                    assert!(common.min_element() < 1e-6, "{kind} {seed} {plane:?}: {a:?} {b:?}");
                }
            }
        }
    });
}

/// Rays from points below lights end at the front of a polygon. All polygons are tested: slow and
/// simple.
#[test]
fn no_ray_escapes_or_hits_a_back() {
    each(|kind, seed, scene| {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let lights: Vec<DVec3> = lights(scene).map(|light| centre(scene, light)).collect();
        for i in 0..3_000 {
            let mut within = |range: f64| rng.random_range(-range..range);
            let away = DVec3::new(within(0.25), within(0.25), -1.1 + within(1.0));
            let from = lights[i % lights.len()] + away;
            let towards = DVec3::new(within(1.0), within(1.0), within(1.0)).normalize();
            let hit = nearest(scene, from, towards);
            let (object, facing) = hit.unwrap_or_else(|| panic!("{kind} {seed}: gap at {from}"));
            assert!(facing < 0.0, "{kind} {seed}: back of {object} from {from} to {towards}");
        }
    });
}

/// The first object hit, and the cosine between its normal and the ray.
fn nearest(scene: &Scene, from: DVec3, towards: DVec3) -> Option<(&str, f64)> {
    let mut best = (f64::INFINITY, None);
    for polygon in &scene.polygons {
        let normal = polygon.plane.normal;
        let mut points = scene.corners(polygon).map(|corner| corner + scene.origin);
        let [a, b, _, d] = [(); 4].map(|()| points.next().unwrap());
        let distance = (a - from).dot(normal) / towards.dot(normal);
        if distance > 0.0 && distance < best.0 {
            let on = from + distance * towards - a;
            let inside =
                |edge: DVec3| (0.0..=1.0).contains(&(on.dot(edge) / edge.length_squared()));
            if inside(b - a) && inside(d - a) {
                best = (distance, Some((polygon.object, towards.dot(normal))));
            }
        }
    }
    best.1.map(|(object, cosine)| (scene.objects[object as usize].as_str(), cosine))
}

#[test]
fn lights_are_equal_and_face_down() {
    each(|kind, seed, scene| {
        let first = lights(scene).next().unwrap();
        for light in lights(scene) {
            assert_eq!(light.plane.normal, DVec3::NEG_Z, "{kind} {seed}");
            assert!((light.area - first.area).abs() < 1e-9, "{kind} {seed}");
            assert_eq!(scene.material(light).emission, scene.material(first).emission);
        }
    });
}

#[test]
fn rooms_are_equal() {
    let scene = load(SceneKind::Rooms, 1996);
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for polygon in &scene.polygons {
        let name = &scene.objects[polygon.object as usize];
        if name.starts_with("room ") {
            *counts.entry(name).or_default() += 1;
        }
    }
    assert_eq!(counts.len(), 32);
    assert!(counts.values().all(|count| Some(count) == counts.values().next()), "{counts:?}");
}

/// Stairs need at least two floors. Five floors are the building of the paper.
#[test]
fn a_building_can_have_other_numbers_of_floors() {
    assert!(make_building(FLOORS.start() - 1, 1).is_none());
    assert!(make_building(FLOORS.end() + 1, 1).is_none());
    let faces = |text: &SceneText| text.obj.lines().skip(3).collect::<String>();
    assert_eq!(faces(&make_building(5, 7).unwrap()), faces(&make(SceneKind::Building, 7)));
    let count = |floors, start| {
        let text = make_building(floors, 7).unwrap();
        assert_eq!(text.name, format!("building-{floors}"));
        text.obj.lines().filter(|line| line.starts_with(start)).count()
    };
    assert_eq!(count(20, "o light"), 4_000);
    // The numbers of windows differ, and only the top floor has ceilings over its shafts.
    let ratio = count(20, "f ") as f64 / count(5, "f ") as f64;
    assert!((ratio - 4.0).abs() < 0.1, "{ratio}");
}

/// There are one thousand lights for any seed. Each floor has more than the one below. No light
/// crosses the planes that quarter the length of the building and halve its width.
#[test]
fn lights_of_the_building_follow_their_rules() {
    for seed in SEEDS {
        let scene = load(SceneKind::Building, seed);
        let mut floors = [0; 5];
        for light in lights(&scene) {
            let points = corners(&scene, light);
            floors[(points[0].z / 3.6) as usize] += 1;
            for (axis, cut) in [(0, 15.0), (0, 30.0), (0, 45.0), (1, 16.0)] {
                let beyond = points.iter().filter(|point| point[axis] > cut).count();
                assert!(beyond == 0 || beyond == 4, "{seed}: {points:?} crosses {cut}");
            }
        }
        assert_eq!(floors.iter().sum::<i32>(), 1_000, "{seed}");
        assert!(floors.is_sorted_by(|below, above| below < above), "{seed}: {floors:?}");
    }
}
