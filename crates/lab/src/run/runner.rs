//! Carries a plan out: independent runs side by side, each saved as soon as it is finished.

use std::cell::RefCell;
use std::io;
use std::path::Path;
use std::rc::Rc;
use std::sync::{Arc, Mutex, PoisonError};

use radiosity::Rgb;
use viewer::{Broadcast, LightRecording};
use virtwall::{
    Helpers, KeptShots, Memory, Observers, Recording, SharedObserver, ShotCounts, ShotMeter, Source,
};

use crate::accuracy::answer::DenseAnswers;
use crate::accuracy::causes::Explained;
use crate::accuracy::errors::ErrorMeasure;
use crate::engine::error_figures::ErrorFigures;
use crate::engine::figures::Figures;
use crate::engine::network;
use crate::engine::simulator::{self, On};
use crate::host::held::held;
use crate::host::host_clock::{HostClock, HostTimes, host_seconds};
use crate::planning::plan::{Plan, Prepared};
use crate::run::feed::{Feed, Follower, News};
use crate::run::progress::{Counters, ProgressObserver};
use crate::run::queue::{Queue, Task};
use crate::run::saved::Saved;
use crate::run::shot_files::ShotFiles;
use crate::run::shot_sum::{Done, ShotSum};
use crate::run::traces::Traces;
use crate::run::viewing::Viewing;

/// How a plan is carried out. None of it changes what a simulated run finds.
pub struct Options {
    /// Threads, at least 1. Each carries out a run; when no run waits, it helps with others.
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
    /// Receives news of simulated runs while they are under way.
    pub feed: Option<Feed>,
    /// Whether simulated runs report progress counters, as events.
    pub counters: bool,
}

/// One shot in this number is reported: all threads report to the same watcher.
const SHOTS_REPORTED: u64 = 64;

/// Something that happened while a plan is carried out.
#[derive(Clone, Copy, Debug)]
pub enum Event {
    /// A run was finished before, by a sweep that was interrupted.
    Found {
        /// Index into [`Plan::runs`].
        run: usize,
    },
    /// A run has begun.
    Started {
        /// Index into [`Plan::runs`].
        run: usize,
    },
    /// A run has shot some more sources.
    Shots {
        /// Index into [`Plan::runs`].
        run: usize,
        /// What it has done.
        done: Done,
    },
    /// Progress counters of a run, at intervals of host time.
    Counters {
        /// Index into [`Plan::runs`].
        run: usize,
        /// The counters.
        counters: Counters,
    },
    /// A run has ended.
    Finished {
        /// Index into [`Plan::runs`].
        run: usize,
        /// What it has done.
        done: Done,
    },
}

/// Receives every event, from the threads that work.
pub type Watch = Arc<dyn Fn(Event) + Send + Sync>;

/// How one run ended: its figures, or why it failed.
pub type Ending = Result<Figures, String>;

/// The same with the radiosities, by environment.
type Ended = Result<(Figures, Vec<Vec<Rgb>>), String>;

/// How all runs ended.
#[derive(Default)]
pub struct Endings {
    /// In the plan's order; none for a run that was not started.
    pub runs: Vec<Option<Ending>>,
    /// Host times of each run, also where it was finished before.
    pub host: Vec<Option<HostTimes>>,
    /// Shots that runs asked for: found or cast.
    pub shots: ShotCounts,
    /// Most host memory used for kept shots, bytes.
    pub shot_bytes: usize,
    /// Recordings for the report.
    pub recordings: Vec<Option<LightRecording>>,
    /// Dense solutions that runs were compared with.
    pub dense: DenseAnswers,
}

/// Carries out all runs of a plan that are not saved in `out`, and saves each there.
///
/// # Errors
/// If a finished run cannot be saved. A run that fails is no error here: its ending says so.
pub fn carry_out(plan: &Plan, out: &Path, options: &Options, watch: Watch) -> io::Result<Endings> {
    let saved = Saved::in_folder(out);
    if options.fresh || options.traces.is_some() {
        saved.forget()?;
    }
    let keys: Vec<String> = plan.runs.iter().map(|run| saved.key(plan, run, options.on)).collect();
    let found = keys.iter().map(|key| saved.load(key));
    let (found, host): (Vec<Option<Ending>>, Vec<Option<HostTimes>>) =
        found.map(|run| run.map(|(figures, host)| (Ok(figures), host)).unzip()).unzip();
    let ended = found.iter().enumerate().filter(|(_, found)| found.is_some());
    ended.for_each(|(run, _)| watch(Event::Found { run }));
    let recorded = match options.on {
        On::Simulation => options.viewing.chosen(plan),
        On::Threads => vec![false; plan.runs.len()],
    };

    // Recordings are not saved: finished runs are simulated again to be recorded.
    let waiting = (0..plan.runs.len()).filter(|&run| found[run].is_none() || recorded[run]);
    let queue = Mutex::new(Queue::new(plan, waiting));
    let threads = options.threads.max(1);
    let shared = Shared {
        plan,
        options,
        watch,
        saved,
        keys,
        recorded,
        memory: Arc::new(Memory::new(options.memory)),
        helpers: Arc::new(Helpers::of(threads)),
        queue,
        meters: plan.problems.iter().map(|_| Arc::new(ShotMeter::new(host_seconds))).collect(),
        endings: Mutex::new(Endings {
            runs: found,
            host,
            recordings: plan.runs.iter().map(|_| None).collect(),
            ..Endings::default()
        }),
        dense: DenseAnswers::default(),
        trouble: Mutex::new(None),
    };
    let work = || shared.helpers.work_then_help(|| shared.work());
    std::thread::scope(|scope| {
        let others = parallel::start(scope, threads - 1, work);
        shared.helpers.without(threads - 1 - others.len());
        work();
    });
    let trouble = held(&shared.trouble).take();
    trouble.map_or_else(|| Ok(shared.endings()), Err)
}

struct Shared<'a> {
    plan: &'a Plan,
    options: &'a Options,
    watch: Watch,
    saved: Saved,
    keys: Vec<String>,
    recorded: Vec<bool>,
    memory: Arc<Memory>,
    helpers: Arc<Helpers>,
    queue: Mutex<Queue>,
    /// By problem, what shots cost that are not in memory.
    meters: Vec<Arc<ShotMeter>>,
    endings: Mutex<Endings>,
    dense: DenseAnswers,
    trouble: Mutex<Option<io::Error>>,
}

impl Shared<'_> {
    /// Works on runs until none waits, or one could not be saved.
    fn work(&self) {
        while held(&self.trouble).is_none() {
            let Some(task) = held(&self.queue).take(|problem| self.kept_shots(problem)) else {
                return;
            };
            let problem = &self.plan.problems[task.problem].problem;
            let shots = Arc::new(ShotSum::new(problem, &self.meters[task.problem]));
            let answer = self.check_answer(&task);
            let clock = HostClock::start();
            (self.watch)(Event::Started { run: task.run });
            let (ended, traced) = match answer {
                Ok(()) => self.run(&task, &shots),
                Err(message) => (Err(message), Ok(())),
            };
            let host = HostTimes {
                cpu_s: clock.cpu_seconds(),
                set_up_s: self.plan.problems[task.problem].set_up_s,
                clock_s: clock.seconds(),
            };
            let run = task.run;
            let found = held(&self.endings).runs[run].is_some();
            let noted = if found { Ok(()) } else { self.note(&task, ended, host) };
            if let Err(error) = traced.and(noted) {
                *held(&self.trouble) = Some(error);
            }
            held(&self.queue).done(&task);
            if !found {
                let done = shots.done();
                (self.watch)(Event::Finished { run, done });
            }
        }
    }

    fn note(&self, task: &Task, ended: Ended, host: HostTimes) -> io::Result<()> {
        let ending = ended.and_then(|(figures, radiosity)| {
            Ok(Figures { errors: self.errors(task, &radiosity)?, ..figures })
        });
        let run = task.run;
        let stored = match &ending {
            Ok(figures) => self.saved.store(&self.keys[run], figures, host),
            Err(_) => Ok(()),
        };
        let mut endings = held(&self.endings);
        endings.runs[run] = Some(ending);
        endings.host[run] = Some(host);
        stored
    }

    fn kept_shots(&self, problem: usize) -> KeptShots {
        let files = self.options.shot_files.as_ref();
        let archive = files.map(|files| files.of(&self.plan.problems[problem]));
        KeptShots::sharing(&self.memory, &self.helpers, archive).measured(&self.meters[problem])
    }

    fn endings(self) -> Endings {
        let (shots, shot_bytes) = (held(&self.queue).counts(), self.memory.most());
        let endings = self.endings.into_inner().unwrap_or_else(PoisonError::into_inner);
        Endings { shots, shot_bytes, dense: self.dense, ..endings }
    }

    /// Checks that what a run is compared with is not dark.
    fn check_answer(&self, task: &Task) -> Result<(), String> {
        let answer = self.plan.answer(&self.plan.runs[task.run], &self.dense);
        answer.map_or(Ok(()), |answer| answer.check())
    }

    /// The error of a run against its answer, if there is one. Its host time does not count as the run's.
    fn errors(&self, task: &Task, radiosity: &[Vec<Rgb>]) -> Result<Option<ErrorFigures>, String> {
        let run = &self.plan.runs[task.run];
        let Some(answer) = self.plan.answer(run, &self.dense) else { return Ok(None) };
        let problem = &self.plan.problems[run.problem].problem;
        let measure = ErrorMeasure::new(&answer, problem)?;
        let mut errors = measure.errors(radiosity);
        if run.point.error_causes {
            let machine = &self.plan.machines[run.machine].machine;
            let run = Explained { point: &run.point, problem, machine, kept: &task.kept };
            let dense = self.dense.of(problem);
            errors.causes = Some(run.causes(radiosity, &measure, &dense)?);
        }
        Ok(Some(errors))
    }

    fn run(&self, task: &Task, shots: &Arc<ShotSum>) -> (Ended, io::Result<()>) {
        let run = &self.plan.runs[task.run];
        let Prepared { problem, scene_bytes, .. } = &self.plan.problems[run.problem];
        let machine = &self.plan.machines[run.machine].machine;
        let (watch, index) = (Arc::clone(&self.watch), task.run);
        let shots = Arc::clone(shots);
        let nothing_kept = Arc::new(KeptShots::new(0).measured(&self.meters[task.problem]));
        let on_shot = Arc::new(move |source: &Source| {
            if shots.add(source).is_multiple_of(SHOTS_REPORTED) {
                watch(Event::Shots { run: index, done: shots.done() });
            }
        });
        let point = &run.point;
        let kept = if point.reuse_shots { &task.kept } else { &nothing_kept };
        let run = simulator::run(problem, point, kept, on_shot);
        let on = self.options.on;
        let (traces, recorded) = (&self.options.traces, self.recorded[task.run]);
        let processors = run.processors;
        let light =
            recorded.then(|| Rc::new(RefCell::new(LightRecording::new(problem, processors))));
        // A trace needs no light.
        let recording = (traces.is_some() && !recorded)
            .then(|| Rc::new(RefCell::new(Recording::new(problem, processors))));
        let broadcast = self.broadcast(task.run, &run);
        let observers = [
            light.clone().map(|light| light as SharedObserver),
            recording.clone().map(|recording| recording as SharedObserver),
            broadcast.clone().map(|broadcast| broadcast as SharedObserver),
            self.progress(task.run, &run),
        ];
        let ended =
            simulator::carry_out(&run, point, on, machine, *scene_bytes, together(observers));
        if let (Some(broadcast), Some(feed)) = (broadcast, &self.options.feed) {
            broadcast.borrow_mut().flush();
            feed(task.run, News::End);
        }
        let light = light.and_then(Rc::into_inner).map(RefCell::into_inner);
        let recording = recording.and_then(Rc::into_inner).map(RefCell::into_inner);
        // Also for a run that failed: it is needed most there.
        let traced =
            match (traces, light.as_ref().map(|light| &light.recording).or(recording.as_ref())) {
                (Some(traces), Some(recording)) => traces.write(self.plan, task.run, recording),
                _ => Ok(()),
            };
        held(&self.endings).recordings[task.run] = light.filter(|_| ended.is_ok());
        (ended, traced)
    }

    /// The observer that feeds live viewers, if there is a feed.
    fn broadcast(&self, index: usize, run: &virtwall::Run) -> Option<Rc<RefCell<Broadcast>>> {
        let feed = self.options.feed.clone().filter(|_| self.options.on == On::Simulation)?;
        let broadcast = Broadcast::new(&run.problem, run.processors, Follower::new(index, feed));
        Some(Rc::new(RefCell::new(broadcast)))
    }

    /// The observer that reports progress counters, if asked for and if it needs no extra simulation.
    fn progress(&self, index: usize, run: &virtwall::Run) -> Option<SharedObserver> {
        let of = &self.plan.runs[index];
        let machine = &self.plan.machines[of.machine].machine;
        let watched = self.options.feed.is_some() || self.recorded[index];
        let costs_nothing = watched || !network::is_open(machine);
        (self.options.counters && costs_nothing).then(|| {
            let watch = Arc::clone(&self.watch);
            let report = move |counters| watch(Event::Counters { run: index, counters });
            Rc::new(RefCell::new(ProgressObserver::new(run, report))) as SharedObserver
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
