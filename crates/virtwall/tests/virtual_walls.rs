//! Virtual walls in place of masks: energy closes, the same run is the same to the bit, and what they get
//! wrong gets less the finer they are.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

mod common;

use std::sync::Arc;

use common::{face, grey, options, paragon, rules, same, scene, sides, two_rooms};
use desim::Duration;
use radiosity::{Rgb, Scene, VirtualWalls};
use virtwall::{
    Ending, KeptShots, Outcome, Problem, Rules, Run, Selection, run_on_threads, simulate,
};

const CELLS: [u32; 3] = [8, 4, 4];
const RAYS: u32 = 4_096;

/// An open room of 8 × 4 × 4 m with a lamp at one end and a block at the other.
fn open_room() -> Scene {
    let mut faces = sides([0.0; 3], [8.0, 4.0, 4.0], [0; 6], true);
    let lamp = [[1.0, 1.0, 3.9], [1.0, 2.0, 3.9], [2.0, 2.0, 3.9], [2.0, 1.0, 3.9]];
    faces.push(face(&lamp, 1));
    faces.extend(sides([5.0, 1.0, 0.0], [6.0, 2.0, 2.0], [0; 6], false));
    scene(&faces, vec![grey(0.4, 0.0), grey(0.0, 100.0)])
}

fn problem(scene: Scene, cut: [u32; 3]) -> Problem {
    Problem::new(scene, options(CELLS, cut, RAYS, 1.0)).unwrap()
}

/// With virtual walls of p × p wall patches of d × d directions.
fn walled(scene: Scene, cut: [u32; 3], p: u32, d: u32) -> Problem {
    problem(scene, cut).with_walls(VirtualWalls::new([p, p], d, RAYS).unwrap())
}

fn run(problem: Problem, processors: usize, rules: Rules) -> Run {
    Run {
        problem: Arc::new(problem),
        processors,
        rules,
        kept: Arc::new(KeptShots::new(1 << 28)),
        on_shot: Arc::new(|_| ()),
    }
}

/// A patch's place, area and radiosity.
type Told = ([i64; 3], f64, Rgb);

/// Patches in an order that no cut changes, with their area and radiosity.
fn light(problem: &Problem, outcome: &Outcome) -> Vec<Told> {
    let environments = problem.environments.iter().zip(&outcome.radiosity);
    let patches = environments.flat_map(|(environment, radiosity)| {
        let place = |x: f64| (x * 1e6).round() as i64;
        let told = environment.patches.iter().zip(radiosity).filter(|(patch, _)| patch.area > 0.0);
        told.map(move |(p, b)| (p.centre.to_array().map(place), p.area, *b))
    });
    let mut patches: Vec<_> = patches.collect();
    patches.sort_by_key(|(place, ..)| *place);
    patches
}

/// Area-weighted relative L2 difference of the second from the first.
fn error(one: &[Told], other: &[Told]) -> f64 {
    assert_eq!(one.len(), other.len());
    let (mut apart, mut size) = (0.0, 0.0);
    for (a, b) in one.iter().zip(other) {
        assert_eq!(a.0, b.0);
        apart += a.1 * (a.2 - b.2).length_squared();
        size += a.1 * a.2.length_squared();
    }
    (apart / size).sqrt()
}

/// A scene cut, with its light from a single environment.
struct Case {
    name: &'static str,
    scene: Scene,
    cut: [u32; 3],
    exact: Vec<Told>,
}

/// How far off a run is, and the bytes that it sent.
struct Found {
    error: f64,
    bytes: u64,
}

impl Case {
    fn new(name: &'static str, scene: Scene, cut: [u32; 3]) -> Case {
        let single = run(problem(scene.clone(), [1, 1, 1]), 1, fine());
        let exact = light(&single.problem, &simulate(&single, &paragon()).unwrap());
        Case { name, scene, cut, exact }
    }

    /// One processor an environment.
    fn find(&self, label: &str, problem: Problem) -> Found {
        let run = run(problem, self.cut.iter().product::<u32>() as usize, fine());
        let outcome = simulate(&run, &paragon()).unwrap();
        assert_eq!(outcome.ending, Ending::Agreed);
        assert!(outcome.energy.error() < 1e-9, "{:?}", outcome.energy);
        let error = error(&self.exact, &light(&run.problem, &outcome));
        let (name, bytes, messages) =
            (self.name, outcome.counts.message_bytes, outcome.counts.messages);
        println!("| {name} | {label} | {:.3} % | {messages} | {bytes} |", error * 100.0);
        Found { error, bytes }
    }
}

/// Down to where order and threshold of shots matter no more.
fn fine() -> Rules {
    Rules { patch_threshold: 1e-7, wall_threshold: 1e-5, ..rules() }
}

/// What masks do not change and walls do, and that walls come nearer the finer they are; `--nocapture`
/// shows the table.
#[test]
fn walls_err_less_the_finer_they_are_and_masks_not_at_all() {
    println!("| scene | interfaces | error | messages | bytes |");
    for (name, scene, cut) in
        [("open room", open_room(), [4, 1, 1]), ("two rooms", two_rooms(), [2, 1, 1])]
    {
        let case = Case::new(name, scene, cut);
        let masks = case.find("masks", problem(case.scene.clone(), cut));
        assert!(masks.error < 1e-5, "{}", masks.error);
        let mut coarser = f64::INFINITY;
        for n in [1, 4, 12] {
            let label = format!("{n} x {n} wall patches, {n} x {n} directions");
            let walls = case.find(&label, walled(case.scene.clone(), cut, n, n));
            assert!(walls.error < 0.7 * coarser, "{name}: {} after {coarser}", walls.error);
            coarser = walls.error;
            // At the bytes of masks they err, and masks do not.
            assert!(walls.error > 10.0 * masks.error || walls.bytes > masks.bytes);
        }
    }
}

/// Both have to be fine: where light comes from, and where it goes.
#[test]
fn wall_patches_and_directions_are_needed_both() {
    let case = Case::new("open room", open_room(), [4, 1, 1]);
    let find = |p, d| {
        let label = format!("{p} x {p} wall patches, {d} x {d} directions");
        case.find(&label, walled(case.scene.clone(), case.cut, p, d)).error
    };
    let (both, patches, directions) = (find(8, 8), find(8, 1), find(1, 8));
    assert!(both < 0.5 * patches && both < 0.5 * directions, "{both} {patches} {directions}");
}

#[test]
fn energy_closes_and_the_same_run_is_the_same() {
    let cut = [4, 2, 1];
    for processors in [1, 3, 8] {
        for rules in [
            rules(),
            Rules { selection: Selection::DeltaRadiosity, merge_masks: true, ..rules() },
            Rules {
                patch_threshold: 0.0,
                energy_threshold: 0.3,
                collect_every: Duration::from_seconds_f64(0.01),
                ..rules()
            },
        ] {
            let run = run(walled(two_rooms(), cut, 3, 2), processors, rules);
            let outcome = simulate(&run, &paragon()).unwrap();
            assert!(outcome.energy.error() < 1e-9, "{:?}", outcome.energy);
            assert_eq!(outcome.ending, Ending::Agreed);
            same(&outcome, &simulate(&run, &paragon()).unwrap());
            let forgetful = Run { kept: Arc::new(KeptShots::new(0)), ..run };
            same(&outcome, &simulate(&forgetful, &paragon()).unwrap());
        }
    }
}

/// Threads run the same program; what differs is how much a wall patch has gathered when it is handed on.
#[test]
fn threads_find_much_the_same_light() {
    let run = run(walled(two_rooms(), [2, 1, 1], 8, 8), 2, rules());
    let [simulated, threads] =
        [simulate(&run, &paragon()), run_on_threads(&run)].map(Result::unwrap);
    assert!(threads.energy.error() < 1e-9);
    if threads.ending == Ending::Agreed {
        let apart = error(&light(&run.problem, &simulated), &light(&run.problem, &threads));
        assert!(apart < 5e-3, "{apart}");
    }
}

/// In one environment there is no wall, and nothing changes.
#[test]
fn one_environment_has_no_wall() {
    let plain = run(problem(open_room(), [1, 1, 1]), 1, rules());
    let walled = run(walled(open_room(), [1, 1, 1], 4, 4), 1, rules());
    let [plain, walled] = [plain, walled].map(|run| simulate(&run, &paragon()).unwrap());
    assert_eq!((plain.radiosity, plain.energy), (walled.radiosity, walled.energy));
}
