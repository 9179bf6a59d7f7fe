//! Carries a plan out: independent runs side by side, each saved as soon as it is finished.

use std::cell::RefCell;
use std::io;
use std::path::Path;
use std::rc::Rc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use radiosity::Rgb;
use viewer::{Broadcast, LightRecording};
use virtwall::{Helpers, KeptShots, Memory, Observers, Recording, SharedObserver, ShotCounts};

use crate::accuracy::answer::DenseAnswers;
use crate::accuracy::causes::Explained;
use crate::accuracy::errors::{Radiosity, Yardstick};
use crate::engine::error_figures::ErrorFigures;
use crate::engine::figures::Figures;
use crate::engine::network;
use crate::engine::simulator::{self, On};
use crate::host::held::held;
use crate::host::host_clock::{HostClock, HostTimes};
use crate::planning::plan::{Plan, Prepared};
use crate::run::feed::{Feed, Follower, News};
use crate::run::pulse::{Heart, Pulse};
use crate::run::queue::{Queue, Task};
use crate::run::saved::Saved;
use crate::run::shot_files::ShotFiles;
use crate::run::traces::Traces;
use crate::run::viewing::Viewing;

/// How a plan is carried out. None of it changes what a simulated run finds.
pub struct Options {
    /// Threads, at least 1: each does a run; when no run waits any more, it helps with those under way.
    pub threads: usize,
    /// Whether to forget runs that an interrupted sweep has finished.
    pub fresh: bool,
    /// What the programs run on.
    pub on: On,
    /// Host memory for shots that are kept between runs, bytes.
    pub memory: usize,
    /// Where shots are kept beyond memory and beyond this sweep.
    pub shot_files: Option<ShotFiles>,
    /// Traces to be written of simulated runs; runs found finished are simulated again for them.
    pub traces: Option<Traces>,
    /// Which runs the report's viewer shows.
    pub viewing: Viewing,
    /// Who follows simulated runs while they are under way.
    pub feed: Option<Feed>,
    /// Whether simulated runs tell how they are, as events.
    pub pulse: bool,
}

/// Shots come by the thousand, and all threads tell the same watcher: one in so many is told.
const SHOTS_TOLD: u64 = 64;

/// Something that happened while a plan is carried out.
#[derive(Clone, Copy, Debug)]
pub enum Event {
    /// A run was found finished, by a sweep that was interrupted.
    Found,
    /// A run has shot some sources more.
    Shots {
        /// Index into [`Plan::runs`].
        run: usize,
        /// How many it has shot so far.
        shots: u64,
    },
    /// How a run is; told now and then.
    Pulse {
        /// Index into [`Plan::runs`].
        run: usize,
        /// How.
        pulse: Pulse,
    },
    /// A run has ended.
    Finished {
        /// Index into [`Plan::runs`].
        run: usize,
    },
}

/// Told of every event, from the threads that work.
pub type Watch = Arc<dyn Fn(Event) + Send + Sync>;

/// How one run ended: its figures, or why it failed.
pub type Ending = Result<Figures, String>;

/// The same with the radiosities found, by environment.
type Ended = Result<(Figures, Vec<Vec<Rgb>>), String>;

/// How all runs ended.
pub struct Endings {
    /// In the plan's order; none for a run that was not come to.
    pub runs: Vec<Option<Ending>>,
    /// What the host took for each run, also where it was found finished.
    pub host: Vec<Option<HostTimes>>,
    /// What became of the shots that runs asked for.
    pub shots: ShotCounts,
    /// Host memory that kept shots took at most, bytes.
    pub shot_bytes: usize,
    /// What was recorded for the report.
    pub films: Vec<Option<LightRecording>>,
    /// Dense solutions that runs were held against.
    pub dense: DenseAnswers,
}

/// Carries out all runs of a plan that are not saved in `out`, and saves each there.
///
/// # Errors
/// If a finished run cannot be saved. A run that fails is no error here: it ends so.
pub fn carry_out(plan: &Plan, out: &Path, options: &Options, watch: Watch) -> io::Result<Endings> {
    let saved = Saved::in_folder(out);
    if options.fresh || options.traces.is_some() {
        saved.forget()?;
    }
    let keys: Vec<String> = plan.runs.iter().map(|run| saved.key(plan, run, options.on)).collect();
    let found = keys.iter().map(|key| saved.load(key));
    let (found, host): (Vec<Option<Ending>>, Vec<Option<HostTimes>>) =
        found.map(|run| run.map(|(figures, host)| (Ok(figures), host)).unzip()).unzip();
    found.iter().flatten().for_each(|_| watch(Event::Found));
    let filmed = match options.on {
        On::Simulation => options.viewing.chosen(plan),
        On::Threads => vec![false; plan.runs.len()],
    };

    // Films are not saved: runs found are made again to be filmed, for that alone.
    let waiting = (0..plan.runs.len()).filter(|&run| found[run].is_none() || filmed[run]);
    let queue = Mutex::new(Queue::new(plan, waiting));
    let threads = options.threads.max(1);
    let desk = Desk {
        plan,
        options,
        watch,
        saved,
        keys,
        filmed,
        memory: Arc::new(Memory::new(options.memory)),
        helpers: Arc::new(Helpers::of(threads)),
        queue,
        runs: Mutex::new(found),
        host: Mutex::new(host),
        films: Mutex::new(plan.runs.iter().map(|_| None).collect()),
        dense: DenseAnswers::default(),
        trouble: Mutex::new(None),
    };
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| desk.helpers.work_then_help(|| desk.work()));
        }
    });
    let trouble = held(&desk.trouble).take();
    match trouble {
        Some(error) => Err(error),
        None => Ok(desk.endings()),
    }
}

/// What the workers share.
struct Desk<'a> {
    plan: &'a Plan,
    options: &'a Options,
    watch: Watch,
    saved: Saved,
    /// Under which each run is saved.
    keys: Vec<String>,
    /// Which runs are filmed.
    filmed: Vec<bool>,
    memory: Arc<Memory>,
    helpers: Arc<Helpers>,
    queue: Mutex<Queue>,
    runs: Mutex<Vec<Option<Ending>>>,
    host: Mutex<Vec<Option<HostTimes>>>,
    films: Mutex<Vec<Option<LightRecording>>>,
    dense: DenseAnswers,
    trouble: Mutex<Option<io::Error>>,
}

impl Desk<'_> {
    /// Works on runs until none waits, or one could not be saved.
    fn work(&self) {
        while held(&self.trouble).is_none() {
            let Some(task) = held(&self.queue).take(|problem| self.kept_shots(problem)) else {
                return;
            };
            let clock = HostClock::start();
            let (ended, traced) = self.run(&task);
            let host = HostTimes {
                cpu_s: clock.cpu_seconds(),
                set_up_s: self.plan.problems[task.problem].set_up_s,
                clock_s: clock.seconds(),
            };
            let run = task.run;
            let found = held(&self.runs)[run].is_some();
            let noted = if found { Ok(()) } else { self.note(&task, ended, host) };
            if let Err(error) = traced.and(noted) {
                *held(&self.trouble) = Some(error);
            }
            held(&self.queue).done(&task);
            if !found {
                (self.watch)(Event::Finished { run });
            }
        }
    }

    /// Saves how a run ended and what it took.
    fn note(&self, task: &Task, ended: Ended, host: HostTimes) -> io::Result<()> {
        let ending = ended.and_then(|(figures, radiosity)| {
            Ok(Figures { errors: self.errors(task, &radiosity)?, ..figures })
        });
        let run = task.run;
        let stored = match &ending {
            Ok(figures) => self.saved.store(&self.keys[run], figures, host),
            Err(_) => Ok(()),
        };
        held(&self.runs)[run] = Some(ending);
        held(&self.host)[run] = Some(host);
        stored
    }

    /// Where the runs of a problem keep their shots.
    fn kept_shots(&self, problem: usize) -> KeptShots {
        let files = self.options.shot_files.as_ref();
        let archive = files.map(|files| files.of(&self.plan.problems[problem]));
        KeptShots::sharing(&self.memory, &self.helpers, archive)
    }

    /// How all ended.
    fn endings(self) -> Endings {
        let (shots, shot_bytes) = (held(&self.queue).counts(), self.memory.most());
        let runs = self.runs.into_inner().unwrap_or_else(PoisonError::into_inner);
        let host = self.host.into_inner().unwrap_or_else(PoisonError::into_inner);
        let films = self.films.into_inner().unwrap_or_else(PoisonError::into_inner);
        Endings { runs, host, shots, shot_bytes, films, dense: self.dense }
    }

    /// How far a run is from the answer, if there is one; no part of what the run took of the host.
    fn errors(&self, task: &Task, radiosity: &Radiosity) -> Result<Option<ErrorFigures>, String> {
        let run = &self.plan.runs[task.run];
        let Some(answer) = self.plan.answer(run, &self.dense) else { return Ok(None) };
        let problem = &self.plan.problems[run.problem].problem;
        let yardstick = Yardstick::new(&answer, problem);
        let mut errors = yardstick.errors(radiosity);
        if run.point.error_causes {
            let machine = &self.plan.machines[run.machine].machine;
            let run = Explained { point: &run.point, problem, machine, kept: &task.kept };
            let dense = self.dense.of(problem);
            errors.causes = Some(run.causes(radiosity, &yardstick, &dense)?);
        }
        Ok(Some(errors))
    }

    /// Carries a run out, and writes its trace if there is to be one.
    fn run(&self, task: &Task) -> (Ended, io::Result<()>) {
        let run = &self.plan.runs[task.run];
        let Prepared { problem, scene_bytes, .. } = &self.plan.problems[run.problem];
        let machine = &self.plan.machines[run.machine].machine;
        let (watch, index) = (Arc::clone(&self.watch), task.run);
        let shots = AtomicU64::new(0);
        let on_shot = Arc::new(move || {
            let shots = shots.fetch_add(1, Ordering::Relaxed) + 1;
            if shots.is_multiple_of(SHOTS_TOLD) {
                watch(Event::Shots { run: index, shots });
            }
        });
        let point = &run.point;
        let nothing_kept = Arc::new(KeptShots::new(0));
        let kept = if point.reuse_shots { &task.kept } else { &nothing_kept };
        let run = simulator::run(problem, point, kept, on_shot);
        let on = self.options.on;
        let (traces, filmed) = (&self.options.traces, self.filmed[task.run]);
        let processors = run.processors;
        let film = filmed.then(|| Rc::new(RefCell::new(LightRecording::new(problem, processors))));
        // A trace needs no light.
        let recording = (traces.is_some() && !filmed)
            .then(|| Rc::new(RefCell::new(Recording::new(problem, processors))));
        let broadcast = self.broadcast(task.run, &run);
        let observers = [
            film.clone().map(|film| film as SharedObserver),
            recording.clone().map(|recording| recording as SharedObserver),
            broadcast.clone().map(|broadcast| broadcast as SharedObserver),
            self.heart(task.run, &run),
        ];
        let ended =
            simulator::carry_out(&run, point, on, machine, *scene_bytes, together(observers));
        if let (Some(broadcast), Some(feed)) = (broadcast, &self.options.feed) {
            broadcast.borrow_mut().flush();
            feed(task.run, News::End);
        }
        let film = film.and_then(Rc::into_inner).map(RefCell::into_inner);
        let recording = recording.and_then(Rc::into_inner).map(RefCell::into_inner);
        // Of a run that failed, too: there it is needed most.
        let traced =
            match (traces, film.as_ref().map(LightRecording::recording).or(recording.as_ref())) {
                (Some(traces), Some(recording)) => traces.write(self.plan, task.run, recording),
                _ => Ok(()),
            };
        held(&self.films)[task.run] = film.filter(|_| ended.is_ok());
        (ended, traced)
    }

    /// Tells those who follow runs of this one.
    fn broadcast(&self, index: usize, run: &virtwall::Run) -> Option<Rc<RefCell<Broadcast>>> {
        let feed = self.options.feed.clone().filter(|_| self.options.on == On::Simulation)?;
        let broadcast = Broadcast::new(&run.problem, run.processors, Follower::new(index, feed));
        Some(Rc::new(RefCell::new(broadcast)))
    }

    /// Tells how a run is, where that is asked for and costs no other simulation.
    fn heart(&self, index: usize, run: &virtwall::Run) -> Option<SharedObserver> {
        let of = &self.plan.runs[index];
        let machine = &self.plan.machines[of.machine].machine;
        let watched = self.options.feed.is_some() || self.filmed[index];
        let costs_nothing = watched || !network::is_open(machine);
        (self.options.pulse && costs_nothing).then(|| {
            let watch = Arc::clone(&self.watch);
            let tell = move |pulse| watch(Event::Pulse { run: index, pulse });
            Rc::new(RefCell::new(Heart::new(run, tell))) as SharedObserver
        })
    }
}

/// Observers as one, if there are any.
fn together(observers: [Option<SharedObserver>; 4]) -> Option<SharedObserver> {
    let mut observers: Vec<SharedObserver> = observers.into_iter().flatten().collect();
    match observers.len() {
        0 | 1 => observers.pop(),
        _ => Some(Rc::new(RefCell::new(Observers(observers)))),
    }
}
