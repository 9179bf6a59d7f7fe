//! A recorded run with what was computed from its recording.

use desim::{Duration, Time};
use virtwall::NodeRecord;

use super::critical_path::{PathSegment, critical_path};
use super::time_breakdown::TimeBreakdown;
use crate::record::{NodeState, RecordedRun, is_shot};

pub(crate) struct AnalysedRun<'a> {
    pub run: &'a RecordedRun<'a>,
    pub path: Vec<PathSegment>,
    /// Seconds of the critical path, indexed by [`NodeState`].
    pub path_seconds: [f64; NodeState::COUNT],
    /// By rank, of compute nodes.
    pub nodes: Vec<TimeBreakdown>,
    /// The sum over all compute nodes.
    pub all: TimeBreakdown,
    /// The compute node that computed longest.
    pub busiest: usize,
    /// The compute node that ended a shot last, and when.
    pub last_shot: Option<(usize, Time)>,
    /// The compute node that learned last of the run's end, and when.
    pub last: (usize, Time),
    /// The number of compute nodes that shot patches of their own.
    pub with_sources: usize,
    /// Seconds of shots in each environment.
    pub environments: Vec<f64>,
}

impl<'a> AnalysedRun<'a> {
    pub fn of(run: &'a RecordedRun<'a>) -> AnalysedRun<'a> {
        let recording = &run.recording.recording;
        let compute = &recording.nodes[..recording.nodes.len() - 1];
        let path = critical_path(recording);
        let mut durations = [Duration::ZERO; NodeState::COUNT];
        path.iter()
            .for_each(|segment| durations[segment.state as usize] += segment.to - segment.from);
        let last = latest(compute.iter().map(NodeRecord::end).enumerate()).unwrap_or_default();
        let ends = compute.iter().enumerate();
        let last_shot =
            latest(ends.filter_map(|(node, record)| Some((node, record.shots.last()?.at))));
        let nodes: Vec<_> = compute.iter().map(|node| TimeBreakdown::of(node, last.1)).collect();
        let mut all = TimeBreakdown::default();
        nodes.iter().for_each(|node| all.add(node));
        let busier = |best: usize, node: usize| {
            if nodes[node].computing() > nodes[best].computing() { node } else { best }
        };
        let busiest = (0..nodes.len()).fold(0, busier);
        let shoots_its_own = |node: &&NodeRecord| {
            node.shots.iter().any(|shot| shot.environment == shot.source_environment)
        };
        AnalysedRun {
            run,
            path,
            path_seconds: durations.map(Duration::as_seconds_f64),
            nodes,
            all,
            busiest,
            last_shot,
            last,
            with_sources: compute.iter().filter(shoots_its_own).count(),
            environments: seconds_by_environment(compute),
        }
    }

    /// Virtual time of the whole run, seconds.
    pub fn seconds(&self) -> f64 {
        self.last.1.as_seconds_f64()
    }

    pub fn processors(&self) -> usize {
        self.run.recording.processors()
    }
}

/// The node with the latest time; of equals the first.
fn latest(times: impl Iterator<Item = (usize, Time)>) -> Option<(usize, Time)> {
    times.reduce(|best, next| if next.1 > best.1 { next } else { best })
}

/// Seconds of shots in each environment, on whatever node it is.
fn seconds_by_environment(nodes: &[NodeRecord]) -> Vec<f64> {
    let mut seconds = Vec::new();
    for node in nodes {
        let mut shots = node.shots.iter().peekable();
        // A shot may have several spans, such as its kernel and its cache misses: it ends with the last of them.
        // A shot that takes no time has none.
        for span in node.spans().filter(|span| is_shot(span.activity)) {
            while shots.next_if(|shot| shot.at < span.to).is_some() {}
            let Some(shot) = shots.peek() else { break };
            let environment = shot.environment as usize;
            seconds.resize(seconds.len().max(environment + 1), 0.0);
            seconds[environment] += (span.to - span.from).as_seconds_f64();
        }
    }
    seconds
}
