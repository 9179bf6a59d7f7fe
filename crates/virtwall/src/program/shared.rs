//! What all compute nodes of a run have in common.

use std::sync::Arc;

use radiosity::Shot;

use super::rules::Rules;
use crate::problem::{Problem, Rank, Source};

/// How the host obtains the shot of a source.
pub(crate) type Cast = dyn Fn(&Source) -> Shot + Send + Sync;

/// What all compute nodes of a run know from the start.
pub(crate) struct Shared {
    pub problem: Arc<Problem>,
    pub rules: Rules,
    /// The compute node of each local environment.
    pub owners: Vec<Rank>,
    /// Compute nodes.
    pub processors: usize,
    /// A wall patch of less value than this hands nothing on.
    pub wall_threshold: f64,
    pub cast: Box<Cast>,
}

impl Shared {
    /// The service node's rank follows those of the compute nodes.
    pub fn service_node(&self) -> Rank {
        self.processors
    }
}
