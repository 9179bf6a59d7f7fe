//! Makes a plan of a sweep: makes every check, and loads each file once.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use config::{Document, Fault, Place, fill, read, read_bytes};
use serde_json::Value;

use crate::accuracy::answer::{self, Stored};
use crate::accuracy::pilot::{Host, Pilots};
use crate::accuracy::tuned::Tuned;
use crate::accuracy::tuner::tune;
use crate::experiment::accuracy;
use crate::experiment::fields::Experiment;
use crate::experiment::sweep::{Point, Sweep};
use crate::files::digest::FileDigest;
use crate::files::file::{PLAIN, is_plain};
use crate::files::find::{FileKind, Found, find, named_from};
use crate::host::host_clock::HostClock;
use crate::host::program::program;
use crate::open::problem;
use crate::open::scene::Scene;
use crate::open::settings::Settings;
use crate::planning::machines::Machines;
use crate::planning::plan::{Plan, Prepared, Run};
use crate::planning::plots::check_plots;
use crate::planning::preparing::Preparing;
use crate::planning::suits::suits;
use crate::table::cheapest::{least_time, read_sweep};
use crate::table::columns;
use crate::table::comparison::Comparison;
use crate::table::runs_csv::Table;

/// The most problems of an experiment: each is meshed and cut, and its hemisphere made, before the first run.
pub const MOST_PROBLEMS: usize = 1_000;

/// What planning has read so far.
pub struct Planner<'a> {
    path: &'a Path,
    folder: &'a Path,
    document: &'a Document,
    sweep: &'a Sweep,
    preparing: &'a Preparing<'a>,
    scenes: Vec<Found>,
    /// Indices into `scenes`, by what the experiment calls them.
    known_scenes: BTreeMap<String, usize>,
    machines: Machines,
    /// Indices into `stored`, by file and scene.
    references: BTreeMap<(PathBuf, usize), usize>,
    stored: Vec<Stored>,
    /// Sweeps that accuracies are compared with, by name.
    sweeps: BTreeMap<String, (Table, FileDigest)>,
}

/// A point of the sweep whose scene is yet to be read.
struct Draft<'a> {
    point: &'a Point,
    typed: Experiment,
    /// Index into [`Planner::scenes`].
    scene: usize,
    /// Index into [`Planner::machines`].
    machine: usize,
    /// How its knobs were found, where the experiment asks for an accuracy.
    tuned: Option<Tuned>,
}

/// A scene that was read, and the CPU seconds that it took.
type Loaded = (Scene, f64);

impl<'a> Planner<'a> {
    pub fn new(
        path: &'a Path,
        document: &'a Document,
        sweep: &'a Sweep,
        preparing: &'a Preparing,
    ) -> Planner<'a> {
        Planner {
            path,
            folder: path.parent().unwrap_or(Path::new("")),
            sweep,
            document,
            preparing,
            scenes: Vec::new(),
            known_scenes: BTreeMap::new(),
            machines: Machines::default(),
            references: BTreeMap::new(),
            stored: Vec::new(),
            sweeps: BTreeMap::new(),
        }
    }

    pub fn plan(mut self) -> Result<Plan, Fault> {
        let name = self.name()?;
        let drafts = self.sweep.points.iter().map(|point| self.draft(point));
        let mut drafts = drafts.collect::<Result<Vec<Draft>, Fault>>()?;
        // Before settings are found: those of one run are not those of others.
        let resolved = resolved(self.document, &drafts[0].typed);
        let scenes = self.load()?;
        if self.preparing.finding {
            self.tune(&mut drafts, &scenes)?;
        }
        let (problems, problem_of) = self.problems(&drafts, &scenes)?;
        let runs = drafts.into_iter().zip(problem_of).map(|(draft, problem)| {
            let stored = self.reference(&draft, &scenes[draft.scene].0, &problems[problem])?;
            let Draft { point, typed, machine, tuned, .. } = draft;
            Ok(Run { index: point.index.clone(), point: typed, problem, machine, stored, tuned })
        });
        let runs = runs.collect::<Result<Vec<Run>, Fault>>()?;
        let first = &runs[0].point;
        let (title, plots) = (first.title.clone(), first.plots.clone());
        let (comparison, compared) = self.comparison(first)?;

        let mut files: Vec<FileDigest> =
            scenes.iter().flat_map(|(scene, _)| scene.digests.clone()).collect();
        files.extend(self.machines.read.iter().flat_map(|machine| machine.digests.clone()));
        files.extend(compared);
        files.extend(self.sweeps.values().map(|(_, digest)| digest.clone()));
        files.extend(self.stored.iter().map(|stored| stored.digest.clone()));
        files.sort();
        files.dedup();
        let warnings = scenes.iter().flat_map(|(scene, _)| scene.all_warnings().cloned()).collect();
        let plan = Plan {
            name,
            title,
            resolved,
            axes: self.sweep.axes.clone(),
            runs,
            problems,
            machines: self.machines.read,
            references: self.stored,
            comparison,
            plots,
            warnings,
            files,
        };
        let axes = &self.sweep.axes;
        let known = columns::drawable(columns::header(&plan.columns(), axes));
        let swept: Vec<String> = axes.iter().map(|axis| axis.place.to_string()).collect();
        check_plots(&plan.plots, &known, &swept, self.document)?;
        Ok(plan)
    }

    /// The name of the results: a plain one, that leads to no other folder.
    fn name(&self) -> Result<String, Fault> {
        let stem = self.path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
        if is_plain(stem) {
            return Ok(stem.to_owned());
        }
        let message = format!("the name \"{stem}\" names its results; expected {PLAIN}");
        Err(Fault::of_file(&self.document.file, message))
    }

    /// Reads and checks one point of the sweep, except its scene.
    fn draft<'p>(&mut self, point: &'p Point) -> Result<Draft<'p>, Fault> {
        let typed: Experiment = read(&point.value).map_err(|fault| {
            self.document.fault(&self.sweep.place_in_file(point, fault.place), fault.message)
        })?;
        let Planner { document, sweep, folder, .. } = *self;
        let machine = self.machines.find(folder, &typed.machine, |place, message| {
            document.fault(&sweep.place_in_file(point, place), message)
        })?;
        suits(&typed, &self.machines.read[machine].machine)
            .map_err(|(field, message)| self.fault(point, field, message))?;
        let scene = self.scene(point, &typed)?;
        self.accuracy(point, &typed)?;
        Ok(Draft { point, typed, scene, machine, tuned: None })
    }

    /// The stored reference of a draft, read once; none if it has none, or a dense one.
    fn reference(
        &mut self,
        draft: &Draft,
        scene: &Scene,
        problem: &Prepared,
    ) -> Result<Option<usize>, Fault> {
        let Experiment { reference, error_causes, .. } = &draft.typed;
        let Some(name) = reference.as_deref() else {
            let message = "true without a \"reference\"; expected one".to_owned();
            let fault = || self.fault(draft.point, "error_causes", message);
            return if *error_causes { Err(fault()) } else { Ok(None) };
        };
        let refuse = |message| self.fault(draft.point, "reference", message);
        if !scene.geometry.media.is_empty() {
            let message = format!("\"{name}\" knows no \"media\"; expected a scene without them");
            return Err(refuse(message));
        }
        let (patches, most) = (problem.problem.patches(), answer::MOST_DENSE);
        if (name == answer::DENSE || *error_causes) && patches > most {
            let message = format!("a dense solution of {patches} patches; expected at most {most}");
            return Err(refuse(message));
        }
        if name == answer::DENSE {
            let lit = scene.geometry.may_reflect_light();
            return if lit { Ok(None) } else { Err(refuse(answer::dark())) };
        }
        let stem = || self.scenes[draft.scene].path.file_stem().unwrap_or_default();
        let name =
            if name == answer::STORED { stem().to_string_lossy() } else { Cow::Borrowed(name) };
        let found = find(self.folder, &FileKind::REFERENCES, &name).map_err(refuse)?;
        let key = (found.path.clone(), draft.scene);
        if let Some(&known) = self.references.get(&key) {
            return Ok(Some(known));
        }
        let stored = Stored::read(&found, &scene.geometry)?;
        self.stored.push(stored);
        self.references.insert(key, self.stored.len() - 1);
        Ok(Some(self.stored.len() - 1))
    }

    /// A fault of a field at one point of the sweep.
    fn fault(&self, point: &Point, field: &str, message: String) -> Fault {
        self.document.fault(&self.sweep.place_in_file(point, Place::of(field)), message)
    }

    fn scene(&mut self, point: &Point, typed: &Experiment) -> Result<usize, Fault> {
        if let Some(&known) = self.known_scenes.get(&typed.scene) {
            return Ok(known);
        }
        let found = find(self.folder, &FileKind::SCENES, &typed.scene)
            .map_err(|message| self.fault(point, "scene", message))?;
        // Several names may mean one file.
        let same = self.scenes.iter().position(|scene| scene.path == found.path);
        let scene = same.unwrap_or_else(|| {
            self.scenes.push(found);
            self.scenes.len() - 1
        });
        self.known_scenes.insert(typed.scene.clone(), scene);
        Ok(scene)
    }

    /// Checks the accuracy that a point asks for, and reads the sweep it is compared with, once.
    fn accuracy(&mut self, point: &Point, typed: &Experiment) -> Result<(), Fault> {
        let Some(accuracy) = &typed.accuracy else { return Ok(()) };
        let checked = accuracy.check(&point.value);
        checked.map_err(|(field, message)| self.fault(point, field, message))?;
        let Some(name) = accuracy.sweep.as_ref() else { return Ok(()) };
        if !self.sweeps.contains_key(name) {
            let sweep = read_sweep(self.folder, name)
                .map_err(|message| self.fault(point, "accuracy.sweep", message))?;
            self.sweeps.insert(name.clone(), sweep);
        }
        Ok(())
    }

    /// Searches settings for the points that ask for an accuracy. Points that differ only in their processors
    /// share a setting.
    fn tune(&self, drafts: &mut [Draft], scenes: &[Loaded]) -> Result<(), Fault> {
        let mut asking: Vec<(Experiment, usize)> = Vec::new();
        let mut known = BTreeMap::new();
        let mut asker = Vec::new();
        for (number, draft) in drafts.iter().enumerate().filter(|(_, d)| d.typed.accuracy.is_some())
        {
            let alike = Experiment { processors: 1, ..draft.typed.clone() };
            let text = serde_json::to_string(&alike).unwrap_or_default();
            let asked = *known.entry(text).or_insert(asking.len());
            asker.push((number, asked));
            if asked == asking.len() {
                asking.push((alike, number));
            }
        }
        let threads = self.preparing.threads.div_ceil(asking.len().max(1));
        let tune = |asked: usize| {
            let (experiment, number) = &asking[asked];
            self.tuned(experiment, &drafts[*number], &scenes[drafts[*number].scene].0, threads)
        };
        let found = parallel::map(asking.len(), self.preparing.threads, tune);
        let found = found.into_iter().collect::<Result<Vec<_>, Fault>>()?;
        for (number, asked) in asker {
            let (point, tuned) = &found[asked];
            let draft = &mut drafts[number];
            draft.typed = Experiment { processors: draft.typed.processors, ..point.clone() };
            draft.tuned = Some(*tuned);
        }
        Ok(())
    }

    fn tuned(
        &self,
        experiment: &Experiment,
        draft: &Draft,
        scene: &Scene,
        threads: usize,
    ) -> Result<(Experiment, Tuned), Fault> {
        let refuse = |(field, message)| self.fault(draft.point, field, message);
        let settings = Settings::of(experiment, scene).map_err(refuse)?;
        let machine = &self.machines.read[draft.machine].machine;
        let accuracy = experiment.accuracy.as_ref();
        let target = accuracy.map_or(1.0, |accuracy| accuracy.relative_l2);
        let sweep = accuracy.and_then(|accuracy| self.sweeps.get(accuracy.sweep.as_ref()?));
        let sweep_time_s =
            sweep.and_then(|(table, _)| least_time(table, &experiment.scene, target));
        let watch = |runs| (self.preparing.on_pilot)(&experiment.scene, target, runs);
        let memory = self.preparing.memory / self.preparing.threads;
        let host = Host { memory, threads, watch: &watch };
        let pilots = Pilots::new(experiment, &settings, &scene.geometry, machine, host);
        let pilots = pilots.map_err(refuse)?;
        let out_of_reach = |message| refuse(("accuracy.relative_l2", message));
        let tuned = tune(&pilots, target).map_err(out_of_reach)?;
        let point = pilots.point(&tuned.knobs).map_err(out_of_reach)?;
        Ok((point, Tuned { sweep_time_s, ..tuned }))
    }

    /// Reads all scenes, each once.
    fn load(&self) -> Result<Vec<Loaded>, Fault> {
        let load = |scene: usize| {
            let clock = HostClock::start();
            Ok((Scene::load(&self.scenes[scene])?, clock.cpu_seconds()))
        };
        let threads = self.preparing.threads;
        std::thread::scope(|scope| {
            // Saved runs are named by a digest of this program, which is computed meanwhile.
            if threads > 1 {
                // If no thread can be started, it is computed when it is needed.
                let _ = std::thread::Builder::new().spawn_scoped(scope, program);
            }
            parallel::map(self.scenes.len(), threads, load).into_iter().collect()
        })
    }

    /// The problems, each different one once, and the index of each draft's problem.
    fn problems(
        &self,
        drafts: &[Draft],
        scenes: &[Loaded],
    ) -> Result<(Vec<Prepared>, Vec<usize>), Fault> {
        let mut wanted: Vec<(Settings, &Draft)> = Vec::new();
        let mut known = BTreeMap::new();
        let mut problem_of = Vec::new();
        for draft in drafts {
            let settings = Settings::of(&draft.typed, &scenes[draft.scene].0)
                .map_err(|(field, message)| self.fault(draft.point, field, message))?;
            let text = serde_json::to_string(&settings).unwrap_or_default();
            let problem = *known.entry(text).or_insert(wanted.len());
            problem_of.push(problem);
            if problem == MOST_PROBLEMS {
                return Err(self.too_many_problems());
            }
            if problem == wanted.len() {
                wanted.push((settings, draft));
            }
        }
        let prepare = |number: usize| {
            let (settings, draft) = &wanted[number];
            let (scene, loading_s) = &scenes[draft.scene];
            let threads = self.preparing.threads;
            let (problem, cpu_s) = problem::problem_on(&scene.geometry, settings, threads)
                .map_err(|(field, message)| self.fault(draft.point, field, message))?;
            let set_up_s = loading_s + cpu_s;
            let (settings, digests) = (settings.clone(), scene.digests.clone());
            Ok(Prepared { settings, problem, digests, scene_bytes: scene.bytes, set_up_s })
        };
        let problems = parallel::map(wanted.len(), self.preparing.threads, prepare);
        Ok((problems.into_iter().collect::<Result<_, Fault>>()?, problem_of))
    }

    fn too_many_problems(&self) -> Fault {
        let lists =
            self.sweep.axes.iter().map(|axis| format!("{} {}", axis.values.len(), axis.place));
        let lists: Vec<String> = lists.collect();
        let message = format!(
            "the lists ({}) make more than {MOST_PROBLEMS} problems, that is scenes that differ in mesh, cut or \
             hemisphere; expected fewer",
            lists.join(", ")
        );
        self.document.fault(&Place::default(), message)
    }

    /// The published figures, if there are any, and the file they are from.
    fn comparison(&self, first: &Experiment) -> Result<(Comparison, Option<FileDigest>), Fault> {
        let Some(name) = &first.compare_with else {
            return Ok((Comparison::default(), None));
        };
        let path = named_from(self.folder, name)
            .map_err(|message| self.document.fault(&Place::of("compare_with"), message))?;
        let bytes = read_bytes(&path)?;
        Ok((Comparison::read(&bytes, &path)?, Some(FileDigest::of(&bytes, name))))
    }
}

/// The experiment file with every default filled in, from its first run: an equivalent file.
pub fn resolved(document: &Document, first: &Experiment) -> Value {
    let mut resolved = document.value.clone();
    fill(&mut resolved, serde_json::to_value(first).unwrap_or_default());
    accuracy::without_replaced(&mut resolved);
    resolved
}
