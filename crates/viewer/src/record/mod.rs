//! What is recorded of a run for the viewer.

/// A recording with what each shot hit.
mod light_recording;
/// The states of a node that the page distinguishes.
mod node_state;
/// A recording with what it is a recording of.
mod recorded_run;

pub use light_recording::LightRecording;
pub(crate) use light_recording::RecordedShot;
pub(crate) use node_state::{NodeState, is_shot};
pub use recorded_run::RecordedRun;
