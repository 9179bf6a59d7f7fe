//! What holds of the scenes under any seed: sound polygons, nothing coincident, no gap, even lights.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::collections::BTreeMap;
use std::fs;

use radiosity::glam::{DVec2, DVec3};
use radiosity::{Polygon, Scene, load_obj};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use scenemaker::{FLOORS, MOST_TABLES, SceneKind, SceneText, make, make_building, make_rooms};

const SEEDS: [u64; 3] = [1996, 7, u64::MAX];

/// A scene as any program would read it, with nothing to remark on. World coordinates are local
/// ones plus the scene's origin.
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

/// The three scenes under every seed, the lowest building, and one that begins anew above its fifth
/// floor.
fn each(mut check: impl FnMut(SceneKind, u64, &Scene)) {
    for kind in SceneKind::PAPER {
        for seed in SEEDS {
            check(kind, seed, &load(kind, seed));
        }
    }
    // Rooms with other numbers of tables; the seed changes nothing there.
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
        assert_ne!(faces(5), faces(6), "{kind}: the seed must matter");
    }
}

#[test]
fn names_are_read_back() {
    for kind in SceneKind::all() {
        assert_eq!(kind.name().parse(), Ok(kind));
    }
    let unknown = "offices".parse::<SceneKind>().unwrap_err().to_string();
    assert!(unknown.contains("\"offices\"") && unknown.contains("office, rooms, building, "));
}

/// So meshing knows no case but one, and a patch is as large as it looks.
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

/// No two level or upright polygons lie in one plane, face the same way and overlap.
#[test]
fn nothing_coincides() {
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

/// From anywhere under a light every ray ends on some polygon's front: the slow, obvious search.
#[test]
fn no_ray_escapes_or_meets_a_back() {
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

/// The object first hit, and the cosine between its normal and the ray.
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
fn lights_are_alike_and_hang_below_ceilings() {
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

/// Two floors are the fewest that stairs can join; five are the paper's.
#[test]
fn a_building_may_have_other_floors() {
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
    // Walls differ in their windows; the top floor alone has a ceiling over its shafts.
    let ratio = count(20, "f ") as f64 / count(5, "f ") as f64;
    assert!((ratio - 4.0).abs() < 0.1, "{ratio}");
}

/// One thousand lights whatever the walls; each floor has more than the one below; none is cut by
/// the planes that quarter the building's length and halve its width.
#[test]
fn the_buildings_lights_follow_their_rule() {
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
