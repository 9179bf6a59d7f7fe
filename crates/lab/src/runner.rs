//! Carries a plan out: independent runs side by side, each saved as soon as it is finished.

use std::io;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use crate::engine::{self, On};
use crate::figures::Figures;
use crate::host_clock::HostClock;
use crate::plan::Plan;
use crate::queue::{Queue, Task};
use crate::saved::Saved;

/// Host memory for shots kept between runs, shared out among the problems worked on at a time.
const KEPT_BYTES: usize = 2 << 30;

/// How a plan is carried out. None of it changes what a simulated run finds.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Runs side by side, at least 1.
    pub threads: usize,
    /// Whether to forget runs that an interrupted sweep has finished.
    pub fresh: bool,
    /// What the programs run on.
    pub on: On,
}

/// Something that happened while a plan is carried out.
#[derive(Clone, Copy, Debug)]
pub enum Event {
    /// A run was found finished, by a sweep that was interrupted.
    Found,
    /// A run has shot one source more.
    Shot {
        /// Index into [`Plan::runs`].
        run: usize,
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

/// How all runs ended.
pub struct Endings {
    /// In the plan's order; none for a run that was not come to.
    pub runs: Vec<Option<Ending>>,
    /// Host seconds of each run; none for those found finished.
    pub host_seconds: Vec<Option<f64>>,
}

/// Carries out all runs of a plan that are not saved in `out`, and saves each there.
///
/// # Errors
/// If a finished run cannot be saved. A run that fails is no error here: it ends so.
pub fn carry_out(plan: &Plan, out: &Path, options: Options, watch: Watch) -> io::Result<Endings> {
    let saved = Saved::in_folder(out);
    if options.fresh {
        saved.forget()?;
    }
    let keys: Vec<String> = plan.runs.iter().map(|run| saved.key(plan, run, options.on)).collect();
    let found: Vec<Option<Ending>> = keys.iter().map(|key| saved.load(key).map(Ok)).collect();
    found.iter().flatten().for_each(|_| watch(Event::Found));

    let waiting = (0..plan.runs.len()).filter(|&run| found[run].is_none());
    let workers = options.threads.clamp(1, plan.runs.len().max(1));
    let budget = KEPT_BYTES / workers.min(plan.problems.len()).max(1);
    let desk = Desk {
        plan,
        options,
        watch,
        saved,
        keys,
        queue: Mutex::new(Queue::new(plan, waiting, budget)),
        endings: Mutex::new(Endings { runs: found, host_seconds: vec![None; plan.runs.len()] }),
        trouble: Mutex::new(None),
    };
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| desk.work());
        }
    });
    match held(&desk.trouble).take() {
        Some(error) => Err(error),
        None => Ok(desk.endings.into_inner().unwrap_or_else(PoisonError::into_inner)),
    }
}

/// What the workers share.
struct Desk<'a> {
    plan: &'a Plan,
    options: Options,
    watch: Watch,
    saved: Saved,
    /// Under which each run is saved.
    keys: Vec<String>,
    queue: Mutex<Queue>,
    endings: Mutex<Endings>,
    trouble: Mutex<Option<io::Error>>,
}

impl Desk<'_> {
    /// Works on runs until none waits, or one could not be saved.
    fn work(&self) {
        while held(&self.trouble).is_none() {
            let Some(task) = held(&self.queue).take() else { return };
            let clock = HostClock::start();
            let ending = self.run(&task);
            if let Ok(figures) = &ending
                && let Err(error) = self.saved.store(&self.keys[task.run], figures)
            {
                *held(&self.trouble) = Some(error);
            }
            let run = task.run;
            {
                let mut endings = held(&self.endings);
                endings.runs[run] = Some(ending);
                endings.host_seconds[run] = Some(clock.seconds());
            }
            held(&self.queue).done(&task);
            (self.watch)(Event::Finished { run });
        }
    }

    fn run(&self, task: &Task) -> Ending {
        let run = &self.plan.runs[task.run];
        let problem = &self.plan.problems[run.problem].problem;
        let machine = &self.plan.machines[run.machine].machine;
        let (watch, index) = (Arc::clone(&self.watch), task.run);
        let on_shot = Arc::new(move || watch(Event::Shot { run: index }));
        let point = &run.point;
        let run = engine::run(problem, point, &task.kept, on_shot);
        engine::carry_out(&run, point, self.options.on, machine)
    }
}

/// A lock that does not mind a worker's panic: that ends the program anyway.
fn held<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
