//! The dense solver compared with known solutions.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use common::{grey, room, whole};
use radiosity::glam::DVec3;
use radiosity::{Face, Material, Scene};
use reference::closed_form::opposed_rectangles;
use reference::{Dense, Patches, Solution};

/// Meshes and solves faces with these materials: the matrix and the solution.
fn solved(
    faces: &[Face],
    materials: Vec<Material>,
    size: f64,
    tolerance: f64,
) -> (Dense, Solution) {
    let objects = ["floor", "ceiling", "walls"].map(str::to_owned).to_vec();
    let (space, environment) = whole(Scene::new(faces, materials, objects).unwrap().0, size);
    let patches = Patches::new(&space, &environment);
    let dense = Dense::new(&space.scene, patches, tolerance, 2, || ());
    let solution = dense.solve();
    (dense, solution)
}

/// A unit cube whose ceiling emits; the irradiances of floor, ceiling and sides.
fn cube(size: f64, tolerance: f64) -> [f64; 3] {
    let mut faces = room([1.0; 3]);
    faces[1].material = 1;
    let materials = vec![grey(0.5, 0.0), grey(0.5, 1.0)];
    let (dense, solution) = solved(&faces, materials, size, tolerance);
    let patches = dense.patches();
    let mean = |range: std::ops::Range<u32>| {
        let (mut sum, mut area) = (0.0, 0.0);
        for i in (0..patches.count()).filter(|&i| range.contains(&patches.surfaces[i].polygon)) {
            let irradiance = (solution.radiosity[i].x - patches.emission[i].x) / 0.5;
            (sum, area) = (sum + irradiance * patches.areas[i], area + patches.areas[i]);
        }
        sum / area
    };
    [mean(0..1), mean(1..2), mean(2..6)]
}

/// Uniform reflectance ρ and emission E in a closed room: B = E / (1 − ρ).
#[test]
fn furnace() {
    for rho in [0.0, 0.5, 0.9, 0.999] {
        let (_, solution) = solved(&room([4.0, 3.0, 2.5]), vec![grey(rho, 2.0)], 1.0, 1e-9);
        let exact = 2.0 / (1.0 - rho);
        for (found, error) in solution.radiosity.iter().zip(&solution.error) {
            assert!((found.x - exact).abs() <= error.x + 1e-13 * exact, "{rho}: {found} {error}");
            assert!(error.x <= 1e-8 * exact / (1.0 - rho), "{rho}: {error}");
        }
    }
}

/// One patch a face: exact to the form factors' error.
#[test]
fn cube_of_one_patch_a_face() {
    let exact = [0.363_491_652_2, 0.181_818_196_2, 0.363_672_537_9];
    for (found, exact) in cube(1.0, 1e-11).into_iter().zip(exact) {
        assert!((found - exact).abs() < 1e-10, "{found} {exact}");
    }
}

/// Finer patches converge to the solution of the continuum.
#[test]
fn refined_cube() {
    let continuum = [0.342_43, 0.208_72, 0.362_21];
    let errors = |size: f64| {
        let found = cube(size, 1e-5);
        [0, 1, 2].map(|i| (found[i] / continuum[i] - 1.0).abs())
    };
    let [coarse, fine] = [0.25, 0.125].map(errors);
    for (coarse, fine) in coarse.into_iter().zip(fine) {
        assert!(fine < 5e-3 && fine <= 0.5 * coarse, "{coarse} {fine}");
    }
}

/// Parallel plates: the exact solution, which tends to that of infinite plates,
/// B₁ = (E₁ + ρ₁ E₂) / (1 − ρ₁ ρ₂), as the plates get wider and less light escapes.
#[test]
fn wide_plates() {
    let (e1, r1, e2, r2) = (1.0, 0.3, 2.0, 0.6);
    let exact = |f: f64| (e1 + r1 * f * e2) / (1.0 - r1 * r2 * f * f);
    let off = [10.0, 100.0, 1000.0].map(|width| {
        let mut faces = room([width, width, 1.0]);
        faces.truncate(2);
        faces[1].material = 1;
        let (_, solution) = solved(&faces, vec![grey(r1, e1), grey(r2, e2)], width, 1e-9);
        let (found, error) = (solution.radiosity[0].x, solution.error[0].x);
        assert!((found - exact(opposed_rectangles(width, width, 1.0))).abs() <= error + 1e-12);
        1.0 - found / exact(1.0)
    });
    assert!(off[0] > off[1] && off[1] > off[2] && (0.0..2e-3).contains(&off[2]), "{off:?}");
}

/// In a sphere irradiance is ⟨E⟩ / (1 − ⟨ρ⟩) everywhere, for any distribution of emission; polyhedra converge
/// to it.
#[test]
fn sphere() {
    let error = |times: u32| {
        let mut faces = octahedron(times);
        // The upper half emits; the lower half has another reflectance.
        for face in &mut faces {
            face.material = u32::from(face.points.iter().map(|p| p.z).sum::<f64>() < 0.0);
        }
        let (dense, solution) = solved(&faces, vec![grey(0.3, 1.0), grey(0.7, 0.0)], 10.0, 1e-6);
        let patches = dense.patches();
        let mean = |of: &dyn Fn(usize) -> f64| {
            let sum: f64 = (0..patches.count()).map(|i| of(i) * patches.areas[i]).sum();
            sum / patches.areas.iter().sum::<f64>()
        };
        let exact = mean(&|i| patches.emission[i].x) / (1.0 - mean(&|i| patches.reflectance[i].x));
        let off = |i: usize| {
            let reflected = solution.radiosity[i].x - patches.emission[i].x;
            reflected / patches.reflectance[i].x / exact - 1.0
        };
        mean(&|i| off(i) * off(i)).sqrt()
    };
    let errors = [1, 2, 3].map(error);
    assert!(errors.windows(2).all(|pair| pair[1] < 0.5 * pair[0]), "{errors:?}");
    assert!(errors[2] < 0.02, "{errors:?}");
}

/// A unit octahedron seen from inside, its triangles subdivided on the sphere `times` times.
fn octahedron(times: u32) -> Vec<Face> {
    let mut triangles = Vec::new();
    for signs in 0..8 {
        let [x, y, z] = [0, 1, 2].map(|axis| if signs >> axis & 1 == 0 { 1.0 } else { -1.0 });
        let [x, y, z] = [DVec3::X * x, DVec3::Y * y, DVec3::Z * z];
        let inwards = (y - x).cross(z - x).dot(x) < 0.0;
        triangles.push(if inwards { [x, y, z] } else { [x, z, y] });
    }
    for _ in 0..times {
        let quarters = |[a, b, c]: [DVec3; 3]| {
            let [ab, bc, ca] = [a + b, b + c, c + a].map(DVec3::normalize);
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        triangles = triangles.into_iter().flat_map(quarters).collect();
    }
    let face = |points: [DVec3; 3]| Face { points: points.to_vec(), material: 0, object: 0 };
    triangles.into_iter().map(face).collect()
}

/// A room with a pillar: form factors from each patch sum to 1.
#[test]
fn rows_of_a_closed_scene_sum_to_one() {
    let mut faces = room([2.0, 2.0, 1.0]);
    let mut pillar = room([0.3, 0.4, 1.0]).split_off(2);
    for face in &mut pillar {
        face.points.iter_mut().for_each(|p| *p += DVec3::new(0.8, 0.7, 0.0));
        face.points.reverse();
    }
    faces.extend(pillar);
    let (dense, solution) = solved(&faces, vec![grey(0.5, 1.0)], 1.0, 1e-4);
    assert!(solution.error.iter().all(|error| error.x < 1e-3), "{:?}", solution.error);
    let patches = dense.patches();
    // Not those of the floor, parts of which are under the pillar.
    for from in (0..patches.count()).filter(|&i| patches.surfaces[i].plane.normal.z == 0.0) {
        let sum: f64 = (0..patches.count()).map(|to| dense.form_factor(from, to)).sum();
        assert!((sum - 1.0).abs() < 2e-4, "{sum} {:?}", patches.surfaces[from]);
    }
}

/// A floor cut into slivers has the light of a whole one: slivers get no accuracy that would take for ever.
#[test]
fn slivers_take_no_light_away() {
    let mut faces = room([3.0, 2.0, 2.0]);
    faces.remove(0);
    let cuts = [0.0, 1.0, 1.0 + 1e-6, 2.0 - 3e-7, 2.0, 3.0];
    for strip in cuts.windows(2) {
        let [a, b] = [strip[0], strip[1]];
        faces.push(common::quad([[a, 0.0, 0.0], [b, 0.0, 0.0], [b, 2.0, 0.0], [a, 2.0, 0.0]], 0));
    }
    faces.iter_mut().filter(|face| face.object == 1).for_each(|face| face.material = 1);
    let (dense, solution) = solved(&faces, vec![grey(0.5, 0.0), grey(0.5, 10.0)], 4.0, 1e-4);
    let areas = &dense.patches().areas;
    let light: f64 = solution.radiosity.iter().zip(areas).map(|(light, area)| light.x * area).sum();
    let exact = 10.0 * 3.0 * 2.0 / (1.0 - 0.5);
    assert!((light / exact - 1.0).abs() < 1e-4, "{light} {exact}");
}
