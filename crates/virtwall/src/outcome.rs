//! What a run found.

use desim::{Duration, Time};
use multicomputer::LayerAccount;
use radiosity::{Rgb, Work};

use crate::ambient;
use crate::compute_node::ComputeNode;
use crate::counts::Counts;
use crate::display::DisplayReport;

/// What a run found: time, counts, energy, light.
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

/// Where the emitted energy is at the end of a run, W.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyLedger {
    /// Emitted by all patches.
    pub emitted: Rgb,
    /// Absorbed by patches and by backs of polygons.
    pub absorbed: Rgb,
    /// On patches, and gathered by virtual walls, not shot.
    pub unshot: Rgb,
    /// In sources handed on and not shot again.
    pub in_transit: Rgb,
    /// Gone out of the scene.
    pub escaped: Rgb,
    /// Absorbed by participating media.
    pub medium: Rgb,
}

impl EnergyLedger {
    /// |emitted − (absorbed + unshot + in transit + escaped + medium)| / emitted, colours summed; 0 when
    /// nothing is emitted.
    pub fn error(&self) -> f64 {
        let found = self.absorbed + self.unshot + self.in_transit + self.escaped + self.medium;
        fraction((self.emitted - found).abs(), self.emitted)
    }
}

fn fraction(part: Rgb, whole: Rgb) -> f64 {
    if whole == Rgb::ZERO { 0.0 } else { part.element_sum() / whole.element_sum() }
}

/// How the end of a run was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ending {
    /// Announced when nothing was left to do.
    Agreed,
    /// Announced by the token ring while sources were still under way or queued.
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
    /// The part of it in which they waited for what was not in the processor's caches.
    pub missing: Duration,
    /// The part of it in which they waited for translations of addresses.
    pub translating: Duration,
    /// Time in sending and receiving, waits for room included.
    pub overhead: Duration,
    /// Time spent waiting for pages that were not in memory.
    pub paging: Duration,
    /// The most bytes that program and message buffers have held, where memory is modelled.
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
    /// Add up what the compute nodes found; `nodes` by rank.
    pub(crate) fn of(time: Time, nodes: &[ComputeNode], mut reports: Vec<NodeReport>) -> Outcome {
        let problem = &nodes[0].shared.problem;
        let mut energy = EnergyLedger { emitted: problem.emitted_power(), ..Default::default() };
        let mut radiosity = vec![Vec::new(); problem.environments.len()];
        let mut counts = Counts::default();
        let mut work = Work::NONE;
        let mut pending = 0;
        for (node, report) in nodes.iter().zip(&mut reports) {
            counts += node.tally.counts;
            work += node.tally.work;
            pending += node.tally.parcels_sent as i64 - node.tally.parcels_taken as i64;
            energy.in_transit += node.tally.sent - node.tally.taken;
            energy.unshot += node.region.gathered_power();
            for (environment, light) in node.region.lights() {
                energy.absorbed += light.absorbed;
                energy.escaped += light.escaped;
                energy.medium += light.medium;
                energy.unshot += light.unshot_power();
                let geometry = &problem.environments[environment as usize];
                let patches = 0..geometry.patches.len() as u32;
                radiosity[environment as usize] =
                    patches.map(|patch| light.radiosity(geometry, patch)).collect();
            }
            report.local_shots = node.tally.counts.local_shots;
            report.received_shots = node.tally.counts.received_shots;
        }
        if nodes[0].shared.rules.shooting.ambient {
            ambient::add(problem, energy.unshot + energy.in_transit, &mut radiosity);
        }
        Outcome {
            time,
            counts,
            energy,
            ending: match pending {
                0 => Ending::Agreed,
                _ => Ending::TooEarly { lost: fraction(energy.in_transit, energy.emitted) },
            },
            work,
            nodes: reports,
            display: None,
            radiosity,
        }
    }

    /// What the message layer did on all compute nodes.
    pub fn layer(&self) -> LayerAccount {
        let mut all = LayerAccount::default();
        self.nodes.iter().for_each(|node| all.add(&node.layer));
        all
    }

    /// Time in which the kernels of all compute nodes waited for what caches missed.
    pub fn missing(&self) -> Duration {
        self.nodes.iter().map(|node| node.missing).sum()
    }

    /// Time in which the kernels of all compute nodes waited for translations of addresses.
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
