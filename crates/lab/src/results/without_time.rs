//! Results of runs on threads of the host, which have no virtual time: why columns and plots of it are empty.

use serde_json::Value;

use crate::experiment::plot::Plot;
use crate::table::measure::Measure;
use crate::table::runs_csv::Table;

const NOTE: &str = "Threads of this host have no virtual time: its columns are empty, and so are plots of them. How \
                    long the host took is in host-times.json and in columns host.*.";

/// What a reader of such results must know; `None` of simulated runs.
pub fn note(manifest: &Value) -> Option<&'static str> {
    (manifest["on"] == "threads").then_some(NOTE)
}

/// A plot of such results; its title says so if no run has a point in it.
pub fn titled(plot: &Plot, table: &Table) -> Plot {
    let [x, y] = [&plot.x, &plot.y].map(|text| Measure::of(text));
    let drawn = |row: &Vec<String>| x.value(table, row).and(y.value(table, row)).is_some();
    if table.rows.iter().any(drawn) {
        return plot.clone();
    }
    let title = || format!("{} by {}", y.words(), x.words().to_lowercase());
    let title = plot.title.clone().unwrap_or_else(title);
    Plot { title: Some(title + " (no virtual time on threads)"), ..plot.clone() }
}
