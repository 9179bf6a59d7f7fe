//! One run. The only folder that calls the simulator.
//!
//! - [`simulator`]: A run from its rules to its figures.
//! - [`knobs`]: How patches are shot.
//! - [`network`]: The network model of a run.
//! - [`figures`]: What one run found.
//! - [`message_layer`]: Figures of the message layer.
//! - [`start_up`]: Figures of the start-up.
//! - [`display`]: Figures of the display.
//! - [`node_memory`]: Figures of the memory of nodes.
//! - [`error_figures`]: The error of a run, and its parts.

pub mod display;
pub mod error_figures;
pub mod figures;
pub mod knobs;
pub mod message_layer;
pub mod network;
pub mod node_memory;
pub mod simulator;
pub mod start_up;
