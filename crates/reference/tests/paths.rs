//! Light paths compared with known solutions.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use common::{grey, room, whole};
use radiosity::{LocalEnvironment, Scene, Space};
use reference::{Dense, Patches, Paths, Problem, Received, Solution};

/// A unit cube whose ceiling emits, in patches of this size.
fn cube(size: f64) -> (Space, LocalEnvironment, Patches) {
    let mut faces = room([1.0; 3]);
    faces[1].material = 1;
    let objects = ["floor", "ceiling", "walls"].map(str::to_owned).to_vec();
    let materials = vec![grey(0.5, 0.0), grey(0.5, 1.0)];
    let (space, environment) = whole(Scene::new(&faces, materials, objects).unwrap().0, size);
    let patches = Patches::new(&space, &environment);
    (space, environment, patches)
}

/// The solution of thirty-two rounds of `paths` paths.
fn solved(cube: &(Space, LocalEnvironment, Patches), problem: Problem, paths: u32) -> Solution {
    let (space, environment, patches) = cube;
    let paths = Paths::new(space, environment, patches, problem, paths, 7);
    let mut received = Received::new(patches.count());
    for round in parallel::map(32, 2, |number| paths.round(number as u32)) {
        received.add(&round);
    }
    paths.solution(&received)
}

/// On patches, paths agree with the dense solution within their standard errors.
#[test]
fn paths_on_patches_agree_with_the_dense_solution() {
    let cube = cube(0.5);
    let exact = Dense::new(&cube.0.scene, cube.2.clone(), 1e-6, 2, || ()).solve();
    let found = solved(&cube, Problem::Patches, 20_000);
    let errors: Vec<f64> = (0..exact.radiosity.len())
        .map(|i| (found.radiosity[i].x - exact.radiosity[i].x) / found.error[i].x)
        .collect();
    let mean_square = errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64;
    assert!((0.3..2.0).contains(&mean_square), "{mean_square} {errors:?}");
    let worst = found.error.iter().map(|error| error.x).fold(0.0, f64::max);
    assert!(worst < 1e-3, "{worst}");
}

/// Irradiances of the continuum on the faces of the cube; extrapolated to about 1e-4.
#[test]
fn paths_agree_with_the_continuum_on_any_mesh() {
    let cube = cube(1.0);
    let found = solved(&cube, Problem::Continuum, 50_000);
    for (face, exact) in
        [0.342_43, 0.208_72, 0.362_21, 0.362_21, 0.362_21, 0.362_21].iter().enumerate()
    {
        let irradiance = (found.radiosity[face].x - cube.2.emission[face].x) / 0.5;
        let error = found.error[face].x / 0.5;
        assert!(
            error < 1e-3 && (irradiance - exact).abs() < 4.0 * error + 1e-4,
            "{face}: {irradiance}"
        );
    }
}

/// A round depends only on seed and number. Energy is conserved: each watt is received, half of it again, and
/// so on: 2 W.
#[test]
fn rounds_are_repeatable_and_conserve_energy() {
    let (space, environment, patches) = cube(0.5);
    let paths = Paths::new(&space, &environment, &patches, Problem::Patches, 1000, 7);
    assert_eq!(paths.round(3), paths.round(3));
    assert_ne!(paths.round(3), paths.round(4));
    let falls: f64 = (0..64).map(|n| paths.round(n).iter().map(|p| p.x).sum::<f64>()).sum();
    assert!((falls / 64.0 - 2.0).abs() < 0.03, "{falls}");
}
