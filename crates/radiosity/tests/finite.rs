//! Whatever the faces are, no output holds a number that is not finite, nor a triangle without area.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use radiosity::glam::DVec3;
use radiosity::{
    Camera, Exposure, Face, Hemisphere, HemisphereKind, LocalEnvironment, Material, Mesh,
    PatchSize, PictureError, PictureOptions, Rgb, Scene, Shading, Space, Tone, render, solve,
};

/// A room of triangles, on a lattice or warped, with slabs in the planes of its floor and ceiling.
#[derive(Clone, Debug)]
struct Room {
    size: [f64; 3],
    /// Triangles or quads.
    triangles: bool,
    /// How far one corner is out of place, metres.
    warp: f64,
    /// Rectangles in the floor's and the ceiling's plane, in eighths of the room.
    slabs: Vec<[u32; 4]>,
    patch: f64,
    cells: u32,
}

fn room() -> impl Strategy<Value = Room> {
    let edge = || prop_oneof![Just(3.0), Just(4.0), 1.0..6.0f64];
    let warp = prop_oneof![Just(0.0), Just(1e-9), Just(1e-7), -0.3..0.3f64];
    let slab = [0u32..7, 0u32..7, 1u32..4, 1u32..4];
    let slabs = proptest::collection::vec(slab, 1..4);
    let patch = prop_oneof![Just(0.5), Just(0.75), 0.3..1.5f64];
    ([edge(), edge(), edge()], any::<bool>(), warp, slabs, patch, 1u32..4).prop_map(
        |(size, triangles, warp, slabs, patch, cells)| Room {
            size,
            triangles,
            warp,
            slabs,
            patch,
            cells,
        },
    )
}

impl Room {
    fn faces(&self) -> Vec<Face> {
        let [x, y, z] = self.size;
        let corner = |i: usize| {
            let at = DVec3::new((i & 1) as f64 * x, (i >> 1 & 1) as f64 * y, (i >> 2) as f64 * z);
            if i == 7 { at + self.warp } else { at }
        };
        let sides =
            [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
        let mut quads: Vec<([DVec3; 4], u32)> =
            sides.iter().map(|side| (side.map(corner), 0)).collect();
        for (slab, &[i, j, width, depth]) in self.slabs.iter().enumerate() {
            let [x0, x1] = [i, (i + width).min(8)].map(|n| f64::from(n) / 8.0 * x);
            let [y0, y1] = [j, (j + depth).min(8)].map(|n| f64::from(n) / 8.0 * y);
            let height = if slab == 0 { z } else { 0.0 };
            let mut quad =
                [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(|[x, y]| DVec3::new(x, y, height));
            if slab == 0 {
                quad.reverse();
            }
            quads.push((quad, u32::from(slab == 0)));
        }
        let face =
            |points: &[DVec3], material| Face { points: points.to_vec(), material, object: 0 };
        quads
            .iter()
            .flat_map(|(quad, material)| match self.triangles {
                true => {
                    vec![face(&quad[..3], *material), face(&[quad[0], quad[2], quad[3]], *material)]
                }
                false => vec![face(quad, *material)],
            })
            .collect()
    }
}

/// Whether a glTF file's numbers are finite; and each triangle has an area.
fn is_sound(glb: &[u8]) -> bool {
    let file = gltf::Gltf::from_slice(glb).unwrap();
    let (document, buffer) = (file.document, file.blob.unwrap());
    let primitive = document.meshes().next().unwrap().primitives().next().unwrap();
    let reader = primitive.reader(|_| Some(buffer.as_slice()));
    let positions: Vec<DVec3> =
        reader.read_positions().unwrap().map(|p| DVec3::from(p.map(f64::from))).collect();
    let indices: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
    let has_area = |corners: &[u32]| {
        let [a, b, c] = [0, 1, 2].map(|i| positions[corners[i] as usize]);
        (b - a).cross(c - a).length() > 0.0
    };
    // All other data are 32-bit floats.
    let floats = document.accessors().filter(|a| a.data_type() == gltf::accessor::DataType::F32);
    let finite = floats.into_iter().all(|accessor| {
        let view = accessor.view().unwrap();
        let bytes = &buffer[view.offset()..][..view.length()];
        bytes.chunks_exact(4).all(|b| f32::from_le_bytes(b.try_into().unwrap()).is_finite())
    });
    finite && indices.chunks_exact(3).all(has_area)
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 1_000, rng_seed: RngSeed::Fixed(14), failure_persistence: None,
        max_shrink_iters: 200, ..ProptestConfig::default()
    })]

    #[test]
    fn every_writer_gets_finite_numbers(room in room()) {
        let material = |emission| Material { emission: Rgb::splat(emission), ..Material::default() };
        let materials = vec![material(0.0), material(5.0)];
        let (scene, _) = Scene::new(&room.faces(), materials, vec!["room".to_owned()]).unwrap();
        let space = Space::new(scene, [room.cells; 3]);
        let size = PatchSize { reflector: room.patch, emitter: room.patch };
        let whole = LocalEnvironment::new(&space, space.grid.whole(), size);
        let least = space.scene.tolerance() * 1e-3;
        prop_assert!(whole.patches.iter().all(|patch| patch.area > least), "a sliver of a patch");
        let area: f64 = whole.patches.iter().map(|patch| patch.area).sum();
        prop_assert!((area / space.scene.area() - 1.0).abs() < 1e-6, "{area}");

        let hemisphere = Hemisphere::new(HemisphereKind::Fibonacci, 64, true).unwrap();
        let (light, _) = solve(&space, &whole, &hemisphere, 0.2, 200, |_| ());
        let patches = 0..whole.patches.len() as u32;
        let radiosity: Vec<Rgb> = patches.map(|patch| light.radiosity(&whole, patch)).collect();
        prop_assert!(radiosity.iter().all(|rgb| rgb.is_finite()));
        let environments = [whole];
        for shading in [Shading::Smooth, Shading::Flat] {
            let mesh = Mesh::new(&space, &environments, shading);
            let lit = mesh.light(std::slice::from_ref(&radiosity));
            let origin = space.scene.origin;
            let (glb, middle_grey) =
                mesh.to_glb(&lit, origin, space.scene.up, Exposure::Auto, Tone::Reinhard).unwrap();
            prop_assert!(is_sound(&glb));
            prop_assert!(middle_grey != 1.0, "the exposure falls back");
            let camera = Camera::overview(&space.scene.bounds, space.scene.up, 24, 16);
            let colour = |polygon, point| mesh.radiosity_at(&lit, polygon, point);
            let picture = render(&space.scene, &camera, colour, PictureOptions::default());
            prop_assert!(picture.unwrap().middle_grey.is_finite());
        }
    }
}

/// A writer refuses a number that is not finite.
#[test]
fn numbers_that_are_not_finite_are_refused() {
    let room = Room {
        size: [1.0; 3],
        triangles: false,
        warp: 0.0,
        slabs: vec![[1, 1, 1, 1]],
        patch: 1.0,
        cells: 1,
    };
    let materials = vec![Material::default(); 2];
    let scene = Scene::new(&room.faces(), materials, vec!["room".to_owned()]).unwrap().0;
    let camera = Camera::overview(&scene.bounds, scene.up, 24, 16);
    for wrong in [f64::NAN, f64::INFINITY, 1e39] {
        let picture = render(&scene, &camera, |_, _| Rgb::splat(wrong), PictureOptions::default());
        assert_eq!(picture.unwrap_err(), PictureError::NotFinite);
        let space = Space::new(scene.clone(), [1; 3]);
        let size = PatchSize { reflector: 1.0, emitter: 1.0 };
        let environments = [LocalEnvironment::new(&space, space.grid.whole(), size)];
        let mesh = Mesh::new(&space, &environments, Shading::Flat);
        let light = vec![Rgb::splat(wrong); mesh.positions().len()];
        let glb = mesh.to_glb(&light, DVec3::ZERO, DVec3::Z, Exposure::Auto, Tone::Linear);
        assert_eq!(glb.unwrap_err(), PictureError::NotFinite);
    }
}
