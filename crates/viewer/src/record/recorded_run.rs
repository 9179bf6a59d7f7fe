//! A recorded run with its problem and its machine, as a report passes it to the viewer.

use std::sync::Arc;

use multicomputer::Machine;
use radiosity::Rgb;
use virtwall::Problem;

use super::LightRecording;

/// A recorded run and what it was a run of.
pub struct RecordedRun<'a> {
    /// Its name, unique in the report.
    pub label: String,
    /// Its scene's name.
    pub scene: String,
    /// Runs of one group differ only in the number of processors.
    pub group: usize,
    /// What was simulated.
    pub problem: &'a Arc<Problem>,
    /// The machine that it was simulated on.
    pub machine: &'a Machine,
    /// The processor of each environment.
    pub owners: Vec<usize>,
    /// The reference radiosity of each patch, W/m², if there is one; the same for all runs of a problem.
    pub answer: Option<Arc<Vec<Rgb>>>,
    /// The published speed-up of this run, if there is one.
    pub published: Option<f64>,
    /// What happened.
    pub recording: &'a LightRecording,
}
