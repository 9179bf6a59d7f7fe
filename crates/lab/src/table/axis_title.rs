//! Titles of axes: a column in words, with its unit.

use crate::table::columns::{COLUMNS, HOST};

/// The title of an axis for a column: its name in words, and the unit of its cells or, if they have none, of the
/// column.
pub fn axis_title(column: &str, unit_of_cells: &str) -> String {
    let words = words(column);
    let unit = if unit_of_cells.is_empty() { unit(column) } else { unit_of_cells };
    // "Message bytes" says it already.
    let said = words.split(' ').any(|word| word == unit);
    if unit.is_empty() || said { words } else { format!("{words} ({unit})") }
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

/// The unit of a column's numbers: as its description says, or as its name ends. Empty if it has none.
fn unit(column: &str) -> &'static str {
    let about = COLUMNS.iter().find(|known| known.name == column).map_or("", |known| known.about);
    let says = |unit: &str| {
        about.split(". ").any(|sentence| sentence.trim_end_matches('.').ends_with(unit))
    };
    if column.ends_with("_s") || column.starts_with(HOST) || says(", s") {
        "s"
    } else if says(", bytes") {
        "bytes"
    } else {
        ""
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_have_units() {
        for (column, cells, title) in [
            ("time_s", "", "time (s)"),
            ("start_up_s", "", "start up (s)"),
            ("memory_high_water", "", "memory high water (bytes)"),
            ("message_bytes", "", "message bytes"),
            ("difference_from_finest", "%", "difference from finest (%)"),
            ("machine.node_memory.installed", "MiB", "installed (MiB)"),
            ("host.cpu_s", "", "host CPU (s)"),
            ("operations.ray", "", "rays counted"),
            ("speed_up", "", "speed-up"),
        ] {
            assert_eq!(axis_title(column, cells), title);
        }
    }

    /// A time without a unit would be a mistake of the list of columns.
    #[test]
    fn every_time_has_a_unit() {
        let times = COLUMNS.iter().filter(|column| column.about.contains("ime that"));
        times.for_each(|column| {
            let share = column.about.starts_with("Share");
            assert!(share || unit(column.name) == "s", "{}", column.name);
        });
    }
}
