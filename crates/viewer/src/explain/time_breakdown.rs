//! Where the time of compute nodes went.

use desim::Time;
use virtwall::NodeRecord;

use crate::record::{NodeState, is_shot};

/// Where the time of one compute node, or of all, went, seconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct TimeBreakdown {
    /// Indexed by [`NodeState`]; waiting is split below.
    states: [f64; NodeState::COUNT],
    /// Waiting before the first shot.
    pub before: f64,
    /// Waiting between shots.
    pub between: f64,
    /// Waiting after the last shot.
    pub after: f64,
}

impl TimeBreakdown {
    /// The breakdown for one node, until `end`, when the last node knew that the run was over.
    pub fn of(node: &NodeRecord, end: Time) -> TimeBreakdown {
        let shots = || node.spans().filter(|span| is_shot(span.activity));
        let first = shots().map(|span| span.from).next().unwrap_or(Time::MAX);
        let last = shots().map(|span| span.to).last().unwrap_or(Time::ZERO);
        let mut breakdown = TimeBreakdown::default();
        for span in node.spans() {
            let seconds = (span.to - span.from).as_seconds_f64();
            *match NodeState::of(span.activity) {
                NodeState::Waiting if span.to <= first => &mut breakdown.before,
                NodeState::Waiting if span.from >= last => &mut breakdown.after,
                NodeState::Waiting => &mut breakdown.between,
                state => &mut breakdown.states[state as usize],
            } += seconds;
        }
        breakdown.after += (end - node.end()).as_seconds_f64();
        breakdown
    }

    pub fn add(&mut self, other: &TimeBreakdown) {
        self.states.iter_mut().zip(other.states).for_each(|(sum, more)| *sum += more);
        self.before += other.before;
        self.between += other.between;
        self.after += other.after;
    }

    pub fn computing(&self) -> f64 {
        self.sum(&NodeState::COMPUTING)
    }

    pub fn overhead(&self) -> f64 {
        self.sum(&NodeState::OVERHEAD)
    }

    pub fn waiting(&self) -> f64 {
        self.before + self.between + self.after
    }

    pub fn in_state(&self, state: NodeState) -> f64 {
        self.states[state as usize]
    }

    fn sum(&self, states: &[NodeState]) -> f64 {
        states.iter().map(|&state| self.in_state(state)).sum()
    }
}
