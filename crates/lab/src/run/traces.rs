//! A trace of each run, for viewers of traces.

use std::io;
use std::path::{Path, PathBuf};

use traces::{Format, Sample};
use virtwall::Recording;

use crate::files::file::{self, is_plain};
use crate::planning::plan::Plan;

/// Traces that are to be written, a file a run.
pub struct Traces {
    /// Where.
    pub folder: PathBuf,
    /// For which viewers.
    pub format: Format,
    /// How much of each run.
    pub sample: Sample,
}

impl Traces {
    /// Writes the trace of a run, by its index.
    pub fn write(&self, plan: &Plan, run: usize, recording: &Recording) -> io::Result<()> {
        let name = name(plan, run);
        let path = self.folder.join(format!("{name}.{}", self.format.extension()));
        file::write(&path, &self.format.encode(recording, &name, self.sample))
    }
}

/// The run's row in `runs.csv`, from 1, its scene and its processors.
fn name(plan: &Plan, run: usize) -> String {
    let width = plan.runs.len().to_string().len();
    let point = &plan.runs[run].point;
    let stem = Path::new(&point.scene).file_stem().and_then(|stem| stem.to_str());
    let scene = stem.filter(|stem| is_plain(stem)).unwrap_or("scene");
    format!("{:0width$}-{scene}-{}", run + 1, point.processors)
}
