//! Meshes of triangles, pictures and glTF files show the radiosities of patches.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use glam::DVec3;
use gltf::mesh::util::ReadIndices;
use radiosity::{
    Camera, Exposure, Face, LocalEnvironment, Material, Mesh, PatchSize, PictureOptions, Rgb,
    Scene, Shading, Space, Tone, render,
};

/// Two floors side by side, 2 m × 2 m in one plane but of different materials, and a wall.
fn scene() -> Scene {
    let face = |points: [[f64; 3]; 4], material| {
        let points = points.map(|p| DVec3::from(p) + DVec3::new(1e3, 2e3, 0.0)).to_vec();
        Face { points, material, object: 0 }
    };
    let floor = |x: f64| [[x, 0.0, 0.0], [x + 2.0, 0.0, 0.0], [x + 2.0, 2.0, 0.0], [x, 2.0, 0.0]];
    let wall = [[0.0, 2.0, 0.0], [4.0, 2.0, 0.0], [4.0, 2.0, 1.0], [0.0, 2.0, 1.0]];
    let material = |name: &str| Material { name: name.to_owned(), ..Material::default() };
    let faces = [face(floor(0.0), 0), face(floor(2.0), 1), face(wall, 0)];
    let materials = vec![material("left"), material("right")];
    Scene::new(&faces, materials, vec!["all".to_owned()]).unwrap().0
}

/// The scene divided in two across both floors, with patches of 1 m.
fn cut() -> (Space, Vec<LocalEnvironment>) {
    let space = Space::new(scene(), [1, 2, 1]);
    let environment = |row: u32| {
        let mut block = space.grid.whole();
        (block.low[1], block.high[1]) = (row, row + 1);
        LocalEnvironment::new(&space, block, PatchSize { reflector: 1.0, emitter: 1.0 })
    };
    let environments = [0, 1].map(environment).into();
    (space, environments)
}

/// A radiosity for each patch, as a function of its centre.
fn light(environments: &[LocalEnvironment], of: impl Fn(DVec3) -> Rgb) -> Vec<Vec<Rgb>> {
    let patches = |e: &LocalEnvironment| e.patches.iter().map(|p| of(p.centre)).collect();
    environments.iter().map(patches).collect()
}

/// Increases to the right and to the back.
fn slope(at: DVec3) -> Rgb {
    Rgb::new(10.0 + 3.0 * at.x + 2.0 * at.y, 5.0, 1.0)
}

#[test]
fn corners_have_the_mean_of_the_patches_that_meet_there() {
    let (space, environments) = cut();
    let radiosity = light(&environments, slope);
    let mesh = Mesh::new(&space, &environments, Shading::Smooth);
    let lit = mesh.light(&radiosity);
    // The left floor, 2 m × 2 m with four patches: local x from -2 to 0, y from -1 to 1.
    let at = |x, y| mesh.radiosity_at(&lit, 0, DVec3::new(x, y, -0.5));
    // A linear function is reproduced at the inner corner.
    assert!(at(-1.0, 0.0).distance(slope(DVec3::new(-1.0, 0.0, 0.0))) < 1e-12);
    // An outer corner has the radiosity of its only patch.
    assert!(at(-2.0, -1.0).distance(slope(DVec3::new(-1.5, -0.5, 0.0))) < 1e-12);
    // The floors have different materials, so no mean is taken across their edge.
    assert!(at(0.0, 0.0).distance(slope(DVec3::new(-0.5, 0.0, 0.0))) < 1e-12);
    // The middle of a patch has the mean of its corners.
    let corners = [at(-2.0, -1.0), at(-1.0, -1.0), at(-1.0, 0.0), at(-2.0, 0.0)];
    assert!(at(-1.5, -0.5).distance(corners.iter().sum::<Rgb>() / 4.0) < 1e-12);
}

#[test]
fn flat_patches_have_constant_radiosity() {
    let (space, environments) = cut();
    let radiosity = light(&environments, slope);
    let mesh = Mesh::new(&space, &environments, Shading::Flat);
    let lit = mesh.light(&radiosity);
    for (environment, radiosity) in environments.iter().zip(&radiosity) {
        for (patch, &radiosity) in environment.patches.iter().zip(radiosity) {
            for shift in [DVec3::ZERO, DVec3::new(0.3, 0.2, 0.2)] {
                let off = if patch.polygon == 2 {
                    shift * DVec3::new(1.0, 0.0, 1.0)
                } else {
                    shift * DVec3::new(1.0, 1.0, 0.0)
                };
                let found = mesh.radiosity_at(&lit, patch.polygon, patch.centre + off);
                assert!(found.distance(radiosity) < 1e-12, "{patch:?}");
            }
        }
    }
}

/// Two coplanar polygons with patches of different sizes have equal radiosities along their common
/// edge.
#[test]
fn there_is_no_seam_between_patches_of_different_sizes() {
    let rectangle = |[x0, x1]: [f64; 2], height: f64| {
        let points = [[x0, 0.0], [x1, 0.0], [x1, height], [x0, height]];
        let points = points.map(|[x, y]| DVec3::new(x, y, 0.0)).to_vec();
        Face { points, material: 0, object: 0 }
    };
    let materials = scene().materials;
    let faces = [rectangle([0.0, 2.0], 2.0), rectangle([2.0, 3.0], 1.5)];
    let scene = Scene::new(&faces, materials, vec!["floor".to_owned()]).unwrap().0;
    let space = Space::new(scene, [1, 1, 1]);
    let size = PatchSize { reflector: 1.0, emitter: 1.0 };
    let environments = [LocalEnvironment::new(&space, space.grid.whole(), size)];
    let mesh = Mesh::new(&space, &environments, Shading::Smooth);
    let lit = mesh.light(&light(&environments, |at| Rgb::new(at.x * at.y, at.y, 1.0)));
    for share in 1..30 {
        // The edge is at x = 2 and y from 0 to 1.5. Local coordinates are relative to the centre.
        let at = DVec3::new(0.5, 0.05 * f64::from(share) - 1.0, 0.0);
        let [left, right] = [0, 1].map(|polygon| mesh.radiosity_at(&lit, polygon, at));
        assert!(left.distance(right) < 1e-9, "{at}: {left} {right}");
    }
}

/// Inverse of the sRGB transfer function.
fn linear(code: u8) -> f64 {
    let encoded = f64::from(code) / 255.0;
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

/// A pixel in the middle of a patch shows its radiosity, to half a step of the eight bits of the
/// picture.
#[test]
fn pixels_show_the_radiosity() {
    let (space, environments) = cut();
    let radiosity = light(&environments, slope);
    let mesh = Mesh::new(&space, &environments, Shading::Flat);
    let lit = mesh.light(&radiosity);
    let camera = Camera {
        eye: DVec3::new(0.0, 0.0, 9.0),
        target: DVec3::ZERO,
        up: DVec3::Y,
        field_of_view_degrees: 20.0,
        width: 160,
        height: 120,
    };
    let (exposure, tone) = (Exposure::MiddleGrey(5.0), Tone::Linear);
    let options = PictureOptions { exposure, tone, ..PictureOptions::default() };
    let colour = |polygon, point| mesh.radiosity_at(&lit, polygon, point);
    let picture = render(&space.scene, &camera, colour, options).unwrap();
    // Width of a pixel at the distance of the floor, metres.
    let pixel = 2.0 * 9.5 * 10.0_f64.to_radians().tan() / 120.0;
    let mut seen = 0;
    for (environment, radiosity) in environments.iter().zip(&radiosity) {
        let patches = environment.patches.iter().zip(radiosity);
        for (patch, &expected) in patches.filter(|(patch, _)| patch.polygon < 2) {
            let column = (80.0 + patch.centre.x / pixel) as usize;
            let row = (60.0 - patch.centre.y / pixel) as usize;
            let codes = &picture.rgb[3 * (row * 160 + column)..][..3];
            for (channel, &code) in codes.iter().enumerate() {
                let shown = |code: u8| linear(code) * 5.0 / 0.18;
                let step = shown(code.saturating_add(1)) - shown(code.saturating_sub(1));
                let found = shown(code);
                assert!((found - expected[channel]).abs() <= 0.26 * step, "{found} {expected}");
            }
            seen += 1;
        }
    }
    assert_eq!(seen, 8);
}

/// Whatever is up becomes y, with lengths and handedness kept.
#[test]
fn up_is_y_in_a_gltf_file() {
    let (space, environments) = cut();
    let mesh = Mesh::new(&space, &environments, Shading::Flat);
    let lit = mesh.light(&light(&environments, slope));
    let tilted = DVec3::new(1.0, 2.0, -2.0) / 3.0;
    for up in [DVec3::Z, DVec3::Y, DVec3::NEG_Y, DVec3::X, DVec3::NEG_Z, tilted] {
        let (exposure, tone) = (Exposure::MiddleGrey(5.0), Tone::Reinhard);
        let (bytes, _) = mesh.to_glb(&lit, DVec3::ZERO, up, exposure, tone).unwrap();
        let file = gltf::Gltf::from_slice(&bytes).unwrap();
        let node = file.scenes().next().unwrap().nodes().next().unwrap();
        let turn =
            glam::DMat4::from_cols_array_2d(&node.transform().matrix().map(|c| c.map(f64::from)));
        let turned = turn.transform_vector3(up);
        assert!(turned.distance(DVec3::Y) < 1e-6, "{up} becomes {turned}");
        assert!((turn.determinant() - 1.0).abs() < 1e-6);
    }
}

/// An independent reader finds the mesh, its radiosities and the colours of a picture in a glTF
/// file.
#[test]
fn a_gltf_file_contains_mesh_radiosities_and_colours() {
    let (space, environments) = cut();
    let radiosity = light(&environments, slope);
    for (shading, vertices) in [(Shading::Smooth, 12 + 9 + 9 + 10), (Shading::Flat, 5 * 12)] {
        let mesh = Mesh::new(&space, &environments, shading);
        let lit = mesh.light(&radiosity);
        let exposure = Exposure::MiddleGrey(5.0);
        let origin = space.scene.origin;
        let up = space.scene.up;
        let (bytes, middle) = mesh.to_glb(&lit, origin, up, exposure, Tone::Reinhard).unwrap();
        assert_eq!(middle, 5.0);
        let file = gltf::Gltf::from_slice(&bytes).unwrap();
        let blob = file.blob.as_deref().unwrap();
        let node = file.scenes().next().unwrap().nodes().next().unwrap();
        let turn =
            glam::DMat4::from_cols_array_2d(&node.transform().matrix().map(|c| c.map(f64::from)));
        let child = node.children().next().unwrap();
        let (shift, ..) = child.transform().decomposed();
        assert_eq!(shift, origin.as_vec3().to_array());
        let primitive = child.mesh().unwrap().primitives().next().unwrap();
        assert!(primitive.material().unlit());
        let reader = primitive.reader(|_| Some(blob));
        let positions: Vec<[f32; 3]> = reader.read_positions().unwrap().collect();
        assert_eq!(positions.len(), vertices, "{shading:?}");
        let colours: Vec<[f32; 3]> = reader.read_colors(0).unwrap().into_rgb_f32().collect();
        let Some(ReadIndices::U32(indices)) = reader.read_indices() else { panic!("32 bits") };
        let indices: Vec<u32> = indices.collect();
        assert_eq!(indices.len(), 12 * 4 * 3);
        // 12 m² of floors and wall, which face up and to -y. In the file up is y.
        let corner = |i: u32| DVec3::from(positions[i as usize].map(f64::from));
        let areas = indices
            .chunks(3)
            .map(|t| (corner(t[1]) - corner(t[0])).cross(corner(t[2]) - corner(t[0])) / 2.0);
        let area = turn.transform_vector3(areas.sum());
        assert!(area.distance(DVec3::new(0.0, 8.0, 4.0)) < 1e-6, "{area}");
        for ((&place, normal), (&rgb, colour)) in
            mesh.positions().iter().zip(mesh.normals()).zip(lit.iter().zip(&colours))
        {
            let shown = Tone::Reinhard.map(rgb / 5.0).as_vec3().to_array();
            assert_eq!(colour, &shown, "{place} {normal}");
        }
        let extras: Vec<_> = primitive.attributes().collect();
        let (_, accessor) = extras
            .iter()
            .find(|(semantic, _)| *semantic == gltf::Semantic::Extras("RADIOSITY".to_owned()))
            .unwrap();
        let stored = gltf::accessor::Iter::<[f32; 3]>::new(accessor.clone(), |_| Some(blob));
        let stored: Vec<[f32; 3]> = stored.unwrap().collect();
        let expected: Vec<[f32; 3]> = lit.iter().map(|rgb| rgb.as_vec3().to_array()).collect();
        assert_eq!(stored, expected);
    }
}
