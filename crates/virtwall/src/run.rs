//! A run: a problem on some processors, under some rules.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use desim::Stalled;
use multicomputer::{MachineError, Rank};
use radiosity::Operation;
use thiserror::Error;

use crate::compute_node::ComputeNode;
use crate::footprint::Thing;
use crate::kept_shots::KeptShots;
use crate::problem::Problem;
use crate::region::Region;
use crate::rules::Rules;
use crate::service_node::Collection;
use crate::shared::Shared;
use crate::step::Step;

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
    /// Called after every shot, from the thread that runs it.
    pub on_shot: Arc<dyn Fn() + Send + Sync>,
}

/// A run that cannot be made or did not end.
#[derive(Debug, Error)]
pub enum RunError {
    /// None, or more than there is work for.
    #[error("{processors} processors; expected 1 to {environments}, one environment each at least")]
    Processors {
        /// What was asked for.
        processors: usize,
        /// Environments of the problem.
        environments: usize,
    },
    /// The machine has too few nodes.
    #[error(transparent)]
    Machine(#[from] MachineError),
    /// The machine file does not price an operation.
    #[error("the machine's processor has no price for \"{}\"; expected cycles under that name", .0.name())]
    Price(Operation),
    /// The machine file does not size a thing.
    #[error("the machine's memory has no size for \"{}\"; expected bytes under that name", .0.name())]
    Size(Thing),
    /// The machine file does not price a step of the initialisation.
    #[error("the machine's start-up has no price for \"{}\"; expected cycles under that name", .0.name())]
    Step(Step),
    /// Every process waits and nothing is under way.
    #[error(transparent)]
    Stalled(#[from] Stalled),
    /// A thread of a run on threads panicked.
    #[error("a compute node's thread failed")]
    Thread,
}

impl Run {
    /// The compute nodes by rank, and what the service node needs to know.
    pub(crate) fn prepare(&self) -> Result<(Vec<ComputeNode>, Collection), RunError> {
        let environments = self.problem.environments.len();
        let processors = self.processors;
        if !(1..=environments).contains(&processors) {
            return Err(RunError::Processors { processors, environments });
        }
        let owners = self.rules.mapping.owners(environments as u32, processors);
        let region = |rank: Option<Rank>, threshold: f64| {
            let mine = (0u32..)
                .zip(&owners)
                .filter(move |&(_, &owner)| rank.is_none_or(|rank| owner == rank));
            let mine = mine.map(|(environment, _)| environment);
            Region::new(&self.problem, mine, &self.rules, threshold)
        };
        let brightest = region(None, 0.0).best_patch(None).map_or(0.0, |(value, ..)| value);
        let threshold = brightest * self.rules.patch_threshold;
        let regions: Vec<Region> = (0..processors).map(|r| region(Some(r), threshold)).collect();
        let shared = Arc::new(Shared {
            problem: Arc::clone(&self.problem),
            rules: self.rules.clone(),
            kept: Arc::clone(&self.kept),
            owners,
            processors,
            wall_threshold: brightest * self.rules.wall_threshold,
            on_shot: Arc::clone(&self.on_shot),
            known: AtomicBool::default(),
        });
        let nodes = regions.into_iter().enumerate();
        let nodes = nodes.map(|(rank, region)| ComputeNode::new(&shared, region, rank)).collect();
        let emitted = self.problem.emitted_power().element_sum();
        let collection = Collection {
            compute_nodes: processors,
            every: self.rules.collect_every,
            stop_below: self.rules.energy_threshold * emitted,
        };
        Ok((nodes, collection))
    }
}
