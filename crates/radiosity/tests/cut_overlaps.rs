//! What faces that overlap in one plane leave of each other, compared with a slow rule for single points.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use proptest::prelude::*;
use radiosity::glam::{DVec2, DVec3};
use radiosity::{Face, Material, Polygon, Rgb, Scene, WarningKind};

/// Two lamps and two surfaces without light.
fn materials() -> Vec<Material> {
    let material = |(reflectance, emission): (f64, f64)| Material {
        name: format!("{reflectance} {emission}"),
        reflectance: Rgb::splat(reflectance),
        emission: Rgb::splat(emission),
        two_sided: false,
    };
    [(0.8, 0.0), (0.2, 0.0), (0.5, 9.0), (0.0, 4.0)].map(material).to_vec()
}

/// Corners of a convex face, counter-clockwise.
fn outline() -> impl Strategy<Value = Vec<DVec2>> {
    let number = || 0.5..3.5;
    let level = (number(), number(), 0.3..2.0, 0.3..2.0).prop_map(|(x, y, w, h)| {
        [[0.0, 0.0], [w, 0.0], [w, h], [0.0, h]]
            .map(|at| DVec2::new(x, y) + DVec2::from(at))
            .to_vec()
    });
    let turned = (level.clone(), 0.0..1.5).prop_map(|(corners, angle)| {
        corners.into_iter().map(|p| corners_about(p, angle)).collect()
    });
    let triangle = (number(), number(), 0.0..6.0, 0.4..2.0).prop_map(|(x, y, angle, size)| {
        let at = |turn: f64| DVec2::new(x, y) + DVec2::from_angle(angle + turn) * size;
        vec![at(0.0), at(1.7), at(3.9)]
    });
    // Whole numbers of quarters share edges and corners.
    let quarters = level.clone().prop_map(|corners: Vec<DVec2>| {
        corners.into_iter().map(|p: DVec2| (p * 4.0).ceil() / 4.0).collect()
    });
    prop_oneof![level, turned, triangle, quarters]
}

fn corners_about(p: DVec2, angle: f64) -> DVec2 {
    let centre = DVec2::splat(2.0);
    centre + DVec2::from_angle(angle).rotate(p - centre)
}

/// Faces of one plane over a floor that all of them are on, each an object.
fn faces() -> impl Strategy<Value = Vec<Face>> {
    let face = (outline(), 0..4_u32);
    let floor = [[-4.0, -4.0], [9.0, -4.0], [9.0, 9.0], [-4.0, 9.0]].map(DVec2::from).to_vec();
    let slope = prop_oneof![Just(0.0), -1.0..1.0];
    (prop::collection::vec(face, 2..=3), slope).prop_map(move |(faces, slope)| {
        let all = faces.into_iter().chain([(floor.clone(), 0)]);
        let lifted = |p: DVec2| DVec3::new(p.x, p.y, 1.0 + slope * p.x);
        let face = |((points, material), object): ((Vec<DVec2>, u32), u32)| Face {
            points: points.into_iter().map(lifted).collect(),
            material,
            object,
        };
        all.zip(0..).map(face).collect()
    })
}

/// The scene, and the area of the overlaps that it warns of.
fn scene(faces: &[Face]) -> (Scene, f64) {
    let objects = ["a", "b", "c", "d"].map(str::to_owned).to_vec();
    let (scene, warnings) = Scene::new(faces, materials(), objects).unwrap();
    let overlap = warnings.iter().find(|warning| warning.kind == WarningKind::Overlap);
    (scene, overlap.map_or(0.0, |warning| warning.area))
}

/// How far a point is inside a convex outline, seen from above; negative outside.
fn depth(corners: &[DVec3], at: DVec2) -> f64 {
    let next = corners.iter().cycle().skip(1);
    let edges = corners.iter().zip(next).map(|(a, b)| (a.truncate(), (*b - *a).truncate()));
    edges.map(|(from, edge)| edge.normalize().perp_dot(at - from)).fold(f64::INFINITY, f64::min)
}

/// The areas of faces, by projection.
fn area(face: &Face) -> f64 {
    let [first, rest @ ..] = face.points.as_slice() else { return 0.0 };
    rest.windows(2).map(|p| (p[0] - *first).cross(p[1] - *first).length() / 2.0).sum()
}

/// The material that is seen at a point, by the rule: lights first, then the smaller face, then the
/// brighter one.
fn seen(faces: &[Face], at: DVec2) -> Option<u32> {
    let materials = materials();
    let here = faces.iter().filter(|face| depth(&face.points, at) > 0.0);
    let key = |face: &&Face| {
        let Material { reflectance, emission, .. } = &materials[face.material as usize];
        // Areas of the same rectangle elsewhere differ by rounding.
        (emission.x == 0.0, (area(face) * 1e9).round(), -emission.x, -reflectance.x)
    };
    here.min_by(|a, b| key(a).partial_cmp(&key(b)).unwrap()).map(|face| face.material)
}

/// The outlines of a scene and their objects, in an order of their own.
fn sorted_outlines(scene: &Scene) -> Vec<(u32, Vec<[u64; 3]>)> {
    let outline = |polygon: &Polygon| {
        let bits = |p: DVec3| (p + 0.0).to_array().map(f64::to_bits);
        let mut corners: Vec<[u64; 3]> = scene.corners(polygon).map(bits).collect();
        let least = (0..corners.len()).min_by_key(|&place| corners[place]).unwrap();
        corners.rotate_left(least);
        (polygon.object, corners)
    };
    let mut outlines: Vec<_> = scene.polygons.iter().map(outline).collect();
    outlines.sort();
    outlines
}

proptest! {
    /// At each point one polygon is left: the one that the rule says.
    #[test]
    fn each_point_has_one_polygon(faces in faces(), points in prop::collection::vec((0.0..4.0, 0.0..4.0), 40)) {
        let (scene, _) = scene(&faces);
        for at in points.into_iter().map(|(x, y)| DVec2::new(x, y)) {
            let local = at - scene.origin.truncate();
            let depths: Vec<(f64, u32)> = scene.polygons.iter().map(|polygon| {
                (depth(&scene.corners(polygon).collect::<Vec<_>>(), local), polygon.material)
            }).collect();
            if depths.iter().any(|(depth, _)| depth.abs() < 1e-6) {
                continue;
            }
            let found: Vec<u32> =
                depths.iter().filter(|(depth, _)| *depth > 0.0).map(|(_, material)| *material).collect();
            prop_assert_eq!(found, Vec::from_iter(seen(&faces, at)), "{}", at);
        }
    }

    /// Areas add up to that of the floor, pieces are cut no further, and all is the same to the bit
    /// whatever the order of the faces.
    #[test]
    fn pieces_tile_the_plane(faces in faces(), turn in 0..4_usize, swap in any::<bool>()) {
        let (first, overlap) = scene(&faces);
        let floor = area(faces.last().unwrap());
        prop_assert!((first.area() - floor).abs() < 1e-7 * floor, "{} {}", first.area(), floor);
        for polygon in &first.polygons {
            let face = Face { points: first.corners(polygon).collect(), material: 0, object: 0 };
            prop_assert!((area(&face) - polygon.area).abs() < 1e-12 * floor);
            let normal = polygon.plane.normal;
            let off = |p: DVec3| (normal.dot(p) - polygon.plane.offset).abs();
            prop_assert!(first.corners(polygon).all(|p| off(p) < 1e-12));
        }

        let pieces = first.polygons.iter().map(|polygon| Face {
            points: first.corners(polygon).map(|p| p + first.origin).collect(),
            material: polygon.material,
            object: polygon.object,
        });
        let (again, more) = scene(&pieces.collect::<Vec<_>>());
        prop_assert!(more == 0.0 && again.polygons.len() == first.polygons.len(), "{}", more);

        let mut others = faces;
        let by = turn % others.len();
        others.rotate_left(by);
        if swap {
            others.swap(0, 1);
        }
        let (other, the_same) = scene(&others);
        prop_assert_eq!(sorted_outlines(&first), sorted_outlines(&other));
        prop_assert!((overlap - the_same).abs() < 1e-12 * floor);
    }
}

/// The pieces of a level face have corners with the very coordinates of what covers it.
#[test]
fn a_lamp_leaves_a_frame() {
    let rectangle = |[x0, x1]: [f64; 2], [y0, y1]: [f64; 2], material| Face {
        points: [[x0, y0], [x1, y0], [x1, y1], [x0, y1]]
            .map(|[x, y]| DVec3::new(x, y, 0.3))
            .to_vec(),
        material,
        object: material,
    };
    let ceiling = rectangle([0.0, 3.0], [0.0, 3.0], 0);
    let (scene, overlap) = scene(&[ceiling, rectangle([1.1, 1.8], [1.0, 1.7], 2)]);
    assert_eq!(scene.polygons.len(), 5, "four pieces and the lamp");
    assert!((overlap - 0.49).abs() < 1e-12 && (scene.area() - 9.0).abs() < 1e-12);
    assert!((scene.emitted_power().x - 9.0 * 0.49).abs() < 1e-12);
    // Each of the lamp's corners is one vertex, shared with the pieces.
    assert_eq!(scene.vertices.len(), 4 + 4 + 4);
}
