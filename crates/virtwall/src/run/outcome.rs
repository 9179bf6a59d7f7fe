//! The outcome of a run: time, counts, energy, light.

use desim::{Duration, Time};
use multicomputer::LayerAccount;
use radiosity::{Rgb, Work};

use super::counts::Counts;
use super::display_report::DisplayReport;
use super::run::Run;
use crate::observe::{EnergyLedger, fraction};
use crate::program::NodeResult;

/// The outcome of a run: time, counts, energy, light.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// From the start of the computation to the moment at which the last compute node knows of its
    /// end; initialisation is not part of it.
    ///
    /// Choice C15: RR-3008 says "computing times".
    pub time: Time,
    /// Shots and messages of all compute nodes.
    pub counts: Counts,
    /// Where the emitted energy is.
    pub energy: EnergyLedger,
    /// How the end was found.
    pub ending: Ending,
    /// Operations counted on all nodes.
    pub work: Work,
    /// What each compute node did, by rank.
    pub nodes: Vec<NodeReport>,
    /// What became of the updates for the display, where one is modelled.
    pub display: Option<DisplayReport>,
    /// Radiosity in W/m², by environment and patch, with the ambient term if the rules say so.
    pub radiosity: Vec<Vec<Rgb>>,
}

/// How the end of a run was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ending {
    /// Announced when nothing was left to do.
    Agreed,
    /// Announced while sources were still in transit or queued.
    TooEarly {
        /// The energy in them, as a fraction of the emitted energy.
        lost: f64,
    },
}

/// What one compute node did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NodeReport {
    /// Time in kernels.
    pub compute: Duration,
    /// The part of it spent on cache misses.
    pub missing: Duration,
    /// The part of it spent on misses of the translation look-aside buffer.
    pub translating: Duration,
    /// Time in sending and receiving, waits for room included.
    pub overhead: Duration,
    /// Time spent waiting for pages that were not in memory.
    pub paging: Duration,
    /// The most bytes that program and message buffers held, where memory is modelled.
    pub memory_high_water: Option<u64>,
    /// Time spent waiting until the node knew of the end.
    pub idle: Duration,
    /// What the message layer did besides sending and receiving.
    pub layer: LayerAccount,
    /// Shots of its own patches.
    pub local_shots: u64,
    /// Shots of sources handed on to it.
    pub received_shots: u64,
}

impl Outcome {
    /// Add up the results of the compute nodes, by rank, and what their back end counted.
    pub(crate) fn of(
        run: &Run,
        time: Time,
        results: Vec<NodeResult>,
        (mut counts, work): (Counts, Work),
        mut nodes: Vec<NodeReport>,
    ) -> Outcome {
        let problem = &run.problem;
        let mut energy = EnergyLedger { emitted: problem.emitted_power(), ..Default::default() };
        let mut radiosity = vec![Vec::new(); problem.environments.len()];
        let mut pending = 0;
        for (node, report) in results.into_iter().zip(&mut nodes) {
            (report.local_shots, report.received_shots) = (node.local_shots, node.received_shots);
            counts.local_shots += node.local_shots;
            counts.received_shots += node.received_shots;
            pending += node.pending;
            energy.in_transit += node.in_transit;
            energy.unshot += node.on_walls;
            for environment in node.environments {
                energy.absorbed += environment.absorbed;
                energy.escaped += environment.escaped;
                energy.medium += environment.medium;
                energy.unshot += environment.unshot;
                radiosity[environment.environment as usize] = environment.radiosity;
            }
        }
        let left = energy.unshot + energy.in_transit;
        if run.rules.shooting.ambient {
            problem.add_ambient_term(left, &mut radiosity);
        }
        let ending = match pending {
            0 => Ending::Agreed,
            _ => Ending::TooEarly { lost: fraction(energy.in_transit, energy.emitted) },
        };
        Outcome { time, counts, energy, ending, work, nodes, display: None, radiosity }
    }

    /// What the message layer did on all compute nodes.
    pub fn layer(&self) -> LayerAccount {
        let mut all = LayerAccount::default();
        self.nodes.iter().for_each(|node| all.add(&node.layer));
        all
    }

    /// Time that all compute nodes spent on cache misses.
    pub fn missing(&self) -> Duration {
        self.nodes.iter().map(|node| node.missing).sum()
    }

    /// Time that all compute nodes spent on misses of the translation look-aside buffer.
    pub fn translating(&self) -> Duration {
        self.nodes.iter().map(|node| node.translating).sum()
    }

    /// Time in kernels as a fraction of all compute nodes' time.
    pub fn busy_fraction(&self) -> f64 {
        let all = self.time.as_seconds_f64() * self.nodes.len() as f64;
        let busy: Duration = self.nodes.iter().map(|node| node.compute).sum();
        if all > 0.0 { busy.as_seconds_f64() / all } else { 0.0 }
    }
}
