//! Participating media: Beer and Lambert's law through masks of integers, however space is cut.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use std::sync::Arc;

use common::{grey, paragon, rules, same, scene, sides, two_rooms};
use radiosity::glam::DVec3;
use radiosity::{
    Bounds, DepthBits, Emitter, Hemisphere, HemisphereKind, LocalEnvironment, Mask, Medium,
    PatchSize, Ray, Rgb, Scene, Side, Space, VirtualWalls, optical_depth, shoot,
};
use virtwall::{Ending, KeptShots, Outcome, Problem, ProblemOptions, Rules, Run, simulate};

const BITS: [DepthBits; 2] = [DepthBits::Eight, DepthBits::Sixteen];

/// A medium between two corners in the world.
fn filled(mut scene: Scene, low: [f64; 3], high: [f64; 3], absorption: f64) -> Scene {
    let [min, max] = [low, high].map(|corner| DVec3::from(corner) - scene.origin);
    scene.media.push(Medium { bounds: Bounds { min, max }, absorption });
    scene
}

/// A black box of 4 × 4 × 8 m, its floor a lamp, filled between two heights.
fn slab(from: f64, to: f64, absorption: f64) -> Scene {
    let shell = sides([0.0; 3], [4.0, 4.0, 8.0], [1, 0, 0, 0, 0, 0], true);
    let shell = scene(&shell, vec![grey(0.0, 0.0), grey(0.0, 10.0)]);
    filled(shell, [0.0, 0.0, from], [4.0, 4.0, to], absorption)
}

/// The two rooms in smoke, thicker in one corner.
fn smoky_rooms() -> Scene {
    let thin = filled(two_rooms(), [-1.0, 0.5, 0.0], [6.3, 2.7, 2.5], 0.2);
    filled(thin, [0.0; 3], [2.2, 1.1, 3.0], 0.7)
}

fn problem(scene: Scene, cut: [u32; 3], kind: HemisphereKind, pixels: u32) -> Problem {
    let options = ProblemOptions {
        patch_size: PatchSize { reflector: 1.0, emitter: 0.5 },
        cells: [8, 4, 8],
        cut,
        hemisphere: Hemisphere::new(kind, pixels, false).unwrap(),
    };
    Problem::new(scene, options).unwrap()
}

fn run(problem: Problem, rules: Rules) -> Run {
    Run {
        processors: problem.environments.len(),
        problem: Arc::new(problem),
        rules,
        kept: Arc::new(KeptShots::new(1 << 28)),
        on_shot: Arc::new(|_| ()),
    }
}

fn outcome(problem: Problem, rules: Rules) -> Outcome {
    let outcome = simulate(&run(problem, rules), &paragon()).unwrap();
    assert!(outcome.energy.error() < 1e-9, "{:?}", outcome.energy);
    assert_eq!(outcome.ending, Ending::Agreed);
    outcome
}

fn share(part: Rgb, outcome: &Outcome) -> f64 {
    part.element_sum() / outcome.energy.emitted.element_sum()
}

/// A hemisphere of one pixel sends all light straight up: what arrives is exp(-σd), but for half a step of
/// the mask's integers each time that it was handed on.
#[test]
fn a_slab_lets_through_what_beer_and_lambert_say() {
    for (from, to, absorption) in [(1.3, 6.1, 0.5), (0.0, 8.0, 0.137), (3.0, 3.01, 40.0)] {
        let exact = -absorption * (to - from);
        for environments in [1, 2, 4, 8] {
            for bits in BITS {
                let scene = slab(from, to, absorption);
                let one_ray = problem(scene, [1, 1, environments], HemisphereKind::Concentric, 1);
                let outcome = outcome(one_ray.with_depth_bits(bits), rules());
                let depth = share(outcome.energy.absorbed, &outcome).ln();
                let bound = f64::from(environments - 1) * bits.step() / 2.0 + 1e-12;
                assert!((depth - exact).abs() <= bound, "{environments} {bits:?}: {depth} {exact}");
                let dimmed = share(outcome.energy.medium, &outcome);
                assert!((dimmed + depth.exp() - 1.0).abs() < 1e-9, "{dimmed}");
            }
        }
    }
}

/// Light dimmed beyond the last step is absorbed there, and no message carries it.
#[test]
fn light_runs_out() {
    let problem = problem(slab(0.0, 4.0, 10.0), [1, 1, 4], HemisphereKind::Concentric, 1);
    let outcome = outcome(problem, rules());
    assert_eq!(outcome.energy.absorbed, Rgb::ZERO);
    assert!((share(outcome.energy.medium, &outcome) - 1.0).abs() < 1e-12);
    // 64 patches, through the first interface only at most.
    assert!(outcome.counts.messages <= 64, "{:?}", outcome.counts);
}

/// Of diffuse light an endless slab lets through 2 E₃(σd) (Abramowitz and Stegun, table 5.4).
#[test]
fn a_slab_dims_diffuse_light_by_the_exponential_integral() {
    for (absorption, exact) in [(0.5, 0.443_209), (1.0, 0.219_384), (2.0, 0.060_267)] {
        let shell = sides([-500.0, -500.0, 0.0], [500.0, 500.0, 1.0], [0; 6], true);
        let shell = scene(&shell, vec![grey(0.0, 0.0)]);
        let shell = filled(shell, [-500.0, -500.0, 0.0], [500.0, 500.0, 1.0], absorption);
        let space = Space::new(shell, [2, 2, 1]);
        let size = PatchSize { reflector: 1e4, emitter: 1e4 };
        let whole = LocalEnvironment::new(&space, space.grid.whole(), size);
        let hemisphere = Hemisphere::new(HemisphereKind::Fibonacci, 30_976, true).unwrap();
        let source = Emitter {
            environment: 0,
            patch: 0,
            polygon: 0,
            centre: DVec3::new(0.3, 0.1, -0.5),
            normal: DVec3::Z,
            power: Rgb::ONE,
            radiosity: Rgb::ONE,
        };
        let shot = shoot(&space, &whole, &hemisphere, &source, &Mask::all(hemisphere.pixels()));
        let left: f64 = shot.hits.iter().map(|&(_, form_factor)| form_factor).sum();
        assert!((left - exact).abs() < 3e-4, "{left} {exact}");
        assert!((left + shot.medium - 1.0).abs() < 1e-12);
    }
}

/// Direct light on every patch, cut or not, within half a step a crossing.
#[test]
fn cuts_change_direct_light_by_half_a_step_a_crossing() {
    let lamp_only = Rules { patch_threshold: 0.9, ..rules() };
    let lit = |cut, bits: DepthBits| {
        let problem = problem(smoky_rooms(), cut, HemisphereKind::Fibonacci, 1_024);
        outcome(problem.with_depth_bits(bits), lamp_only.clone())
    };
    let [exact, clear] = [smoky_rooms(), two_rooms()].map(|scene| {
        outcome(problem(scene, [1; 3], HemisphereKind::Fibonacci, 1_024), lamp_only.clone())
    });
    assert!(share(exact.energy.absorbed, &exact) < 0.8 * share(clear.energy.absorbed, &clear));
    assert_eq!(clear.energy.medium, Rgb::ZERO);
    for cut in [[2, 1, 1], [4, 2, 1], [4, 2, 2]] {
        for bits in BITS {
            let found = lit(cut, bits);
            let crossings = f64::from(cut.iter().sum::<u32>() - 3);
            let bound = (crossings * bits.step() / 2.0).exp_m1() + 1e-9;
            let (some, all) = (found.energy.absorbed, exact.energy.absorbed);
            let off = (some.element_sum() / all.element_sum() - 1.0).abs();
            assert!(off <= bound, "{cut:?} {bits:?}: {off} > {bound}");
        }
    }
}

/// Hits, backs, escapes, what goes on and what the medium takes part the light of a mask among them.
#[test]
fn a_shot_loses_no_light() {
    for bits in BITS {
        let problem = problem(smoky_rooms(), [4, 2, 1], HemisphereKind::Hemicube, 300);
        for (number, environment) in (0u32..).zip(&problem.environments) {
            for (patch, p) in (0u32..).zip(&environment.patches) {
                let source = Emitter {
                    environment: number,
                    patch,
                    polygon: p.polygon,
                    centre: p.centre,
                    normal: problem.space.scene.polygons[p.polygon as usize].plane.normal,
                    power: Rgb::ONE,
                    radiosity: Rgb::ONE,
                };
                let first = Mask::all(problem.hemisphere.pixels()).with_depths(bits);
                let mut waiting = vec![(number, first)];
                while let Some((number, mask)) = waiting.pop() {
                    let environment = &problem.environments[number as usize];
                    let shot =
                        shoot(&problem.space, environment, &problem.hemisphere, &source, &mask);
                    let weight = |i: u32| problem.hemisphere.weights[i as usize];
                    let arriving: f64 =
                        mask.ones().map(|i| weight(i) * mask.transmittance(i)).sum();
                    let hit: f64 = shot.hits.iter().map(|&(_, form_factor)| form_factor).sum();
                    let on: f64 = shot.outgoing.iter().flatten().map(|o| o.form_factor).sum();
                    let all = hit + shot.backs + shot.escaped + on + shot.medium;
                    assert!((all - arriving).abs() < 1e-12, "{all} {arriving}");
                    for (side, outgoing) in Side::ALL.into_iter().zip(shot.outgoing) {
                        let neighbour = || problem.decomposition.neighbour(number, side);
                        waiting.extend(outgoing.map(|outgoing| (neighbour(), outgoing.mask)));
                    }
                }
            }
        }
    }
}

/// Kept, merged, on walls: the same rules as without media. A message takes a byte or two a pixel.
#[test]
fn media_change_nothing_else() {
    let smoky = || problem(smoky_rooms(), [4, 2, 1], HemisphereKind::Fibonacci, 1_024);
    for (bits, bytes) in [(DepthBits::Eight, 1_024), (DepthBits::Sixteen, 2_048)] {
        let run = run(smoky().with_depth_bits(bits), rules());
        let outcome = simulate(&run, &paragon()).unwrap();
        assert_eq!(outcome.counts.message_bytes, outcome.counts.messages * (129 + bytes));
        let forgetful = Run { kept: Arc::new(KeptShots::new(0)), ..run.clone() };
        same(&outcome, &simulate(&forgetful, &paragon()).unwrap());
        same(&outcome, &simulate(&run, &paragon()).unwrap());
    }
    outcome(smoky(), Rules { merge_masks: true, ..rules() });
    let walls = VirtualWalls::new([4, 4], 4, 1_024).unwrap();
    let walled = outcome(smoky().with_walls(walls), rules());
    let masked = outcome(smoky(), rules());
    let [walled, masked] = [walled, masked].map(|o| share(o.energy.medium, &o));
    assert!((walled / masked - 1.0).abs() < 0.05, "{walled} {masked}");
}

/// Depths inside boxes that part a space add up; where media overlap both absorb.
#[test]
fn depths_add_up() {
    let bounds = |min: [f64; 3], max: [f64; 3]| Bounds { min: min.into(), max: max.into() };
    let media = [
        Medium { bounds: bounds([-1.0; 3], [1.0; 3]), absorption: 0.5 },
        Medium { bounds: bounds([0.0, -2.0, -2.0], [3.0, 2.0, 2.0]), absorption: 2.0 },
    ];
    let whole = bounds([-2.0, -2.0, -2.0], [4.0, 2.0, 2.0]);
    let along_x = Ray::new(DVec3::new(-2.0, 0.1, 0.2), DVec3::X);
    let depth = |ray: &Ray, limit| optical_depth(&media, ray, &whole, limit);
    assert_eq!(depth(&along_x, f64::INFINITY), 2.0 * 0.5 + 3.0 * 2.0);
    assert_eq!(depth(&along_x, 2.5), 1.5 * 0.5 + 0.5 * 2.0);
    assert_eq!(depth(&along_x, 0.5), 0.0);
    let directions = [[1.0, 2.0, 3.0], [-1.0, 0.0, 0.5], [0.0, 0.0, 1.0], [0.3, -0.2, 0.0]];
    for direction in directions.map(DVec3::from) {
        // From a point in a side of a medium and in the plane between the parts.
        let ray = Ray::new(DVec3::new(1.0, 0.0, -1.0), direction.normalize());
        let parts = [-2.0, 1.0].map(|low: f64| {
            let high: f64 = if low < 1.0 { 1.0 } else { 4.0 };
            optical_depth(&media, &ray, &bounds([low, -2.0, -2.0], [high, 2.0, 2.0]), 9.0)
        });
        let all = depth(&ray, 9.0);
        let sum = if direction.x == 0.0 { parts[0].max(parts[1]) } else { parts[0] + parts[1] };
        assert!((sum - all).abs() < 1e-12, "{direction}: {parts:?} {all}");
    }
}
