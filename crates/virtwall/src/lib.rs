//! The parallel programs of Inria RR-3008, and the machines that they run on.
//!
//! | folder | what is in it |
//! |---|---|
//! | `problem` | the scene, meshed and cut into local environments, with its hemispheres |
//! | `walls` | virtual walls, the method that masks replaced |
//! | `wire` | the messages, and their bytes |
//! | `program` | compute node (Figure 9), service node (Figure 6), termination |
//! | `casting` | how the host gets a shot: cast, kept from another run, cast ahead of time |
//! | `observe` | who watches a run, and recordings of it |
//! | `run` | what is to be run, and what came out |
//! | `on` | back ends: the simulated machine, threads of this host |
//! | `instants` | the light at any instant of a simulated run |
//!
//! Knows nothing of files, plots or the command line.

mod casting;
mod instants;
mod observe;
mod on;
mod problem;
mod program;
mod run;
mod walls;
mod wire;

pub use casting::{Archive, Helpers, KeptShots, Memory, ShotCounts, ShotKey};
pub use instants::{Instant, radiosity_at, visit_instants, visit_stops};
pub use observe::{
    Activity, EnergyAt, EnergyLedger, MessageRecord, NodeRecord, Observer, Observers, Recording,
    SentMessage, SharedObserver, ShotRecord, Span,
};
pub use on::RunError;
pub use on::simulated::{
    Layout, StartUpReport, StartUpStep, Storage, Thing, simulate, simulate_observed, simulate_over,
    start_up,
};
pub use on::threads::run_on_threads;
pub use problem::{
    CutScene, Decomposition, Mapping, Problem, ProblemError, ProblemOptions, Rank, Shooting,
    Source, SourceSplit,
};
pub use program::{
    Collection, ComputeNode, Display, EnvironmentResult, Event, NoDisplay, NodeResult, Order,
    Process, ProgramError, Queue, Rules, Selection, Step, Ties, Turn, compute_node, service_node,
};
pub use run::{Counts, DisplayReport, Ending, NodeReport, Outcome, Run};
pub use walls::WallPatch;
pub use wire::{DecodeError, Message, MessageKind, PatchUpdate, Sums};
