//! Scenes and problems that tests share.

#![allow(dead_code, reason = "each test file uses some of these")]

use std::sync::Arc;

use desim::Duration;
use multicomputer::Machine;
use radiosity::glam::DVec3;
use radiosity::{Face, Hemisphere, HemisphereKind, Material, PatchSize, Rgb, Scene};
use virtwall::{
    Mapping, Order, Outcome, Problem, ProblemOptions, Rules, Selection, Shooting, Ties,
};

/// A material that reflects `reflectance` and emits `emission` in all colours.
pub fn grey(reflectance: f64, emission: f64) -> Material {
    Material {
        name: format!("grey {reflectance} {emission}"),
        reflectance: Rgb::splat(reflectance),
        emission: Rgb::splat(emission),
        two_sided: false,
    }
}

pub fn face(points: &[[f64; 3]], material: u32) -> Face {
    Face { points: points.iter().map(|&p| DVec3::from(p)).collect(), material, object: 0 }
}

/// The six sides of a box, seen from inside (`inwards`) or from outside; material by side: floor,
/// ceiling, then the walls at low y, high x, high y, low x.
pub fn sides(low: [f64; 3], high: [f64; 3], materials: [u32; 6], inwards: bool) -> Vec<Face> {
    let [a, b, c] = low;
    let [x, y, z] = high;
    let quads = [
        [[a, b, c], [x, b, c], [x, y, c], [a, y, c]],
        [[a, b, z], [a, y, z], [x, y, z], [x, b, z]],
        [[a, b, c], [a, b, z], [x, b, z], [x, b, c]],
        [[x, b, c], [x, b, z], [x, y, z], [x, y, c]],
        [[x, y, c], [x, y, z], [a, y, z], [a, y, c]],
        [[a, y, c], [a, y, z], [a, b, z], [a, b, c]],
    ];
    let oriented = |mut quad: [[f64; 3]; 4]| {
        if !inwards {
            quad.reverse();
        }
        quad
    };
    quads.into_iter().zip(materials).map(|(quad, m)| face(&oriented(quad), m)).collect()
}

pub fn scene(faces: &[Face], materials: Vec<Material>) -> Scene {
    Scene::new(faces, materials, vec!["object".to_owned()]).unwrap().0
}

/// Two rooms of 4 × 3 × 3 m joined by a door, a lamp in one, a box in the other.
pub fn two_rooms() -> Scene {
    let mut faces = sides([0.0; 3], [8.0, 3.0, 3.0], [0; 6], true);
    let wall = |x: f64, front: bool| {
        let panels = [
            [[x, 0.0, 0.0], [x, 1.0, 0.0], [x, 1.0, 3.0], [x, 0.0, 3.0]],
            [[x, 2.0, 0.0], [x, 3.0, 0.0], [x, 3.0, 3.0], [x, 2.0, 3.0]],
            [[x, 1.0, 2.0], [x, 2.0, 2.0], [x, 2.0, 3.0], [x, 1.0, 3.0]],
        ];
        panels.map(|mut quad| {
            if !front {
                quad.reverse();
            }
            face(&quad, 1)
        })
    };
    faces.extend(wall(4.0, true));
    faces.extend(wall(3.9, false));
    faces.extend(sides([5.0, 1.0, 0.0], [6.0, 2.0, 1.0], [1; 6], false));
    let lamp = [[1.5, 1.0, 2.9], [1.5, 2.0, 2.9], [2.5, 2.0, 2.9], [2.5, 1.0, 2.9]];
    faces.push(face(&lamp, 2));
    scene(&faces, vec![grey(0.5, 0.0), grey(0.3, 0.0), grey(0.0, 100.0)])
}

pub fn options(cells: [u32; 3], cut: [u32; 3], pixels: u32, size: f64) -> ProblemOptions {
    ProblemOptions {
        patch_size: PatchSize { reflector: size, emitter: size },
        cells,
        cut,
        hemisphere: Hemisphere::new(HemisphereKind::Fibonacci, pixels, true).unwrap(),
    }
}

pub fn problem(scene: Scene, cells: [u32; 3], cut: [u32; 3], pixels: u32, size: f64) -> Problem {
    Problem::new(scene, options(cells, cut, pixels, size)).unwrap()
}

pub fn paragon() -> Machine {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../machines/paragon-xps.json");
    Machine::from_json(&std::fs::read_to_string(path).unwrap(), path).unwrap()
}

pub fn rules() -> Rules {
    Rules {
        selection: Selection::Energy,
        ties: Ties::ReceivedFirst,
        order: Order::Best,
        patch_threshold: 0.002,
        wall_threshold: 1e-4,
        energy_threshold: 0.0,
        shots_without_progress: None,
        collect_every: Duration::from_seconds_f64(1.0),
        radiosity_updates: true,
        merge_masks: false,
        mapping: Mapping::Blocks,
        seed: 0,
        shooting: Shooting::default(),
    }
}

/// The two rooms, cut.
pub fn two_rooms_cut(cut: [u32; 3]) -> Arc<Problem> {
    Arc::new(problem(two_rooms(), [8, 4, 4], cut, 1_024, 0.5))
}

/// Two outcomes are the same to the bit.
pub fn same(one: &Outcome, other: &Outcome) {
    assert_eq!(one.time, other.time);
    assert_eq!(one.counts, other.counts);
    assert_eq!(one.energy, other.energy);
    assert_eq!(one.ending, other.ending);
    assert_eq!(one.work, other.work);
    assert_eq!(one.nodes, other.nodes);
    assert_eq!(one.display, other.display);
    assert_eq!(one.radiosity, other.radiosity);
}
