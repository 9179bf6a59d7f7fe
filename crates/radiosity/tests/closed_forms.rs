//! Scenes with known solutions.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use radiosity::glam::DVec3;
use radiosity::{
    Emitter, Face, Hemisphere, HemisphereKind, LocalEnvironment, Mask, Material, PatchSize, Rgb,
    Scene, Space, shoot, solve,
};

fn grey(reflectance: f64, emission: f64) -> Material {
    let (reflectance, emission) = (Rgb::splat(reflectance), Rgb::splat(emission));
    Material { reflectance, emission, ..Material::default() }
}

fn quad(points: [[f64; 3]; 4], object: u32) -> Face {
    Face { points: points.map(DVec3::from).to_vec(), material: 0, object }
}

/// A box of a × b × c seen from inside. Floor, ceiling and walls are objects 0, 1 and 2.
fn room([a, b, c]: [f64; 3]) -> Vec<Face> {
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

fn space(faces: &[Face], material: Material) -> Space {
    let objects = ["floor", "ceiling", "walls"].map(str::to_owned).to_vec();
    Space::new(Scene::new(faces, vec![material], objects).unwrap().0, [4, 4, 4])
}

fn fibonacci(pixels: u32) -> Hemisphere {
    Hemisphere::new(HemisphereKind::Fibonacci, pixels, true).unwrap()
}

fn whole(space: &Space, size: f64) -> LocalEnvironment {
    LocalEnvironment::new(space, space.grid.whole(), PatchSize { reflector: size, emitter: size })
}

/// Form factor between two objects, by rays from the centres of the patches of the first.
fn form_factor(space: &Space, from: u32, to: u32, size: f64, pixels: u32) -> f64 {
    let environment = whole(space, size);
    let hemisphere = fibonacci(pixels);
    let object = |polygon: u32| space.scene.polygons[polygon as usize].object;
    let (mut sum, mut area) = (0.0, 0.0);
    for (number, patch) in (0..).zip(&environment.patches) {
        if object(patch.polygon) != from {
            continue;
        }
        let emitter = Emitter {
            environment: 0,
            patch: number,
            polygon: patch.polygon,
            centre: patch.centre,
            normal: space.scene.polygons[patch.polygon as usize].plane.normal,
            power: Rgb::ONE,
            radiosity: Rgb::ONE,
        };
        let shot = shoot(space, &environment, &hemisphere, &emitter, &Mask::all(pixels));
        let hits = shot
            .hits
            .iter()
            .filter(|&&(hit, _)| object(environment.patches[hit as usize].polygon) == to);
        sum += patch.area * hits.map(|&(_, form_factor)| form_factor).sum::<f64>();
        area += patch.area;
    }
    sum / area
}

/// Checks relative errors over refinements of patches and pixels: each is at most 0.35 of the one
/// before (sampling from centres is of second order), the last is below `last`.
fn converges(faces: &[Face], from: u32, to: u32, exact: f64, last: f64) {
    let space = space(faces, grey(0.5, 0.0));
    let errors: Vec<f64> = [(1.0, 4_096), (0.5, 16_384), (0.25, 65_536), (0.125, 65_536)]
        .map(|(size, pixels)| (form_factor(&space, from, to, size, pixels) / exact - 1.0).abs())
        .to_vec();
    for pair in errors.windows(2) {
        assert!(pair[1] <= 0.35 * pair[0] || pair[1] < last, "{errors:?}");
    }
    assert!(errors[3] < last, "{errors:?}");
}

/// Howell C-11, 1 × 1 at distance 1.
#[test]
fn parallel_squares() {
    let mut faces = room([1.0, 1.0, 1.0]);
    faces.truncate(2);
    converges(&faces, 0, 1, 0.199_824_895_7, 3.5e-3);
}

/// Howell C-14, unit squares with a common edge. Patches at the edge touch their receivers, for
/// which sampling from the centre is least accurate: the error falls only linearly.
#[test]
fn perpendicular_squares() {
    let space = space(&room([1.0; 3])[..3], grey(0.5, 0.0));
    let error = |size: f64, pixels: u32| {
        (form_factor(&space, 0, 2, size, pixels) / 0.200_043_776_1 - 1.0).abs()
    };
    let errors =
        [error(0.5, 16_384), error(0.25, 16_384), error(0.125, 65_536), error(0.0625, 65_536)];
    assert!(errors.windows(2).all(|pair| pair[1] < 0.75 * pair[0]), "{errors:?}");
    assert!(errors[3] < 0.02, "{errors:?}");
}

/// Unit squares at distance 1 with an obstacle [0,½]² midway: 0.1498686718.
#[test]
fn obstructed_squares() {
    let mut faces = room([1.0, 1.0, 1.0]);
    faces.truncate(2);
    let (l, h, z) = (0.0, 0.5, 0.5);
    faces.push(quad([[l, l, z], [h, l, z], [h, h, z], [l, h, z]], 2));
    faces.push(quad([[l, h, z], [h, h, z], [h, l, z], [l, l, z]], 2));
    converges(&faces, 0, 1, 0.149_868_671_8, 5e-3);
}

/// A closed box with uniform reflectance and emission: B = E / (1 − ρ) everywhere. Only for patches
/// along the edges is sampling from centres inaccurate. Their fraction of the area falls with the
/// patch size h, so the L2 error falls as √h.
#[test]
fn furnace() {
    for reflectance in [0.5, 0.8] {
        let space = space(&room([4.0, 3.0, 2.5]), grey(reflectance, 2.0));
        let exact = 2.0 / (1.0 - reflectance);
        let spread = [1.0, 0.5].map(|size| {
            let environment = whole(&space, size);
            let (light, _) = solve(&space, &environment, &fibonacci(2_048), 1e-5, u64::MAX, |_| ());
            // Energy is conserved, so the mean is exact except for the unshot power.
            let mean = light.leaving.iter().sum::<Rgb>().x / space.scene.area();
            assert!((mean / exact - 1.0).abs() < 1e-4, "{mean} {exact}");
            let squares = (0..environment.patches.len() as u32).map(|patch| {
                let error = light.radiosity(&environment, patch).x / exact - 1.0;
                error * error * environment.patches[patch as usize].area
            });
            (squares.sum::<f64>() / space.scene.area()).sqrt()
        });
        assert!(spread[1] < 0.03 && spread[1] <= 0.8 * spread[0], "{reflectance}: {spread:?}");
    }
}

/// An open scene: light that leaves it is counted as escaped, and the energy balance closes.
#[test]
fn open_to_the_sky() {
    let space = space(&room([2.0, 2.0, 1.0])[..1], grey(0.5, 1.0));
    let environment = whole(&space, 0.5);
    let (light, shots) = solve(&space, &environment, &fibonacci(256), 0.0, u64::MAX, |_| ());
    assert_eq!(shots, 16);
    assert!((light.escaped.x - 4.0).abs() < 1e-12 && light.absorbed.x == 0.0, "{light:?}");
}

/// No light: nothing to shoot.
#[test]
fn no_light() {
    let space = space(&room([1.0; 3]), grey(0.5, 0.0));
    let (light, shots) = solve(&space, &whole(&space, 0.5), &fibonacci(256), 0.0, u64::MAX, |_| ());
    assert_eq!((shots, light.unshot_power()), (0, Rgb::ZERO));
}
