//! The critical path: the chain of work and messages that decided when a run ended.

use desim::Time;
use virtwall::{Recording, Span};

use crate::film::Doing;

/// One link of the chain.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Link {
    /// On which node; for a message under way the one it comes to.
    pub node: usize,
    pub doing: Doing,
    pub from: Time,
    pub to: Time,
}

/// Followed back from the end of the compute node that finished last: what a node does was held up by
/// what it did before; a wait by the message that ended it, and that by its sender.
pub(crate) fn critical_path(recording: &Recording) -> Vec<Link> {
    let nodes: Vec<Vec<Span>> = recording.nodes.iter().map(|node| node.spans().collect()).collect();
    let arrivals = arrivals(recording);
    let compute = &recording.nodes[..recording.nodes.len() - 1];
    let last = (0..compute.len()).max_by_key(|&node| (compute[node].end(), usize::MAX - node));
    let Some(mut node) = last else { return Vec::new() };
    let mut time = recording.nodes[node].end();
    // Of messages that come at once, each must have been sent before the one that it explains.
    let mut before = u64::MAX;
    let mut path = Vec::new();
    while time > Time::ZERO {
        let ended = nodes[node].partition_point(|span| span.to < time);
        let Some(span) = nodes[node].get(ended).filter(|span| span.from < time) else { break };
        let doing = Doing::of(span.activity);
        let sent = || {
            let come =
                arrivals[node].partition_point(|&(at, number)| (at, number) < (time, before));
            let (at, number) = arrivals[node][..come].last().copied()?;
            (at > span.from).then(|| (number, recording.messages[number as usize]))
        };
        match (doing == Doing::Waiting).then(sent).flatten() {
            Some((number, message)) => {
                path.push(Link { node, doing: Doing::Travelling, from: message.sent, to: time });
                (node, time, before) = (message.from as usize, message.sent, number);
            }
            None => {
                path.push(Link { node, doing, from: span.from, to: time });
                time = span.from;
            }
        }
    }
    path.reverse();
    path
}

/// By rank, when which messages came, in that order.
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
