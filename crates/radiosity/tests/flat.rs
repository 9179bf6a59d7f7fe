//! Closed boxes whose corners are beside the planes of their walls, as files round them: no ray leaves.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use proptest::prelude::*;
use radiosity::glam::DVec3;
use radiosity::{
    Block, Emitter, Face, Hemisphere, HemisphereKind, LocalEnvironment, Mask, Material, PatchSize,
    Rgb, Scene, Space, shoot,
};

const SIZE: [f64; 3] = [4.0, 3.0, 2.5];

/// Quads of each wall along an edge.
const QUADS: usize = 2;

/// The walls of a box, seen from inside, with shared corners that are moved.
fn walls(moved: impl Fn([usize; 3]) -> DVec3) -> Vec<Face> {
    let corner = |at: [usize; 3]| {
        let share = |axis: usize| SIZE[axis] * at[axis] as f64 / QUADS as f64;
        DVec3::new(share(0), share(1), share(2)) + moved(at)
    };
    let mut faces = Vec::new();
    for axis in 0..3 {
        for upper in [false, true] {
            for (i, j) in (0..QUADS * QUADS).map(|n| (n / QUADS, n % QUADS)) {
                let at = |di: usize, dj: usize| {
                    let mut at = [0; 3];
                    at[axis] = if upper { QUADS } else { 0 };
                    at[(axis + 1) % 3] = i + di;
                    at[(axis + 2) % 3] = j + dj;
                    corner(at)
                };
                let mut points = vec![at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
                if upper {
                    points.reverse();
                }
                faces.push(Face { points, material: 0, object: 0 });
            }
        }
    }
    faces
}

/// Share of the light of equally bright patches that leaves the scene or hits backs, in one environment or in two
/// halves.
fn lost(faces: &[Face], halves: bool) -> f64 {
    let scene = Scene::new(faces, vec![Material::default()], vec!["box".to_owned()]).unwrap().0;
    let space = Space::new(scene, [4, 4, 4]);
    let whole = space.grid.whole();
    let (mut low, mut high) = (whole, whole);
    (low.high[0], high.low[0]) = (2, 2);
    let blocks: Vec<Block> = if halves { vec![low, high] } else { vec![whole] };
    let size = PatchSize { reflector: 1.0, emitter: 1.0 };
    let environments: Vec<LocalEnvironment> =
        blocks.into_iter().map(|block| LocalEnvironment::new(&space, block, size)).collect();
    let hemisphere = Hemisphere::new(HemisphereKind::Fibonacci, 256, false).unwrap();
    let (mut lost, mut area) = (0.0, 0.0);
    for (own, environment) in environments.iter().enumerate() {
        for (number, patch) in environment.patches.iter().enumerate() {
            area += patch.area;
            let emitter = Emitter {
                environment: own as u32,
                patch: number as u32,
                polygon: patch.polygon,
                centre: patch.centre,
                normal: space.scene.polygons[patch.polygon as usize].plane.normal,
                power: Rgb::ONE,
                radiosity: Rgb::ONE,
            };
            let cast = |environment: &LocalEnvironment, mask: &Mask| {
                shoot(&space, environment, &hemisphere, &emitter, mask)
            };
            let shot = cast(environment, &Mask::all(hemisphere.pixels()));
            lost += patch.area * (shot.escaped + shot.backs);
            for outgoing in shot.outgoing.iter().flatten() {
                let shot = cast(&environments[1 - own], &outgoing.mask);
                lost += patch.area * (shot.escaped + shot.backs + left(&shot));
            }
        }
    }
    lost / area
}

/// Form factor of what goes back.
fn left(shot: &radiosity::Shot) -> f64 {
    shot.outgoing.iter().flatten().map(|outgoing| outgoing.form_factor).sum()
}

/// A distance of any order of magnitude up to a thousandth of the box, either way.
fn distance() -> impl Strategy<Value = f64> {
    (-10.0..-3.0, any::<bool>())
        .prop_map(|(order, up)| 10f64.powf(order) * if up { 1.0 } else { -1.0 })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// All corners moved, by distances of one order.
    #[test]
    fn nothing_leaves_a_box_of_rounded_corners(
        order in -10.0..-3.0f64,
        shares in prop::collection::vec(-1.0..1.0f64, 81),
        halves in any::<bool>(),
    ) {
        let moved = |[x, y, z]: [usize; 3]| {
            let at = ((x * 3 + y) * 3 + z) * 3;
            DVec3::from_slice(&shares[at..at + 3]) * 10f64.powf(order)
        };
        prop_assert!(lost(&walls(moved), halves) <= 1e-5);
    }

    /// One corner moved along one axis.
    #[test]
    fn nothing_leaves_a_box_with_a_corner_beside_its_place(
        at in [0..3usize, 0..3usize, 0..3usize],
        axis in 0..3usize,
        distance in distance(),
        halves in any::<bool>(),
    ) {
        let moved = |other: [usize; 3]| {
            if other == at { DVec3::AXES[axis] * distance } else { DVec3::ZERO }
        };
        prop_assert!(lost(&walls(moved), halves) <= 1e-5);
    }
}
