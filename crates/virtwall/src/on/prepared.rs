//! A run made ready for a back end.

use std::sync::Arc;

use super::error::RunError;
use super::host::Host;
use super::progress::Progress;
use crate::casting::LookAhead;
use crate::problem::Source;
use crate::program::{Collection, ComputeNode, Shared};
use crate::run::Run;

/// The programs of a run before they start.
pub(super) struct Prepared {
    /// By rank.
    pub nodes: Vec<ComputeNode>,
    pub collection: Collection,
    pub host: Host,
}

impl Prepared {
    /// Give every compute node its environments, and the service node what it needs to know.
    pub fn new(run: &Run) -> Result<Prepared, RunError> {
        let Run { problem, processors, rules, kept, on_shot } = run;
        let environments = problem.environments.len();
        if !(1..=environments).contains(processors) {
            return Err(RunError::Processors { processors: *processors, environments });
        }
        let look_ahead = Arc::new(LookAhead::new(problem, rules.shooting, kept));
        let brightest = problem.brightest(|power, b| rules.selection.value_of(power, b));
        let casts = Arc::clone(&look_ahead);
        let shared = Arc::new(Shared {
            problem: Arc::clone(problem),
            rules: rules.clone(),
            owners: rules.mapping.owners(environments as u32, *processors, rules.seed),
            processors: *processors,
            wall_threshold: brightest * rules.wall_threshold,
            cast: Box::new(move |source: &Source| casts.cast(source)),
        });
        let threshold = brightest * rules.patch_threshold;
        let nodes = (0..*processors).map(|rank| ComputeNode::new(&shared, rank, threshold));
        let emitted = problem.emitted_power().element_sum();
        Ok(Prepared {
            nodes: nodes.collect(),
            collection: Collection {
                compute_nodes: *processors,
                every: rules.collect_every,
                stop_below: rules.energy_threshold * emitted,
            },
            host: Host {
                look_ahead,
                progress: Arc::new(Progress::of(run)),
                on_shot: Arc::clone(on_shot),
            },
        })
    }
}
