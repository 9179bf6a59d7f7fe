//! Closed rooms with faces that overlap in the plane of the ceiling: light goes somewhere, once.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use common::{grey, room, whole};
use proptest::prelude::*;
use radiosity::glam::DVec3;
use radiosity::{Face, Scene};
use reference::{Dense, Estimate, ObjectRays, Objects, Patches, Paths, Problem, Received};

/// Of all surfaces.
const REFLECTANCE: f64 = 0.5;

/// From each object.
const RAYS: u64 = 1 << 19;

/// So many rays may miss what they should meet.
const FEW: f64 = 8.0;

/// A rectangle or a triangle in a ceiling of 3 × 3 m at 2 m, seen from below; and whether it emits.
fn panel() -> impl Strategy<Value = (Vec<DVec3>, bool)> {
    let corner = || (0.2..1.8, 0.2..1.8);
    let rectangle = (corner(), 0.3..1.0, 0.3..1.0)
        .prop_map(|((x, y), w, h)| vec![[x, y], [x, y + h], [x + w, y + h], [x + w, y]]);
    let triangle = (corner(), 0.3..1.0, 0.3..1.0)
        .prop_map(|((x, y), w, h)| vec![[x, y], [x + 0.4 * w, y + h], [x + w, y + 0.3 * h]]);
    let lifted = |corners: Vec<[f64; 2]>| -> Vec<DVec3> {
        corners.into_iter().map(|[x, y]| DVec3::new(x, y, 2.0)).collect()
    };
    (prop_oneof![rectangle, triangle].prop_map(lifted), any::<bool>())
}

/// A room with two or three panels, in any order of faces.
fn faces() -> impl Strategy<Value = Vec<Face>> {
    prop::collection::vec(panel(), 2..=3)
        .prop_map(|panels| {
            let panels = panels.into_iter().zip(3..).map(|((points, emits), object)| Face {
                points,
                material: u32::from(emits),
                object,
            });
            room([3.0, 3.0, 2.0]).into_iter().chain(panels).collect::<Vec<_>>()
        })
        .prop_shuffle()
}

fn scene(faces: &[Face]) -> Scene {
    let objects = ["floor", "ceiling", "walls", "a", "b", "c"].map(str::to_owned).to_vec();
    Scene::new(faces, vec![grey(REFLECTANCE, 0.0), grey(REFLECTANCE, 9.0)], objects).unwrap().0
}

fn sum(row: &[Estimate]) -> f64 {
    row.iter().map(|one| one.value).sum()
}

/// Rows of exact form factors sum to 1, so do those of rays; both agree, and rays there and back.
fn form_factors_close(scene: Scene) -> Result<(), TestCaseError> {
    let (space, _) = whole(scene, 1.0);
    let objects = Objects::new(&space.scene);
    let all = 0..objects.count();
    let rays = ObjectRays::new(&objects, &space, RAYS, 1996).unwrap();
    let by_rays: Vec<Vec<Estimate>> = all.clone().map(|from| rays.from(from)).collect();
    for from in all.clone() {
        let exact: Vec<Estimate> = all.clone().map(|to| objects.exact(from, to, 1e-5)[0]).collect();
        let error: f64 = exact.iter().map(|one| one.error).sum();
        prop_assert!((sum(&exact) - 1.0).abs() <= error, "{from} {exact:?}");
        prop_assert!((sum(&by_rays[from]) - 1.0).abs() < 1e-12, "{from} {by_rays:?}");
        for to in all.clone() {
            let [there, back] = [&by_rays[from][to], &by_rays[to][from]];
            // Sixteen sets give a standard error that is itself 18 % uncertain, and what few rays meet
            // has none.
            let within = 6.0 * there.error + exact[to].error + FEW / RAYS as f64;
            prop_assert!((there.value - exact[to].value).abs() <= within, "{there:?} {exact:?}");
            let [one, other] = [(from, there), (to, back)].map(|(object, found)| {
                let area = objects.area(object);
                (area * found.value, area * (6.0 * found.error + FEW / RAYS as f64))
            });
            prop_assert!((one.0 - other.0).abs() <= one.1 + other.1, "{one:?} {other:?}");
        }
    }
    Ok(())
}

/// In a closed room of one reflectance ρ, all surfaces together send out Φ / (1 − ρ), and what emits is
/// seen: by the dense method and by paths.
fn light_closes(scene: Scene) -> Result<(), TestCaseError> {
    let sent = scene.emitted_power().x / (1.0 - REFLECTANCE);
    let (space, environment) = whole(scene, 1.0);
    let patches = Patches::new(&space, &environment);
    let total = |radiosity: &[DVec3]| -> f64 {
        radiosity.iter().zip(&patches.areas).map(|(one, area)| one.x * area).sum()
    };
    let dense = Dense::new(&space.scene, patches.clone(), 1e-4, 2, || ()).solve();
    let found = total(&dense.radiosity);
    prop_assert!((found - sent).abs() <= 2e-4 * sent, "dense {found} {sent}");
    let paths = Paths::new(&space, &environment, &patches, Problem::Patches, 4_000, 1996);
    let mut received = Received::new(patches.count());
    (0..8).for_each(|round| received.add(&paths.round(round)));
    let found = total(&paths.solution(&received).radiosity);
    prop_assert!((found - sent).abs() <= 0.02 * sent, "paths {found} {sent}");
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(16) })]

    #[test]
    fn form_factors_of_overlapping_faces_close(faces in faces()) {
        form_factors_close(scene(&faces))?;
    }

    #[test]
    fn light_of_overlapping_faces_closes(faces in faces()) {
        light_closes(scene(&faces))?;
    }
}
