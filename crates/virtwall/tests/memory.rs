//! Host memory by the patch, measured, since "why not fewer" wants a number to begin with.

#![allow(clippy::unwrap_used, reason = "a test may stop where it stands")]

use std::path::Path;
use std::sync::Arc;

use desim::Duration;
use multicomputer::Machine;
use peak_alloc::PeakAlloc;
use radiosity::{Hemisphere, HemisphereKind, LocalEnvironment, Mask, Patch, PatchSize, Rgb};
use virtwall::{
    KeptShots, Mapping, Order, Problem, ProblemOptions, Rules, Run, Selection, Shooting, Ties,
    simulate,
};

#[global_allocator]
static HEAP: PeakAlloc = PeakAlloc;

/// The building with so many floors, meshed as the paper's and cut into 64 environments. Few pixels:
/// hemisphere and masks do not grow with the scene.
fn building(floors: u16) -> Problem {
    let text = scenemaker::make_building(floors, 1996).unwrap();
    let read = |path: &Path| match path.extension().unwrap().to_str() {
        Some("obj") => Ok(text.obj.clone().into_bytes()),
        _ => Ok(text.mtl.clone().into_bytes()),
    };
    let (scene, _) = radiosity::load_obj_from(Path::new("building.obj"), &read).unwrap();
    let options = ProblemOptions {
        patch_size: PatchSize { reflector: 1.08, emitter: 0.6 },
        cells: [40, 24, 28 * u32::from(floors) / 5],
        cut: [4, 2, 8],
        hemisphere: Hemisphere::new(HemisphereKind::Fibonacci, 64, true).unwrap(),
    };
    Problem::new(scene, options).unwrap()
}

fn machine() -> Machine {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../machines/paragon-xps.json");
    Machine::from_json(&std::fs::read_to_string(path).unwrap(), path).unwrap()
}

/// Bytes that a problem takes, bytes that a run on 56 nodes takes besides at most, patches.
fn bytes(floors: u16) -> [f64; 3] {
    let before = HEAP.current_usage();
    let problem = Arc::new(building(floors));
    let ready = HEAP.current_usage();
    let rules = Rules {
        selection: Selection::Energy,
        ties: Ties::ReceivedFirst,
        order: Order::Best,
        patch_threshold: 0.1,
        wall_threshold: 0.0,
        energy_threshold: 0.0,
        shots_without_progress: None,
        collect_every: Duration::from_seconds_f64(1.0),
        radiosity_updates: true,
        merge_masks: false,
        mapping: Mapping::Blocks,
        seed: 0,
        shooting: Shooting::default(),
    };
    HEAP.reset_peak_usage();
    let (problem, kept) = (Arc::clone(&problem), Arc::new(KeptShots::new(0)));
    let patches = problem.patches();
    let run = Run { problem, processors: 56, rules, kept, on_shot: Arc::new(|_| ()) };
    simulate(&run, &machine()).unwrap();
    [ready - before, HEAP.peak_usage() - ready, patches].map(|count| count as f64)
}

/// Of two sizes the difference by the patch, so that what is fixed does not count.
#[test]
fn a_patch_takes_some_250_bytes() {
    let (small, large) = (bytes(5), bytes(10));
    let [problem, run] = [0, 1].map(|i| (large[i] - small[i]) / (large[2] - small[2]));
    println!("{problem:.0} bytes a patch for the problem and {run:.0} for a run");
    // A patch itself, its slot in a quad-tree, its share of pieces, polygons, vertices, boxes, cells.
    assert_eq!(size_of::<Patch>(), 40);
    assert!((70.0..180.0).contains(&problem), "{problem:.0} bytes a patch for the problem");
    // Leaving and unshot power, reflectance, radiosity in the outcome; what selection remembers.
    assert_eq!(size_of::<Rgb>(), 24);
    assert!((70.0..180.0).contains(&run), "{run:.0} bytes a patch for a run");
    // What is left of a run without a patch: 56 nodes, their network, what is under way.
    let fixed = small[1] - run * small[2];
    println!("{:.2} MiB for a simulated machine", fixed / 1_048_576.0);
    assert!(fixed < 5.0 * 1_048_576.0, "{fixed:.0} bytes for a simulated machine");
    // A mask is its bits.
    let words = size_of_val(Mask::none(30_976).words());
    assert_eq!((words, size_of::<Mask>()), (30_976 / 8, 40));
    assert!(size_of::<LocalEnvironment>() < 512);
}
