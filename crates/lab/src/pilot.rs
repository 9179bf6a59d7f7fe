//! Pilot runs: what a setting of the knobs costs, and the light that it finds.

use std::cell::RefCell;
use std::fmt;
use std::rc::Rc;
use std::sync::Arc;

use multicomputer::Machine;
use radiosity::Rgb;
use reference::{Difference, Overlaps, Patches};
use virtwall::{KeptShots, Problem};

use crate::engine::{self, On};
use crate::experiment::{Directions, Experiment, Selection};
use crate::fault::WrongField;
use crate::quantity::{Fraction, Length};
use crate::settings::Settings;
use crate::source_split::SplitFields;

/// A setting of the knobs that trade accuracy for time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knobs {
    /// Patches are so many times as long as the experiment, or the scene, asks for.
    pub mesh: f64,
    /// Rays a source.
    pub pixels: u32,
    /// A patch is cut into so many sources along each of its two directions.
    pub split: u32,
    /// The share of the brightest patch below which none is shot, both on the mesh that is asked for.
    pub threshold: f64,
    /// What a patch that does not emit shoots, over what it has not shot.
    pub overshoot: f64,
    /// Whether the ambient term is added.
    pub ambient: bool,
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

/// What a pilot run found.
pub struct Pilot {
    /// Virtual seconds on one processor.
    pub time_s: f64,
    /// The part of the emitted energy that was not shot.
    pub unshot: f64,
    /// Mean radiosities over the patches that the experiment asks for, W/m².
    pub means: Vec<Rgb>,
}

/// Pilot runs of one point of an experiment, on one processor; each is made once.
pub struct Pilots<'a> {
    base: &'a Experiment,
    /// As the experiment asks for, without the tuner.
    settings: Settings,
    scene: &'a radiosity::Scene,
    machine: &'a Machine,
    memory: usize,
    watch: &'a dyn Fn(usize),
    patches: Patches,
    /// By which the threshold is told.
    brightest: f64,
    problems: RefCell<Vec<Prepared>>,
    runs: RefCell<Vec<(Knobs, Rc<Pilot>)>>,
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
    /// Of a point, with so many bytes of host memory for shots that pilots share; `watch` hears how many
    /// were made.
    ///
    /// # Errors
    /// The field of the experiment at fault.
    pub fn new(
        base: &'a Experiment,
        settings: &Settings,
        scene: &'a radiosity::Scene,
        machine: &'a Machine,
        memory: usize,
        watch: &'a dyn Fn(usize),
    ) -> Result<Pilots<'a>, WrongField> {
        let problem = engine::problem(scene, settings)?;
        let patches = Patches::of_all(&problem.space, &problem.environments);
        let (settings, brightest) = (settings.clone(), brightest(&problem));
        let (problems, runs) = (RefCell::default(), RefCell::default());
        Ok(Pilots {
            base,
            settings,
            scene,
            machine,
            memory,
            watch,
            patches,
            brightest,
            problems,
            runs,
        })
    }

    /// The experiment with its knobs set.
    ///
    /// # Errors
    /// If there is no such mesh or hemisphere.
    pub fn point(&self, knobs: &Knobs) -> Result<Experiment, String> {
        // Patches have energies by their areas; the brightest may be as large on every mesh.
        let share = match self.base.selection {
            Selection::Energy => {
                self.brightest * knobs.mesh * knobs.mesh / self.prepared(knobs)?.brightest
            }
            Selection::DeltaRadiosity => 1.0,
        };
        let length = |metres: f64| Length::parse(&format!("{metres} m")).ok();
        let mut point = self.base.clone();
        point.accuracy = None;
        point.patch_size = length(self.settings.patch_size * knobs.mesh);
        point.emitter_patch_size = length(self.settings.emitter_patch_size * knobs.mesh);
        point.hemisphere.directions = Directions::Fibonacci;
        point.hemisphere.pixels = knobs.pixels;
        point.source_split = SplitFields { most: knobs.split, ..SplitFields::default() };
        point.overshoot = knobs.overshoot;
        point.ambient = knobs.ambient;
        let percent = |share: f64| Fraction::parse(&format!("{} %", 100.0 * share));
        point.stop.patch_threshold =
            percent(knobs.threshold * share).unwrap_or(point.stop.patch_threshold);
        Ok(point)
    }

    /// The run of a setting.
    ///
    /// # Errors
    /// Why it could not be made, or did not end.
    pub fn run(&self, knobs: &Knobs) -> Result<Rc<Pilot>, String> {
        if let Some((_, pilot)) = self.runs.borrow().iter().find(|(known, _)| known == knobs) {
            return Ok(Rc::clone(pilot));
        }
        let point = Experiment { processors: 1, reference: None, ..self.point(knobs)? };
        let Prepared { problem, overlaps, kept, .. } = self.prepared(knobs)?;
        let run = engine::run(&problem, &point, &kept, Arc::new(|| ()));
        let (figures, radiosity) =
            engine::carry_out(&run, &point, On::Simulation, self.machine, 0, None)?;
        let means = overlaps.means(&radiosity.concat());
        let (time_s, unshot) = (figures.time_s.unwrap_or(0.0), figures.energy.unshot);
        let pilot = Rc::new(Pilot { time_s, unshot, means });
        self.runs.borrow_mut().push((*knobs, Rc::clone(&pilot)));
        (self.watch)(self.count());
        Ok(pilot)
    }

    /// Runs made so far.
    pub fn count(&self) -> usize {
        self.runs.borrow().len()
    }

    /// How far one solution is from another, relative to what the other says is reflected.
    pub fn difference(&self, one: &Pilot, other: &Pilot) -> f64 {
        Difference::between(&self.patches, &other.means, &one.means, &other.means).relative_l2
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
                settings.directions = Directions::Fibonacci;
                settings.pixels = knobs.pixels;
                let problem = engine::problem(self.scene, &settings);
                let problem = problem.map_err(|(field, message)| format!("{field}: {message}"))?;
                let own = Patches::of_all(&problem.space, &problem.environments);
                // What other settings shot is needed no more.
                problems.iter_mut().for_each(|p| p.kept = Arc::new(KeptShots::new(0)));
                problems.push(Prepared {
                    mesh: knobs.mesh,
                    pixels: knobs.pixels,
                    brightest: brightest(&problem),
                    problem,
                    overlaps: Rc::new(Overlaps::new(&self.patches, &own)),
                    kept: Arc::new(KeptShots::new(self.memory)),
                });
                problems.len() - 1
            }
        };
        Ok(problems[place].clone())
    }
}

/// What the brightest patch has to shoot at the start, W.
fn brightest(problem: &Problem) -> f64 {
    let powers = problem.environments.iter().flat_map(|environment| {
        let patches = 0..environment.patches.len() as u32;
        patches.map(|patch| environment.emitted_power(&problem.space, patch).element_sum())
    });
    powers.fold(f64::MIN_POSITIVE, f64::max)
}
