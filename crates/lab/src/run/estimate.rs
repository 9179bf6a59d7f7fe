//! How long the rest of a sweep will take the host: from what its runs have cost so far. Reads no clock.
//!
//! A run costs the time to simulate its shots, and the time that it waits for those that are not in memory. The
//! first run of a problem waits for nearly all, the later ones for few. So both are measured apart, per shot, and
//! a run that has not begun is expected to cost what those cost that are most like it.

use std::collections::BTreeMap;

use crate::planning::plan::{Plan, Run};
use crate::run::runner::Event;
use crate::run::shot_sum::Done;

/// What is known of a run in advance.
#[derive(Clone, Copy, Debug)]
pub struct Known {
    /// Which problem it is of.
    pub problem: usize,
    /// Which machine it is on.
    pub machine: usize,
    /// Its processors.
    pub processors: u32,
    /// Whether it uses shots of other runs.
    pub reuses: bool,
    /// Whether its threshold is so high that it shoots little more than the lights.
    pub lights_only: bool,
    /// Patches of its problem.
    pub patches: usize,
}

impl Known {
    /// What is known of a run of a plan.
    pub fn of(plan: &Plan, run: &Run) -> Known {
        Known {
            problem: run.problem,
            machine: run.machine,
            processors: run.point.processors,
            reuses: run.point.reuse_shots,
            lights_only: run.point.stop.patch_threshold.value() >= LIGHTS_ONLY,
            patches: plan.problems[run.problem].problem.patches(),
        }
    }
}

/// Seconds that may be left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Left {
    /// Rather more than this.
    pub least: f64,
    /// The best estimate.
    pub likely: f64,
    /// Rather less than this.
    pub most: f64,
}

/// Estimates what is left.
pub struct Estimator {
    runs: Vec<Track>,
    /// By problem, its first run in the plan's order.
    first: Vec<usize>,
    /// By problem, whether one of its runs has made shots.
    begun: Vec<bool>,
    /// By problem, what its runs had done at their last event.
    done: Vec<Done>,
    threads: usize,
}

/// What a run has done so far.
struct Track {
    known: Known,
    state: State,
    /// Seconds from its start to its last event.
    took: f64,
    shots: f64,
    /// Power of its shots of patches over the emitted power.
    power: f64,
    /// Shots that were not in memory.
    new: f64,
    /// Seconds that it waited for these.
    waited: f64,
    /// Whether it began before another run of its problem had ended.
    is_first: bool,
}

#[derive(Clone, Copy, PartialEq)]
enum State {
    Waiting,
    /// Since this second.
    UnderWay(f64),
    Ended,
    /// By a sweep that was interrupted: it tells nothing of costs.
    Found,
}

/// How much a run counts in the estimate of another: `problem` if that is another problem, `machine` if another
/// machine. Each of the three estimates has one that decides, so that it counts a thousandth.
#[derive(Clone, Copy)]
struct Likeness {
    problem: f64,
    machine: f64,
}

/// Simulating a shot takes as long as the machine's models do, on any problem.
const SIMULATING: Likeness = Likeness { problem: 0.03, machine: 0.001 };
/// How many shots there are, and how long one is cast, the problem decides.
const SHOOTING: Likeness = Likeness { problem: 0.001, machine: 1.0 };
/// A run's own figures outweigh all others.
const ITSELF: f64 = 1e6;

/// The most steps of an estimate. Sweeps of very many runs that differ much have none.
const MOST_STEPS: usize = 2_000_000;

/// The power that the first run of a problem must have shot before its shots are extrapolated.
const LEAST_POWER: f64 = 0.02;

/// The least threshold per patch of such runs: half of the paper's. At lower ones reflected light is shot, too, and
/// nothing tells how much until a run has ended.
const LIGHTS_ONLY: f64 = 0.05;

/// By what factor estimates may be off, of runs like those that were measured, and of problems of which none was.
const KNOWN: f64 = 1.2;
const UNKNOWN: f64 = 4.0;

/// Shots of a problem of which no run has begun go by its patches to this power: midway between as many as in
/// other problems and as many for each patch.
const BY_PATCHES: f64 = 0.5;

impl Estimator {
    /// Nothing has been done yet.
    pub fn new(runs: impl IntoIterator<Item = Known>, threads: usize) -> Estimator {
        let runs: Vec<Track> = runs.into_iter().map(Track::new).collect();
        let problems = runs.iter().map(|run| run.known.problem + 1).max().unwrap_or(0);
        let mut first = vec![0; problems];
        runs.iter().enumerate().rev().for_each(|(i, run)| first[run.known.problem] = i);
        let (done, begun) = (vec![Done::default(); problems], vec![false; problems]);
        Estimator { runs, first, done, begun, threads: threads.max(1) }
    }

    /// The runs of a plan.
    pub fn of(plan: &Plan, threads: usize) -> Estimator {
        Estimator::new(plan.runs.iter().map(|run| Known::of(plan, run)), threads)
    }

    /// Something has happened after `seconds`.
    pub fn note(&mut self, seconds: f64, event: Event) {
        match event {
            Event::Found { run } => self.runs[run].state = State::Found,
            Event::Started { run } => {
                let problem = self.runs[run].known.problem;
                let ended =
                    |other: &Track| other.known.problem == problem && other.state == State::Ended;
                self.runs[run].is_first = !self.runs.iter().any(ended);
                self.runs[run].state = State::UnderWay(seconds);
            }
            Event::Shots { run, done } => self.measure(seconds, run, done),
            Event::Finished { run, done } => {
                self.measure(seconds, run, done);
                self.runs[run].state = State::Ended;
            }
            Event::Counters { .. } => {}
        }
    }

    fn measure(&mut self, seconds: f64, run: usize, done: Done) {
        let run = &mut self.runs[run];
        let State::UnderWay(since) = run.state else { return };
        let before = std::mem::replace(&mut self.done[run.known.problem], done);
        self.begun[run.known.problem] |= done.shots > 0;
        run.took = seconds - since;
        (run.shots, run.power) = (done.shots as f64, done.power);
        run.new += done.new.saturating_sub(before.new) as f64;
        run.waited += (done.waited_s - before.waited_s).max(0.0);
    }

    /// What is left after `seconds`; `None` as long as nothing tells.
    pub fn left(&self, seconds: f64) -> Option<Left> {
        // Seconds of each run, and whether none of its problem has begun.
        let mut runs = Vec::new();
        // Runs that wait and have the same in common with others cost the same.
        let mut alike = BTreeMap::new();
        for run in &self.runs {
            let left = match run.state {
                State::Ended | State::Found => continue,
                State::Waiting => {
                    let Known { problem, machine, processors, reuses, .. } = run.known;
                    let kind = (problem, machine, processors, reuses, self.is_next(run));
                    if let Some(&cost) = alike.get(&kind) {
                        cost
                    } else if alike.len() * self.runs.len() < MOST_STEPS {
                        let cost = self.cost(run, self.shots(run)?)?;
                        alike.insert(kind, cost);
                        cost
                    } else {
                        return None;
                    }
                }
                State::UnderWay(since) => {
                    let further = (self.shots(run)? - run.shots).max(0.0);
                    // Since its last event it has made shots, too.
                    let passed = seconds - since - run.took;
                    (self.cost(run, further)? - passed).max(0.0)
                }
            };
            runs.push((left, !self.begun[run.known.problem]));
        }
        // Threads share runs and help each other, but no run is divided.
        let time = |known: f64, unknown: f64| {
            let times = runs.iter().map(|(left, new)| left * if *new { unknown } else { known });
            let (sum, longest) =
                times.fold((0.0, 0.0_f64), |(sum, most), time| (sum + time, most.max(time)));
            (sum / self.threads as f64).max(longest)
        };
        Some(Left {
            least: time(1.0 / KNOWN, 1.0 / UNKNOWN),
            likely: time(1.0, 1.0),
            most: time(KNOWN, UNKNOWN),
        })
    }

    /// All shots that a run will have made.
    fn shots(&self, run: &Track) -> Option<f64> {
        let own = (run.shots > 0.0).then(|| run.all_shots()).flatten();
        let size = |run: &Track| (run.known.patches as f64).powf(BY_PATCHES);
        let by_size = |other: &Track| Some((other.all_shots()? / size(other), 1.0));
        own.or_else(|| Some(self.mean(run, SHOOTING, by_size)? * size(run)))
    }

    /// Seconds that a run needs for this number of further shots.
    fn cost(&self, run: &Track, shots: f64) -> Option<f64> {
        let simulating = self.mean(run, SIMULATING, |other| {
            (other.shots > 0.0).then_some(((other.took - other.waited).max(0.0), other.shots))
        })?;
        let new = self.new_share(run) * shots;
        let waited = |other: &Track| (other.new > 0.0).then_some((other.waited, other.new));
        let waiting = self.mean(run, SHOOTING, waited);
        Some(shots * simulating + new * waiting.unwrap_or(0.0))
    }

    /// The share of a run's further shots that will not be in memory.
    fn new_share(&self, run: &Track) -> f64 {
        if run.shots > 0.0 {
            return run.new / run.shots;
        }
        let of_problem = |other: &&Track| other.known.problem == run.known.problem;
        let begun = |other: &&Track| other.shots > 0.0;
        if !run.known.reuses || self.is_next(run) {
            return 1.0;
        }
        let later = self.runs.iter().filter(of_problem).filter(begun).filter(|r| !r.is_first);
        let (new, shots) = later.fold((0.0, 0.0), |(n, s), run| (n + run.new, s + run.shots));
        if shots > 0.0 { new / shots } else { 0.0 }
    }

    /// Whether it will be the first run of its problem.
    fn is_next(&self, run: &Track) -> bool {
        let problem = run.known.problem;
        !self.begun[problem] && std::ptr::eq(&raw const self.runs[self.first[problem]], run)
    }

    /// A quotient of two sums over runs, each of which counts the more the more it is like this one.
    fn mean(
        &self,
        like: &Track,
        likeness: Likeness,
        of: impl Fn(&Track) -> Option<(f64, f64)>,
    ) -> Option<f64> {
        let (mut over, mut under) = (0.0, 0.0);
        for run in &self.runs {
            if let Some((value, count)) = of(run) {
                let weight = likeness.of(run, like);
                over += weight * value;
                under += weight * count;
            }
        }
        (under > 0.0).then(|| over / under)
    }
}

impl Track {
    fn new(known: Known) -> Track {
        let (took, shots, power, new, waited) = (0.0, 0.0, 0.0, 0.0, 0.0);
        Track { known, state: State::Waiting, took, shots, power, new, waited, is_first: false }
    }

    /// All its shots, once it has ended; before, from the share of the emitted power that it has shot, if it
    /// shoots little else.
    fn all_shots(&self) -> Option<f64> {
        match self.state {
            State::Ended => Some(self.shots),
            State::UnderWay(_) if self.known.lights_only && self.power >= LEAST_POWER => {
                Some(self.shots / self.power.min(1.0))
            }
            _ => None,
        }
    }
}

impl Likeness {
    fn of(self, one: &Track, other: &Track) -> f64 {
        if std::ptr::eq(one, other) {
            return ITSELF;
        }
        let (a, b) = (&one.known, &other.known);
        let factor = |same: bool, otherwise: f64| if same { 1.0 } else { otherwise };
        let apart = (f64::from(a.processors) / f64::from(b.processors)).ln();
        factor(a.problem == b.problem, self.problem) * factor(a.machine == b.machine, self.machine)
            / (1.0 + apart * apart)
    }
}
