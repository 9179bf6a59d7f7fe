//! The programs of Inria RR-3008: decomposition, compute node (Figure 9), service node (Figure 6),
//! termination detection, wire format; on a simulated machine or on threads.
//!
//! Knows nothing of files, plots or the command line.

mod ambient;
mod coarse;
mod compute_node;
mod counts;
mod decomposition;
mod display;
mod energy;
mod footprint;
mod gathered;
mod helpers;
mod instants;
mod interpreter;
mod kept_shots;
mod memory;
mod message;
mod observer;
mod outcome;
mod problem;
mod process;
mod queue;
mod reader;
mod recording;
mod region;
mod ring;
mod rules;
mod run;
mod service_node;
mod shooting;
mod shot_code;
mod shot_key;
mod simulation;
mod start_up;
mod storage;
mod threads;
mod wall_patch;

pub use compute_node::{ComputeNode, compute_node};
pub use counts::Counts;
pub use decomposition::{Decomposition, Mapping};
pub use display::DisplayReport;
pub use footprint::{Footprint, Thing};
pub use helpers::Helpers;
pub use instants::{Instant, radiosity_at, visit_instants};
pub use kept_shots::{Archive, KeptShots, ShotCounts};
pub use memory::Memory;
pub use message::{Message, MessageKind, Parcel, PatchUpdate, Sums};
pub use observer::{Activity, Observer, SentMessage, SharedObserver};
pub use outcome::{Ending, EnergyLedger, NodeReport, Outcome};
pub use problem::{Problem, ProblemError, ProblemOptions};
pub use process::Process;
pub use reader::DecodeError;
pub use recording::{EnergyAt, MessageRecord, NodeRecord, Recording, ShotRecord, Span};
pub use region::Region;
pub use rules::{Rules, Selection, Ties};
pub use run::{Run, RunError};
pub use service_node::{Collection, service_node};
pub use shooting::{Shooting, SourceSplit};
pub use shot_key::ShotKey;
pub use simulation::{simulate, simulate_observed, simulate_over};
pub use start_up::{StartUpReport, Step, start_up};
pub use storage::{Layout, Storage};
pub use threads::run_on_threads;
pub use wall_patch::WallPatch;
