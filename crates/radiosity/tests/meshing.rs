//! Meshing takes time in proportion to its patches, and their number is known beforehand.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]
#![allow(
    clippy::disallowed_methods,
    reason = "how long meshing takes on the host is what is tested"
)]

use std::time::{Duration, Instant};

use radiosity::glam::DVec3;
use radiosity::{Face, LocalEnvironment, Material, PatchSize, Rgb, Scene, Space};

fn scene(faces: &[[[f64; 2]; 3]]) -> Scene {
    let face = |corners: &[[f64; 2]; 3]| {
        let points = corners.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec();
        Face { points, material: 0, object: 0 }
    };
    let faces: Vec<Face> = faces.iter().map(face).collect();
    Scene::new(&faces, vec![Material::default()], vec!["all".to_owned()]).unwrap().0
}

const HALF: [[f64; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];

/// Half a million patches, outlines included: a search for each slot through all others takes minutes.
#[test]
fn a_triangle_of_many_patches_is_meshed_at_once() {
    let start = Instant::now();
    let space = Space::new(scene(&[HALF]), [1; 3]);
    let size = PatchSize { reflector: 0.001, emitter: 0.001 };
    let whole = LocalEnvironment::new(&space, space.grid.whole(), size);
    assert!(whole.patches.len() > 500_000);
    let outlines = (0..whole.patches.len() as u32).map(|patch| whole.outline(&space, patch));
    assert!(outlines.into_iter().all(|outline| outline.len() >= 3));
    assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
}

#[test]
fn too_many_patches_are_counted_before_they_are_made() {
    let refused = |scene: &Scene, size: PatchSize| size.check(scene).unwrap_err().to_string();
    let size = |reflector, emitter| PatchSize { reflector, emitter };
    let half = scene(&[HALF]);
    assert!(size(0.001, 1e-9).check(&half).is_ok(), "nothing emits");
    let many = scene(&[HALF, [[1.0, 1.0], [0.0, 1.0], [1.0, 0.0]]]);
    let text = refused(&many, size(0.0001, 1.0));
    assert_eq!(
        text,
        "0.0001 m makes some 33554432 patches, up to 4096 x 4096 a polygon; expected at most 20000000"
    );

    // Slivers have hardly any area, but many patches along them.
    let sliver = |i: u32| {
        let y = f64::from(i) * 1e-3;
        [[0.0, y], [1.0, y], [0.0, y + 1e-6]]
    };
    let slivers = scene(&(0..20_000).map(sliver).collect::<Vec<_>>());
    let text = refused(&slivers, size(0.0005, 1.0));
    assert!(text.contains("makes some 40960000 patches, up to 2048 x 1 a polygon"), "{text}");

    let mut lamps = half;
    lamps.materials[0].emission = Rgb::ONE;
    lamps.polygons = vec![lamps.polygons[0].clone(); 14];
    let error = size(1.0, 1e-6).check(&lamps).unwrap_err();
    assert!(error.emitters);
    assert!(error.to_string().contains("234881024 patches, up to 4096 x 4096"), "{error}");
}
