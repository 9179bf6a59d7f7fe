//! Calls the simulator. No other folder of this crate does.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;
use std::sync::Arc;

use config::{Fault, Place, unknown};
use desim::Time;
use multicomputer::{Machine, MessageLayer};
use radiosity::{Operation, Rgb};
use serde::Serialize;
use virtwall::{
    Ending, Instant, KeptShots, Outcome, Problem, Rules, Run, RunError, START_UP_STEPS,
    SharedObserver, Shooting, Source, SourceSplit, Thing,
};

use crate::engine::figures::{
    DisplayFigures, Energy, Figures, MessageLayerFigures, NodeMemoryFigures, StartUpFigures,
};
use crate::engine::network;
use crate::experiment::fields::Experiment;
use crate::experiment::source_split::SplitFields;

/// What the programs run on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum On {
    /// The simulated machine.
    #[default]
    Simulation,
    /// Threads of this host: the same light, no virtual time.
    Threads,
}

pub fn operations() -> impl Iterator<Item = &'static str> {
    operations_explained().map(|(name, _)| name)
}

/// The names of the operations, and what each is.
pub fn operations_explained() -> impl Iterator<Item = (&'static str, &'static str)> {
    Operation::ALL.iter().map(|operation| (operation.name(), operation.about()))
}

/// Checks that a machine has a price for every operation and, if it models them, a size for everything in a
/// node's memory and a price for every step of the start-up; and none for anything else.
///
/// # Errors
/// What is missing or unknown, and where. The caller adds the name of the file.
pub fn check_machine(machine: &Machine) -> Result<(), Fault> {
    all_of("operations", "processor.operations", operations(), &machine.processor.cycles)?;
    if let Some(memory) = &machine.node_memory {
        let things = Thing::ALL.iter().map(|(_, name)| *name);
        all_of("sizes", "node_memory.sizes", things, &memory.sizes)?;
    }
    if let Some(start_up) = &machine.start_up {
        let steps = START_UP_STEPS.iter().copied();
        all_of("operations", "start_up.operations", steps, &start_up.cycles)?;
    }
    Ok(())
}

/// Checks that a map at `place` of a machine has exactly these names.
fn all_of<V>(
    what: &str,
    place: &str,
    names: impl Iterator<Item = &'static str>,
    map: &BTreeMap<String, V>,
) -> Result<(), Fault> {
    let names: Vec<String> = names.map(str::to_owned).collect();
    if let Some(name) = map.keys().find(|name| !names.contains(name)) {
        let message = unknown("field", name, &names);
        return Err(Fault::at(Place::of(place).key(name), message));
    }
    if let Some(name) = names.iter().find(|name| !map.contains_key(*name)) {
        let message = format!("\"{name}\" is missing; expected {what}: {}", names.join(", "));
        return Err(Fault::at(Place::of(place), message));
    }
    Ok(())
}

/// The run of a problem at one point of an experiment; `on_shot` is called after every shot with its source.
pub fn run(
    problem: &Arc<Problem>,
    point: &Experiment,
    kept: &Arc<KeptShots>,
    on_shot: Arc<dyn Fn(&Source) + Send + Sync>,
) -> Run {
    Run {
        problem: Arc::clone(problem),
        processors: point.processors as usize,
        rules: rules(point),
        kept: Arc::clone(kept),
        on_shot,
    }
}

/// Carries out a run, on the simulated `machine` or on threads. Returns its figures, and its radiosities by
/// environment. Only a simulated run has an observer.
pub fn carry_out(
    run: &Run,
    point: &Experiment,
    on: On,
    machine: &Machine,
    scene_bytes: u64,
    observer: Option<SharedObserver>,
) -> Result<(Figures, Vec<Vec<Rgb>>), String> {
    let simulated = || {
        let start_up = virtwall::start_up(run, machine, scene_bytes)?;
        let (outcome, network) = network::simulate(run, machine, point, observer)?;
        Ok((outcome, network, start_up))
    };
    let outcome = match on {
        On::Simulation => simulated(),
        On::Threads => virtwall::run_on_threads(run).map(|outcome| (outcome, None, None)),
    };
    let (outcome, network, start_up) = outcome.map_err(|error: RunError| error.to_string())?;
    let start_up = start_up.as_ref().map(StartUpFigures::of);
    let counted = start_up.filter(|_| point.count_start_up).map_or(0.0, |s| s.start_up_s);
    let simulated = on == On::Simulation;
    let has_layer = simulated && machine.message_layer != MessageLayer::default();
    let has_caches = simulated && !machine.processor.caches.is_empty();
    let translates = has_caches && machine.processor.translations.is_some();
    let figures = figures(&run.problem, &outcome, simulated);
    let figures = Figures {
        time_s: figures.time_s.map(|time_s| time_s + counted),
        network,
        message_layer: has_layer.then(|| MessageLayerFigures::of(&outcome.layer())),
        start_up,
        missing_s: has_caches.then(|| outcome.missing().as_seconds_f64()),
        translating_s: translates.then(|| outcome.translating().as_seconds_f64()),
        ..figures
    };
    Ok((figures, outcome.radiosity))
}

/// The most shots of a solution for a picture.
const MOST_SHOTS: u64 = 100_000;

/// A solution for a picture.
pub struct Solved {
    /// The radiosities.
    pub light: Light,
    /// The share of the emitted light that is not shot.
    pub left: f64,
    /// Shots done.
    pub shots: u64,
}

impl Solved {
    /// A warning, if more light is left than what was asked for.
    pub fn warning(&self, unshot: f64) -> Option<String> {
        let Solved { left, shots, .. } = self;
        (*left > unshot).then(|| {
            let [left, unshot] = [left, &unshot].map(|share| 100.0 * share);
            let expected = format!("expected at most {unshot:.1} %");
            format!(
                "{left:.1} % of the light is unshot after {shots} shots; {expected}: larger patches \
                 or darker surfaces (\"patch_size\", \"clamp_reflectance\" of a scene file) need fewer shots"
            )
        })
    }
}

/// Radiosity in W/m², by environment and patch.
pub type Light = Vec<Vec<Rgb>>;

/// The light of a simulated run at each of `times`, in rising order; and the time of the run's end, after
/// which the light does not change.
pub fn light_at(
    run: &Run,
    point: &Experiment,
    machine: &Machine,
    times: &[Time],
) -> Result<(Vec<Light>, Time), String> {
    let light = Rc::new(RefCell::new(Vec::new()));
    let visit = {
        let light = Rc::clone(&light);
        move |instant: Instant| {
            light.borrow_mut().push(instant.radiosity().map(Iterator::collect).collect());
        }
    };
    let outcome = network::model_used(run, machine, point)
        .and_then(|model| Ok(machine.network_on(model)?))
        .and_then(|network| virtwall::visit_instants(run, machine, network, times, visit))
        .map_err(|error| error.to_string())?;
    Ok((light.take(), outcome.time))
}

/// A run as it would have ended at a threshold.
pub struct Stopped {
    pub time_s: f64,
    /// The part of the emitted energy that was not shot.
    pub unshot: f64,
    /// Radiosity in W/m², by patch, one environment after the other.
    pub radiosity: Vec<Rgb>,
    /// What the ambient term would add to a patch that reflects everything, W/m².
    pub ambient: Rgb,
}

/// The states in which a run on one processor would end at each of `thresholds`, in falling order. The last
/// one is the threshold of the run itself.
pub fn stops(
    run: &Run,
    point: &Experiment,
    machine: &Machine,
    thresholds: &[f64],
) -> Result<Vec<Stopped>, String> {
    let stops = Rc::new(RefCell::new(Vec::new()));
    let visit = {
        let stops = Rc::clone(&stops);
        move |instant: Instant| {
            let energy = &instant.energy;
            let left = (energy.unshot + energy.in_transit).element_sum();
            stops.borrow_mut().push(Stopped {
                time_s: instant.time.as_seconds_f64(),
                unshot: left / energy.emitted.element_sum().max(f64::MIN_POSITIVE),
                radiosity: instant.radiosity().flatten().collect(),
                ambient: instant.ambient(),
            });
        }
    };
    let model = network::model_used(run, machine, point).map_err(|error| error.to_string())?;
    // With several environments a run does not begin like one with a lower threshold, so each threshold
    // needs a run of its own.
    let per_run = if run.problem.environments.len() == 1 { thresholds.len().max(1) } else { 1 };
    for thresholds in thresholds.chunks(per_run) {
        let network = machine.network_on(model).map_err(|error| error.to_string())?;
        let mut run = run.clone();
        run.rules.patch_threshold = thresholds[thresholds.len() - 1];
        virtwall::visit_stops(&run, machine, network, thresholds, visit.clone())
            .map_err(|error| error.to_string())?;
    }
    Ok(stops.take())
}

/// The light in a problem of one environment when at most the share `unshot` is unshot, or after [`MOST_SHOTS`].
/// Calls `watch` after each shot with the share that is left.
pub fn solved(problem: &Problem, unshot: f64, watch: impl FnMut(f64)) -> Solved {
    let whole = &problem.environments[0];
    let (light, shots) =
        radiosity::solve(&problem.space, whole, &problem.hemisphere, unshot, MOST_SHOTS, watch);
    let patches = 0..whole.patches.len() as u32;
    let radiosity = patches.map(|patch| light.radiosity(whole, patch)).collect();
    let emitted = problem.emitted_power().element_sum();
    let left = light.unshot_power().element_sum();
    let left = if emitted > 0.0 { left / emitted } else { 0.0 };
    Solved { light: vec![radiosity], left, shots }
}

pub fn outcome(run: &Run, point: &Experiment, machine: &Machine) -> Result<Outcome, String> {
    let simulated = network::simulate(run, machine, point, None);
    simulated.map(|(outcome, _)| outcome).map_err(|error| error.to_string())
}

/// The outcome's figures; times only if they are virtual.
fn figures(problem: &Problem, outcome: &Outcome, virtual_time: bool) -> Figures {
    let energy = &outcome.energy;
    let share = |part: Rgb| match energy.emitted.element_sum() {
        0.0 => 0.0,
        emitted => part.element_sum() / emitted,
    };
    Figures {
        time_s: virtual_time.then(|| outcome.time.as_seconds_f64()),
        local_shots: outcome.counts.local_shots,
        received_shots: outcome.counts.received_shots,
        messages: outcome.counts.messages,
        message_bytes: outcome.counts.message_bytes,
        update_messages: outcome.counts.update_messages,
        update_bytes: outcome.counts.update_bytes,
        control_messages: outcome.counts.control_messages,
        busy_fraction: virtual_time.then(|| outcome.busy_fraction()),
        energy_error: energy.error(),
        energy: Energy {
            absorbed: share(energy.absorbed),
            unshot: share(energy.unshot),
            in_transit: share(energy.in_transit),
            escaped: share(energy.escaped),
            medium: share(energy.medium),
        },
        too_early: match outcome.ending {
            Ending::Agreed => None,
            Ending::TooEarly { lost } => Some(lost),
        },
        patches: problem.patches() as u64,
        memory: NodeMemoryFigures::of(outcome),
        display: outcome.display.as_ref().map(DisplayFigures::of),
        work: outcome.work.counts().map(|(op, n)| (op.name().to_owned(), n)).collect(),
        ..Figures::default()
    }
}

/// The processor of each environment at one point of an experiment.
pub fn owners(point: &Experiment, problem: &Problem) -> Vec<usize> {
    let environments = problem.environments.len() as u32;
    point.mapping.owners(environments, point.processors as usize, point.seed)
}

fn rules(point: &Experiment) -> Rules {
    Rules {
        selection: point.selection,
        ties: point.ties,
        order: point.order,
        patch_threshold: point.stop.patch_threshold.value(),
        energy_threshold: point.stop.energy_threshold.value(),
        shots_without_progress: point
            .stop
            .shots_without_progress
            .map(|shots| u64::from(shots.get())),
        collect_every: desim::Duration::from_seconds_f64(point.stop.collect_every.value()),
        wall_threshold: point.virtual_walls.threshold.value(),
        radiosity_updates: point.radiosity_updates,
        merge_masks: point.merge_masks,
        mapping: point.mapping,
        seed: point.seed,
        shooting: shooting(point),
    }
}

/// The most shots of patches that one processor needs at a point of an experiment, where that is known.
pub fn most_shots_in_sequence(problem: &Problem, point: &Experiment) -> Option<f64> {
    virtwall::most_shots_in_sequence(problem, &rules(point))
}

/// How patches are shot at a point of an experiment, where it goes beyond the paper.
pub fn shooting(point: &Experiment) -> Shooting {
    let SplitFields { most, nearer_than } = point.source_split;
    Shooting {
        split: SourceSplit { nearer_than: nearer_than.unwrap_or(f64::INFINITY), most },
        overshoot: point.overshoot,
        ambient: point.ambient,
    }
}
