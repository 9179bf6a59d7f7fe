//! Plots that an experiment asks for.

use config::{Document, Fault, Place, unknown};

use crate::experiment::plot::{Plot, ReferenceLine};
use crate::files::file::{PLAIN, is_plain};
use crate::table::measure::Measure;

/// A field of a plot, and what is wrong with it.
type Wrong = (Place, String);

/// Refuses plots of columns that there will not be, or with names that lead elsewhere. `known` are the columns that
/// can be drawn, `swept` those that are swept.
pub fn check_plots(
    plots: &[Plot],
    known: &[String],
    swept: &[String],
    document: &Document,
) -> Result<(), Fault> {
    for (i, plot) in plots.iter().enumerate() {
        let place = Place::of("plots").item(i);
        check_columns(plot, known)
            .and_then(|()| check_over(plot, swept))
            .and_then(|()| check_lines(plot))
            .map_err(|(field, message)| document.fault(&place.join(&field), message))?;
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

fn check_columns(plot: &Plot, known: &[String]) -> Result<(), Wrong> {
    let [x, y] = [&plot.x, &plot.y].map(|text| Measure::of(text));
    let one = |field: &'static str, name: &Option<String>| (field, name.iter().cloned().collect());
    let product = |measure: Measure| measure.columns().iter().map(|&c| c.to_owned()).collect();
    let fields: [(&str, Vec<String>); 5] = [
        ("x", product(x)),
        ("y", product(y)),
        one("series", &plot.series),
        one("facet", &plot.facet),
        one("over", &plot.over),
    ];
    for (field, columns) in fields {
        if let Some(column) = columns.iter().find(|column| !known.contains(column)) {
            return Err((Place::of(field), unknown("column", column, known)));
        }
    }
    match plot.mark.keys().find(|&column| !known.contains(column)) {
        Some(column) => Err((Place::of("mark").key(column), unknown("column", column, known))),
        None => Ok(()),
    }
}

/// Repeats are at the same x: both are swept fields, and no field has two parts.
fn check_over(plot: &Plot, swept: &[String]) -> Result<(), Wrong> {
    let Some(over) = &plot.over else { return Ok(()) };
    let fields = if swept.is_empty() { "none here".to_owned() } else { swept.join(", ") };
    for (field, name) in [("over", over), ("x", &plot.x)] {
        if !swept.contains(name) {
            let message =
                format!("\"{name}\" is not swept; with \"over\" expected a swept field ({fields})");
            return Err((Place::of(field), message));
        }
    }
    let parts =
        [("x", Some(&plot.x)), ("series", plot.series.as_ref()), ("facet", plot.facet.as_ref())];
    match parts.iter().find(|(_, name)| *name == Some(over)) {
        Some((part, _)) => {
            let message =
                format!("\"{over}\" is \"{part}\" too; expected another swept field ({fields})");
            Err((Place::of("over"), message))
        }
        None => Ok(()),
    }
}

fn check_lines(plot: &Plot) -> Result<(), Wrong> {
    let [log_x, log_y] = plot.logarithmic();
    for (i, ReferenceLine { x, y, .. }) in plot.lines.iter().enumerate() {
        let place = Place::of("lines").item(i);
        let (field, value, logarithmic) = match (x, y) {
            (Some(x), None) => ("x", *x, log_x),
            (None, Some(y)) => ("y", *y, log_y),
            (both, _) => {
                let found = if both.is_some() { "both" } else { "neither" };
                return Err((place, format!("{found} of \"x\" and \"y\"; expected one of them")));
            }
        };
        if logarithmic && value <= 0.0 {
            let message = format!("{value} on a logarithmic axis; expected a number above 0");
            return Err((place.key(field), message));
        }
    }
    Ok(())
}
