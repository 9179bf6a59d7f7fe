//! Why a run could not be made, or did not end.

use std::collections::BTreeMap;

use desim::Stalled;
use multicomputer::MachineError;
use thiserror::Error;

use crate::program::ProgramError;

/// Why a run could not be made, or did not end.
#[derive(Debug, Error)]
pub enum RunError {
    /// No processor, or more than there are environments.
    #[error("{processors} processors; expected 1 to {environments}, one environment each at least")]
    Processors {
        /// Processors that the run asks for.
        processors: usize,
        /// Environments of the problem.
        environments: usize,
    },
    /// The machine has too few nodes.
    #[error(transparent)]
    Machine(#[from] MachineError),
    /// The machine file lacks a number that the programs need.
    #[error("the machine's {part} for \"{name}\"; expected {unit} under that name")]
    Missing {
        /// Part of the machine file and what it lacks: "processor has no price".
        part: &'static str,
        /// The operation, thing or step that needs it.
        name: &'static str,
        /// Unit of the missing number.
        unit: &'static str,
    },
    /// The initialisation takes too long to say how long.
    #[error("the start-up of the machine takes longer than virtual time lasts (213 days)")]
    StartUp,
    /// Deadlock: processes wait and no event is left.
    #[error(transparent)]
    Stalled(#[from] Stalled),
    /// A program cannot go on.
    #[error(transparent)]
    Program(#[from] ProgramError),
    /// The energy does not balance, or is not a number.
    #[error(
        "{error:e} of the emitted energy is unaccounted for; expected at most {}",
        RunError::LARGEST_ENERGY_ERROR
    )]
    Unbalanced {
        /// The error of the balance, a fraction of the emitted energy.
        error: f64,
    },
    /// A thread of a run on threads cannot be started.
    #[error("the host cannot start the {threads} threads of this run: {cause}")]
    NoThread {
        /// One for each compute node, and one for the service node.
        threads: usize,
        /// What the host says.
        cause: String,
    },
    /// A thread of a run on threads panicked.
    #[error("a compute node's thread failed")]
    Thread,
}

impl RunError {
    /// The largest error of the energy balance by rounding, a fraction of the emitted energy.
    pub const LARGEST_ENERGY_ERROR: f64 = 1e-9;

    /// Refuses a part of a machine whose `map` lacks one of these names.
    pub(super) fn require_all<V, const N: usize>(
        part: &'static str,
        names: [&'static str; N],
        map: &BTreeMap<String, V>,
        unit: &'static str,
    ) -> Result<(), RunError> {
        match names.into_iter().find(|&name| !map.contains_key(name)) {
            None => Ok(()),
            Some(name) => Err(RunError::Missing { part, name, unit }),
        }
    }
}
