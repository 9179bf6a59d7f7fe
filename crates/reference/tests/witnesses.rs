//! Witnesses estimate known errors.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use common::{grey, room, whole};
use radiosity::{LocalEnvironment, Rgb, Scene, Space};
use reference::{Dense, Patches, Testimony, Witnesses};

/// A unit cube whose ceiling emits, in patches of a quarter of a metre.
fn cube() -> (Space, LocalEnvironment) {
    let mut faces = room([1.0; 3]);
    faces[1].material = 1;
    let objects = ["floor", "ceiling", "walls"].map(str::to_owned).to_vec();
    let materials = vec![grey(0.5, 0.0), grey(0.5, 1.0)];
    whole(Scene::new(&faces, materials, objects).unwrap().0, 0.25)
}

/// Witnesses find an error of 10 % in light that is 10 % too bright, with few paths; the result does not depend on
/// the number of threads.
#[test]
fn a_known_error_is_estimated() {
    let (space, environment) = cube();
    let patches = Patches::new(&space, &environment);
    let exact = Dense::new(&space.scene, patches.clone(), 1e-5, 2, || ()).solve().radiosity;
    let both = exact.iter().zip(&patches.emission);
    let brighter: Vec<Rgb> = both.map(|(&b, &e)| e + (b - e) * 1.1).collect();
    let mut witnesses = Witnesses::new(space, environment, 7, 1);
    let agrees = |testimony: Testimony, square: f64| {
        (testimony.square - square).abs() < 4.0 * testimony.deviation + 1e-4
    };
    while witnesses.error(&brighter).deviation > 0.0005 {
        witnesses.double(2);
    }
    let estimate = witnesses.error(&brighter);
    assert!(agrees(estimate, 0.01), "{estimate:?}");
    assert!((estimate.error() - 0.1).abs() < 0.01, "{estimate:?}");
    let estimate = witnesses.error(&exact);
    assert!(agrees(estimate, 0.0) && estimate.error() < 0.02, "{estimate:?}");
    assert!(witnesses.paths() < 200_000, "{}", witnesses.paths());

    let (space, environment) = cube();
    let mut others = Witnesses::new(space, environment, 7, 3);
    while others.paths() < witnesses.paths() {
        others.double(1);
    }
    assert_eq!(others.error(&exact), witnesses.error(&exact));
}

/// Errors are relative to the reflected light: in a scene without light none is small.
#[test]
fn a_dark_scene_has_no_error_of_zero() {
    let dark = Scene::new(&room([1.0; 3]), vec![grey(0.5, 0.0)], vec!["room".to_owned(); 3]);
    let (space, environment) = whole(dark.unwrap().0, 0.5);
    let patches = environment.patches.len();
    let witnesses = Witnesses::new(space, environment, 7, 1);
    assert!(!witnesses.reflect_light());
    assert_eq!(witnesses.error(&vec![Rgb::ZERO; patches]).error(), f64::INFINITY);
}
