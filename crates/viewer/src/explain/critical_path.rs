//! The critical path: the chain of work and messages that determined when a run ended.

use desim::Time;
use virtwall::{Recording, Span};

use crate::record::NodeState;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PathSegment {
    /// The node; of a message under way its receiver.
    pub node: usize,
    pub state: NodeState,
    pub from: Time,
    pub to: Time,
}

/// Followed back from the end of the compute node that finished last: what a node does depends on what
/// it did before, a wait on the message that ended it, and the message on its sender.
pub(crate) fn critical_path(recording: &Recording) -> Vec<PathSegment> {
    let nodes: Vec<Vec<Span>> = recording.nodes.iter().map(|node| node.spans().collect()).collect();
    let arrivals = arrivals(recording);
    let compute = &recording.nodes[..recording.nodes.len() - 1];
    let last = (0..compute.len()).max_by_key(|&node| (compute[node].end(), usize::MAX - node));
    let Some(mut node) = last else { return Vec::new() };
    let mut time = recording.nodes[node].end();
    // Where messages take no time, several arrive at one time: each must have been sent before the one
    // that it explains.
    let mut before = u64::MAX;
    let mut path = Vec::new();
    while time > Time::ZERO {
        let ended = nodes[node].partition_point(|span| span.to < time);
        let Some(span) = nodes[node].get(ended).filter(|span| span.from < time) else { break };
        let state = NodeState::of(span.activity);
        let awaited = || {
            let arrived =
                arrivals[node].partition_point(|&(at, number)| (at, number) < (time, before));
            let (at, number) = arrivals[node][..arrived].last().copied()?;
            (at > span.from).then(|| (number, recording.messages[number as usize]))
        };
        match (state == NodeState::Waiting).then(awaited).flatten() {
            Some((number, message)) => {
                let state = NodeState::Travelling;
                path.push(PathSegment { node, state, from: message.sent, to: time });
                (node, time, before) = (message.from as usize, message.sent, number);
            }
            None => {
                path.push(PathSegment { node, state, from: span.from, to: time });
                time = span.from;
            }
        }
    }
    path.reverse();
    path
}

/// By rank, the times and numbers of arriving messages, sorted.
fn arrivals(recording: &Recording) -> Vec<Vec<(Time, u64)>> {
    let mut arrivals = vec![Vec::new(); recording.nodes.len()];
    for (message, number) in recording.messages.iter().zip(0..) {
        if let Some(at) = message.arrived {
            arrivals[message.to as usize].push((at, number));
        }
    }
    arrivals.iter_mut().for_each(|node| node.sort_unstable());
    arrivals
}
