//! Knobs that trade accuracy for time: each closes the energy, and does what it is for.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use std::sync::Arc;

use common::{paragon, rules, two_rooms_cut};
use virtwall::{KeptShots, Outcome, Problem, Rules, Run, Shooting, SourceSplit, simulate};

fn outcome(problem: &Arc<Problem>, patch_threshold: f64, shooting: Shooting) -> Outcome {
    let run = Run {
        problem: Arc::clone(problem),
        processors: problem.environments.len(),
        rules: Rules { patch_threshold, shooting, ..rules() },
        kept: Arc::new(KeptShots::new(64 << 20)),
        on_shot: Arc::new(|_| ()),
    };
    let outcome = simulate(&run, &paragon()).unwrap();
    assert!(outcome.energy.error() < 1e-12, "{:?}", outcome.energy);
    outcome
}

/// The root mean square by which radiosities differ, over that of one of them, both by area.
fn difference(problem: &Problem, one: &Outcome, other: &Outcome) -> f64 {
    let areas = problem.environments.iter().flat_map(|e| e.patches.iter().map(|patch| patch.area));
    let pairs = one.radiosity.iter().flatten().zip(other.radiosity.iter().flatten());
    let sums = areas.zip(pairs).fold([0.0; 2], |[off, all], (area, (a, b))| {
        [off + area * (*a - *b).length_squared(), all + area * a.length_squared()]
    });
    (sums[0] / sums[1]).sqrt()
}

#[test]
fn patches_are_cut_where_something_is_near() {
    let problem = two_rooms_cut([1, 1, 1]);
    let shots = |nearer_than, most| {
        let split = SourceSplit { nearer_than, most };
        let outcome = outcome(&problem, 0.004, Shooting { split, ..Shooting::default() });
        (outcome.counts.local_shots, outcome.energy.unshot)
    };
    let (whole, _) = shots(f64::INFINITY, 1);
    let (quarters, _) = shots(f64::INFINITY, 2);
    let (near, _) = shots(1.5, 2);
    assert!(whole < near && near < quarters, "{whole} {near} {quarters}");
    // Not quite four times as many, since what they find is not the same.
    assert!((quarters as f64 / whole as f64 - 4.0).abs() < 0.4, "{quarters} {whole}");
}

#[test]
fn over_shooting_gets_there_sooner() {
    let problem = two_rooms_cut([1, 1, 1]);
    let to = |threshold, overshoot| {
        outcome(&problem, threshold, Shooting { overshoot, ..Shooting::default() })
    };
    let answer = to(1e-6, 1.0);
    let [plain, over] = [1.0, 1.2].map(|overshoot| to(2e-3, overshoot));
    assert!(over.counts.local_shots < plain.counts.local_shots);
    assert!(difference(&problem, &answer, &over) < difference(&problem, &answer, &plain));
    assert!(difference(&problem, &answer, &to(1e-6, 1.2)) < 1e-4);
}

/// The ambient term is told, not shot.
#[test]
fn the_ambient_term_is_for_display() {
    let problem = two_rooms_cut([2, 1, 1]);
    let told = |threshold, ambient| {
        outcome(&problem, threshold, Shooting { ambient, ..Shooting::default() })
    };
    let answer = told(1e-6, false);
    let (plain, ambient) = (told(0.1, false), told(0.1, true));
    assert_eq!(plain.energy, ambient.energy);
    assert_eq!((plain.time, plain.counts), (ambient.time, ambient.counts));
    assert!(difference(&problem, &answer, &ambient) < 0.7 * difference(&problem, &answer, &plain));
}
