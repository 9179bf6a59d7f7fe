//! Reads experiment files as plans.

use std::path::Path;

use config::{Document, Fault, read, refuse_unknown_keys};
use serde_json::Value;

use crate::experiment::fields::{Experiment, leave_out_comparisons};
use crate::experiment::machine::open_up;
use crate::experiment::schema::FIELDS;
use crate::experiment::sweep::Sweep;
use crate::host::host_memory::half_of_free_memory;
use crate::planning::plan::Plan;
use crate::planning::planner::{Planner, resolved};
use crate::planning::preparing::Preparing;

impl Plan {
    /// Reads an experiment file, applies `--set path=value` arguments, validates all of it with its scenes and
    /// machines, and searches the settings that it leaves open.
    ///
    /// # Errors
    /// The first fault met. Nothing was written.
    pub fn read(path: &Path, arguments: &[String], preparing: &Preparing) -> Result<Plan, Fault> {
        Plan::of(path, Document::read(path)?, arguments, preparing)
    }

    /// Reads an experiment from a document, as if it were the file at `path`.
    pub(crate) fn of(
        path: &Path,
        mut document: Document,
        arguments: &[String],
        preparing: &Preparing,
    ) -> Result<Plan, Fault> {
        let sweep = swept(&mut document, arguments)?;
        Planner::new(path, &document, &sweep, preparing).plan()
    }

    /// The same for the light of one run: its row in the results, from 1, or the last. Nothing else is
    /// prepared, and nothing that the run is compared with.
    pub(crate) fn of_row(
        path: &Path,
        mut document: Document,
        arguments: &[String],
        row: Option<usize>,
    ) -> Result<(Plan, usize), Fault> {
        let mut sweep = swept(&mut document, arguments)?;
        let runs = sweep.points.len();
        let row = row.unwrap_or(runs);
        if !(1..=runs).contains(&row) {
            let message = format!("{row}; expected a row of runs.csv, 1 to {runs}");
            return Err(Fault::of_file("--run", message));
        }
        sweep.points = vec![sweep.points.swap_remove(row - 1)];
        leave_out_comparisons(&mut sweep.points[0].value);
        let (threads, memory) = (parallel::host_threads(), half_of_free_memory());
        let preparing = Preparing { threads, memory, ..Preparing::default() };
        let plan = Planner::new(path, &document, &sweep, &preparing).plan()?;
        Ok((plan, row))
    }
}

/// An experiment with every default filled in, without its scenes and machines; and the document it is from.
pub fn read_alone(mut document: Document) -> Result<(Document, Value), Fault> {
    let sweep = swept(&mut document, &[])?;
    let point = &sweep.points[0];
    let first: Experiment = read(&point.value)
        .map_err(|fault| document.fault(&sweep.place_in_file(point, fault.place), fault.message))?;
    let resolved = resolved(&document, &first);
    Ok((document, resolved))
}

/// Applies `--set` arguments to an experiment and finds its runs.
pub fn swept(document: &mut Document, arguments: &[String]) -> Result<Sweep, Fault> {
    for argument in arguments {
        if let Some((_, value)) = argument.strip_prefix("machine.").and_then(|a| a.split_once('='))
        {
            open_up(&mut document.value, value.trim_start().starts_with('['));
        }
        document.set(argument)?;
    }
    let known = refuse_unknown_keys(&FIELDS, &document.value);
    known.map_err(|fault| document.locate(fault))?;
    Sweep::of(document)
}
