//! How long the initialisation of compute nodes takes: §4.2.1 of RR-3008.

use desim::Duration;
use multicomputer::Machine;

use crate::on::error::RunError;
use crate::run::Run;

/// The steps of the initialisation, by the names under which machine files price them: a polygon of the scene
/// read from the file's text and compared with the node's environments; a piece of a polygon cut out for an
/// environment and entered into cells; a patch of a quad-tree made.
pub const START_UP_STEPS: [&str; 3] = ["polygon_read", "polygon_cut", "patch_made"];

/// The start-up of the last compute node to become ready.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StartUpReport {
    /// Time from the start until it was ready.
    pub time: Duration,
    /// Part of `time` until it had read the scene.
    pub reading: Duration,
    /// Part of `reading` in which it waited at I/O nodes for requests of other nodes.
    pub disk_wait: Duration,
}

/// The start-up of a run whose scene's files have `scene_bytes` bytes, where the machine models it. Every
/// compute node reads all of the scene ("all the compute nodes perform I/O operations at the same
/// time"), keeps what is in its own environments, and makes patches of it.
///
/// Choice C30: computing begins when all nodes are ready.
///
/// # Errors
/// When the machine has no price for a step, or virtual time is over before the end.
#[doc(alias = "load_scene")]
pub fn start_up(
    run: &Run,
    machine: &Machine,
    scene_bytes: u64,
) -> Result<Option<StartUpReport>, RunError> {
    let Some(model) = &machine.start_up else { return Ok(None) };
    RunError::require_all("start-up has no price", START_UP_STEPS, &model.cycles, "cycles")?;
    let problem = &run.problem;
    let owners =
        run.rules.mapping.owners(problem.environments.len() as u32, run.processors, run.rules.seed);
    let all = problem.space.scene.polygons.len() as u64;
    let mut counts = vec![[all, 0, 0]; run.processors];
    for (environment, &owner) in problem.environments.iter().zip(&owners) {
        counts[owner][1] += environment.polygons() as u64;
        counts[owner][2] += environment.patches.len() as u64;
    }
    let processor = &machine.processor;
    let seconds = |counts: &[u64; 3]| -> f64 {
        let cycles = START_UP_STEPS.iter().zip(counts);
        let cycles = cycles.map(|(&step, &times)| model.cycles[step] * times as f64);
        cycles.sum::<f64>() * processor.scale / processor.clock
    };
    let readings = model.read(run.processors, scene_bytes);
    let reports = readings.iter().zip(&counts).map(|(reading, counts)| {
        let read = reading.done - desim::Time::ZERO;
        let time = read + Duration::from_seconds_f64(seconds(counts));
        StartUpReport { time, reading: read, disk_wait: reading.waited }
    });
    let last = reports.max_by_key(|report| report.time);
    match last.filter(|report| report.time == Duration::MAX) {
        Some(_) => Err(RunError::StartUp),
        None => Ok(last),
    }
}
