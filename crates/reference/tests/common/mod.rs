//! Scenes whose answer is known.

#![allow(dead_code, reason = "not every test uses all")]

use radiosity::glam::DVec3;
use radiosity::{Face, LocalEnvironment, Material, PatchSize, Rgb, Scene, Space};

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

/// Faces of half-grey surfaces.
pub fn scene(faces: &[Face]) -> Scene {
    let objects = ["floor", "ceiling", "walls", "table"].map(str::to_owned).to_vec();
    Scene::new(faces, vec![grey(0.5, 0.0)], objects).unwrap().0
}

/// A scene as one environment.
pub fn whole(scene: Scene, size: f64) -> (Space, LocalEnvironment) {
    let space = Space::new(scene, [4, 4, 4]);
    let size = PatchSize { reflector: size, emitter: size };
    let environment = LocalEnvironment::new(&space, space.grid.whole(), size);
    (space, environment)
}
