//! Rays that end exactly on borders between patches, where the scene is cut.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use std::collections::BTreeMap;

use common::{face, grey, scene, sides};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use radiosity::{
    Emitter, Face, Hemisphere, HemisphereKind, Mask, PatchSize, Rgb, Scene, Side, shoot,
};
use virtwall::{Problem, ProblemOptions};

/// A room of 4 × 4 × 4 cells, whose ceiling and floor are strips that end on planes of the grid; and a block
/// on planes of the grid.
#[derive(Clone, Debug)]
struct Room {
    cell: [f64; 3],
    /// Where the floor and the ceiling are divided, in cells, and the order of their strips.
    strips: [(Vec<u32>, bool); 2],
    block: Option<[u32; 3]>,
    /// Patches along a cell.
    patches: u32,
    cut: [u32; 3],
    directions: HemisphereKind,
}

fn room() -> impl Strategy<Value = Room> {
    let cell = prop_oneof![Just([1.0; 3]), Just([0.7, 0.7, 0.9]), Just([1.1, 0.3, 0.37])];
    let divided = || {
        let borders = prop_oneof![
            Just(vec![]),
            Just(vec![2]),
            Just(vec![1, 3]),
            Just(vec![1, 2]),
            Just(vec![1, 2, 3])
        ];
        (borders, any::<bool>())
    };
    let block = proptest::option::of([1u32..3, 1u32..3, 1u32..3]);
    let along = || prop_oneof![Just(1u32), Just(2), Just(4)];
    let cut = [along(), along(), along()];
    let directions = prop_oneof![Just(HemisphereKind::Hemicube), Just(HemisphereKind::Concentric)];
    (cell, [divided(), divided()], block, 1u32..3, cut, directions).prop_map(
        |(cell, strips, block, patches, cut, directions)| Room {
            cell,
            strips,
            block,
            patches,
            cut,
            directions,
        },
    )
}

impl Room {
    fn scene(&self) -> Scene {
        let [x, y, z] = self.cell;
        let shell = sides([0.0; 3], self.cell.map(|cell| 4.0 * cell), [0; 6], true);
        let mut faces: Vec<Face> = shell[2..].to_vec();
        for ((borders, turned), height) in self.strips.iter().zip([0.0, 4.0 * z]) {
            let ends: Vec<u32> =
                [0].into_iter().chain(borders.iter().copied()).chain([4]).collect();
            let mut strips: Vec<Face> = Vec::new();
            for end in ends.windows(2) {
                let [from, to] = [end[0], end[1]].map(|cells| f64::from(cells) * x);
                let [near, far] = [0.0, 4.0 * y];
                let mut quad = [
                    [from, near, height],
                    [to, near, height],
                    [to, far, height],
                    [from, far, height],
                ];
                if height > 0.0 {
                    quad.reverse();
                }
                strips.push(face(&quad, 0));
            }
            if *turned {
                strips.reverse();
            }
            faces.extend(strips);
        }
        if let Some(at) = self.block {
            let corner = |more: u32| [0, 1, 2].map(|a| f64::from(at[a] + more) * self.cell[a]);
            faces.extend(sides(corner(0), corner(1), [0; 6], false));
        }
        scene(&faces, vec![grey(0.5, 1.0)])
    }

    fn problem(&self, cut: [u32; 3]) -> Problem {
        let size = self.cell.into_iter().fold(f64::INFINITY, f64::min) / f64::from(self.patches);
        let hemisphere = Hemisphere::new(self.directions, 108, false);
        let hemisphere = hemisphere.or_else(|_| Hemisphere::new(self.directions, 100, false));
        let options = ProblemOptions {
            patch_size: PatchSize { reflector: size, emitter: size },
            cells: [4; 3],
            cut,
            hemisphere: hemisphere.unwrap(),
        };
        Problem::new(self.scene(), options).unwrap()
    }
}

/// A patch in any decomposition: its polygon, and its centre in steps of a micrometre.
type Place = (u32, [i64; 3]);

fn place(problem: &Problem, environment: usize, patch: u32) -> Place {
    let patch = problem.environments[environment].patches[patch as usize];
    (patch.polygon, patch.centre.to_array().map(|c| (c * 1e6).round() as i64))
}

/// The form factors from each patch to all patches.
fn form_factors(problem: &Problem) -> BTreeMap<Place, BTreeMap<Place, f64>> {
    let all = Mask::all(problem.hemisphere.pixels());
    let mut rows = BTreeMap::new();
    for (number, own) in problem.environments.iter().enumerate() {
        for (index, patch) in (0..).zip(&own.patches).filter(|(_, patch)| patch.area > 0.0) {
            let emitter = Emitter {
                environment: number as u32,
                patch: index,
                polygon: patch.polygon,
                centre: patch.centre,
                normal: problem.space.scene.polygons[patch.polygon as usize].plane.normal,
                power: Rgb::ONE,
                radiosity: Rgb::ONE,
            };
            let mut row: BTreeMap<Place, f64> = BTreeMap::new();
            let mut waiting = vec![(number as u32, all.clone())];
            while let Some((here, mask)) = waiting.pop() {
                let environment = &problem.environments[here as usize];
                let shot = shoot(&problem.space, environment, &problem.hemisphere, &emitter, &mask);
                for (hit, form_factor) in shot.hits {
                    *row.entry(place(problem, here as usize, hit)).or_default() += form_factor;
                }
                for (side, outgoing) in Side::ALL.into_iter().zip(shot.outgoing) {
                    let there = || problem.decomposition.neighbour(here, side);
                    waiting.extend(outgoing.map(|outgoing| (there(), outgoing.mask)));
                }
            }
            rows.insert(place(problem, number, index), row);
        }
    }
    rows
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 32, rng_seed: RngSeed::Fixed(7), failure_persistence: None, ..ProptestConfig::default()
    })]

    /// With unrotated directions many rays end exactly on a border between patches, also where the scene is
    /// cut. Every decomposition gives such a ray to the same patch.
    #[test]
    fn a_border_has_one_owner_in_every_decomposition(room in room()) {
        let (whole, cut) = (form_factors(&room.problem([1; 3])), form_factors(&room.problem(room.cut)));
        prop_assert_eq!(whole.len(), cut.len());
        for (from, row) in &whole {
            for (to, form_factor) in row {
                let other = cut[from].get(to).copied().unwrap_or(0.0);
                prop_assert!((form_factor - other).abs() < 1e-12, "{from:?} {to:?} {form_factor} {other}");
            }
        }
    }
}
