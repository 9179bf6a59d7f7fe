//! Scenes with known form factors and solutions.

#![allow(dead_code, reason = "not every test uses all")]

use std::f64::consts::TAU;

use radiosity::glam::DVec3;
use radiosity::{Face, LocalEnvironment, Material, PatchSize, Rgb, Scene, Space};
use reference::closed_form;

pub fn grey(reflectance: f64, emission: f64) -> Material {
    Material {
        name: format!("{reflectance} {emission}"),
        reflectance: Rgb::splat(reflectance),
        emission: Rgb::splat(emission),
        two_sided: false,
    }
}

pub fn quad(points: [[f64; 3]; 4], object: u32) -> Face {
    Face { points: points.map(DVec3::from).to_vec(), material: 0, object }
}

/// A box of a × b × c seen from inside; floor and ceiling are objects 0 and 1, the walls 2.
pub fn room([a, b, c]: [f64; 3]) -> Vec<Face> {
    let o = 0.0;
    vec![
        quad([[o, o, o], [a, o, o], [a, b, o], [o, b, o]], 0),
        quad([[o, o, c], [o, b, c], [a, b, c], [a, o, c]], 1),
        quad([[o, o, o], [o, o, c], [a, o, c], [a, o, o]], 2),
        quad([[a, o, o], [a, o, c], [a, b, c], [a, b, o]], 2),
        quad([[a, b, o], [a, b, c], [o, b, c], [o, b, o]], 2),
        quad([[o, b, o], [o, b, c], [o, o, c], [o, o, o]], 2),
    ]
}

/// A scene of faces with reflectance 0.5.
pub fn scene(faces: &[Face]) -> Scene {
    let objects = ["floor", "ceiling", "walls", "table"].map(str::to_owned).to_vec();
    Scene::new(faces, vec![grey(0.5, 0.0)], objects).unwrap().0
}

/// A scene as one local environment.
pub fn whole(scene: Scene, size: f64) -> (Space, LocalEnvironment) {
    let space = Space::new(scene, [4, 4, 4]);
    let size = PatchSize { reflector: size, emitter: size };
    let environment = LocalEnvironment::new(&space, space.grid.whole(), size);
    (space, environment)
}

/// Scenes in which the form factor from object 0 to object 1, one polygon each, has a closed form; and its value.
pub fn closed_forms() -> Vec<(&'static str, Vec<Face>, f64)> {
    let floor = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let and = |points: [[f64; 3]; 4]| vec![quad(floor, 0), quad(points, 1)];
    let opposed = |z: f64| and([[0.0, 0.0, z], [0.0, 1.0, z], [1.0, 1.0, z], [1.0, 0.0, z]]);
    let wall = |x: f64| and([[x, 0.0, 0.0], [x, 1.0, 0.0], [x, 1.0, 1.0], [x, 0.0, 1.0]]);
    let (unit, next) = ([0.0, 1.0], [1.0, 2.0]);
    let mut obstructed = opposed(1.0);
    let (o, h) = (0.0, 0.5);
    obstructed.push(quad([[o, o, h], [h, o, h], [h, h, h], [o, h, h]], 2));
    let disc = |z: f64, turn: f64| -> Vec<DVec3> {
        let angle = |i: u32| turn * TAU * f64::from(i) / 256.0;
        (0..256).map(|i| DVec3::new(angle(i).cos(), angle(i).sin(), z)).collect()
    };
    let discs = [(0, disc(0.0, 1.0)), (1, disc(1.0, -1.0))];
    let discs = discs.map(|(object, points)| Face { points, material: 0, object });
    vec![
        ("opposed", opposed(1.0), closed_form::opposed_rectangles(1.0, 1.0, 1.0)),
        ("close", opposed(0.1), closed_form::opposed_rectangles(1.0, 1.0, 0.1)),
        (
            "aside",
            and([[1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [2.0, 1.0, 1.0], [2.0, 0.0, 1.0]]),
            closed_form::parallel_rectangles([unit, unit], [next, unit], 1.0),
        ),
        ("adjacent", wall(0.0), closed_form::adjacent_rectangles(1.0, 1.0, 1.0)),
        ("apart", wall(-1.0), closed_form::perpendicular_rectangles([next, unit], [unit, unit])),
        ("discs", discs.to_vec(), closed_form::coaxial_discs(1.0, 1.0, 1.0)),
        ("obstructed", obstructed, 0.149_868_671_8),
    ]
}
