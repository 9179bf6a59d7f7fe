//! Refined meshes are valid, and finer only where radiosity changes.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use radiosity::glam::DVec3;
use radiosity::{
    Emitter, Face, Hemisphere, HemisphereKind, LocalEnvironment, Mask, Material, PatchSize,
    Refinement, Rgb, Scene, Space, Wanted, shoot, shoot_plainly,
};

const SIZE: PatchSize = PatchSize { reflector: 1.0, emitter: 1.0 };

fn material(emission: f64) -> Material {
    let (name, emission) = (format!("{emission}"), Rgb::splat(emission));
    Material { name, emission, ..Material::default() }
}

fn face(points: &[[f64; 3]], material: u32) -> Face {
    Face { points: points.iter().map(|&p| DVec3::from(p)).collect(), material, object: 0 }
}

/// A room of 8 × 4 × 3 m seen from inside: either empty with emitting walls, or with a lamp low
/// above the floor at one end and a slanted triangle at the other.
fn room(glows: bool) -> Space {
    let sides =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let corner =
        |i: usize| [8.0 * (i & 1) as f64, 4.0 * (i >> 1 & 1) as f64, 3.0 * (i >> 2) as f64];
    let mut faces: Vec<Face> = sides.iter().map(|side| face(&side.map(corner), 0)).collect();
    faces.push(face(&[[1.0, 1.5, 1.0], [1.0, 2.5, 1.0], [2.0, 2.5, 1.0], [2.0, 1.5, 1.0]], 1));
    faces.push(face(&[[5.1, 1.0, 0.4], [7.3, 1.2, 0.9], [6.0, 2.9, 1.6]], 0));
    let materials = vec![material(if glows { 1.0 } else { 0.0 }), material(1.0)];
    faces.truncate(if glows { 6 } else { 8 });
    let scene = Scene::new(&faces, materials, vec!["all".to_owned()]).unwrap().0;
    Space::new(scene, [8, 4, 3])
}

fn refinement(space: &Space, relative_l2: f64) -> Refinement {
    Refinement::new(space, SIZE, Wanted { relative_l2, most_halvings: 4 }).unwrap()
}

/// Meshes of the whole scene, and of the two blocks into which it is divided.
fn meshes(space: &Space, refinement: &Refinement) -> [LocalEnvironment; 3] {
    let (mut low, mut high) = (space.grid.whole(), space.grid.whole());
    (low.high[0], high.low[0]) = (3, 3);
    [space.grid.whole(), low, high].map(|block| refinement.mesh(space, block, SIZE))
}

#[test]
fn patches_cover_the_scene_and_are_found() {
    let space = room(false);
    let refinement = refinement(&space, 0.03);
    let meshes = meshes(&space, &refinement);
    let area = |mesh: &LocalEnvironment| mesh.patches.iter().map(|patch| patch.area).sum::<f64>();
    assert!((area(&meshes[0]) - space.scene.area()).abs() < 1e-9);
    assert!((area(&meshes[1]) + area(&meshes[2]) - space.scene.area()).abs() < 1e-9);
    for mesh in &meshes {
        assert!(mesh.patches.len() > 100);
        for (number, patch) in (0..).zip(&mesh.patches) {
            assert_eq!(mesh.patch_at(patch.polygon, patch.centre), Some(number));
            let outline = mesh.outline(&space, number);
            let mean = outline.iter().sum::<DVec3>() / outline.len() as f64;
            // All of a convex outline is inside the slots of its patch.
            for corner in &outline {
                let inside = mean + (*corner - mean) * 0.999;
                assert_eq!(mesh.patch_at(patch.polygon, inside), Some(number), "{patch:?}");
            }
        }
    }
}

/// Patches are small under the lamp and large far away. With uniform emission none is halved.
#[test]
fn the_mesh_is_fine_only_where_radiosity_changes() {
    let space = room(false);
    let [mesh, ..] = meshes(&space, &refinement(&space, 0.03));
    let of_floor = |x: f64| {
        let patch = mesh.patch_at(0, DVec3::new(x, 2.1, 0.0) - space.scene.origin).unwrap();
        mesh.patches[patch as usize].area
    };
    assert!(of_floor(7.6) >= 16.0 * of_floor(1.1), "{} {}", of_floor(7.6), of_floor(1.1));
    let alike = room(true);
    let uniform = LocalEnvironment::new(&alike, alike.grid.whole(), SIZE);
    let [mesh, ..] = meshes(&alike, &refinement(&alike, 0.1));
    assert_eq!(mesh.patches.len(), uniform.patches.len());
}

#[test]
fn less_error_takes_more_patches() {
    let space = room(false);
    let patches = [0.3, 0.1, 0.05, 0.02]
        .map(|error| meshes(&space, &refinement(&space, error))[0].patches.len());
    assert!(patches.is_sorted() && patches[3] > 2 * patches[0], "{patches:?}");
}

/// Rays in bundles and one by one find the same patches, also of different sizes.
#[test]
fn bundles_shoot_as_single_rays_do() {
    let space = room(false);
    let [_, low, high] = meshes(&space, &refinement(&space, 0.05));
    let hemisphere = Hemisphere::new(HemisphereKind::Fibonacci, 512, true).unwrap();
    for (patch, of) in (0..).zip(&low.patches).step_by(5) {
        let emitter = Emitter {
            environment: 0,
            patch,
            polygon: of.polygon,
            centre: of.centre,
            normal: space.scene.polygons[of.polygon as usize].plane.normal,
            power: Rgb::ONE,
            radiosity: Rgb::ONE,
        };
        let shot = |mesh, mask: &Mask| {
            let [fast, plain] = [shoot, shoot_plainly]
                .map(|shoot| shoot(&space, mesh, &hemisphere, &emitter, mask));
            assert_eq!(fast, plain);
            fast
        };
        for outgoing in shot(&low, &Mask::all(512)).outgoing.iter().flatten() {
            shot(&high, &outgoing.mask);
        }
    }
}
