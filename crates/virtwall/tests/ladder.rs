//! Rays scaled by unshot energy: fewer for dimmer sources, and masks that still add no error.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use std::collections::BTreeSet;
use std::sync::Arc;

use common::{face, grey, options, paragon, rules, same, scene, sides};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use radiosity::{Hemisphere, HemisphereKind, Light, Mask, Rgb, Scene, shoot, shoot_plainly};
use virtwall::{KeptShots, Message, Problem, Rules, Run, Source, simulate};

const PIXELS: u32 = 4_096;

/// An open room of 8 × 4 × 4 m with a lamp at one end and a block at the other.
fn open_room() -> Scene {
    let mut faces = sides([0.0; 3], [8.0, 4.0, 4.0], [0; 6], true);
    let lamp = [[1.0, 1.0, 3.9], [1.0, 2.0, 3.9], [2.0, 2.0, 3.9], [2.0, 1.0, 3.9]];
    faces.push(face(&lamp, 1));
    faces.extend(sides([5.0, 1.0, 0.0], [6.0, 2.0, 2.0], [0; 6], false));
    scene(&faces, vec![grey(0.4, 0.0), grey(0.0, 100.0)])
}

fn problem(cut: [u32; 3], smaller: &[u32]) -> Problem {
    let hemisphere = |&pixels| Hemisphere::new(HemisphereKind::Fibonacci, pixels, true).unwrap();
    Problem::new(open_room(), options([8, 4, 4], cut, PIXELS, 1.0))
        .unwrap()
        .with_smaller_hemispheres(smaller.iter().map(hemisphere).collect())
}

fn run(problem: &Arc<Problem>, bytes: usize) -> Run {
    Run {
        problem: Arc::clone(problem),
        processors: problem.environments.len(),
        rules: Rules { patch_threshold: 1e-3, ..rules() },
        kept: Arc::new(KeptShots::new(bytes)),
        on_shot: Arc::new(|_| ()),
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 200,
        rng_seed: RngSeed::Fixed(1996),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    /// No ray carries more than those of the brightest patch, and the next smaller hemisphere's would.
    #[test]
    fn rays_carry_as_much_as_they_may(share in 0.0..1.0f64, dimmer in 0..12i32) {
        let sizes = [1_024, 256, 64, 7];
        let problem = problem([1, 1, 1], &sizes);
        // The lamp is one patch of 1 m².
        let power = Rgb::splat(100.0 * share * 0.5f64.powi(dimmer));
        let pixels = problem.hemisphere_for(power).pixels();
        let carried = |pixels: u32| power.x / f64::from(pixels);
        let most = 100.0 / f64::from(PIXELS);
        prop_assert!(carried(pixels) <= most * 1.000_001);
        if let Some(&smaller) = sizes.iter().find(|&&size| size < pixels) {
            prop_assert!(carried(smaller) > most);
        }
    }
}

/// A quarter of the power has a quarter of the rays, to the last digit or not.
#[test]
fn rounding_decides_nothing() {
    let problem = problem([1, 1, 1], &[1_024, 256]);
    for (share, pixels) in [(1.0, 4_096), (0.25, 1_024), (0.25 + 1e-12, 1_024), (0.0, 256)] {
        assert_eq!(problem.hemisphere_for(Rgb::splat(100.0 * share)).pixels(), pixels, "{share}");
        assert_eq!(problem.hemisphere_for(Rgb::splat(-100.0 * share)).pixels(), pixels);
    }
    // The mask says whose it is.
    assert_eq!(problem.hemisphere_of(&Mask::none(256)).pixels(), 256);
}

/// A patch's place and radiosity.
type Told = ([i64; 3], Rgb);

/// Radiosities by place after six rounds in which every patch shoots what it has, in the order of their
/// places; and the lengths of the masks that this took. Every shot is also cast plainly, every mask
/// handed on is encoded.
fn light(problem: &Problem) -> (Vec<Told>, BTreeSet<u32>) {
    let place = |x: f64| (x * 1e6).round() as i64;
    let environments = || (0u32..).zip(&problem.environments);
    let mut order: Vec<([i64; 3], u32, u32)> = environments()
        .flat_map(|(e, environment)| {
            let patches = (0u32..).zip(&environment.patches).filter(|(_, patch)| patch.area > 0.0);
            patches.map(move |(i, patch)| (patch.centre.to_array().map(place), e, i))
        })
        .collect();
    order.sort_unstable();
    let mut lights: Vec<Light> =
        environments().map(|(_, environment)| Light::new(&problem.space, environment)).collect();
    let mut lengths = BTreeSet::new();
    for &(_, e, patch) in order.iter().cycle().take(6 * order.len()) {
        let environment = &problem.environments[e as usize];
        let source = lights[e as usize].emitter(&problem.space, environment, e, patch);
        lights[e as usize].unshot[patch as usize] = Rgb::ZERO;
        let mask = Mask::all(problem.hemisphere_for(source.power).pixels());
        let mut waiting =
            vec![Source { environment: e, shot: 0, emitter: source, mask, form_factor: 1.0 }];
        while let Some(parcel) = waiting.pop() {
            let (here, mask) = (&problem.environments[parcel.environment as usize], &parcel.mask);
            lengths.insert(mask.pixels());
            let [fast, plain] = [shoot, shoot_plainly].map(|shoot| {
                shoot(&problem.space, here, problem.hemisphere_of(mask), &source, mask)
            });
            assert_eq!(fast, plain);
            lights[parcel.environment as usize].receive(&source, &fast);
            for onward in problem.onward(&parcel, &fast) {
                let message = Message::Source(Box::new(onward.clone()));
                let bytes = message.encode();
                assert_eq!(bytes.len() as u32, 129 + onward.mask.pixels().div_ceil(64) * 8);
                assert_eq!(Message::decode(&bytes), Ok(message));
                waiting.push(onward);
            }
        }
    }
    let told = |&(place, e, patch): &([i64; 3], u32, u32)| {
        (place, lights[e as usize].radiosity(&problem.environments[e as usize], patch))
    };
    (order.iter().map(told).collect(), lengths)
}

/// Masks add no error: whatever the cut, the same sources shot in the same order light every patch the
/// same but for rounding.
#[test]
fn any_cut_finds_the_same_light() {
    let smaller = [256, 64, 16];
    let (whole, lengths) = light(&problem([1, 1, 1], &smaller));
    assert_eq!(lengths, BTreeSet::from([16, 64, 256, 4_096]));
    for cut in [[2, 1, 1], [4, 1, 1], [8, 1, 1]] {
        let (parts, _) = light(&problem(cut, &smaller));
        assert_eq!(parts.len(), whole.len());
        for (one, other) in whole.iter().zip(&parts) {
            let apart = (one.1 - other.1).length();
            let same = one.0 == other.0 && apart <= 1e-12 * one.1.length();
            assert!(same, "{cut:?}: {one:?} {other:?}");
        }
    }
}

/// Kept shots tell hemispheres apart; energy closes; fewer rays and shorter messages do it.
#[test]
fn dim_sources_cost_less() {
    let full = Arc::new(problem([4, 1, 1], &[]));
    let scaled = Arc::new(problem([4, 1, 1], &[1_024, 256, 64]));
    let [all, fewer] = [full, scaled].map(|problem| {
        let kept = simulate(&run(&problem, 64 << 20), &paragon()).unwrap();
        same(&kept, &simulate(&run(&problem, 0), &paragon()).unwrap());
        assert!(kept.energy.error() < 1e-12, "{:?}", kept.energy);
        kept
    });
    assert!(fewer.time.as_seconds_f64() < 0.3 * all.time.as_seconds_f64());
    let bytes = |counts: &virtwall::Counts| counts.message_bytes as f64 / counts.messages as f64;
    assert!(bytes(&fewer.counts) < 0.5 * bytes(&all.counts));
}
