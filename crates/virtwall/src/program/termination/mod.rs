//! Termination detection (§4.2.4, second step): one file for each protocol.

mod protocol;
mod token_ring;

pub(super) use protocol::{Action, Termination};

use self::token_ring::TokenRing;
use crate::problem::Rank;

/// The part of node `rank` among `nodes` compute nodes.
pub(super) fn protocol(rank: Rank, nodes: usize) -> Box<dyn Termination> {
    Box::new(TokenRing::new(rank, nodes))
}
