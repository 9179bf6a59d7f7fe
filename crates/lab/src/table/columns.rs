//! The columns of runs.csv. A new column is one entry of [`EVERY_RUN`] or of [`FEATURES`].

use serde_json::{Value, json};

use crate::engine::simulator;
use crate::experiment::sweep::Axis;
use crate::table::column::{Column, Input};
use crate::table::every_run::EVERY_RUN;
use crate::table::features::FEATURES;

/// The column after which the swept fields of the experiment stand.
const SWEPT_AFTER: &str = "energy_error";

/// All columns, in the order of runs.csv.
fn all() -> impl Iterator<Item = &'static Column> {
    EVERY_RUN.iter().chain(FEATURES)
}

/// The columns that results of these runs have, without the swept fields.
pub fn shown(runs: &[Input]) -> Vec<&'static Column> {
    all().filter(|column| runs.iter().any(|run| (column.shown)(run))).collect()
}

/// The header of runs.csv: `columns`, and the swept fields that are not among the first of them.
pub fn header(columns: &[&Column], axes: &[Axis]) -> Vec<String> {
    let mut names: Vec<String> = columns.iter().map(|column| column.name.to_owned()).collect();
    let first = names.iter().position(|name| name == SWEPT_AFTER).map_or(0, |last| last + 1);
    let swept = axes.iter().map(|axis| axis.place.to_string());
    let swept: Vec<String> = swept.filter(|name| !names[..first].contains(name)).collect();
    names.splice(first..first, swept);
    names
}

/// The prefix of columns of host times. They are not in runs.csv: they come from host-times.json.
pub const HOST: &str = "host.";

/// Host times of a run, as host-times.json names them, and what each is.
pub const HOST_TIMES: [(&str, &str); 3] = [
    ("cpu_s", "Processor time of the host that the run took."),
    ("set_up_s", "Processor time of the host for reading, cutting and meshing the scene."),
    ("clock_s", "Time on the host's clock from start to end of the run."),
];

/// The column of operations, and the prefix that names a single count of it.
pub const OPERATIONS: [&str; 2] = ["operations", "operations."];

/// All columns that can be drawn: those of runs.csv, each count of operations, host times.
pub fn drawable(runs_csv: Vec<String>) -> Vec<String> {
    let others = others().map(|(name, ..)| name);
    runs_csv.into_iter().chain(others).collect()
}

/// What can be drawn besides the columns of runs.csv: names, units, meanings.
fn others() -> impl Iterator<Item = (String, &'static str, &'static str)> {
    let counts = simulator::operations_explained();
    let counts = counts.map(|(name, about)| (OPERATIONS[1].to_owned() + name, "count", about));
    let host = HOST_TIMES.iter().map(|(name, about)| (HOST.to_owned() + name, "s", *about));
    counts.chain(host)
}

/// All columns that a plot can name, but for swept fields: names, units, meanings.
pub fn explained() -> impl Iterator<Item = (String, &'static str, &'static str)> {
    let columns = all().map(|column| (column.name.to_owned(), column.unit, column.about));
    columns.chain(others())
}

/// What a column holds, and its unit; none of a swept field.
pub fn about(column: &str) -> Option<String> {
    let (_, unit, about) = explained().find(|(name, ..)| name == column)?;
    Some(format!("{about} Unit: {unit}."))
}

/// The unit of a column, or else "ratio", "count", "number" or "text"; none of a swept field.
pub fn unit(column: &str) -> Option<&'static str> {
    explained().find(|(name, ..)| name == column).map(|(_, unit, _)| unit)
}

/// What the columns of runs.csv hold, as a Table Schema (specs.frictionlessdata.io/table-schema).
pub fn runs_schema() -> Value {
    let field = |column: &Column| json!({ "name": column.name, "unit": column.unit, "description": column.about });
    let about = "Columns of runs.csv. Swept fields of the experiment stand after energy_error; \
                 columns of what no run uses are left out.";
    json!({ "description": about, "fields": all().map(field).collect::<Vec<_>>() })
}
