//! The paper's protocol: a token with a truth value that goes round a ring of all compute nodes.

use super::protocol::{Action, Termination};
use crate::problem::Rank;

/// The protocol's state on one compute node.
///
/// "A token, whose value is initially true, is sent through the ring. If a compute node has sent a
/// patch to another node in the ring since the last visit, the value of the token is changed to
/// false." Like Dijkstra's rule it assumes that messages arrive at once. Where they do not, it can
/// announce the end while a source is still under way; the run's result says so.
#[doc(alias = "TerminationDetection")]
pub(super) struct TokenRing {
    rank: Rank,
    nodes: usize,
    /// Whether this node has sent a source since the token's last visit.
    has_sent: bool,
    /// Value of the token, while this node holds it.
    token: Option<bool>,
}

impl TokenRing {
    /// The first node holds the token at first, with a value that cannot end the run.
    ///
    /// Choice C14: it starts the first round when it first has nothing to compute.
    pub fn new(rank: Rank, nodes: usize) -> TokenRing {
        TokenRing { rank, nodes, has_sent: false, token: (rank == 0).then_some(false) }
    }
}

impl Termination for TokenRing {
    fn source_sent(&mut self) {
        self.has_sent = true;
    }

    fn token_arrived(&mut self, value: bool) {
        self.token = Some(value);
    }

    fn idle(&mut self) -> Action {
        if self.nodes == 1 {
            return Action::Announce;
        }
        let Some(value) = self.token.take() else { return Action::Wait };
        let next = (self.rank + 1) % self.nodes;
        let has_sent = std::mem::take(&mut self.has_sent);
        let unchanged = value && !has_sent;
        match self.rank {
            0 if unchanged => Action::Announce,
            0 => Action::Send(next, true),
            _ => Action::Send(next, unchanged),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The number of rounds of the token among three idle nodes; `sender` has sent a source before.
    fn rounds(sender: Option<Rank>) -> usize {
        let mut nodes: Vec<TokenRing> = (0..3).map(|rank| TokenRing::new(rank, 3)).collect();
        if let Some(rank) = sender {
            nodes[rank].source_sent();
        }
        let mut at = 0;
        for passes in 0.. {
            match nodes[at].idle() {
                Action::Send(to, value) => {
                    nodes[to].token_arrived(value);
                    at = to;
                }
                Action::Announce => return passes / 3,
                Action::Wait => unreachable!("the token is here"),
            }
        }
        unreachable!()
    }

    #[test]
    fn a_quiet_round_ends_it_and_a_source_costs_another() {
        assert_eq!(rounds(None), 1);
        assert_eq!(rounds(Some(0)), 1); // sent before the token first leaves node 0
        assert_eq!(rounds(Some(1)), 2);
        assert_eq!(rounds(Some(2)), 2);
    }

    #[test]
    fn without_the_token_a_node_waits() {
        assert_eq!(TokenRing::new(1, 3).idle(), Action::Wait);
        assert_eq!(TokenRing::new(0, 1).idle(), Action::Announce);
    }
}
