//! Titles of axes: a column in words, with its unit.

use crate::table::columns;

/// The title of an axis for the product of these columns: their names in words, and the unit of its cells or, if they
/// have none, those of the columns.
pub fn axis_title(columns: &[&str], unit_of_cells: &str) -> String {
    let units: Vec<&str> = columns.iter().filter_map(|column| unit(column)).collect();
    let unit = if unit_of_cells.is_empty() { units.join(" × ") } else { unit_of_cells.to_owned() };
    let names = names(columns);
    if unit.is_empty() { names } else { format!("{names} ({unit})") }
}

/// The name of a product of columns for people, without units.
pub fn names(columns: &[&str]) -> String {
    columns.iter().map(|column| words(column)).collect::<Vec<_>>().join(" × ")
}

/// A column's name for people: without the field that holds it, and without its unit.
pub fn words(column: &str) -> String {
    let name = column.rsplit('.').next().unwrap_or(column);
    match column {
        "speed_up" => return "speed-up".to_owned(),
        "paper_speed_up" => return "paper's speed-up".to_owned(),
        _ => {}
    }
    let words = name.strip_suffix("_s").unwrap_or(name).replace('_', " ");
    match column.split_once('.') {
        Some(("host", _)) => format!("host {}", words.replace("cpu", "CPU")),
        Some(("operations", _)) => format!("{words}s counted"),
        _ => words,
    }
}

/// The unit of a column that is shown beside its name: a count and a number need none. What is no column of runs.csv
/// may have one at the end of its name.
fn unit(column: &str) -> Option<&'static str> {
    let by_name = || column.ends_with("_s").then_some("s");
    columns::unit(column)
        .or_else(by_name)
        .filter(|unit| !["count", "number", "text"].contains(unit))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_have_units() {
        for (column, cells, title) in [
            ("time_s", "", "time (s)"),
            ("start_up_s", "", "start up (s)"),
            ("memory_high_water", "", "memory high water (B)"),
            ("message_bytes", "", "message bytes (B)"),
            ("difference_from_finest", "", "difference from finest (%)"),
            ("machine.node_memory.installed", "MiB", "installed (MiB)"),
            ("host.cpu_s", "", "host CPU (s)"),
            ("operations.ray", "", "rays counted"),
            ("speed_up", "", "speed-up (ratio)"),
        ] {
            assert_eq!(axis_title(&[column], cells), title);
        }
    }

    /// A time in another unit would be a mistake of the list of columns.
    #[test]
    fn every_time_is_in_seconds() {
        let times = columns::explained().filter(|(name, ..)| name.ends_with("_s"));
        assert!(times.map(|(name, unit, _)| assert_eq!(unit, "s", "{name}")).count() > 10);
    }
}
