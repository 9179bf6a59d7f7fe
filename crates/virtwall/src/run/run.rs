//! A run: a problem, the number of processors, and the rules.

use std::sync::Arc;

use crate::casting::KeptShots;
use crate::problem::{Problem, Source};
use crate::program::Rules;

/// What is to be run.
#[derive(Clone)]
pub struct Run {
    /// The scene, meshed and cut.
    pub problem: Arc<Problem>,
    /// Compute nodes to use.
    pub processors: usize,
    /// What RR-3008 leaves open.
    pub rules: Rules,
    /// Shots kept from and for other runs of the same problem.
    pub kept: Arc<KeptShots>,
    /// Called after every shot with its source, from the thread that carries out the run.
    pub on_shot: Arc<dyn Fn(&Source) + Send + Sync>,
}
