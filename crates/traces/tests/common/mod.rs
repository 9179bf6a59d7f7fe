//! A small run to trace.

#![allow(dead_code, reason = "each test file uses some of these")]

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use desim::Duration;
use multicomputer::{Machine, Network};
use radiosity::glam::DVec3;
use radiosity::{Face, Hemisphere, HemisphereKind, Material, PatchSize, Rgb, Scene};
use virtwall::{
    KeptShots, Mapping, Order, Outcome, Problem, ProblemOptions, Recording, Rules, Run, Selection,
    Shooting, Ties, simulate_observed,
};

/// Processors of the run.
pub const PROCESSORS: usize = 4;

/// A floor and a lamp above it.
fn scene() -> Scene {
    let material = |reflectance, emission| Material {
        name: format!("{emission}"),
        reflectance: Rgb::splat(reflectance),
        emission: Rgb::splat(emission),
        two_sided: false,
    };
    let square = |[low, high]: [f64; 2], z: f64, up: bool, material| {
        let mut points = vec![
            DVec3::new(low, low, z),
            DVec3::new(high, low, z),
            DVec3::new(high, high, z),
            DVec3::new(low, high, z),
        ];
        if !up {
            points.reverse();
        }
        Face { points, material, object: 0 }
    };
    let faces = [
        square([0.0, 4.0], 0.0, true, 0),
        square([0.0, 4.0], 3.0, false, 0),
        square([1.5, 2.5], 2.9, false, 1),
    ];
    let materials = vec![material(0.5, 0.0), material(0.0, 100.0)];
    Scene::new(&faces, materials, vec!["object".to_owned()]).unwrap().0
}

pub fn paragon() -> Machine {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../machines/paragon-xps.json");
    Machine::from_json(&std::fs::read_to_string(path).unwrap(), path).unwrap()
}

/// A run on a machine over a network, recorded.
pub fn record(machine: &Machine, network: Box<dyn Network>) -> (Outcome, Recording) {
    let options = ProblemOptions {
        patch_size: PatchSize { reflector: 0.5, emitter: 0.5 },
        cells: [4, 4, 2],
        cut: [2, 2, 1],
        hemisphere: Hemisphere::new(HemisphereKind::Fibonacci, 1_024, true).unwrap(),
    };
    let rules = Rules {
        selection: Selection::Energy,
        ties: Ties::ReceivedFirst,
        order: Order::Best,
        patch_threshold: 0.002,
        energy_threshold: 0.0,
        shots_without_progress: None,
        collect_every: Duration::from_seconds_f64(0.5),
        radiosity_updates: true,
        merge_masks: false,
        mapping: Mapping::Blocks,
        seed: 0,
        shooting: Shooting::default(),
        wall_threshold: 0.0,
    };
    let run = Run {
        problem: Arc::new(Problem::new(scene(), options).unwrap()),
        processors: PROCESSORS,
        rules,
        kept: Arc::new(KeptShots::new(1 << 30)),
        on_shot: Arc::new(|_| ()),
    };
    let recording = Rc::new(RefCell::new(Recording::new(&run.problem, PROCESSORS)));
    let outcome = simulate_observed(&run, machine, network, Some(recording.clone() as _)).unwrap();
    (outcome, recording.take())
}
