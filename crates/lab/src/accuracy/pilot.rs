//! Pilot runs: what a setting of the knobs costs, and the light that it finds.

use std::cell::{Cell, RefCell};
use std::fmt;
use std::rc::Rc;
use std::sync::Arc;

use multicomputer::Machine;
use radiosity::{HemisphereKind, LocalEnvironment, PatchSize, Rgb, Space};
use reference::{Difference, NoReference, Overlaps, Patches, Testimony, Witnesses};
use virtwall::{KeptShots, Problem, Selection};

use crate::engine::simulator::{self, Stopped};
use crate::experiment::fields::Experiment;
use crate::experiment::source_split::SplitFields;
use crate::files::WrongField;
use crate::files::quantity::{Fraction, Length};
use crate::open::problem;
use crate::open::settings::Settings;

/// A setting of the knobs that trade accuracy for time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knobs {
    /// Edge of a patch over that of the experiment or the scene.
    pub mesh: f64,
    pub pixels: u32,
    /// Sources of a patch along each of its two directions.
    pub split: u32,
    /// The share of the brightest patch below which none is shot, both on the mesh that is asked for.
    pub threshold: f64,
    /// What a patch that does not emit shoots, over what it has not shot.
    pub overshoot: f64,
    pub ambient: bool,
}

impl Knobs {
    /// Whether the same rays are cast, from the same patches in the same order, down to some threshold.
    pub fn casts_as(&self, other: &Knobs) -> bool {
        let Knobs { threshold, ambient, .. } = *self;
        Knobs { threshold, ambient, ..*other } == *self
    }
}

impl fmt::Display for Knobs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Knobs { mesh, pixels, split, threshold, overshoot, ambient } = self;
        write!(
            f,
            "{pixels} rays a source, sources {split} x {split} a patch, patches {mesh} times as "
        )?;
        write!(f, "long, shot down to {:.4} %", 100.0 * threshold)?;
        if *overshoot != 1.0 {
            write!(f, " and {overshoot} times over")?;
        }
        f.write_str(if *ambient { ", ambient term" } else { "" })
    }
}

/// Most paths of all witnesses together.
const MOST_PATHS: u64 = 1 << 25;

/// Highest threshold at which pilot runs are evaluated, as a share of the brightest patch.
const FIRST_THRESHOLD: f64 = 0.1;

/// Steps in which thresholds fall by half.
const STEPS_A_HALVING: f64 = 2.0;

pub fn threshold(step: usize) -> f64 {
    FIRST_THRESHOLD / 2.0_f64.powf(step as f64 / STEPS_A_HALVING)
}

/// A pilot run: one for all thresholds, with and without the ambient term.
pub struct Pilot {
    knobs: Knobs,
    /// As it would end at the threshold of each step.
    pub stops: Vec<Stopped>,
}

/// Pilot runs of one point of an experiment, on one processor; each is made once.
pub struct Pilots<'a> {
    base: &'a Experiment,
    /// The settings of the experiment, before the search.
    settings: Settings,
    scene: &'a radiosity::Scene,
    machine: &'a Machine,
    host: Host<'a>,
    witnesses: RefCell<Witnesses>,
    /// The power that thresholds are relative to, W.
    brightest: f64,
    problems: RefCell<Vec<Prepared>>,
    runs: RefCell<Vec<Rc<Pilot>>>,
    /// Runs made so far.
    pub count: Cell<usize>,
}

/// What pilots may use of the host.
#[derive(Clone, Copy)]
pub struct Host<'a> {
    /// Bytes for shots that they share.
    pub memory: usize,
    /// Threads that trace paths of light.
    pub threads: usize,
    /// Called with the number of pilot runs made.
    pub watch: &'a dyn Fn(usize),
}

/// A mesh and a hemisphere, and what was shot there.
#[derive(Clone)]
struct Prepared {
    mesh: f64,
    pixels: u32,
    brightest: f64,
    problem: Arc<Problem>,
    overlaps: Rc<Overlaps>,
    kept: Arc<KeptShots>,
}

impl<'a> Pilots<'a> {
    pub fn new(
        base: &'a Experiment,
        settings: &Settings,
        scene: &'a radiosity::Scene,
        machine: &'a Machine,
        host: Host<'a>,
    ) -> Result<Pilots<'a>, WrongField> {
        if !scene.media.is_empty() {
            let message = "errors are not estimated where there are \"media\"; expected none";
            return Err(("accuracy", message.to_owned()));
        }
        let problem = problem::problem(scene, settings)?;
        let (reflector, emitter) = (settings.patch_size, settings.emitter_patch_size);
        let space = Space::new(scene.clone(), settings.cells.0);
        let size = PatchSize { reflector, emitter };
        let whole = LocalEnvironment::new(&space, space.grid.whole(), size);
        // Independent of the paths of a stored reference, which has the experiment's seed.
        let seed = !base.seed;
        let mut witnesses = Witnesses::new(space, whole, seed, host.threads);
        while !witnesses.reflect_light() && witnesses.paths() < MOST_PATHS {
            witnesses.double(host.threads);
        }
        if !witnesses.reflect_light() {
            return Err(("accuracy", NoReference::Dark.to_string()));
        }
        let witnesses = RefCell::new(witnesses);
        Ok(Pilots {
            base,
            settings: settings.clone(),
            scene,
            machine,
            host,
            witnesses,
            brightest: brightest(&problem),
            problems: RefCell::default(),
            runs: RefCell::default(),
            count: Cell::new(0),
        })
    }

    /// By how much patches with knobs are to be brighter, as a share of their brightest, than on the mesh
    /// that is asked for: patches have energies by their areas, and the brightest may be as large on every mesh.
    fn share(&self, knobs: &Knobs) -> Result<f64, String> {
        Ok(match self.base.selection {
            Selection::Energy => {
                self.brightest * knobs.mesh * knobs.mesh / self.prepared(knobs)?.brightest
            }
            Selection::DeltaRadiosity => 1.0,
        })
    }

    /// The experiment with its knobs set.
    pub fn point(&self, knobs: &Knobs) -> Result<Experiment, String> {
        let share = self.share(knobs)?;
        let length = |metres: f64| Length::parse(&format!("{metres} m")).ok();
        let mut point = self.base.clone();
        point.accuracy = None;
        point.patch_size = length(self.settings.patch_size * knobs.mesh);
        point.emitter_patch_size = length(self.settings.emitter_patch_size * knobs.mesh);
        point.hemisphere.directions = HemisphereKind::Fibonacci;
        point.hemisphere.pixels = knobs.pixels;
        point.source_split = SplitFields { most: knobs.split, ..SplitFields::default() };
        point.overshoot = knobs.overshoot;
        point.ambient = knobs.ambient;
        let percent = |share: f64| Fraction::parse(&format!("{} %", 100.0 * share));
        point.stop.patch_threshold =
            percent(knobs.threshold * share).unwrap_or(point.stop.patch_threshold);
        Ok(point)
    }

    /// The run of a setting, down to the threshold of a step at least; the knobs' own, and whether they
    /// ask for the ambient term, do not matter.
    pub fn run(&self, knobs: &Knobs, steps: usize) -> Result<Rc<Pilot>, String> {
        let knobs = Knobs { threshold: threshold(steps), ambient: false, ..*knobs };
        let known = self.runs.borrow().iter().position(|pilot| pilot.knobs.casts_as(&knobs));
        if let Some(known) = known {
            let pilot = Rc::clone(&self.runs.borrow()[known]);
            if pilot.stops.len() > steps {
                return Ok(pilot);
            }
            self.runs.borrow_mut().remove(known);
        }
        let point = Experiment { processors: 1, reference: None, ..self.point(&knobs)? };
        let share = self.share(&knobs)?;
        let Prepared { problem, overlaps, kept, .. } = self.prepared(&knobs)?;
        let run = simulator::run(&problem, &point, &kept, Arc::new(|_| ()));
        let thresholds: Vec<f64> = (0..=steps).map(|step| threshold(step) * share).collect();
        let mut stops = simulator::stops(&run, &point, self.machine, &thresholds)?;
        stops.iter_mut().for_each(|stop| stop.radiosity = overlaps.means(&stop.radiosity));
        let pilot = Rc::new(Pilot { knobs, stops });
        self.runs.borrow_mut().push(Rc::clone(&pilot));
        self.count.set(self.count.get() + 1);
        (self.host.watch)(self.count.get());
        Ok(pilot)
    }

    /// Radiosities of a run that stopped, with or without the ambient term, W/m².
    pub fn solution(&self, stop: &Stopped, ambient: bool) -> Vec<Rgb> {
        let witnesses = self.witnesses.borrow();
        let term = if ambient { stop.ambient } else { Rgb::ZERO };
        let both = stop.radiosity.iter().zip(&witnesses.patches().reflectance);
        both.map(|(&radiosity, &reflectance)| radiosity + reflectance * term).collect()
    }

    /// Difference of two solutions, relative to the reflected light of the second.
    pub fn difference(&self, one: &[Rgb], other: &[Rgb]) -> f64 {
        let difference = Difference::between(self.witnesses.borrow().patches(), other, one, other);
        difference.map_or(f64::INFINITY, |difference| difference.relative_l2)
    }

    /// The error of a solution, as witnesses estimate it.
    pub fn error(&self, solution: &[Rgb]) -> Testimony {
        self.witnesses.borrow().error(solution)
    }

    /// Adds paths until the standard error of a solution's squared error is at most `square`, or a tenth of
    /// that squared error.
    pub fn sharpen(&self, solution: &[Rgb], square: f64) {
        let mut witnesses = self.witnesses.borrow_mut();
        let unsure = |said: Testimony| said.deviation > square.max(0.1 * said.square);
        while unsure(witnesses.error(solution)) && witnesses.paths() < MOST_PATHS {
            witnesses.double(self.host.threads);
        }
    }

    fn prepared(&self, knobs: &Knobs) -> Result<Prepared, String> {
        let mut problems = self.problems.borrow_mut();
        let known = |p: &Prepared| p.mesh == knobs.mesh && p.pixels == knobs.pixels;
        let place = match problems.iter().position(known) {
            Some(place) => place,
            None => {
                let mut settings = self.settings.clone();
                settings.patch_size *= knobs.mesh;
                settings.emitter_patch_size *= knobs.mesh;
                settings.directions = HemisphereKind::Fibonacci;
                settings.pixels = knobs.pixels;
                let problem = problem::problem(self.scene, &settings);
                let problem = problem.map_err(|(field, message)| format!("{field}: {message}"))?;
                let own = Patches::of_all(&problem.space, &problem.environments);
                // Kept shots of other settings are no longer needed.
                problems.iter_mut().for_each(|p| p.kept = Arc::new(KeptShots::new(0)));
                problems.push(Prepared {
                    mesh: knobs.mesh,
                    pixels: knobs.pixels,
                    brightest: brightest(&problem),
                    problem,
                    overlaps: Rc::new(Overlaps::new(self.witnesses.borrow().patches(), &own)),
                    kept: Arc::new(KeptShots::new(self.host.memory)),
                });
                problems.len() - 1
            }
        };
        Ok(problems[place].clone())
    }
}

/// Power that the brightest patch has to shoot at the start, W.
fn brightest(problem: &Problem) -> f64 {
    let powers = problem.environments.iter().flat_map(|environment| {
        let patches = 0..environment.patches.len() as u32;
        patches.map(|patch| environment.emitted_power(&problem.space, patch).element_sum())
    });
    powers.fold(f64::MIN_POSITIVE, f64::max)
}
