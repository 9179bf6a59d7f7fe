//! A column of runs.csv, and the data from which its cells are computed.

use multicomputer::Machine;
use virtwall::Problem;

use crate::accuracy::tuned::Tuned;
use crate::engine::error_figures::{Causes, ErrorFigures};
use crate::engine::figures::Figures;
use crate::engine::network::NetworkFigures;
use crate::experiment::fields::Experiment;
use crate::table::comparison::Published;

pub struct Column {
    pub name: &'static str,
    /// Its unit, or else "ratio", "count", "number" or "text".
    pub unit: &'static str,
    /// What it holds, and where the paper has that, such as (§5.3).
    pub about: &'static str,
    /// Whether results have the column because of this run. One such run is enough.
    pub shown: fn(&Input) -> bool,
    /// The cell of a run; none leaves it empty.
    pub cell: fn(&Row) -> Option<String>,
}

pub const fn column(
    name: &'static str,
    unit: &'static str,
    about: &'static str,
    shown: fn(&Input) -> bool,
    cell: fn(&Row) -> Option<String>,
) -> Column {
    Column { name, unit, about, shown, cell }
}

/// What is known of a run before it starts.
pub struct Input<'a> {
    pub point: &'a Experiment,
    pub machine: &'a Machine,
    pub problem: &'a Problem,
    /// The setting found for it, if it asks for an accuracy.
    pub tuned: Option<&'a Tuned>,
}

/// All that the cells of a run are made of.
pub struct Row<'a> {
    pub input: Input<'a>,
    /// Its figures; none if it failed or was not started.
    pub figures: Option<&'a Figures>,
    pub failure: Option<&'a str>,
    pub published: Published,
    /// Time on one processor, all else equal, over its time.
    pub speed_up: Option<f64>,
    /// Time with one local environment, all else equal, over its time.
    pub gain: Option<f64>,
    /// By how much its time exceeds that on the finest network model run, all else equal, as a share.
    pub difference_from_finest: Option<f64>,
}

impl Row<'_> {
    pub fn cell(&self, column: &Column) -> String {
        (column.cell)(self).unwrap_or_default()
    }

    pub fn network(&self) -> Option<&NetworkFigures> {
        self.figures?.network.as_ref()
    }

    pub fn errors(&self) -> Option<ErrorFigures> {
        self.figures?.errors
    }

    pub fn causes(&self) -> Option<Causes> {
        self.errors()?.causes
    }
}

#[expect(clippy::needless_pass_by_value, reason = "numbers and texts alike")]
pub fn text(value: impl ToString) -> Option<String> {
    Some(value.to_string())
}

pub fn fixed(value: f64, decimals: usize) -> Option<String> {
    Some(format!("{value:.decimals$}"))
}

pub fn scientific(value: f64) -> Option<String> {
    Some(format!("{value:.6e}"))
}
