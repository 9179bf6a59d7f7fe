//! Termination detection by a token that goes round a ring, as RR-3008 states it.

use multicomputer::Rank;

/// One compute node's part in the ring of §4.2.4.
///
/// "A token, whose value is initially true, is sent through the ring. If a compute node has sent a
/// patch to another node in the ring since the last visit, the value of the token is changed to
/// false." Like Dijkstra's rule it takes messages to arrive at once; where they do not, it may
/// announce the end while a source is still under way. The simulator sees that and says so.
#[doc(alias = "TerminationDetection")]
pub(crate) struct Ring {
    rank: Rank,
    nodes: usize,
    /// Whether this node has sent a patch since the token's last visit.
    has_sent: bool,
    /// The token, while it is here.
    token: Option<bool>,
}

/// What a node with nothing left to do does with the token.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Step {
    /// It is elsewhere.
    Wait,
    /// Pass it on with this value.
    Pass(Rank, bool),
    /// Tell everybody that the computation has ended.
    Announce,
}

impl Ring {
    /// The first node holds the token at first, with a value that ends nothing.
    ///
    /// Choice C14: it starts the first round when it first has nothing to compute.
    pub(crate) fn new(rank: Rank, nodes: usize) -> Ring {
        Ring { rank, nodes, has_sent: false, token: (rank == 0).then_some(false) }
    }

    /// This node sends a patch to another.
    pub(crate) fn patch_sent(&mut self) {
        self.has_sent = true;
    }

    /// The token arrives.
    pub(crate) fn token_arrived(&mut self, value: bool) {
        self.token = Some(value);
    }

    /// This node has nothing to compute: what it does with the token.
    pub(crate) fn step(&mut self) -> Step {
        if self.nodes == 1 {
            return Step::Announce;
        }
        let Some(value) = self.token.take() else { return Step::Wait };
        let next = (self.rank + 1) % self.nodes;
        let has_sent = std::mem::take(&mut self.has_sent);
        let unchanged = value && !has_sent;
        match self.rank {
            0 if unchanged => Step::Announce,
            0 => Step::Pass(next, true),
            _ => Step::Pass(next, unchanged),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Let the token go round three idle nodes; `sender` has sent a patch before.
    fn rounds(sender: Option<Rank>) -> usize {
        let mut nodes: Vec<Ring> = (0..3).map(|rank| Ring::new(rank, 3)).collect();
        if let Some(rank) = sender {
            nodes[rank].patch_sent();
        }
        let mut at = 0;
        for passes in 0.. {
            match nodes[at].step() {
                Step::Pass(to, value) => {
                    nodes[to].token_arrived(value);
                    at = to;
                }
                Step::Announce => return passes / 3,
                Step::Wait => unreachable!("the token is here"),
            }
        }
        unreachable!()
    }

    #[test]
    fn a_quiet_round_ends_it_and_a_patch_costs_another() {
        assert_eq!(rounds(None), 1);
        assert_eq!(rounds(Some(0)), 1); // sent before the token's first start from node 0
        assert_eq!(rounds(Some(1)), 2);
        assert_eq!(rounds(Some(2)), 2);
    }

    #[test]
    fn without_the_token_a_node_waits() {
        assert_eq!(Ring::new(1, 3).step(), Step::Wait);
        assert_eq!(Ring::new(0, 1).step(), Step::Announce);
    }
}
