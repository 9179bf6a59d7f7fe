//! The parallel programs of Inria RR-3008, and the machines that they run on.
//!
//! Knows nothing of files, plots or the command line.

mod casting; // how the host gets a shot: cast, kept from another run, cast ahead of time
mod instants; // the light at any instant of a simulated run
mod observe; // observers of a run, and recordings
mod on; // back ends: the simulated machine, threads of this host
mod problem; // the scene, meshed and cut into local environments, with its hemispheres
mod program; // compute node (Figure 9), service node (Figure 6), termination
mod run; // what is to be run, and its outcome
mod walls; // virtual walls, the method that masks replaced
mod wire; // the messages, and their bytes

pub use casting::{Archive, Helpers, KeptShots, Memory, ShotCounts, ShotKey, ShotMeter};
pub use instants::{Instant, visit_instants, visit_stops};
pub use observe::{
    Activity, EnergyAt, EnergyLedger, MessageRecord, NodeRecord, Observer, Observers, Recording,
    SentMessage, SharedObserver, ShotRecord, Span,
};
pub use on::RunError;
pub use on::simulated::{
    Layout, START_UP_STEPS, StartUpReport, Storage, Thing, simulate, simulate_observed, start_up,
};
pub use on::threads::run_on_threads;
pub use problem::{
    CutScene, Decomposition, Mapping, Problem, ProblemError, ProblemOptions, Rank, Shooting,
    Source, SourceSplit,
};
pub use program::{
    Collection, ComputeNode, Display, EnvironmentResult, Event, NoDisplay, NoProgress, NodeResult,
    Order, Process, ProgramError, Queue, Rules, Selection, Step, Ties, Turn, compute_node,
    service_node,
};
pub use run::{Counts, DisplayReport, Ending, NodeReport, Outcome, Run, most_shots_in_sequence};
pub use walls::WallPatch;
pub use wire::{DecodeError, Message, MessageKind, PatchUpdate, Sums};
