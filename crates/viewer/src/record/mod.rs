//! What is recorded of a run for the viewer.

mod light_recording; // a recording with what each shot hit
mod node_state; // the states of a node that the page distinguishes
mod recorded_run; // a recording with what it is a recording of

pub use light_recording::LightRecording;
pub(crate) use light_recording::RecordedShot;
pub(crate) use node_state::{NodeState, is_shot};
pub use recorded_run::RecordedRun;
