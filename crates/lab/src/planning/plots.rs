//! Plots that an experiment asks for.

use config::{Document, Fault, Place, unknown};

use crate::experiment::fields::Plot;
use crate::files::file::{PLAIN, is_plain};
use crate::planning::plan::Plan;
use crate::table::columns;
use crate::table::measure::Measure;

/// Refuses plots of columns that there will not be, or with names that lead elsewhere.
pub fn check_plots(plan: &Plan, document: &Document) -> Result<(), Fault> {
    let plots: &[Plot] = &plan.plots;
    let known = columns::drawable(&plan.columns(), &plan.axes);
    for (i, plot) in plots.iter().enumerate() {
        let place = Place::of("plots").item(i);
        let [x, y] = [&plot.x, &plot.y].map(|text| Measure::of(text));
        let series: Vec<&str> = plot.series.iter().map(String::as_str).collect();
        for (field, columns) in [("x", x.columns()), ("y", y.columns()), ("series", &series)] {
            if let Some(column) = columns.iter().find(|&&c| !known.iter().any(|k| k == c)) {
                let message = unknown("column", column, &known);
                return Err(document.fault(&place.key(field), message));
            }
        }
        if let Some(column) = plot.mark.keys().find(|&column| !known.contains(column)) {
            let message = unknown("column", column, &known);
            return Err(document.fault(&place.key("mark").key(column), message));
        }
        let stem = plot.stem();
        if !is_plain(&stem) {
            let message = format!("\"{stem}\" names a file; expected {PLAIN}");
            return Err(document.fault(&place.key("file"), message));
        }
        if plots[..i].iter().any(|earlier| earlier.stem() == stem) {
            let message =
                format!("\"{stem}.svg\" is an earlier plot too; expected a \"file\" of its own");
            return Err(document.fault(&place, message));
        }
    }
    Ok(())
}
