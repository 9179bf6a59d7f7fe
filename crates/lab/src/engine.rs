//! The one door to the simulator: beyond it nothing here knows how a kernel or a link works.

use std::path::Path;
use std::sync::Arc;

use multicomputer::Machine;
use radiosity::{Hemisphere, HemisphereKind, Operation, PatchSize, Rgb};
use virtwall::{Ending, KeptShots, Outcome, ProblemError, ProblemOptions, Rules};

use crate::experiment::{self as fields, Experiment};
use crate::fault::Fault;
use crate::figures::{Energy, Figures};
use crate::problem::Settings;

/// A scene in memory.
pub struct Scene {
    /// The geometry.
    pub scene: radiosity::Scene,
    /// What was mended on loading.
    pub warnings: Vec<String>,
}

impl Scene {
    /// Loads an OBJ file; `label` is what results call it.
    ///
    /// # Errors
    /// What is wrong with the file or its materials, and where.
    pub fn load(path: &Path, label: &str) -> Result<Scene, Fault> {
        let (scene, warnings) = radiosity::load_obj(path).map_err(Fault::complete)?;
        let warnings = warnings.iter().map(|warning| format!("{label}: {warning}")).collect();
        Ok(Scene { scene, warnings })
    }

    /// Extents along x, y and z, metres.
    pub fn extents(&self) -> [f64; 3] {
        self.scene.bounds.size().to_array()
    }

    /// Sum of areas, m².
    pub fn area(&self) -> f64 {
        self.scene.area()
    }

    /// Polygons after cleaning.
    pub fn polygons(&self) -> usize {
        self.scene.polygons.len()
    }
}

/// Reads a machine description and makes sure that it prices every operation.
///
/// # Errors
/// What is wrong with the file, and where.
pub fn load_machine(path: &Path) -> Result<Machine, Fault> {
    let file = path.display().to_string();
    let text = std::fs::read_to_string(path)
        .map_err(|error| Fault::of_file(&file, format!("cannot be read: {error}")))?;
    let machine = Machine::from_json(&text, &file).map_err(Fault::complete)?;
    let priced = |operation: &&Operation| machine.processor.price(operation.name()).is_some();
    match Operation::ALL.iter().find(|operation| !priced(operation)) {
        None => Ok(machine),
        Some(operation) => {
            let message = format!("no price of \"{}\"; expected one of each", operation.name());
            Err(Fault::of_file(file, message))
        }
    }
}

/// A scene, meshed and cut.
pub struct Problem(Arc<virtwall::Problem>);

impl Problem {
    /// Meshes and cuts a scene.
    ///
    /// # Errors
    /// The experiment's field at fault, and what is wrong with it.
    pub fn new(scene: &Scene, settings: &Settings) -> Result<Problem, (&'static str, String)> {
        let kind = match settings.directions {
            fields::Directions::Fibonacci => HemisphereKind::Fibonacci,
            fields::Directions::Hemicube => HemisphereKind::Hemicube,
            fields::Directions::Polar => HemisphereKind::Polar,
            fields::Directions::Concentric => HemisphereKind::Concentric,
        };
        let hemisphere = Hemisphere::new(kind, settings.pixels, settings.rotated)
            .map_err(|error| ("hemisphere.pixels", error.to_string()))?;
        let (reflector, emitter) = (settings.patch_size, settings.emitter_patch_size);
        let options = ProblemOptions {
            patch_size: PatchSize { reflector, emitter },
            cells: settings.cells.0,
            cut: settings.cut.0,
            hemisphere,
        };
        match virtwall::Problem::new(scene.scene.clone(), options) {
            Ok(problem) => Ok(Problem(Arc::new(problem))),
            Err(error) => {
                let field = match error {
                    ProblemError::Cells(_) => "cells",
                    ProblemError::Cut { .. } => "cut",
                    ProblemError::PatchSize(..) => "patch_size",
                };
                Err((field, error.to_string()))
            }
        }
    }

    /// Patches of all local environments.
    pub fn patches(&self) -> usize {
        self.0.patches()
    }
}

/// Shots kept between the runs of one problem.
#[derive(Clone)]
pub struct Kept(Arc<KeptShots>);

impl Kept {
    /// Keeps at most so many bytes of them.
    pub fn new(bytes: usize) -> Kept {
        Kept(Arc::new(KeptShots::new(bytes)))
    }
}

/// One run, ready to go.
pub struct Run(virtwall::Run);

impl Run {
    /// The run of a problem at one point of an experiment; `on_shot` is called after every shot.
    pub fn new(
        problem: &Problem,
        point: &Experiment,
        kept: &Kept,
        on_shot: Arc<dyn Fn() + Send + Sync>,
    ) -> Run {
        Run(virtwall::Run {
            problem: Arc::clone(&problem.0),
            processors: point.processors as usize,
            rules: rules(point),
            kept: Arc::clone(&kept.0),
            on_shot,
        })
    }

    /// Runs on a simulated machine.
    ///
    /// # Errors
    /// Why the run did not end.
    pub fn simulate(&self, machine: &Machine) -> Result<Figures, String> {
        let outcome = virtwall::simulate(&self.0, machine).map_err(|error| error.to_string())?;
        Ok(self.figures(&outcome, true))
    }

    /// Runs on threads of this host.
    ///
    /// # Errors
    /// Why the run did not end.
    pub fn on_threads(&self) -> Result<Figures, String> {
        let outcome = virtwall::run_on_threads(&self.0).map_err(|error| error.to_string())?;
        Ok(self.figures(&outcome, false))
    }

    /// The outcome's figures; times only if they are virtual.
    fn figures(&self, outcome: &Outcome, virtual_time: bool) -> Figures {
        let energy = &outcome.energy;
        let share = |part: Rgb| match energy.emitted.element_sum() {
            0.0 => 0.0,
            emitted => part.element_sum() / emitted,
        };
        Figures {
            time_s: virtual_time.then(|| outcome.time.as_seconds_f64()),
            local_shots: outcome.local_shots,
            received_shots: outcome.received_shots,
            messages: outcome.messages,
            message_bytes: outcome.message_bytes,
            update_messages: outcome.update_messages,
            update_bytes: outcome.update_bytes,
            control_messages: outcome.control_messages,
            busy_fraction: virtual_time.then(|| outcome.busy_fraction()),
            energy_error: energy.error(),
            energy: Energy {
                absorbed: share(energy.absorbed),
                unshot: share(energy.unshot),
                in_transit: share(energy.in_transit),
                escaped: share(energy.escaped),
            },
            too_early: match outcome.ending {
                Ending::Agreed => None,
                Ending::TooEarly { lost } => Some(lost),
            },
            patches: self.0.problem.patches() as u64,
            work: outcome.work.counts().map(|(op, n)| (op.name().to_owned(), n)).collect(),
        }
    }
}

/// The rules that a point of an experiment sets.
fn rules(point: &Experiment) -> Rules {
    Rules {
        selection: match point.selection {
            fields::Selection::Energy => virtwall::Selection::Energy,
            fields::Selection::DeltaRadiosity => virtwall::Selection::DeltaRadiosity,
        },
        ties: match point.ties {
            fields::Ties::ReceivedFirst => virtwall::Ties::ReceivedFirst,
            fields::Ties::LocalFirst => virtwall::Ties::LocalFirst,
        },
        patch_threshold: point.stop.patch_threshold.value(),
        energy_threshold: point.stop.energy_threshold.value(),
        collect_every: desim::Duration::from_seconds_f64(point.stop.collect_every.value()),
        radiosity_updates: point.radiosity_updates,
        merge_masks: point.merge_masks,
        mapping: match point.mapping {
            fields::Mapping::Blocks => virtwall::Mapping::Blocks,
            fields::Mapping::Cyclic => virtwall::Mapping::Cyclic,
            fields::Mapping::Random => virtwall::Mapping::Random(point.seed),
        },
    }
}
