//! How long the rest of a sweep will take the host: from what its runs have cost so far. Reads no clock.
//!
//! A run costs the time to simulate its shots, and the time that it waits for those that are not in memory. The
//! first run of a problem waits for nearly all, the later ones for few. So both are measured apart, per shot, and
//! a run that has not begun is expected to cost what those cost that are most like it.

use crate::planning::plan::Plan;
use crate::run::runner::{Done, Event};

/// What is known of a run in advance.
#[derive(Clone, Copy, Debug)]
pub struct Known {
    /// Which problem it is of.
    pub problem: usize,
    /// Which machine it is on.
    pub machine: usize,
    /// On so many processors.
    pub processors: u32,
    /// Whether it uses shots of other runs.
    pub reuses: bool,
    /// Patches of its problem.
    pub patches: usize,
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

/// The power that the first run of a problem must have shot before its shots are extrapolated.
const LEAST_POWER: f64 = 0.02;

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
        Estimator { runs, done: vec![Done::default(); problems], threads: threads.max(1) }
    }

    /// The runs of a plan.
    pub fn of(plan: &Plan, threads: usize) -> Estimator {
        let known = |run: &crate::planning::plan::Run| Known {
            problem: run.problem,
            machine: run.machine,
            processors: run.point.processors,
            reuses: run.point.reuse_shots,
            patches: plan.problems[run.problem].problem.patches(),
        };
        Estimator::new(plan.runs.iter().map(known), threads)
    }

    /// Something has happened after `seconds`.
    pub fn note(&mut self, seconds: f64, event: Event) {
        match event {
            Event::Found { run } => self.runs[run].state = State::Found,
            Event::Started { run } => {
                let problem = self.runs[run].known.problem;
                let ended = |other: &Track| {
                    other.known.problem == problem && other.state == State::Ended
                };
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
        run.took = seconds - since;
        (run.shots, run.power) = (done.shots as f64, done.power);
        run.new += done.new.saturating_sub(before.new) as f64;
        run.waited += (done.waited_s - before.waited_s).max(0.0);
    }

    /// What is left after `seconds`; `None` as long as nothing tells.
    pub fn left(&self, seconds: f64) -> Option<Left> {
        let (mut sum, mut unsure, mut longest) = (0.0, 0.0, 0.0_f64);
        for run in &self.runs {
            let left = match run.state {
                State::Ended | State::Found => continue,
                State::Waiting => self.cost(run, self.shots(run)?)?,
                State::UnderWay(since) => {
                    let all = self.shots(run)?.max(run.shots);
                    // Since its last event it has made shots, too.
                    let passed = seconds - since - run.took;
                    (self.cost(run, all - run.shots)? - passed).max(0.0)
                }
            };
            sum += left;
            unsure += if self.is_begun(run.known.problem) { 0.0 } else { left };
            longest = longest.max(left);
        }
        let sure = sum - unsure;
        // Threads share runs and help each other.
        let time = |factor: f64, other: f64| {
            ((sure * factor + unsure * other) / self.threads as f64).max(longest * factor.min(1.0))
        };
        Some(Left {
            least: time(1.0 / KNOWN, 1.0 / UNKNOWN),
            likely: time(1.0, 1.0),
            most: time(KNOWN, UNKNOWN),
        })
    }

    fn is_begun(&self, problem: usize) -> bool {
        self.runs.iter().any(|run| run.known.problem == problem && run.shots > 0.0)
    }

    /// All shots that a run will have made.
    fn shots(&self, run: &Track) -> Option<f64> {
        let own = (run.shots > 0.0).then(|| run.all_shots()).flatten();
        let size = |run: &Track| (run.known.patches as f64).powf(BY_PATCHES);
        let by_size = |other: &Track| Some((other.all_shots()? / size(other), 1.0));
        own.or_else(|| Some(self.mean(run, SHOOTING, by_size)? * size(run)))
    }

    /// Seconds that a run needs for so many shots more.
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
        if !run.known.reuses || !self.is_begun(run.known.problem) && self.is_next(run) {
            return 1.0;
        }
        let later = self.runs.iter().filter(of_problem).filter(begun).filter(|r| !r.is_first);
        let (new, shots) = later.fold((0.0, 0.0), |(n, s), run| (n + run.new, s + run.shots));
        if shots > 0.0 { new / shots } else { 0.0 }
    }

    /// Whether it is the first run of its problem.
    fn is_next(&self, run: &Track) -> bool {
        let first = self.runs.iter().find(|other| other.known.problem == run.known.problem);
        first.is_some_and(|first| std::ptr::eq(first, run))
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

    /// All its shots, once it has ended; before, from the share of the emitted power that it has shot. When
    /// that is all, what is left is reflected light, and nothing tells how much of it will be shot.
    fn all_shots(&self) -> Option<f64> {
        match self.state {
            State::Ended => Some(self.shots),
            State::UnderWay(_) if (LEAST_POWER..1.0).contains(&self.power) => {
                Some(self.shots / self.power)
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
